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

Top divide(const LoweredScene& picture, Cell cell, const Painter& painter, unsigned maxDepth) {
    TopBuilder builder(picture, painter, maxDepth, cell.clippedRuns.size());
    return builder.run(std::move(cell));
}

void numberBlocks(Top& top, std::vector<Cell>& cells) {
    if (top.cell) {
        top.block = cells.size();
        cells.push_back(std::move(*top.cell));
    }
    for (Top& child : top.children)
        numberBlocks(child, cells);
}

/// A block's tree, and the paints that it uses in place of its palette.
struct BlockTree {
    struct Used {
        PaintId id;  ///< in the tree
        PaintProgram program;
    };
    Tree tree;
    std::size_t paletteSize = 0;  ///< 0 where ids are no paints of a palette, or all are its first
    std::vector<Used> paints;     ///< in the order in which a walk meets them
};

/// Finds the paints that a block's tree uses.
class UsedPaints {
public:
    explicit UsedPaints(Tree tree) : tree_(std::move(tree)) {}

    BlockTree run() {
        palette_ = std::move(tree_.palette).take();
        BlockTree block;
        if (palette_.size() > 1) {
            block.paletteSize = palette_.size();
            isUsed_.resize(palette_.size());
            visit(tree_.root);
        }
        block.paints = std::move(used_);
        block.paints.shrink_to_fit();
        block.tree = std::move(tree_);
        return block;
    }

private:
    void visit(Entry entry) {
        switch (entry.kind()) {
            case Entry::Kind::Solid:
                return use(entry.payload());
            case Entry::Kind::Leaf:
                return visit(tree_.leaves[entry.payload()]);
            case Entry::Kind::Node:
            case Entry::Kind::Instances:  // a built tree has none
                break;
        }
        for (const Entry child : tree_.nodes[entry.payload()].children)
            visit(child);
    }

    void visit(const Tree::Leaf& leaf) {
        for (const PaintId corner : leaf.corners)
            use(corner);
        PaintId left = leaf.corners[0], right = left;  // of the piece before: mostly the same
        for (const Tree::Piece& piece : std::span(tree_.pieces).subspan(leaf.firstPiece, leaf.pieceCount)) {
            if (piece.left == left && piece.right == right)
                continue;
            use(left = piece.left);
            use(right = piece.right);
        }
    }

    void use(PaintId id) {
        if (!isUsed_[id])
            add(id);
    }
    [[gnu::noinline]] void add(PaintId id) {  // so that use() is inlined
        isUsed_[id] = true;
        used_.push_back({id, std::move(palette_[id])});
    }

    Tree tree_;
    std::vector<PaintProgram> palette_;
    std::vector<std::uint8_t> isUsed_;  ///< by id
    std::vector<BlockTree::Used> used_;
};

/// Joins blocks in walking order, so that the result does not depend on where blocks begin.
class Assembler {
public:
    explicit Assembler(std::vector<BlockTree> blocks) : blocks_(std::move(blocks)) {}

    JoinedTree run(const Top& top) {
        std::size_t nodes = 0, leaves = 0;
        for (const BlockTree& block : blocks_)
            nodes += block.tree.nodes.size(), leaves += block.tree.leaves.size();
        limits::need(nodes * sizeof(asset::Node) + leaves * sizeof(Tree::Leaf));
        tree_.nodes.reserve(nodes + blocks_.size());  // above blocks: fewer nodes
        tree_.leaves.reserve(leaves);
        joined_.blocks.reserve(blocks_.size());
        tree_.root = join(top);
        return std::move(joined_);
    }

private:
    Entry join(const Top& top) {
        if (top.cell)
            return join(blocks_[top.block]);
        return appendNode(tree_.nodes, [&](std::size_t i) { return join(top.children[i]); });
    }

    Entry join(BlockTree& block) {
        paints_.assign(block.paletteSize, 0);
        for (const auto& [id, program] : block.paints)
            paints_[id] = tree_.palette.add(program);
        const Tree& tree = block.tree;
        tree_.error = std::max(tree_.error, tree.error);
        tree_.unproven.insert(tree_.unproven.end(), tree.unproven.begin(), tree.unproven.end());
        const Entry root = copy(tree, tree.root);
        pieces_ += static_cast<std::uint32_t>(tree.pieces.size());
        joined_.blocks.push_back({std::move(block.tree.pieces), paints_});
        block = {};
        return root;
    }

    Entry copy(const Tree& block, Entry entry) {
        switch (entry.kind()) {
            case Entry::Kind::Solid:
                return Entry::make(Entry::Kind::Solid, paint(entry.payload()));
            case Entry::Kind::Leaf:
                return copy(block.leaves[entry.payload()]);
            case Entry::Kind::Node:
            case Entry::Kind::Instances:  // a built tree has none
                break;
        }
        const asset::Node& node = block.nodes[entry.payload()];
        return appendNode(tree_.nodes, [&](std::size_t i) { return copy(block, node.children[i]); });
    }

    Entry copy(Tree::Leaf leaf) {
        limits::check();
        leaf.firstPiece += pieces_;
        for (PaintId& corner : leaf.corners)
            corner = paint(corner);
        tree_.leaves.push_back(leaf);
        return Entry::make(Entry::Kind::Leaf, static_cast<std::uint32_t>(tree_.leaves.size() - 1));
    }

    PaintId paint(PaintId id) const { return paints_.empty() ? id : paints_[id]; }

    std::vector<BlockTree> blocks_;
    std::vector<PaintId> paints_;  ///< of the joined palette, by those of the block at hand
    std::uint32_t pieces_ = 0;     ///< of the blocks before
    JoinedTree joined_;
    Tree& tree_ = joined_.tree;
};

}  // namespace

JoinedTree buildTree(const LoweredScene& picture, const Square& root, std::span<const std::uint32_t> layers,
                     const Painter& painter, const TreeOptions& options, TreeTimes& times) {
    const limits::Stage stage("dividing the picture");
    const auto start = Clock::now();
    WorkLimit work(options.maxWork);
    Top top = divide(picture, rootCell(picture, root, layers), painter, options.maxDepth);
    std::vector<Cell> cells;
    numberBlocks(top, cells);

    std::vector<BlockTree> blocks(cells.size());
    tbb::enumerable_thread_specific<BlockBuilder> builders(
        [&] { return BlockBuilder(picture, painter, options, work); });
    const auto divided = Clock::now();
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&, holding = limits::current()](std::size_t i) {
        const limits::Scope scope(holding);
        limits::progress(static_cast<double>(done++) / static_cast<double>(blocks.size()));
        Tree block = builders.local().run(std::move(cells[i]), i % timedBlocks == 0);
        blocks[i] = UsedPaints(std::move(block)).run();
    });
    const double wall = milliseconds(divided, Clock::now());
    TreeTimes sum;
    for (const BlockBuilder& b : builders)
        sum += b.times();
    times.divide += milliseconds(start, divided);
    times += sum.sharing(wall);
    const limits::Stage assembling("assembling");
    return Assembler(std::move(blocks)).run(top);
}

}  // namespace vtm::compiler
