#include "compiler/src/join.hpp"

#include <algorithm>

#include "compiler/src/encode.hpp"

namespace vtm::compiler {
namespace {

using asset::Entry;

Entry join(const Partition& partition, const Partition::Top& top, std::span<const std::uint16_t> paints,
           asset::Asset& asset) {
    if (top.block)
        return encodeTree(partition.blocks()[*top.block].tree, paints, asset);
    const std::size_t index = asset.nodes.size();  // before its children's
    asset.nodes.emplace_back();
    asset::Node node;
    for (std::size_t i = 0; i < 16; ++i)
        node.children[i] = join(partition, top.children[i], paints, asset);
    const Entry first = node.children[0];
    if (first.kind() == Entry::Kind::Solid && std::all_of(node.children.begin(), node.children.end(),
                                                          [&](Entry e) { return e.bits == first.bits; })) {
        asset.nodes.pop_back();
        return first;
    }
    asset.nodes[index] = node;
    return Entry::make(Entry::Kind::Node, static_cast<std::uint32_t>(index));
}

}  // namespace

asset::Entry joinBlocks(const Partition& partition, std::span<const std::uint16_t> paints,
                        asset::Asset& asset) {
    std::size_t nodes = partition.blocks().size(), leaves = 0, pieces = 0;  // above blocks: fewer nodes
    for (const Partition::Block& block : partition.blocks()) {
        nodes += block.tree.nodes.size();
        leaves += block.tree.leaves.size();
        pieces += block.tree.pieces.size();
    }
    asset.nodes.reserve(nodes);
    asset.leaves.reserve(leaves);
    asset.pieces.reserve(pieces);
    return join(partition, partition.top(), paints, asset);
}

}  // namespace vtm::compiler
