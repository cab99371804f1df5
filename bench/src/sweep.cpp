#include <algorithm>

#include <fmt/core.h>

#include "bench/src/fragment_cost.hpp"
#include "bench/src/measure.hpp"
#include "bench/src/reports.hpp"
#include "compiler/compile.hpp"

namespace vtm::bench {
namespace {

struct Setting {
    std::string name;
    compiler::Options options;
};

/// Fixed settings, and what the compiler does when it is left alone.
std::vector<Setting> settings() {
    std::vector<Setting> all{{"default", {}}};
    for (const unsigned depth : {4u, 5u, 6u, 8u})
        for (const unsigned pieces : {2u, 4u, 8u, 12u, 16u, 24u, 48u}) {
            compiler::Options options;
            options.piecesPerLeaf = pieces;
            options.maxDepth = depth;
            all.push_back({fmt::format("{} pieces, depth {}", pieces, depth), options});
        }
    return all;
}

struct Point {
    double bytes = 0, cost = 0;
    std::uint32_t fallback = 0;
};

Point measure(const scene::Scene& scene, const compiler::Options& options) {
    const asset::Asset asset = compiler::compile(scene, options).asset;
    return {double(asset::summarize(asset).bytes), squareFigures(asset).fragmentCost, asset.fallbackLeaves};
}

/// Whether one is better in bytes or in cost, and not worse in the other.
bool dominates(const Point& a, const Point& b) {
    return a.bytes <= b.bytes && a.cost <= b.cost && (a.bytes < b.bytes || a.cost < b.cost);
}

/// A setting over all files: medians relative to the default, and how often it is on the front.
Json summaryOf(const std::string& setting, const Json& rows) {
    std::vector<double> bytes, costs, products;
    int front = 0, files = 0;
    double defaultBytes = 1, defaultCost = 1;
    for (const Json& row : rows) {
        if (row["setting"] == "default") {
            defaultBytes = row["bytes"].get<double>();
            defaultCost = row["fragment cost"].get<double>();
        }
        if (row["setting"] != setting)
            continue;
        ++files;
        front += row["front"] == "yes";
        bytes.push_back(row["bytes"].get<double>() / defaultBytes);
        costs.push_back(row["fragment cost"].get<double>() / defaultCost);
        products.push_back(row["bytes x cost / default"].get<double>());
    }
    return {{"setting", setting},
            {"bytes / default", median(bytes)},
            {"cost / default", median(costs)},
            {"bytes x cost / default", median(products)},
            {"on the front", fmt::format("{} of {}", front, files)}};
}

}  // namespace

Report sweep(const std::vector<File>& files) {
    Report report;
    report.name = "sweep";
    report.title = "Leaf size and depth: bytes against fragment cost";
    report.text = fmt::format(
        "At equal tolerance. Fragment cost in nanoseconds a pixel, averaged over the picture: {} for finding "
        "a square, {} "
        "more in a leaf, {} more for each of its pieces (measured with llvmpipe; only ratios matter). A "
        "point is on the "
        "front if no other of the same file is smaller and cheaper. Leaves that were averaged from samples "
        "disqualify a setting. The table has medians over the files; every file is in the JSON.",
        lookupCost, leafCost, pieceCost);
    const std::vector<Setting> all = settings();
    for (const File& file : files) {
        const scene::Scene scene = load(file);
        std::vector<Point> points;
        for (const Setting& setting : all)
            points.push_back(measure(scene, setting.options));
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool beaten = std::ranges::any_of(points, [&](const Point& other) {
                return other.fallback == 0 && dominates(other, points[i]);
            });
            report.rows.push_back({{"file", file.name},
                                   {"setting", all[i].name},
                                   {"bytes", std::size_t(points[i].bytes)},
                                   {"fragment cost", points[i].cost},
                                   {"bytes x cost / default",
                                    points[i].bytes * points[i].cost / (points[0].bytes * points[0].cost)},
                                   {"front", beaten || points[i].fallback > 0 ? "" : "yes"},
                                   {"fallback leaves", points[i].fallback}});
        }
    }
    for (const Setting& setting : all)
        report.summary.push_back(summaryOf(setting.name, report.rows));
    return report;
}

}  // namespace vtm::bench
