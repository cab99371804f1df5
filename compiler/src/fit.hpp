/// \file
/// Boundaries to pieces: chains of planar edges become Hermite cubics in leaf coordinates.
#pragma once

#include <vector>

#include "asset/asset.hpp"
#include "compiler/src/planar.hpp"

namespace vtm::compiler {

struct FittedLeaf {
    std::vector<asset::Piece> pieces;
    std::array<std::uint16_t, 4> corners{};
};

/// Every point of a chain lies within `tolerance` lattice steps (plus the leaf's quantisation, half
/// of 1/65535 of its side) of the chain's pieces. End points on the border stay on it, inner ones
/// inside, and none is a corner: what a renderer may rely on.
FittedLeaf fit(const Square& square, const PlanarLeaf& leaf, double tolerance);

}  // namespace vtm::compiler
