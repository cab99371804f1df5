/// \file
/// Nodes of a 16-tree, in walking order.
#pragma once

#include <algorithm>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::compiler {

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
