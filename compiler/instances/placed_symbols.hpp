/// \file
/// Maps, and where they are placed: in the picture and in each other.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "asset/instances.hpp"
#include "compiler/instances/symbol_map.hpp"
#include "compiler/paint/palette.hpp"

namespace vtm::compiler {

struct PlacedSymbol {
    std::uint32_t map = 0;   ///< of PlacedSymbols::maps
    asset::Affine2 toOuter;  ///< from its square, [0, 1]², to user units, or to that of the group around
    std::vector<PaintId> paints;  ///< by region: the ground first. Of a group's: the group's numbers
};

/// A map that consists of others, which stand behind it in PlacedSymbols::maps. What they leave free shows
/// the ground.
struct GroupMap {
    std::vector<PlacedSymbol> placed;
    std::uint32_t paints = 0;  ///< numbers that it names, but for 0
};

struct PlacedSymbols {
    std::vector<std::variant<SymbolMap, GroupMap>> maps;
    std::vector<PlacedSymbol> placed;   ///< in the picture
    std::vector<std::uint32_t> layers;  ///< of the picture, that are left; ascending
    double error = 0;                   ///< no boundary of an instance is farther off, in user units
};

}  // namespace vtm::compiler
