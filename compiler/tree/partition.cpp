#include "compiler/tree/partition.hpp"

#include <algorithm>
#include <limits>

#include "compiler/tree/encode.hpp"

namespace vtm::compiler {
namespace {

struct LayerBox {
    std::uint32_t layer;
    LatticePoint min, max;

    /// Whether the layer may be in the square; outside its box its winding number is zero.
    bool reaches(const Square& s) const {
        return max.x > s.x0 && min.x < s.x1() && max.y > s.y0 && min.y < s.y1();
    }
};

LayerBox boxOf(const Outlines& outlines, const Layer& layer, std::uint32_t index) {
    constexpr Coord minimum = std::numeric_limits<Coord>::min(), maximum = std::numeric_limits<Coord>::max();
    LayerBox box{index, {maximum, maximum}, {minimum, minimum}};
    for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r)
        for (const LatticePoint p :
             {outlines.points[outlines.runs[r].first], outlines.points[outlines.runs[r].last]}) {
            box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y)};
            box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y)};
        }
    return box;
}

template <class Entries>
bool contains(const Entries& entries, std::uint32_t layer) {
    const auto at = std::lower_bound(entries.begin(), entries.end(), layer,
                                     [](const auto& e, std::uint32_t l) { return e.layer < l; });
    return at != entries.end() && at->layer == layer;
}

/// The layers that have no index in the other picture.
std::vector<std::uint32_t> nowhere(const std::vector<std::uint32_t>& indices) {
    std::vector<std::uint32_t> layers;
    for (std::uint32_t i = 0; i < indices.size(); ++i)
        if (indices[i] == noIndex)
            layers.push_back(i);
    return layers;
}

template <class Entries>
void renumber(Entries& entries, const std::vector<std::uint32_t>& after) {
    std::erase_if(entries, [&](auto& e) {
        e.layer = after[e.layer];
        return e.layer == noIndex;
    });
}

template <class Entries>
void merge(Entries& into, const Entries& added) {
    const auto middle = static_cast<std::ptrdiff_t>(into.size());
    into.insert(into.end(), added.begin(), added.end());
    std::inplace_merge(into.begin(), into.begin() + middle, into.end(),
                       [](const auto& a, const auto& b) { return a.layer < b.layer; });
}

}  // namespace

Partition::Partition(const Square& root, std::size_t maximum, unsigned maxDepth)
    : root_(root), maximum_(maximum), deepest_(std::min(maxBlockLevel, maxDepth)), top_{0, {}}, blocks_(1) {
    blocks_[0].cell.square = root;
}

void Partition::update(const std::vector<Layer>& before, const LoweredScene& picture,
                       const LayerChanges& changes, const std::vector<std::uint32_t>& touched,
                       Painter& painter) {
    const Points points = picture.outlines.points;
    mark(picture.outlines, before, nowhere(changes.after));
    renumber(changes);
    mark(picture.outlines, picture.layers, touched);
    if (const std::vector<std::uint32_t> added = nowhere(changes.before); !added.empty()) {
        Cell cell = rootCell(picture, root_, added);
        insert(points, top_, cell);
    }
    Culler culler(picture, painter);
    splitLarge(points, culler, top_);
}

/// Marks the blocks in which layers are.
void Partition::mark(const Outlines& outlines, const std::vector<Layer>& layers,
                     const std::vector<std::uint32_t>& which) {
    std::vector<LayerBox> boxes;
    for (std::uint32_t layer : which)
        boxes.push_back(boxOf(outlines, layers[layer], layer));
    for (Block& block : blocks_)
        block.dirty |= std::any_of(boxes.begin(), boxes.end(), [&](const LayerBox& box) {
            return box.reaches(block.cell.square) &&
                   (contains(block.cell.clippedRuns, box.layer) || contains(block.cell.windings, box.layer));
        });
}

/// Replaces the layers' indices and takes those out that are gone: their blocks are marked.
void Partition::renumber(const LayerChanges& changes) {
    const bool all = changes.renumbers();
    for (Block& block : blocks_)
        if (all || block.dirty) {
            compiler::renumber(block.cell.clippedRuns, changes.after);
            compiler::renumber(block.cell.windings, changes.after);
        }
}

void Partition::insert(Points points, Top& top, Cell& cell) {
    if (cell.clippedRuns.empty() && cell.windings.empty())
        return;
    if (top.block) {
        Block& block = blocks_[*top.block];
        merge(block.cell.clippedRuns, cell.clippedRuns);
        merge(block.cell.windings, cell.windings);
        block.dirty = true;
        return;
    }
    std::array<Cell, 16> children;
    splitCell(points, cell, children);
    for (std::size_t i = 0; i < 16; ++i)
        insert(points, top.children[i], children[i]);
}

void Partition::splitLarge(Points points, Culler& culler, Top& top) {
    if (top.block) {
        const std::size_t first = *top.block;
        const Cell& whole = blocks_[first].cell;
        if (!blocks_[first].dirty || whole.level >= deepest_ || whole.clippedRuns.size() <= maximum_)
            return;
        Cell culled = whole;
        culler.run(culled);
        if (culled.clippedRuns.size() <= maximum_)
            return;
        std::array<Cell, 16> children;
        splitCell(points, whole, children);
        top.block.reset();
        for (std::size_t i = 0; i < 16; ++i) {
            const std::size_t place = i == 0 ? first : blocks_.size();
            if (i > 0)
                blocks_.emplace_back();
            blocks_[place].cell = std::move(children[i]);
            top.children.push_back({place, {}});
        }
    }
    for (Top& child : top.children)
        splitLarge(points, culler, child);
}

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
