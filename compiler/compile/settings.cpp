#include "compiler/compile/settings.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vtm::compiler {
namespace {

/// A lattice step is this many bits finer than the tolerance: snapping moves points by a step or two.
constexpr int stepBits = 6;
/// Deeper levels save no drawing.
constexpr unsigned usualDepth = 8;
/// Cells of that level still have this many steps a side.
constexpr int lastCellBits = 4;
/// So have those that are split because they are not proven: an eighth of the tolerance or a quarter, whose
/// diagonal fits into the budget (ErrorBudget::mean). Means are of 4 × 4 points, which take two steps each.
constexpr int smallestCellBits = 3;

}  // namespace

void checkOptions(const Options& o) {
    if (!(o.tolerance >= std::ldexp(1.0, -26) && o.tolerance <= std::ldexp(1.0, -6)))
        throw std::invalid_argument(fmt::format("tolerance is {}, not in [2^-26, 2^-6]", o.tolerance));
    if (!(o.nanosecondsPerByte >= 1 && o.nanosecondsPerByte <= 1e6))
        throw std::invalid_argument(
            fmt::format("nanosecondsPerByte is {}, not in [1, 1e6]", o.nanosecondsPerByte));
    if (o.piecesPerLeaf && (*o.piecesPerLeaf < 1 || *o.piecesPerLeaf > 4096))
        throw std::invalid_argument(fmt::format("piecesPerLeaf is {}, not in [1, 4096]", *o.piecesPerLeaf));
    if (o.filterPixels > maxFilterPixels)
        throw std::invalid_argument(
            fmt::format("filterPixels is {}, not in [0, {}]", o.filterPixels, maxFilterPixels));
    if (o.maxDepth > asset::maxLevel)
        throw std::invalid_argument(
            fmt::format("maxDepth is {}, not in [0, {}]", o.maxDepth, asset::maxLevel));
}

int latticeBits(const Options& o) {
    return std::min(maxLatticeBits, static_cast<int>(std::ceil(-std::log2(o.tolerance))) + stepBits);
}

ErrorBudget errorBudget(const Options& o) { return {o.tolerance, latticeBits(o)}; }

TreeOptions treeOptions(const Options& o) {
    TreeOptions t(errorBudget(o));
    t.maxWork = o.maxWork;
    t.cost.nanosecondsPerByte = o.nanosecondsPerByte;
    t.piecesPerLeaf = o.piecesPerLeaf;
    t.maxDepth = std::min({o.maxDepth, usualDepth, static_cast<unsigned>(latticeBits(o) - lastCellBits) / 2});
    t.minDepth = std::min(t.maxDepth, t.budget.coarsestLevel());
    const auto finest = static_cast<unsigned>(latticeBits(o) - smallestCellBits) / 2;
    t.lastDepth = std::max(t.maxDepth, std::min(o.maxDepth, finest));
    return t;
}

std::vector<StageTime> stageTimes(double lowered, double built, const TreeTimes& t) {
    return {{"lower", lowered},
            {"divide", t.divide},
            {"planarise", t.planarise},
            {"fit", t.fit},
            {"encode", built - t.divide - t.planarise - t.fit}};
}

void certify(const Tree& tree, const ErrorBudget& budget, Result& result) {
    result.provenError = std::max(result.provenError, budget.share(tree.error));
    const double longer = std::max(result.asset.width, result.asset.height);
    const auto picture = [&](Coord steps) { return longer * budget.share(steps + 1.0); };
    for (const Square& s : tree.unproven)
        result.unproven.push_back({picture(s.x0), picture(s.y0), longer * budget.share(s.side)});
}

double finestPixel(const Result& result) {
    return result.provenError * std::max(result.asset.width, result.asset.height) / asset::finestShare;
}

std::vector<std::string> warningsOf(const Result& result, const Options& options, float colourError) {
    std::vector<std::string> warnings;
    if (!result.unproven.empty())
        warnings.push_back(std::to_string(result.unproven.size()) +
                           " leaves could not be told apart and are filled with the mean of samples");
    if (result.provenError > options.tolerance)
        warnings.push_back("boundaries are proven to lie within " +
                           std::to_string(result.provenError / options.tolerance) + " tolerances only");
    if (colourError > 0)
        warnings.push_back("more than 65536 region colours: the nearest were merged, by up to " +
                           std::to_string(colourError) + " in a component");
    return warnings;
}

}  // namespace vtm::compiler
