/// \file
/// What an asset costs a renderer that shades every pixel from its square of the tree.
#pragma once

#include <array>

#include <vtm/asset/asset.hpp>
#include "compiler/cost.hpp"

namespace vtm::bench {

/// The compiler's own weights, of which only the ratios matter: nanoseconds for a pixel of one colour; what
/// every pixel of a leaf pays; what each of the leaf's pieces adds.
inline constexpr double solidCost = compiler::CostModel::perSolidFragment,
                        leafCost = compiler::CostModel::perLeafFragment,
                        pieceCost = compiler::CostModel::perPiece;

struct SquareFigures {
    /// Nanoseconds a pixel, averaged over the picture. A square of w × h pixels is drawn as a quad half a
    /// pixel wider all round: (w + 1) (h + 1) times solidCost, or leafCost + pieces · pieceCost.
    double fragmentCost = 0;
    /// Squares by level.
    std::array<std::size_t, asset::maxLevel + 1> squares{};
    /// Leaves by level.
    std::array<std::size_t, asset::maxLevel + 1> leaves{};
};

/// Of the first map, whose squares outside the picture do not count.
SquareFigures squareFigures(const asset::Asset& asset);

/// The deepest level, and the one that holds `share` of all leaves at it or above.
unsigned levelHolding(const SquareFigures& figures, double share);

}  // namespace vtm::bench
