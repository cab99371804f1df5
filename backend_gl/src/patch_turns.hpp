/// \file
/// What a pixel of a cell takes of the driver's turns of loops, at most.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asset/planar_map.hpp"

namespace vtm::gl {

/// Of patch_fragment.glsl, for a list of so many pieces.
std::uint64_t solidTurns(std::size_t pieces);

/// Of patch_programs_fragment.glsl, for pieces `list` and the paint at the reference point. `turns`: by paint.
std::uint64_t turnsWithPrograms(std::span<const std::uint32_t> turns, std::uint32_t paint,
                           const std::vector<asset::PlanarPiece>& pieces,
                           std::span<const std::uint32_t> list);

}  // namespace vtm::gl
