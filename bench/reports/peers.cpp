#include <fmt/core.h>
#include <tbb/global_control.h>

#include <vtm/compiler/compile.hpp>
#include "bench/engines/peer_rsvg.hpp"
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

constexpr int width = 1024;  ///< pixels
constexpr Budget fileBudget{4000, 1000};
constexpr int maxPairs = 41;

/// The whole picture, `width` pixels wide.
asset::View viewOf(const scene::Scene& scene) {
    const double scale = width / scene.width;
    return {width, std::max(1, int(scale * scene.height + 0.5)), {scale, 0, 0, scale, 0, 0}};
}

/// Median of wall milliseconds, on all cores.
double wallTime(const scene::Scene& scene) {
    std::vector<double> times;
    for (int i = 0; i < 7; ++i) {
        const double start = wallMilliseconds();
        compiler::compile(scene);
        times.push_back(wallMilliseconds() - start);
    }
    return median(times);
}

/// Compiles on one core while it lives.
class OneCore {
    tbb::global_control maximum_{tbb::global_control::max_allowed_parallelism, 1};
};

void addCompared(const File& file, double spend, Report& report) {
    const scene::Scene scene = load(file);
    const asset::View view = viewOf(scene);
    Rsvg rsvg(file.path, scene.width, scene.height);
    const Paired time = [&] {
        const OneCore one;
        return pairwise([&] { rsvg.draw(view); }, [&] { compiler::compile(scene); }, spend, maxPairs);
    }();
    const asset::Summary summary = asset::summarize(compiler::compile(scene).asset);
    report.rows.push_back({{"file", file.name},
                           {"librsvg ms", time.first},
                           {"encode ms", time.second},
                           {"encode / librsvg", time.ratio},
                           {"quartiles", fmt::format("{:.3g}-{:.3g}", time.low, time.high)},
                           {"pairs", time.pairs},
                           {"on all cores, wall ms", wallTime(scene)},
                           {"asset bytes", summary.bytes},
                           {"pieces", summary.pieces}});
}

void addAlone(const File& file, Report& report) {
    const scene::Scene scene = load(file);
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) {
        const OneCore one;
        times.push_back(spentTime([&] { compiler::compile(scene); }));
    }
    const asset::Summary summary = asset::summarize(compiler::compile(scene).asset);
    report.rows.push_back({{"file", file.name},
                           {"encode ms", median(times)},
                           {"asset bytes", summary.bytes},
                           {"pieces", summary.pieces}});
}

}  // namespace

Report peers(const Options& options) {
    Report report;
    report.name = "peers";
    report.title = "Encoding against drawing once";
    const std::optional<std::string> peer = rsvgVersion();
    report.text =
        peer.value_or("librsvg, which is missing here (librsvg2-dev),") +
        " draws each file once, 1024 pixels wide, from a parsed handle; we encode it from a scene in "
        "memory, with the default options. CPU time on one core, the two taking turns: medians, and the "
        "median and the quartiles of the ratios pair by pair.";
    for (const File& file : filesOf(options))
        try {
            peer ? addCompared(file, fileBudget.of(options), report) : addAlone(file, report);
        } catch (const RsvgError& error) {
            report.notes.push_back(file.name + ": " + error.what() + ".");
        }
    return report;
}

}  // namespace vtm::bench
