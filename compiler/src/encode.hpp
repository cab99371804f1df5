/// \file
/// Trees as the asset's records.
#pragma once

#include <span>

#include "compiler/src/tree.hpp"

namespace vtm::compiler {

/// Appends the tree's records to the asset; `paints`: the asset's index of each of its paints. Returns the
/// root.
asset::Entry encodeTree(const Tree& tree, std::span<const std::uint16_t> paints, asset::Asset& asset);

}  // namespace vtm::compiler
