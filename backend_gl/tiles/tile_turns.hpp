/// \file
/// What a pixel of a cell takes of the driver's turns of loops, at most.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/planar_map.hpp"
#include "raster/steepness.hpp"

namespace vtm::gl {

/// Of tile_fragment.glsl, for a list of so many pieces.
std::uint64_t solidTurns(std::size_t pieces);

/// What paints cost, by paint.
struct PaintCosts {
    std::span<const std::uint32_t> turns;  ///< of turns.hpp
    std::span<const asset::PaintChange> changes;
    float minSteep = 0;  ///< no pixel of the tile has a smaller one

    bool mayBeSteep(std::uint32_t paint) const { return changes[paint].steepness > minSteep; }
};

/// Of tile_programs_fragment.glsl, for pieces `list` and the paint at the reference point.
std::uint64_t turnsWithPrograms(const PaintCosts& costs, std::uint32_t paint,
                                const std::vector<asset::PlanarPiece>& pieces,
                                std::span<const std::uint32_t> list);

}  // namespace vtm::gl
