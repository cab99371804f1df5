#include "compiler/src/partition.hpp"

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

LayerBox boxOf(const Picture& picture, std::uint32_t index) {
    const Layer& layer = picture.layers[index];
    const Points points = picture.outlines.points;
    constexpr Coord least = std::numeric_limits<Coord>::min(), most = std::numeric_limits<Coord>::max();
    LayerBox box{index, {most, most}, {least, least}};
    for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r)
        for (const LatticePoint p :
             {points[picture.outlines.runs[r].first], points[picture.outlines.runs[r].last]}) {
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

template <class Entries>
void renumber(Entries& entries, const std::vector<std::uint32_t>& after) {
    std::erase_if(entries, [&](auto& e) {
        e.layer = after[e.layer];
        return e.layer == none;
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

Partition::Partition(const Square& root, std::size_t most)
    : root_(root), most_(most), top_{0, {}}, blocks_(1) {
    blocks_[0].cell.square = root;
}

void Partition::update(const Picture& picture, const LayerChanges& changes,
                       const std::vector<std::uint32_t>& touched, Painter& painter) {
    const Points points = picture.outlines.points;
    renumber(changes.after, changes.renumbers());
    markBlocks(picture, touched);
    std::vector<std::uint32_t> added;
    for (std::uint32_t i = 0; i < changes.before.size(); ++i)
        if (changes.before[i] == none)
            added.push_back(i);
    if (!added.empty()) {
        Cell cell = rootCell(picture, root_, added);
        insert(points, top_, cell);
    }
    Culler culler(picture, painter);
    splitLarge(points, culler, top_);
}

/// Replaces the layers' indices and takes those out that are gone.
void Partition::renumber(const std::vector<std::uint32_t>& after, bool all) {
    std::vector<std::uint32_t> gone;
    for (std::uint32_t i = 0; i < after.size(); ++i)
        if (after[i] == none)
            gone.push_back(i);
    if (gone.empty() && !all)
        return;
    for (Block& block : blocks_) {
        Cell& cell = block.cell;
        const std::size_t size = cell.strands.size() + cell.windings.size();
        const bool concerned = all || gone.size() > 16 || std::any_of(gone.begin(), gone.end(), [&](auto l) {
                                   return contains(cell.strands, l) || contains(cell.windings, l);
                               });
        if (!concerned)
            continue;
        compiler::renumber(cell.strands, after);
        compiler::renumber(cell.windings, after);
        block.dirty |= cell.strands.size() + cell.windings.size() != size;
    }
}

void Partition::markBlocks(const Picture& picture, const std::vector<std::uint32_t>& touched) {
    std::vector<LayerBox> boxes;
    for (std::uint32_t layer : touched)
        boxes.push_back(boxOf(picture, layer));
    if (!boxes.empty())
        for (Block& block : blocks_)
            block.dirty |= std::any_of(boxes.begin(), boxes.end(), [&](const LayerBox& box) {
                return box.reaches(block.cell.square) &&
                       (contains(block.cell.strands, box.layer) || contains(block.cell.windings, box.layer));
            });
}

void Partition::insert(Points points, Top& top, Cell& cell) {
    if (cell.strands.empty() && cell.windings.empty())
        return;
    if (top.block) {
        Block& block = blocks_[*top.block];
        merge(block.cell.strands, cell.strands);
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
        if (!blocks_[first].dirty || whole.level >= lastLevel || whole.strands.size() <= most_)
            return;
        Cell culled = whole;
        culler.run(culled);
        if (culled.strands.size() <= most_)
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
