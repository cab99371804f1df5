/// \file
/// Kept blocks to an asset's one map.
#pragma once

#include "compiler/src/partition.hpp"

namespace vtm::compiler {

/// Appends the blocks' trees to the asset's nodes, leaves, pieces and count of fallback leaves; `paints`: the
/// asset's index of each paint. Returns the root.
asset::Entry joinBlocks(const Partition& partition, std::span<const std::uint16_t> paints,
                        asset::Asset& asset);

}  // namespace vtm::compiler
