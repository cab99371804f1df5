/// \file
/// What the runner runs: a case has a dotted name, stands in a file, says what it is about, and has an
/// outcome.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <vtm/image/bitmap.hpp>
#include "conformance/compare/compare.hpp"
#include "conformance/runner/judge/faults.hpp"

namespace vtm::conformance {

/// Who draws. Scan is the fast CPU route of the same asset that Asset evaluates; Reference is the truth's own
/// engine, judged on pixels that are finer (docs/testing.md).
enum class Engine { Gl, Asset, Scan, Reference };
inline constexpr Engine allEngines[] = {Engine::Gl, Engine::Asset, Engine::Scan, Engine::Reference};
std::string_view nameOf(Engine engine);
/// Throws std::runtime_error for a name that is none.
Engine engineOf(std::string_view name);

/// How a case is run.
struct Setting {
    std::vector<Engine> engines{std::begin(allEngines), std::end(allEngines)};  ///< those that may be asked
    Fault fault = Fault::None;                                                  ///< injected on purpose
    bool keepPictures = false;                                                  ///< of cases that pass, too
    bool shrink = true;                                                         ///< scenes that fail
};

/// The worst that an engine did in a case.
struct Figure {
    std::string engine, view;
    compare::Difference difference;
    double flat = 0;     ///< largest difference where the expected picture is flat (judge.hpp)
    std::string broken;  ///< the bound that does not hold, or empty
};

struct Pictures {
    std::string engine, view;
    image::Raster expected, drawn;
};

struct Outcome {
    enum class Status { Passed, Failed, Skipped };
    Status status = Status::Passed;
    std::string message;  ///< why it failed or was skipped
    std::vector<Figure> figures;
    std::optional<Pictures> pictures;  ///< the worst ones, where it failed or they are to be kept

    static Outcome passed() { return {}; }
    static Outcome failed(std::string why) { return {Status::Failed, std::move(why), {}, {}}; }
    static Outcome skipped(std::string why) { return {Status::Skipped, std::move(why), {}, {}}; }
};

struct Case {
    std::string name;   ///< suite.folder.file.variant
    std::string file;   ///< where it stands
    std::string about;  ///< what it includes and excludes
    /// May throw, which is a failure; called on any thread, once at a time.
    std::function<Outcome(const Setting&)> run;
};

}  // namespace vtm::conformance
