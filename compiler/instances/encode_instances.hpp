/// \file
/// Placed symbols as the asset's records.
#pragma once

#include <cstdint>
#include <span>

#include <glm/mat2x2.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::compiler {

struct PlacedSymbols;

/// By how much rounding it moves a corner of [0, 1]² at most, along x or y, in sides of the square around:
/// `linear` leads there.
double placementError(const glm::dmat2& linear);

/// Appends the maps of symbols and places them in the asset's first map, which lies at the origin. `paints`:
/// the asset's index of each paint.
void encodeInstances(const PlacedSymbols& placed, std::span<const std::uint16_t> paints, asset::Asset& asset);

}  // namespace vtm::compiler
