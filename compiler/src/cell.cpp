#include "compiler/src/cell.hpp"

#include <bit>

namespace vtm::compiler {
namespace {

/// Further left than any geometry reaches.
constexpr Coord outside = 1 << 20;

/// Hands strands down to 16 children. A square's side is a power of two.
class Splitter {
public:
    Splitter(Points points, const Square& square, std::array<Cell, 16>& children)
        : points_(points),
          square_(square),
          step_(square.side / 4),
          shift_(std::countr_zero(static_cast<std::uint32_t>(step_))),
          children_(children) {}

    void push(const Strand& strand, std::array<int, 16>& windings) {
        const LatticePoint from = points_[strand.first], to = points_[strand.last];
        const auto [left, right] = std::minmax(from.x, to.x);
        const auto [low, high] = std::minmax(from.y, to.y);
        const int i0 = place(left - std::int64_t{square_.x0}), i1 = place(right - std::int64_t{square_.x0});
        const int j0 = place(low - std::int64_t{square_.y0}), j1 = place(high - std::int64_t{square_.y0});
        const bool within =
            left > square_.x0 && right < square_.x1() && low > square_.y0 && high < square_.y1();
        if (within && i0 == i1 && j0 == j1) {
            children_[index(i0, j0)].strands.push_back(strand);
            return;  // crosses no line between first corners
        }
        for (int j = j0; j <= j1; ++j)
            for (int i = i0; i <= i1; ++i) {
                Cell& child = children_[index(i, j)];
                const Strand part = narrowed(points_, strand, child.square);
                if (part.first != part.last)
                    child.strands.push_back(part);
            }
        if (left < square_.x0 && right > square_.x0)
            addAlongColumn(strand, windings);
        for (int j = low < square_.y0 ? 0 : j0 + 1; j <= j1; ++j)
            addAlongRow(strand, j, windings);
    }

private:
    static std::size_t index(int i, int j) { return static_cast<std::size_t>(4 * j + i); }
    int place(std::int64_t offset) const {
        return static_cast<int>(std::clamp<std::int64_t>(offset >> shift_, 0, 3));
    }

    /// The children's windings are those at their first corners, reached along the first column up to row
    /// j, then along row j.
    void addAlongColumn(const Strand& strand, std::array<int, 16>& windings) const {
        for (int j = 1; j < 4; ++j) {
            const int up = windingAlongY(points_, strand, square_.x0, square_.y0, square_.y0 + j * step_);
            for (int i = 0; i < 4; ++i)
                windings[index(i, j)] += up;
        }
    }
    void addAlongRow(const Strand& strand, int j, std::array<int, 16>& windings) const {
        const Coord y = square_.y0 + j * step_;
        const std::uint32_t c = chordAtY(points_, strand, y);
        if (c == strand.last)
            return;
        const LatticePoint a = points_[c], b = points_[c + 1];
        const int before = cornerOnLeft(a, b, {square_.x0, y});
        for (int i = 1; i < 4; ++i)
            windings[index(i, j)] += int{cornerOnLeft(a, b, {square_.x0 + i * step_, y})} - before;
    }

    const Points points_;
    const Square square_;
    const Coord step_;
    const int shift_;
    std::array<Cell, 16>& children_;
};

}  // namespace

std::size_t Cell::chordCount() const {
    std::size_t count = 0;
    for (const Strand& s : strands)
        count += s.last - s.first;
    return count;
}

Cell rootCell(const Picture& picture, const Square& square, std::span<const std::uint32_t> layers) {
    const Points points = picture.outlines.points;
    Cell cell{square, 0, {}, {}};
    for (std::uint32_t index : layers) {
        const Layer& layer = picture.layers[index];
        int winding = 0;
        for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r) {
            const Run& run = picture.outlines.runs[r];
            const Strand whole{run.first, run.last, index};
            // From a point left of everything, where the winding is zero.
            winding += windingAlongX(points, whole, square.y0, square.x0 - outside, square.x0);
            const Strand part = narrowed(points, whole, square);
            if (part.first != part.last)
                cell.strands.push_back(part);
        }
        if (winding != 0)
            cell.windings.push_back({index, winding});
    }
    return cell;
}

void splitCell(Points points, const Cell& cell, std::array<Cell, 16>& children) {
    for (int i = 0; i < 16; ++i) {
        Cell& child = children[static_cast<std::size_t>(i)];
        child.square = cell.square.child(i % 4, i / 4);
        child.level = cell.level + 1;
        child.strands.clear();
        child.windings.clear();
    }
    Splitter splitter(points, cell.square, children);
    auto known = cell.windings.begin();
    const auto copyKnown = [&](std::uint32_t below) {
        for (; known != cell.windings.end() && known->layer < below; ++known)
            for (Cell& child : children)
                child.windings.push_back(*known);
    };
    for (std::size_t s = 0; s < cell.strands.size();) {
        const std::uint32_t layer = cell.strands[s].layer;
        copyKnown(layer);
        int base = 0;
        if (known != cell.windings.end() && known->layer == layer)
            base = (known++)->winding;
        std::array<int, 16> windings;
        windings.fill(base);
        for (; s < cell.strands.size() && cell.strands[s].layer == layer; ++s)
            splitter.push(cell.strands[s], windings);
        for (std::size_t i = 0; i < 16; ++i)
            if (windings[i] != 0)
                children[i].windings.push_back({layer, windings[i]});
    }
    copyKnown(none);
}

void listLayers(const Cell& cell, std::vector<std::uint32_t>& layers) {
    layers.clear();
    auto known = cell.windings.begin();
    for (std::size_t s = 0; s < cell.strands.size(); ++s) {
        const std::uint32_t layer = cell.strands[s].layer;
        if (s > 0 && cell.strands[s - 1].layer == layer)
            continue;
        for (; known != cell.windings.end() && known->layer < layer; ++known)
            layers.push_back(known->layer);
        if (known != cell.windings.end() && known->layer == layer)
            ++known;
        layers.push_back(layer);
    }
    for (; known != cell.windings.end(); ++known)
        layers.push_back(known->layer);
}

}  // namespace vtm::compiler
