/// \file
/// Placed symbols as the asset's records.
#pragma once

#include <cstdint>
#include <span>

#include <vtm/asset/asset.hpp>

namespace vtm::compiler {

struct PlacedSymbols;

/// Appends the maps of symbols and places them in the asset's first map, which lies at the origin. `paints`:
/// the asset's index of each paint.
void encodeInstances(const PlacedSymbols& placed, std::span<const std::uint16_t> paints, asset::Asset& asset);

}  // namespace vtm::compiler
