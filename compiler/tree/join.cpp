#include "compiler/tree/join.hpp"

#include <algorithm>

#include "compiler/tree/append_node.hpp"
#include "compiler/tree/encode.hpp"

namespace vtm::compiler {
namespace {

using asset::Entry;
using Block = Partition::Block;

Entry shifted(Entry e, std::uint32_t nodes, std::uint32_t leaves) {
    if (e.kind() == Entry::Kind::Solid)
        return e;
    return Entry::make(e.kind(), e.payload() + (e.kind() == Entry::Kind::Leaf ? leaves : nodes));
}

class Joiner {
public:
    Joiner(Partition& partition, std::span<const std::uint16_t> paints, const asset::Asset* last,
           asset::Asset& next)
        : partition_(partition), paints_(paints), last_(last), next_(next) {}

    Entry run() {
        std::size_t nodes = partition_.blocks().size(), leaves = 0, pieces = 0;  // above blocks: fewer nodes
        for (const Block& block : partition_.blocks()) {
            nodes += block.tree.nodes.size();
            leaves += block.tree.leaves.size();
            pieces += block.tree.pieces.size();
        }
        next_.nodes.reserve(nodes);
        next_.leaves.reserve(leaves);
        next_.pieces.reserve(pieces);
        return join(partition_.top());
    }

private:
    Entry join(const Partition::Top& top) {
        if (top.block)
            return append(partition_.blocks()[*top.block]);
        return appendNode(next_.nodes, [&](std::size_t i) { return join(top.children[i]); });
    }

    Entry append(Block& block) {
        if (block.tree.root.kind() == Entry::Kind::Solid)  // no records, hence no place
            return encodeTree(block.tree, paints_, next_);
        const Block::Place place{{},
                                 static_cast<std::uint32_t>(next_.nodes.size()),
                                 static_cast<std::uint32_t>(next_.leaves.size()),
                                 static_cast<std::uint32_t>(next_.pieces.size())};
        const Entry root = last_ && block.place ? copy(block.tree, *block.place, place)
                                                : encodeTree(block.tree, paints_, next_);
        block.place = place;
        block.place->root = root;
        return root;
    }

    /// The tree's records from where they stand one after the other, faster than from the tree.
    Entry copy(const Tree& tree, const Block::Place& from, const Block::Place& to) {
        const std::uint32_t nodes = to.node - from.node, leaves = to.leaf - from.leaf,  // modulo 2^32
            pieces = to.piece - from.piece;
        const auto range = [](const auto& all, std::uint32_t first, std::size_t count) {
            return std::span(all).subspan(first, count);
        };
        for (asset::Node node : range(last_->nodes, from.node, tree.nodes.size())) {
            for (Entry& child : node.children)
                child = shifted(child, nodes, leaves);
            next_.nodes.push_back(node);
        }
        for (asset::Leaf leaf : range(last_->leaves, from.leaf, tree.leaves.size())) {
            leaf.firstPiece += pieces;
            next_.leaves.push_back(leaf);
        }
        const auto unchanged = range(last_->pieces, from.piece, tree.pieces.size());
        next_.pieces.insert(next_.pieces.end(), unchanged.begin(), unchanged.end());
        next_.fallbackLeaves += static_cast<std::uint32_t>(tree.unproven.size());
        return shifted(from.root, nodes, leaves);
    }

    Partition& partition_;
    const std::span<const std::uint16_t> paints_;
    const asset::Asset* const last_;
    asset::Asset& next_;
};

}  // namespace

asset::Entry joinBlocks(Partition& partition, std::span<const std::uint16_t> paints, const asset::Asset* last,
                        asset::Asset& next) {
    return Joiner(partition, paints, last, next).run();
}

}  // namespace vtm::compiler
