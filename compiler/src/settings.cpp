#include "compiler/src/settings.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vtm::compiler {
namespace {

/// A lattice step is this many bits finer than the tolerance: snapping moves points by a step or two.
constexpr int stepBits = 6;
/// Cells of the last level still have this many steps a side.
constexpr int lastCellBits = 4;

/// Of the whole tolerance: what chords may take from the curves, pieces from the chords, and rounding
/// from the pieces' ends. The eighth that is left is the lattice's: snapping moves a point by a step or
/// two, which are a sixteenth of the smallest tolerance each.
constexpr double chordShare = 3.0 / 16, fitShare = 1.0 / 2, quantisationShare = 3.0 / 16;

}  // namespace

void checkOptions(const Options& o) {
    if (!(o.tolerance >= std::ldexp(1.0, -26) && o.tolerance <= std::ldexp(1.0, -6)))
        throw std::invalid_argument("tolerance must lie in [2^-26, 2^-6]");
    if (!(o.nanosecondsPerByte >= 1 && o.nanosecondsPerByte <= 1e6))
        throw std::invalid_argument("nanosecondsPerByte must lie in [1, 1e6]");
    if (o.piecesPerLeaf && (*o.piecesPerLeaf < 1 || *o.piecesPerLeaf > 4096))
        throw std::invalid_argument("piecesPerLeaf must lie in [1, 4096]");
    if (o.maxDepth > asset::maxLevel)
        throw std::invalid_argument("maxDepth must be at most " + std::to_string(asset::maxLevel));
}

int latticeBits(const Options& o) {
    return std::min(maxLatticeBits, static_cast<int>(std::ceil(-std::log2(o.tolerance))) + stepBits);
}

double chordTolerance(const Options& o) { return std::ldexp(o.tolerance * chordShare, latticeBits(o)); }

TreeOptions treeOptions(const Options& o) {
    const int bits = latticeBits(o);
    TreeOptions t;
    t.fitTolerance = std::ldexp(o.tolerance * fitShare, bits);
    t.cost.nanosecondsPerByte = o.nanosecondsPerByte;
    t.piecesPerLeaf = o.piecesPerLeaf;
    t.maxDepth = std::min(o.maxDepth, static_cast<unsigned>(bits - lastCellBits) / 2);
    // A leaf's end points are rounded by half of 1/65535 of its side in each axis.
    const double widest = o.tolerance * quantisationShare * asset::leafExtent * std::sqrt(2.0);
    t.minDepth =
        std::min(t.maxDepth, static_cast<unsigned>(std::max(0.0, std::ceil(-std::log2(widest) / 2))));
    return t;
}

std::vector<StageTime> stageTimes(double lowered, double built, const TreeTimes& t) {
    return {{"lower", lowered},
            {"push", t.push},
            {"planarise", t.planarise},
            {"fit", t.fit},
            {"encode", built - t.push - t.planarise - t.fit}};
}

std::vector<std::string> warningsOf(const asset::Asset& asset, float colourError) {
    std::vector<std::string> warnings;
    if (asset.fallbackLeaves > 0)
        warnings.push_back(std::to_string(asset.fallbackLeaves) +
                           " leaves could not be certified and are filled with the mean of samples");
    if (colourError > 0)
        warnings.push_back("more than 65536 region colours: the nearest were merged, by up to " +
                           std::to_string(colourError) + " in a component");
    return warnings;
}

}  // namespace vtm::compiler
