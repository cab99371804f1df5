#include "compiler/src/tree.hpp"

#include <algorithm>
#include <optional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "compiler/src/block.hpp"

namespace vtm::compiler {
namespace {

using asset::Entry;

/// A cell with no more strands than this, or than this part of the picture's, or on this level, is a
/// block: small enough to keep all processors busy, large enough to be worth a thread's while.
constexpr std::size_t blockStrands = 64;
constexpr std::size_t blockShare = 64;
constexpr unsigned blockLevel = 3;

/// The tree above the blocks.
struct Top {
    std::optional<std::size_t> block;
    std::vector<Top> children;  ///< 16 if it is not a block
};

class TopBuilder {
public:
    TopBuilder(const Picture& picture, Painter& painter, std::size_t strands)
        : points_(picture.outlines.points),
          culler_(picture, painter),
          most_(std::max(blockStrands, strands / blockShare)) {}

    /// The cells of blocks are culled.
    Top run(Cell cell) {
        culler_.run(cell);
        if (cell.strands.size() <= most_ || cell.level >= blockLevel) {
            blocks.push_back(std::move(cell));
            return {blocks.size() - 1, {}};
        }
        Top top;
        std::array<Cell, 16> children;
        splitCell(points_, cell, children);
        cell = {};
        for (Cell& child : children)
            top.children.push_back(run(std::move(child)));
        return top;
    }

    std::vector<Cell> blocks;

private:
    const Points points_;
    Culler culler_;
    const std::size_t most_;
};

/// Joins blocks in walking order, so that the result does not depend on where blocks begin.
class Assembler {
public:
    explicit Assembler(const std::vector<Tree>& blocks) : blocks_(blocks) {}

    Tree run(const Top& top) {
        tree_.root = join(top);
        return std::move(tree_);
    }

private:
    Entry join(const Top& top) {
        if (top.block) {
            const Tree& block = blocks_[*top.block];
            paints_.assign(block.palette.size(), unknown);
            tree_.error = std::max(tree_.error, block.error);
            tree_.unproven.insert(tree_.unproven.end(), block.unproven.begin(), block.unproven.end());
            return copy(block, block.root);
        }
        const std::size_t index = tree_.nodes.size();
        tree_.nodes.emplace_back();
        asset::Node node;
        for (std::size_t i = 0; i < 16; ++i)
            node.children[i] = join(top.children[i]);
        const Entry first = node.children[0];
        if (first.kind() == Entry::Kind::Solid &&
            std::all_of(node.children.begin(), node.children.end(),
                        [&](Entry e) { return e.bits == first.bits; })) {
            tree_.nodes.pop_back();
            return first;
        }
        tree_.nodes[index] = node;
        return Entry::make(Entry::Kind::Node, static_cast<std::uint32_t>(index));
    }

    Entry copy(const Tree& block, Entry entry) {
        switch (entry.kind()) {
            case Entry::Kind::Solid:
                return Entry::make(Entry::Kind::Solid, paint(block, entry.payload()));
            case Entry::Kind::Leaf:
                return copy(block, block.leaves[entry.payload()]);
            case Entry::Kind::Node:
                break;
        }
        const std::size_t index = tree_.nodes.size();
        tree_.nodes.emplace_back();
        for (std::size_t i = 0; i < 16; ++i) {
            const Entry child = copy(block, block.nodes[entry.payload()].children[i]);
            tree_.nodes[index].children[i] = child;
        }
        return Entry::make(Entry::Kind::Node, static_cast<std::uint32_t>(index));
    }

    Entry copy(const Tree& block, Tree::Leaf leaf) {
        const std::uint32_t first = leaf.firstPiece;
        leaf.firstPiece = static_cast<std::uint32_t>(tree_.pieces.size());
        for (PaintId& corner : leaf.corners)
            corner = paint(block, corner);
        for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
            Tree::Piece piece = block.pieces[first + i];
            piece.left = paint(block, piece.left);
            piece.right = paint(block, piece.right);
            tree_.pieces.push_back(piece);
        }
        tree_.leaves.push_back(leaf);
        return Entry::make(Entry::Kind::Leaf, static_cast<std::uint32_t>(tree_.leaves.size() - 1));
    }

    PaintId paint(const Tree& block, PaintId local) {
        if (local >= paints_.size())
            return local;  // a mask's, which is no paint of the palette
        if (paints_[local] == unknown)
            paints_[local] = tree_.palette.add(block.palette[local]);
        return paints_[local];
    }

    static constexpr PaintId unknown = 0xFFFFFFFFu;
    const std::vector<Tree>& blocks_;
    std::vector<PaintId> paints_;  ///< of the block at hand, in the whole tree's palette
    Tree tree_;
};

}  // namespace

Tree buildTree(const Picture& picture, const Square& root, std::span<const std::uint32_t> layers,
               const Painter& painter, const TreeOptions& options, TreeTimes& times) {
    WorkLimit work;
    Cell cell = rootCell(picture, root, layers);
    const std::unique_ptr<Painter> topPainter = painter.clone();
    TopBuilder topBuilder(picture, *topPainter, cell.strands.size());
    const Top top = topBuilder.run(std::move(cell));

    std::vector<Tree> blocks(topBuilder.blocks.size());
    tbb::enumerable_thread_specific<BlockBuilder> builders(
        [&] { return BlockBuilder(picture, painter, options, work); });
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
        blocks[i] = builders.local().run(std::move(topBuilder.blocks[i]));
    });
    for (const BlockBuilder& b : builders) {
        times.push += b.times().push;
        times.planarise += b.times().planarise;
        times.fit += b.times().fit;
    }
    return Assembler(blocks).run(top);
}

}  // namespace vtm::compiler
