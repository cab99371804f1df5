// What trees and instances each save against a flat grid, and what they cost when they are drawn.

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/scan.hpp>
#include "asset/walk.hpp"
#include "bench/input/files.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

constexpr Budget pictureBudget{1500, 300};

double nodesBelow(const asset::Asset& asset, asset::Entry entry) {
    if (entry.kind() != asset::Entry::Kind::Node)
        return 0;
    double nodes = 1;
    for (const asset::Entry child : asset.nodes[entry.payload()].children)
        nodes += nodesBelow(asset, child);
    return nodes;
}

/// Entries of 4 bytes for every cell of one size, the size of each map's finest leaf, in place of the nodes
/// of trees. Leaves, pieces and paints are counted as they are, though a finer grid would cut them up: a
/// lower bound.
double gridBytes(const asset::Asset& asset) {
    double nodes = 0, cells = 0;
    for (const asset::Map& map : asset.maps) {
        unsigned finest = 0;
        asset::walk(asset, map.root,
                    [&](asset::Cell cell, asset::Entry) { finest = std::max(finest, cell.level); });
        const bool isPicture = &map == &asset.maps.front();
        const double cell = std::ldexp(map.side, -2 * int(finest));
        cells += isPicture ? std::ceil(asset.width / cell) * std::ceil(asset.height / cell)
                           : std::ldexp(1.0, 4 * int(finest));
        nodes += nodesBelow(asset, map.root);
    }
    return double(asset::summarize(asset).bytes) + cells * sizeof(asset::Entry) - nodes * sizeof(asset::Node);
}

/// Turned a little more in each round.
asset::View viewOf(const asset::Asset& asset, int side, int round) {
    const double scale = side / std::max(asset.width, asset.height), angle = 0.1 + 0.02 * round;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    return {side, side, {c, s, -s, c, 0.05 * side, -0.05 * side}};
}

/// A sheet of 16 × 16 stars, as signs repeat on a map.
scene::Scene stars() {
    scene::Scene scene{512, 512, {}};
    scene::Path path{scene::MoveTo{{14, 0}}};
    for (int i = 1; i < 10; ++i) {
        const double angle = 0.62832 * i, radius = i % 2 == 0 ? 14 : 6;
        path.push_back(scene::LineTo{{radius * std::cos(angle), radius * std::sin(angle)}});
    }
    path.push_back(scene::Close{});
    const auto star = std::make_shared<const scene::Path>(std::move(path));
    for (int i = 0; i < 256; ++i)
        scene.root.children.push_back(
            {scene::Item{star, scene::translation(16 + 32 * (i % 16), 16 + 32 * (i / 16)),
                         scene::FillRule::NonZero, scene::Color{}, 1}});
    return scene;
}

void addPicture(const std::string& name, const scene::Scene& scene, const Options& options, Report& report) {
    const asset::Asset both = compiler::compile(scene).asset;
    if (!both.filters.empty()) {
        report.notes.push_back(name + ": left out, a picture with filters is not one map.");
        return;
    }
    const asset::Asset tree = compiler::compile(scene, {.instances = false}).asset;
    const asset::Scanner scanner(both), flatScanner(tree);
    int a = 0, b = 0;
    const Paired time =
        pairwise([&] { flatScanner.draw(viewOf(tree, options.side, a++)); },
                 [&] { scanner.draw(viewOf(both, options.side, b++)); }, pictureBudget.of(options), 21);
    const double grid = gridBytes(tree);
    report.rows.push_back({{"file", name},
                           {"flat grid, bytes", std::size_t(grid)},
                           {"tree", asset::summarize(tree).bytes},
                           {"instances", std::size_t(gridBytes(both))},
                           {"both", asset::summarize(both).bytes},
                           {"flat / tree", grid / double(asset::summarize(tree).bytes)},
                           {"flat / instances", grid / gridBytes(both)},
                           {"flat / both", grid / double(asset::summarize(both).bytes)},
                           {"instances placed", both.instances.size()},
                           {"tree, ms", time.first},
                           {"both, ms", time.second},
                           {"both / tree", time.ratio}});
}

}  // namespace

Report recursion(const Options& options) {
    Report report;
    report.name = "recursion";
    report.title = "Trees and instances";
    report.text = fmt::format(
        "Bytes as a flat grid of equal cells, as trees of cells, with shapes that repeat stored once but "
        "grids in place "
        "of trees, and with both, which is what the compiler makes. Grids have 4 bytes a cell; leaves, "
        "pieces and paints are "
        "counted as the tree has them, so that grids are lower bounds. Then CPU milliseconds of "
        "`asset::Scanner` turning the "
        "picture at {} pixels, without instances and with them, in turns, and their ratio pair by pair.",
        options.side);
    addPicture("256 stars", stars(), options, report);
    for (const File& file : filesOf(options))
        addPicture(file.name, load(file), options, report);
    const auto medianOf = [&](const char* column) {
        std::vector<double> values;
        for (const Json& row : report.rows)
            values.push_back(row[column]);
        return median(values);
    };
    report.notes.push_back(
        fmt::format("Medians: {:.3g} times smaller than the flat grid by trees, {:.3g} by instances, {:.3g} "
                    "by both; drawn in {:.3g} of the time without instances.",
                    medianOf("flat / tree"), medianOf("flat / instances"), medianOf("flat / both"),
                    medianOf("both / tree")));
    return report;
}

}  // namespace vtm::bench
