/// \file
/// Kept blocks to an asset's one map.
#pragma once

#include "compiler/tree/partition.hpp"

namespace vtm::compiler {

/// Appends the blocks' trees to `next`: nodes, leaves, pieces and count of fallback leaves; `paints`: its
/// index of each paint. `last`: the asset that was joined before, if paints have the same indices there: the
/// blocks that were not built since are copied from it. Returns the root.
asset::Entry joinBlocks(Partition& partition, std::span<const std::uint16_t> paints, const asset::Asset* last,
                        asset::Asset& next);

}  // namespace vtm::compiler
