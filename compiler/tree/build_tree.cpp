#include "compiler/tree/build_tree.hpp"

#include <algorithm>
#include <atomic>
#include <optional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "compiler/tree/block.hpp"
#include "compiler/tree/encode.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {
namespace {

using asset::Entry;

/// A cell with no more clipped runs than this, or than this part of the picture's, or on this level, is a
/// block: small enough to keep all processors busy, large enough to be worth a thread's while.
constexpr std::size_t blockRuns = 256;
constexpr std::size_t blockShare = 24;
constexpr unsigned blockLevel = 3;

/// One of so many blocks is timed: enough to tell the stages' shares, and clocks are not free.
constexpr std::size_t timedBlocks = 8;

/// A cell with more clipped runs hands them to its children's cells on all processors.
constexpr std::size_t runsForAll = 4096;

/// The tree above the blocks.
struct Top {
    std::optional<Cell> cell;   ///< of a block, culled if it has clipped runs; taken by numberBlocks
    std::size_t block = 0;      ///< its number, in walking order
    std::vector<Top> children;  ///< 16 if it is not a block
};

class TopBuilder {
public:
    TopBuilder(const LoweredScene& picture, const Painter& painter, unsigned maxDepth,
               std::size_t clippedRuns)
        : picture_(picture),
          points_(picture.outlines.points),
          cullers_([&] { return CullerOfThread(picture, painter); }),
          maximum_(std::max(blockRuns, clippedRuns / blockShare)),
          deepest_(std::min(blockLevel, maxDepth)) {}

    Top run(Cell cell) {
        const AtCell at("dividing the picture", picture_, cell);
        Top top;
        if (!cell.clippedRuns.empty()) {
            limits::check();
            cullers_.local().culler.run(cell);
        }
        if (cell.clippedRuns.size() <= maximum_ || cell.level >= deepest_) {
            top.cell = std::move(cell);
            return top;
        }
        const auto children = std::make_unique<std::array<Cell, 16>>();
        splitCell(points_, cell, *children);
        const bool onAll = cell.clippedRuns.size() > runsForAll;
        cell = {};
        top.children.resize(16);
        const auto build = [&, holding = limits::current()](std::size_t i) {
            const limits::Scope scope(holding);
            top.children[i] = run(std::move((*children)[i]));
        };
        if (onAll)
            tbb::parallel_for(std::size_t{0}, std::size_t{16}, build);
        else
            for (std::size_t i = 0; i < 16; ++i)
                build(i);
        return top;
    }

private:
    struct CullerOfThread {
        CullerOfThread(const LoweredScene& picture, const Painter& p)
            : painter(p.clone()), culler(picture, *painter) {}
        std::unique_ptr<Painter> painter;
        Culler culler;
    };

    const LoweredScene& picture_;
    const Points points_;
    tbb::enumerable_thread_specific<CullerOfThread> cullers_;
    const std::size_t maximum_;
    const unsigned deepest_;
};

void numberBlocks(Top& top, std::vector<Cell>& cells) {
    if (top.cell) {
        top.block = cells.size();
        cells.push_back(std::move(*top.cell));
    }
    for (Top& child : top.children)
        numberBlocks(child, cells);
}

/// Joins blocks in walking order, so that the result does not depend on where blocks begin.
class Assembler {
public:
    explicit Assembler(const std::vector<Tree>& blocks) : blocks_(blocks) {}

    Tree run(const Top& top) {
        std::size_t nodes = 0, leaves = 0, pieces = 0;
        for (const Tree& block : blocks_)
            nodes += block.nodes.size(), leaves += block.leaves.size(), pieces += block.pieces.size();
        limits::need(nodes * sizeof(asset::Node) + leaves * sizeof(Tree::Leaf) +
                     pieces * sizeof(Tree::Piece));
        tree_.nodes.reserve(nodes + blocks_.size());  // above blocks: fewer nodes
        tree_.leaves.reserve(leaves);
        tree_.pieces.reserve(pieces);
        tree_.root = join(top);
        return std::move(tree_);
    }

private:
    Entry join(const Top& top) {
        if (top.cell) {
            const Tree& block = blocks_[top.block];
            paints_.assign(block.palette.size(), unknown);
            tree_.error = std::max(tree_.error, block.error);
            tree_.unproven.insert(tree_.unproven.end(), block.unproven.begin(), block.unproven.end());
            return copy(block, block.root);
        }
        return appendNode(tree_.nodes, [&](std::size_t i) { return join(top.children[i]); });
    }

    Entry copy(const Tree& block, Entry entry) {
        switch (entry.kind()) {
            case Entry::Kind::Solid:
                return Entry::make(Entry::Kind::Solid, paint(block, entry.payload()));
            case Entry::Kind::Leaf:
                return copy(block, block.leaves[entry.payload()]);
            case Entry::Kind::Node:
            case Entry::Kind::Instances:  // a built tree has none
                break;
        }
        const asset::Node& node = block.nodes[entry.payload()];
        return appendNode(tree_.nodes, [&](std::size_t i) { return copy(block, node.children[i]); });
    }

    Entry copy(const Tree& block, Tree::Leaf leaf) {
        limits::check();
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

Tree buildTree(const LoweredScene& picture, const Square& root, std::span<const std::uint32_t> layers,
               const Painter& painter, const TreeOptions& options, TreeTimes& times) {
    const limits::Stage stage("dividing the picture");
    const auto start = Clock::now();
    WorkLimit work(options.maxWork);
    Cell cell = rootCell(picture, root, layers);
    TopBuilder topBuilder(picture, painter, options.maxDepth, cell.clippedRuns.size());
    Top top = topBuilder.run(std::move(cell));
    std::vector<Cell> cells;
    numberBlocks(top, cells);

    std::vector<Tree> blocks(cells.size());
    tbb::enumerable_thread_specific<BlockBuilder> builders(
        [&] { return BlockBuilder(picture, painter, options, work); });
    const auto divided = Clock::now();
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&, holding = limits::current()](std::size_t i) {
        const limits::Scope scope(holding);
        limits::progress(static_cast<double>(done++) / static_cast<double>(blocks.size()));
        blocks[i] = builders.local().run(std::move(cells[i]), i % timedBlocks == 0);
    });
    const double wall = milliseconds(divided, Clock::now());
    TreeTimes sum;
    for (const BlockBuilder& b : builders)
        sum += b.times();
    times.divide += milliseconds(start, divided);
    times += sum.sharing(wall);
    const limits::Stage assembling("assembling");
    return Assembler(blocks).run(top);
}

}  // namespace vtm::compiler
