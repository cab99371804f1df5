/// \file
/// Visiting every square of a map, solid or with pieces, or finding one.
#pragma once

#include <algorithm>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/limits/limits.hpp>

namespace vtm::asset {

/// The i-th of 16 squares that make one up.
inline Cell childOf(Cell cell, std::uint32_t i) {
    return {cell.x * 4 + i % 4, cell.y * 4 + i / 4, cell.level + 1};
}

/// Calls visit(Cell, Entry) for each Solid and Leaf entry below `entry`, depth first.
template <class Visit>
void walk(const AssetView& asset, Entry entry, Visit&& visit, Cell cell = {}) {
    if (entry.kind() != Entry::Kind::Node) {
        limits::check();
        visit(cell, entry);
        return;
    }
    const Node& node = asset.nodes[entry.payload()];
    for (std::uint32_t i = 0; i < 16; ++i)
        walk(asset, node.children[i], visit, childOf(cell, i));
}

/// The square of a tree that holds a point, and where in it, both from 0 to 1 along each side. A point on a
/// border belongs to the square of higher coordinates, if there is one.
struct SquareAt {
    Cell cell;
    Entry entry;
    glm::dvec2 within;
};
inline SquareAt squareAt(const AssetView& asset, Entry entry, glm::dvec2 p) {
    Cell cell;
    while (entry.kind() == Entry::Kind::Node) {
        p *= 4.0;
        const auto x = std::uint32_t(std::min(p.x, 3.0)), y = std::uint32_t(std::min(p.y, 3.0));
        p -= glm::dvec2(x, y);
        cell = {cell.x * 4 + x, cell.y * 4 + y, cell.level + 1};
        entry = asset.nodes[entry.payload()].children[y * 4 + x];
    }
    return {cell, entry, p};
}

}  // namespace vtm::asset
