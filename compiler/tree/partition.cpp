#include "compiler/tree/partition.hpp"

#include <algorithm>
#include <limits>

namespace vtm::compiler {
namespace {

/// Blocks of this level are not split.
constexpr unsigned lastLevel = 3;

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
    : root_(root), maximum_(maximum), deepest_(std::min(lastLevel, maxDepth)), top_{0, {}}, blocks_(1) {
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

}  // namespace vtm::compiler
