#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include "bench/input/files.hpp"
#include "bench/measure/fragment_cost.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

struct Setting {
    std::string name;
    compiler::Options options;
};

/// Leaves of at most so many pieces, unless that is too deep.
std::vector<Setting> fixedSettings() {
    std::vector<Setting> all;
    for (const unsigned depth : {4u, 5u, 6u, 8u})
        for (const unsigned pieces : {2u, 4u, 8u, 12u, 16u, 24u, 48u}) {
            compiler::Options options;
            options.piecesPerLeaf = pieces;
            options.maxDepth = depth;
            all.push_back({fmt::format("{} pieces, depth {}", pieces, depth), options});
        }
    return all;
}

/// The cost model from bytes that are worth nearly nothing to bytes that are worth all, in steps of 2^(1/4).
std::vector<Setting> modelSettings() {
    std::vector<Setting> all;
    for (int step = 0; step <= 76; ++step) {
        compiler::Options options;
        options.nanosecondsPerByte = std::exp2(step / 4.0);
        all.push_back({fmt::format("{:.0f} ns a byte", options.nanosecondsPerByte), options});
    }
    return all;
}

struct Point {
    double bytes = 0, cost = 0;
    std::uint32_t fallback = 0;

    Point& operator+=(const Point& other) {
        bytes += other.bytes;
        cost += other.cost;
        fallback += other.fallback;
        return *this;
    }
};

Point measure(const scene::Scene& scene, const compiler::Options& options) {
    const asset::Asset asset = compiler::compile(scene, options).asset;
    return {double(asset::summarize(asset).bytes), squareFigures(asset).fragmentCost, asset.fallbackLeaves};
}

std::vector<Point> measureAll(const scene::Scene& scene, const std::vector<Setting>& settings) {
    std::vector<Point> points;
    for (const Setting& setting : settings)
        points.push_back(measure(scene, setting.options));
    return points;
}

/// The smallest of the model's assets that cost no more to draw and have no more averaged leaves: its number,
/// or noIndex.
constexpr std::size_t noIndex = std::numeric_limits<std::size_t>::max();
std::size_t smallestAt(const Point& fixed, const std::vector<Point>& model) {
    std::size_t best = noIndex;
    for (std::size_t i = 0; i < model.size(); ++i)
        if (model[i].cost <= fixed.cost && model[i].fallback <= fixed.fallback &&
            (best == noIndex || model[i].bytes < model[best].bytes))
            best = i;
    return best;
}

double ratioAt(const Point& fixed, const std::vector<Point>& model) {
    const std::size_t best = smallestAt(fixed, model);
    return best == noIndex ? std::numeric_limits<double>::quiet_NaN() : model[best].bytes / fixed.bytes;
}

void add(std::vector<Point>& sums, const std::vector<Point>& points) {
    sums.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        sums[i] += points[i];
}

}  // namespace

Report sweep(const Options& options) {
    const std::vector<File> files = filesOf(options);
    const std::vector<Setting> fixed = fixedSettings(), model = modelSettings();
    Report report;
    report.name = "sweep";
    report.title = "The cost model against fixed sizes of leaves";
    report.text = fmt::format(
        "At equal tolerance. Fragment cost in nanoseconds a pixel with the longer side on 1024 pixels: {} "
        "for a "
        "pixel of one colour, {} for one in a leaf and {} more for each of its pieces (measured with "
        "llvmpipe; only "
        "ratios matter). Against each fixed rule stands the smallest asset that the cost model gives that is "
        "drawn at no more cost, over values of nanosecondsPerByte in steps of 2^(1/4): one value for all "
        "files "
        "(the sums over them), and the best for each file alone.",
        solidCost, leafCost, pieceCost);
    std::vector<Point> fixedSums, modelSums;
    std::vector<std::vector<double>> ratios(fixed.size());
    for (const File& file : files) {
        const scene::Scene scene = load(file);
        const std::vector<Point> ofFixed = measureAll(scene, fixed), ofModel = measureAll(scene, model);
        add(fixedSums, ofFixed);
        add(modelSums, ofModel);
        for (const auto& [settings, points] : {std::pair(&fixed, &ofFixed), std::pair(&model, &ofModel)})
            for (std::size_t i = 0; i < settings->size(); ++i)
                report.rows.push_back({{"file", file.name},
                                       {"setting", (*settings)[i].name},
                                       {"model", settings == &model},
                                       {"bytes", std::size_t((*points)[i].bytes)},
                                       {"fragment cost", (*points)[i].cost},
                                       {"fallback leaves", (*points)[i].fallback}});
        for (std::size_t i = 0; i < fixed.size(); ++i)
            ratios[i].push_back(ratioAt(ofFixed[i], ofModel));
    }
    for (std::size_t i = 0; i < fixed.size(); ++i) {
        std::erase_if(ratios[i], [](double r) { return std::isnan(r); });
        const std::size_t best = smallestAt(fixedSums[i], modelSums);
        report.summary.push_back({{"fixed", fixed[i].name},
                                  {"KB", std::round(fixedSums[i].bytes / 1024)},
                                  {"cost", fixedSums[i].cost / double(files.size())},
                                  {"the model at", best == noIndex ? "none" : model[best].name},
                                  {"bytes of one model / fixed", ratioAt(fixedSums[i], modelSums)},
                                  {"file by file: median", median(ratios[i])},
                                  {"worst", ratios[i].empty() ? 0 : std::ranges::max(ratios[i])},
                                  {"files", fmt::format("{} of {}", ratios[i].size(), files.size())}});
    }
    return report;
}

}  // namespace vtm::bench
