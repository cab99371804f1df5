/// \file
/// Trees as the asset's records: nodes in walking order, leaves, pieces.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "compiler/tree/build_tree.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// Appends the tree's records to the asset; `paints`: the asset's index of each of its paints. Returns the
/// root.
asset::Entry encodeTree(const Tree& tree, std::span<const std::uint16_t> paints, asset::Asset& asset);
/// The memory of pieces is freed as they are appended.
asset::Entry encodeTree(JoinedTree joined, std::span<const std::uint16_t> paints, asset::Asset& asset);

/// Throws LimitError if so many records are more squares and pieces than asset::maxDrawn: each map is drawn
/// once, and trees share nothing.
void checkDrawn(std::size_t maps, std::size_t nodes, std::size_t pieces);

/// Appends a node whose child i is the Entry child(i), which appends what lies below it to `nodes`. A node
/// stands before its children's, so that walks need no check for cycles. Children that are one solid make no
/// node: that solid is returned.
template <class Child>
asset::Entry appendNode(std::vector<asset::Node>& nodes, const Child& child) {
    using asset::Entry;
    const std::size_t index = nodes.size();
    nodes.emplace_back();
    asset::Node node;
    for (std::size_t i = 0; i < node.children.size(); ++i)
        node.children[i] = child(i);
    const Entry first = node.children[0];
    if (first.kind() == Entry::Kind::Solid &&
        std::ranges::all_of(node.children, [&](Entry e) { return e.bits == first.bits; })) {
        nodes.pop_back();  // solid children made no nodes
        return first;
    }
    nodes[index] = node;
    return Entry::make(Entry::Kind::Node, static_cast<std::uint32_t>(index));
}

}  // namespace vtm::compiler
