#include <cmath>

#include <fmt/core.h>

#include <vtm/compiler/compile.hpp>
#include "bench/input/files.hpp"
#include "bench/input/font.hpp"
#include "bench/measure/fragment_cost.hpp"
#include "bench/measure/measure.hpp"
#include "bench/reports/reports.hpp"

namespace vtm::bench {
namespace {

/// Of the levels that count as the finest: all leaves, or all but the hundredth that lies deepest, at spots
/// where a single vertex of many edges asks for it.
constexpr double nearlyAll = 0.99;
/// A vertex of three regions never fits in a leaf of two pieces; cells of a thousandth of the picture end
/// that.
constexpr unsigned pairDepth = 5;

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

struct Factors {
    std::vector<double> usual, asInPaper;
};

/// Leaves as the compiler likes them, and of at most two pieces, as the paper's cells.
void addScene(const std::string& name, const scene::Scene& scene, Report& report, Factors& all) {
    const asset::Asset asset = compiler::compile(scene, {.instances = false}).asset;
    const double bytes = double(asset::summarize(asset).bytes);
    const unsigned finest = levelHolding(squareFigures(asset), 1);
    all.usual.push_back(flatBytes(asset, finest) / bytes);

    const asset::Asset pairs =
        compiler::compile(scene, {.piecesPerLeaf = 2, .maxDepth = pairDepth, .instances = false}).asset;
    const double pairBytes = double(asset::summarize(pairs).bytes);
    const unsigned usual = levelHolding(squareFigures(pairs), nearlyAll);
    all.asInPaper.push_back(paperBytes(pairs, usual) / pairBytes);
    report.rows.push_back({{"picture", name},
                           {"asset bytes", std::size_t(bytes)},
                           {"of these tree", asset.nodes.size() * sizeof(asset::Node)},
                           {"finest level", finest},
                           {"flat / asset", all.usual.back()},
                           {"two pieces a leaf: bytes", std::size_t(pairBytes)},
                           {"level of 99 %", usual},
                           {"flat / these", flatBytes(pairs, usual) / pairBytes},
                           {"paper's flat / these", all.asInPaper.back()}});
}

}  // namespace

Report compression(const Options& options) {
    Report report;
    report.name = "compression";
    report.title = "Bytes against a flat grid";
    report.text =
        "A flat grid has an entry of 4 bytes for every cell of one size; the tree has nodes. Both have "
        "the same leaves, pieces and paints, although a grid as fine as the finest leaf would cut the "
        "coarser ones up: the factor is a lower bound. First the assets that the compiler makes when it "
        "is left alone. Its lists are as long as pays, so leaves are large, and little of an asset is "
        "tree. Then leaves of at most two pieces, the cells of the paper: here the tree goes where "
        "detail is, and a grid as fine as that must be so everywhere. The level, 5 at most, is the one "
        "that holds 99 % of the leaves. The paper's flat grid has a slot of two pieces in every cell, "
        "used or not; with ours of 16 bytes each that is the last column. The paper reports 8 for its "
        "font.";
    Factors corpus, sheets;
    for (const File& file : filesOf(options))
        addScene(file.name, load(file), report, corpus);
    std::string why;
    if (const auto sheet = fontSheet(options.font, why))
        addScene("font", *sheet, report, sheets);
    else
        report.notes.push_back("No font: " + why + ".");
    report.notes.push_back(fmt::format(
        "Medians over the files: {:.3g} for the compiler's own leaves; {:.3g} against the paper's flat "
        "grid for leaves of two pieces.",
        median(corpus.usual), median(corpus.asInPaper)));
    return report;
}

}  // namespace vtm::bench
