#include <fmt/core.h>

#include "bench/engines/contest.hpp"
#include "bench/measure/measure.hpp"

namespace vtm::bench {
namespace {

/// An engine among those of a process.
struct Target {
    std::string command, name;
    std::size_t index;
};

std::vector<Target> targetsOf(const Options& options, std::vector<std::string>& notes) {
    std::vector<Target> targets;
    for (const std::string& command : engineCommands(options, notes)) {
        const Engines engines = childEngines(command, notes);
        for (std::size_t i = 0; i < engines.size(); ++i)
            targets.push_back({command, engines[i]->name(), i});
    }
    return targets;
}

struct Peak {
    double bare, above;  ///< bytes of the process before it was given a file, and how much was added
};

/// Of a fresh process that draws one file once. Engines that read none are given the scene's paths.
Peak peakOf(const Target& target, const LoadedFile& picture, int side) {
    std::vector<std::string> known;  // what is missing was noted before
    const Engines engines = childEngines(target.command, known);
    Engine& engine = *engines.at(target.index);
    const double bare = engine.peakBytes().value();
    const asset::View view = viewOf(picture.scene, side, {.name = ""}, 0);
    if (!engine.drawCold(picture, view)) {
        engine.load(picture);
        engine.draw(view);
    }
    return {bare, engine.peakBytes().value() - bare};
}

}  // namespace

Report memory(const Options& options) {
    Report report;
    report.name = "memory";
    report.title = fmt::format("Peak memory at {} pixels", options.side);
    report.text =
        "From the file to pixels once, every engine in a fresh process: megabytes of its largest resident "
        "set "
        "beyond what it had before it was given the file (which is in brackets: runtime, libraries, driver). "
        "`skia` and `blend2d` are given a file of our paths. What a display server holds is in nobody's.";
    const std::vector<Target> targets = targetsOf(options, report.notes);
    for (const File& file : filesOf(options)) {
        fmt::print(stderr, "{}\n", file.name);
        const LoadedFile picture{file, load(file)};
        Json line = {{"file", file.name}};
        for (const Target& target : targets) {
            line[target.name] = "-";
            try {
                const Peak peak = peakOf(target, picture, options.side);
                report.rows.push_back({{"file", file.name},
                                       {"engine", target.name},
                                       {"MB", peak.above / 1e6},
                                       {"bare MB", peak.bare / 1e6}});
                line[target.name] = fmt::format("{:.3g} ({:.3g})", peak.above / 1e6, peak.bare / 1e6);
            } catch (const std::exception& refusal) {
                report.notes.push_back(
                    fmt::format("{}: not by {}: {}.", file.name, target.name, refusal.what()));
            }
        }
        report.summary.push_back(line);
    }
    return report;
}

}  // namespace vtm::bench
