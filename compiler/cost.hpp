/// \file
/// What a leaf costs: bytes of the asset against time to draw it.
///
/// cost = nanoseconds + nanosecondsPerByte · bytes, with
///   bytes(leaf of p pieces) = 16 + 16 p, bytes(node) = 64,
///   nanoseconds = (side + 1)² · (perLeafFragment + p · perPiece) for a leaf of `side` pixels when the
/// picture's longer side is drawn with nominalPixels: a leaf's quad covers its square and half a pixel
/// round it, and every fragment adds up all pieces.
/// The weights are those of a software rasteriser (docs/regions.md); a GPU's differ by a common factor,
/// which only moves the balance that nanosecondsPerByte sets.
#pragma once

#include <array>
#include <cstddef>

#include <vtm/asset/asset.hpp>

namespace vtm::compiler {

struct CostModel {
    double nanosecondsPerByte = 700;

    static constexpr double nominalPixels = 1024;
    static constexpr double perLeafFragment = 50, perPiece = 43, perSolidFragment = 5;

    /// Of a map that is drawn on so many pixels a side.
    static constexpr std::array<double, asset::maxLevel + 1> areasFor(double side) {
        std::array<double, asset::maxLevel + 1> areas{};
        for (double& a : areas) {
            a = (side + 1) * (side + 1);
            side /= 4;
        }
        return areas;
    }

    std::array<double, asset::maxLevel + 1> area = areasFor(nominalPixels);  ///< by level: (side + 1)²

    double drawing(double pieces, unsigned level) const {
        return area[level] * (pieces > 0 ? perLeafFragment + pieces * perPiece : perSolidFragment);
    }
    double leaf(double pieces, unsigned level) const {
        return drawing(pieces, level) + nanosecondsPerByte * (pieces > 0 ? 16 + 16 * pieces : 0);
    }
    double node() const { return nanosecondsPerByte * 64; }
};

}  // namespace vtm::compiler
