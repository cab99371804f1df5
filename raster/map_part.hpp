/// \file
/// A map's boundaries by squares of its tree: a square can be made anew, and drawn, without the others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "raster/planar_map.hpp"

namespace vtm::asset {

/// What a square shows along a part of one of its borders.
struct Stretch {
    /// The border's line, counted in cells of the deepest level, above fromBits; then where the part begins,
    /// lattice steps. Lines seen from below are counted from 1, so that 24 bits hold all of either kind.
    std::uint64_t key;
    std::uint64_t to;
    std::uint32_t paint;

    static constexpr unsigned fromBits = 40;
    std::uint64_t line() const { return key >> fromBits; }
    std::uint64_t from() const { return key & ((std::uint64_t(1) << fromBits) - 1); }
};
static_assert(latticeExtent < std::int64_t(1) << Stretch::fromBits && 2 * maxLevel + Stretch::fromBits <= 64);

/// All borders of one direction, each seen from both of its sides.
struct Borders {
    std::vector<Stretch> below, above;  ///< from the squares with lower, with higher coordinates
};

/// A square of a map's tree.
struct MapPart {
    Cell cell;
    std::vector<PlanarPiece> pieces;  ///< the boundaries in it
    std::array<Borders, 2> borders;   ///< what its sides show: the horizontal ones, the vertical ones
};

/// `entry`: of the square.
MapPart mapPart(const AssetView& asset, Cell cell, Entry entry);
/// Squares that together are the one of `entry`: with about `pieces` pieces each, unless these are in one
/// leaf.
std::vector<MapPart> mapParts(const AssetView& asset, Cell cell, Entry entry, std::size_t pieces);

/// A piece wherever the two sides of some parts' borders show different paints. Beside a part without a
/// neighbour lies paint 0. With the parts' pieces these are all boundaries of the picture that has nothing
/// but these parts.
std::vector<PlanarPiece> seams(std::array<Borders, 2> borders);

}  // namespace vtm::asset
