#include <cmath>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include "bench/input/synthetic.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {

Report scaling(const Options& options) {
    Report report;
    report.name = "scaling";
    report.title = "Growth over the number of curves";
    report.text =
        "Scenes of opaque blobs of four cubics, evenly strewn, as small as they are many, encoded with the "
        "default "
        "options, each in a process of its own. `cpu / (n log2 n)` is relative to the first row: where it "
        "does not rise, cost "
        "grows no faster than n log n. The peak is that of scene, compiler and asset together; `above scene` "
        "is "
        "what of it compiler and asset add to the scene, in bytes a curve.";
    double first = 0;
    for (double exponent = 2; exponent < 6.25; exponent += 0.5) {
        const auto curves = std::size_t(std::lround(std::pow(10, exponent)));
        if (curves > options.largest)
            break;
        scene::Scene scene;
        asset::Asset asset;
        const auto use = inChild([&] { scene = syntheticScene(curves); },
                                 [&] {
                                     asset = compiler::compile(scene).asset;
                                     return double(asset::summarize(asset).bytes);
                                 });
        if (!use) {
            report.notes.push_back(
                fmt::format("{} curves: the compiler refused or ran out of memory.", curves));
            continue;
        }
        const double relative = use->cpu / (double(curves) * std::log2(double(curves)));
        first = first == 0 ? relative : first;
        report.rows.push_back({{"curves", curves},
                               {"cpu ms", use->cpu},
                               {"wall ms", use->wall},
                               {"cpu / (n log2 n)", relative / first},
                               {"peak MB", use->peakBytes / 1e6},
                               {"above scene", (use->peakBytes - use->preparedBytes) / double(curves)},
                               {"asset bytes", std::size_t(use->result)},
                               {"bytes / curve", use->result / double(curves)}});
    }
    return report;
}

}  // namespace vtm::bench
