/// \file
/// Visiting every square of a map, solid or with pieces.
#pragma once

#include "asset/asset.hpp"

namespace vtm::asset {

/// Calls visit(Cell, Entry) for each Solid and Leaf entry below `entry`, depth first.
template <class Visit>
void walk(const AssetView& asset, Entry entry, Visit&& visit, Cell cell = {}) {
    if (entry.kind() != Entry::Kind::Node) {
        visit(cell, entry);
        return;
    }
    const Node& node = asset.nodes[entry.payload()];
    for (std::uint32_t i = 0; i < 16; ++i)
        walk(asset, node.children[i], visit, {cell.x * 4 + i % 4, cell.y * 4 + i / 4, cell.level + 1});
}

}  // namespace vtm::asset
