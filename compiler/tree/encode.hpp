/// \file
/// Trees as the asset's records.
#pragma once

#include <span>

#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// Appends the tree's records to the asset; `paints`: the asset's index of each of its paints. Returns the
/// root.
asset::Entry encodeTree(const Tree& tree, std::span<const std::uint16_t> paints, asset::Asset& asset);

/// Throws LimitError if so many records are more squares and pieces than asset::maxDrawn: each map is drawn
/// once, and trees share nothing.
void checkDrawn(std::size_t maps, std::size_t nodes, std::size_t pieces);

}  // namespace vtm::compiler
