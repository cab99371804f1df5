#include <cmath>

#include <fmt/core.h>

#include "bench/src/font.hpp"
#include "bench/src/fragment_cost.hpp"
#include "bench/src/measure.hpp"
#include "bench/src/reports.hpp"
#include "compiler/compile.hpp"

namespace vtm::bench {
namespace {

/// Of the levels that count as the finest: all leaves, or all but the hundredth that lies deepest, at spots
/// where a single vertex of many edges asks for it.
constexpr double nearlyAll = 0.99;

double cellsInside(const asset::Asset& asset, unsigned level) {
    const double cell = std::ldexp(asset.maps.at(0).side, -2 * int(level));
    return std::ceil(asset.width / cell) * std::ceil(asset.height / cell);
}

/// The paper's flat grid with our pieces: every cell has room for two, whatever it holds.
double paperBytes(const asset::Asset& asset, unsigned level) {
    return cellsInside(asset, level) * 2 * sizeof(asset::Piece);
}

/// A grid that stores one entry for every cell of a level inside the picture, and what lies in its cells no
/// worse than the tree does: the tree's leaves, pieces and paints are counted once, though finer cells would
/// cut them up.
double flatBytes(const asset::Asset& asset, unsigned level) {
    const double tree = double(asset.nodes.size() * sizeof(asset::Node));
    return cellsInside(asset, level) * sizeof(asset::Entry) + double(asset::summarize(asset).bytes) - tree;
}

void addScene(const std::string& name, const scene::Scene& scene, Report& report, std::vector<double>& all) {
    const asset::Asset asset = compiler::compile(scene).asset;
    const asset::Summary summary = asset::summarize(asset);
    const SquareFigures figures = squareFigures(asset);
    const unsigned finest = levelHolding(figures, 1), usual = levelHolding(figures, nearlyAll);
    const double bytes = double(summary.bytes);
    all.push_back(flatBytes(asset, usual) / bytes);
    report.rows.push_back({{"picture", name},
                           {"asset bytes", summary.bytes},
                           {"of these tree", asset.nodes.size() * sizeof(asset::Node)},
                           {"finest level", finest},
                           {"flat / asset, finest", flatBytes(asset, finest) / bytes},
                           {"level of 99 %", usual},
                           {"flat / asset, 99 %", all.back()},
                           {"paper's flat / asset, 99 %", paperBytes(asset, usual) / bytes}});
}

}  // namespace

Report compression(const std::vector<File>& files, const std::string& font) {
    Report report;
    report.name = "compression";
    report.title = "Bytes against a flat grid";
    report.text =
        "A flat grid has an entry of 4 bytes for every cell of one size; the tree has nodes. Both have the "
        "same leaves, "
        "pieces and paints, although a grid as fine as the finest leaf would cut the coarser ones up: the "
        "factor is a "
        "lower bound. At the level of the finest leaf, and at the one that holds 99 % of the leaves, where a "
        "grid "
        "could not show the rest. The paper's flat grid has a slot of two pieces in every cell; with ours of "
        "16 bytes that is "
        "the last column, a lower bound too, since cells with more pieces would not fit. The paper reports 8 "
        "for its font.";
    std::vector<double> corpus, sheets;
    for (const File& file : files)
        addScene(file.name, load(file), report, corpus);
    std::string why;
    if (const auto sheet = fontSheet(font, why))
        addScene("font", *sheet, report, sheets);
    else
        report.notes.push_back("No font: " + why + ".");
    report.notes.push_back(fmt::format("Median over the files, level of 99 %: {:.3g}.", median(corpus)));
    return report;
}

}  // namespace vtm::bench
