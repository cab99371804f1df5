#include "compiler/tree/encode.hpp"
#include <vtm/limits/limits.hpp>

#include <algorithm>
#include <string>

#include <vtm/compiler/compile.hpp>

namespace vtm::compiler {

using asset::Entry;

namespace {

/// All but the pieces.
asset::Entry encodeSquares(const Tree& tree, std::span<const std::uint16_t> paints, asset::Asset& asset) {
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
    limits::need(tree.nodes.size() * sizeof(asset::Node) + tree.leaves.size() * sizeof(asset::Leaf));
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
    asset.fallbackLeaves += static_cast<std::uint32_t>(tree.unproven.size());
    return entry(tree.root);
}

/// `indices`: the asset's index of each of the pieces' paints.
void encodePieces(std::span<const Tree::Piece> pieces, std::span<const std::uint16_t> indices,
                  std::vector<asset::Piece>& to) {
    limits::check();
    for (const Tree::Piece& p : pieces)
        to.push_back({p.a, p.b, p.slopeA, p.slopeB, indices[p.left], indices[p.right]});
}

}  // namespace

asset::Entry encodeTree(const Tree& tree, std::span<const std::uint16_t> paints, asset::Asset& asset) {
    const asset::Entry root = encodeSquares(tree, paints, asset);
    limits::need(tree.pieces.size() * sizeof(asset::Piece));
    encodePieces(tree.pieces, paints, asset.pieces);
    return root;
}

asset::Entry encodeTree(JoinedTree joined, std::span<const std::uint16_t> paints, asset::Asset& asset) {
    const asset::Entry root = encodeSquares(joined.tree, paints, asset);
    std::size_t count = asset.pieces.size();
    for (const JoinedTree::Block& block : joined.blocks)
        count += block.pieces.size();
    limits::need((count - asset.pieces.size()) * sizeof(asset::Piece));
    if (count > asset.pieces.capacity())
        asset.pieces.reserve(std::max(count, 2 * asset.pieces.capacity()));
    std::vector<std::uint16_t> indices;
    for (JoinedTree::Block& block : joined.blocks) {
        const JoinedTree::Block taken = std::move(block);
        indices.clear();
        for (const PaintId id : taken.paints)
            indices.push_back(paints[id]);
        encodePieces(taken.pieces, taken.paints.empty() ? paints : indices, asset.pieces);
    }
    return root;
}

void checkDrawn(std::size_t maps, std::size_t nodes, std::size_t pieces) {
    if (maps + 16 * nodes + pieces > asset::maxDrawn)
        throw LimitError("the picture needs more than " + std::to_string(asset::maxDrawn) +
                         " squares and pieces; a larger tolerance needs fewer");
}

}  // namespace vtm::compiler
