/// \file
/// The turns that engines take.
#pragma once

#include <span>

#include "bench/engines/engine.hpp"
#include "bench/reports/reports.hpp"

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

/// Contender::difference of what lacks something or has it elsewhere. Antialiasing or none makes less
/// than 1.6 on our files, what a peer leaves out 3 and more.
inline constexpr double otherPicture = 2.5;

/// Views that are measured together.
struct Kind {
    const char* name;
    double zoom = 1;
    bool moving = true, cold = false;
    double size = 1;       ///< of the raster, by the side that is asked for
    bool zooming = false;  ///< from 1/16 to 64 times, twice as large with every round
};

/// The zoom path's rounds: 1/16 to 64 times.
inline constexpr int zoomRounds = 11;

/// How long turns are taken.
struct Patience {
    double budget;        ///< CPU milliseconds of a file and a kind of views, all engines
    int fewest, maximum;  ///< rounds
    double longest;       ///< CPU milliseconds of one drawing: who takes longer is out, and is noted
};
Patience patienceOf(const Options& options);

/// Turned and enlarged about the picture's middle, more with each step; its longer side fills `side` pixels
/// at zoom 1.
asset::View viewOf(const scene::Scene& scene, int side, const Kind& kind, int step);

/// Ours and every peer that is here, each in a process of its own, so that none pays for another one's memory
/// and threads; the others are noted by name.
Contenders contenders(const Options& options, std::vector<std::string>& notes);

/// The commands of their processes, for what wants fresh ones. The missing are noted.
std::vector<std::string> engineCommands(const Options& options, std::vector<std::string>& notes);

/// The last of ours, which the others are compared with.
const Contender& reference(const Contenders& all);

/// Loads a picture everywhere and compares what each makes of it. Writes what they draw at the zooms of
/// `kinds`, if wanted. What an engine cannot do is noted.
void prepare(Contenders& all, const LoadedFile& picture, std::span<const Kind> kinds, const Options& options,
             std::vector<std::string>& notes);

/// All take turns, a view a round; the first round is not counted. Leaves their times. An engine that fails
/// is out until the next kind of views.
void takeTurns(Contenders& all, const LoadedFile& picture, const Kind& kind, int side,
               const Patience& patience, std::vector<std::string>& notes);

}  // namespace vtm::bench
