#include "compiler/tree/encode.hpp"
#include <vtm/limits/limits.hpp>

#include <string>

#include <vtm/compiler/compile.hpp>

namespace vtm::compiler {

using asset::Entry;

asset::Entry encodeTree(const Tree& tree, std::span<const std::uint16_t> paints, asset::Asset& asset) {
    const auto nodes = static_cast<std::uint32_t>(asset.nodes.size()),
               leaves = static_cast<std::uint32_t>(asset.leaves.size()),
               pieces = static_cast<std::uint32_t>(asset.pieces.size());
    const auto entry = [&](Entry e) {
        switch (e.kind()) {
            case Entry::Kind::Solid:
                return Entry::make(e.kind(), paints[e.payload()]);
            case Entry::Kind::Leaf:
                return Entry::make(e.kind(), e.payload() + leaves);
            case Entry::Kind::Node:
            case Entry::Kind::Instances:  // a built tree has none
                break;
        }
        return Entry::make(e.kind(), e.payload() + nodes);
    };
    limits::need(tree.nodes.size() * sizeof(asset::Node) + tree.leaves.size() * sizeof(asset::Leaf) +
                 tree.pieces.size() * sizeof(asset::Piece));
    for (asset::Node node : tree.nodes) {
        limits::check();
        for (Entry& e : node.children)
            e = entry(e);
        asset.nodes.push_back(node);
    }
    for (const Tree::Leaf& l : tree.leaves) {
        limits::check();
        asset::Leaf leaf;
        leaf.firstPiece = l.firstPiece + pieces;
        leaf.pieceCount = static_cast<std::uint16_t>(l.pieceCount);
        for (std::size_t k = 0; k < 4; ++k)
            leaf.corners[k] = paints[l.corners[k]];
        asset.leaves.push_back(leaf);
    }
    for (const Tree::Piece& p : tree.pieces)
        asset.pieces.push_back({p.a, p.b, p.slopeA, p.slopeB, paints[p.left], paints[p.right]});
    asset.fallbackLeaves += static_cast<std::uint32_t>(tree.unproven.size());
    return entry(tree.root);
}

void checkDrawn(std::size_t maps, std::size_t nodes, std::size_t pieces) {
    if (maps + 16 * nodes + pieces > asset::maxDrawn)
        throw LimitError("the picture needs more than " + std::to_string(asset::maxDrawn) +
                         " squares and pieces; a larger tolerance needs fewer");
}

}  // namespace vtm::compiler
