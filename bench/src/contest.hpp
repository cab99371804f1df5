/// \file
/// The turns that engines take in `bench_report drawing`.
#pragma once

#include <span>

#include "bench/src/engine.hpp"
#include "bench/src/reports.hpp"

namespace vtm::bench {

/// An engine and what it did with the present picture.
struct Contender {
    std::unique_ptr<Engine> engine;
    bool ours = false;
    bool loads = false;              ///< it reads the picture
    bool able = false;               ///< and has not failed with the present kind of views
    double difference = 0;           ///< rms from ours, means over 64ths of the side, of 255
    std::vector<double> times = {};  ///< of the present kind of views, a round each; empty if it draws none
};
using Contenders = std::vector<Contender>;

/// Views that are measured together.
struct Kind {
    const char* name;
    double zoom;
    bool moving, cold;
};

/// Ours and every peer that is here; the others are noted by name.
Contenders contenders(const DrawingOptions& options, std::vector<std::string>& notes);

/// The last of ours, which the others are compared with.
const Contender& reference(const Contenders& all);

/// Loads a picture everywhere and compares what each makes of it. Writes what they draw at the zooms of
/// `kinds`, if wanted. What an engine cannot do is noted.
void prepare(Contenders& all, const Picture& picture, std::span<const Kind> kinds,
             const DrawingOptions& options, std::vector<std::string>& notes);

/// All take turns, a view a round; the first round is not counted. Leaves their times. An engine that fails
/// is out until the next kind of views.
void takeTurns(Contenders& all, const Picture& picture, const Kind& kind, int side,
               std::vector<std::string>& notes);

}  // namespace vtm::bench
