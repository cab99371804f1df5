#include "compiler/src/cell.hpp"

namespace vtm::compiler {
namespace {

/// Further left than any geometry reaches.
constexpr Coord outside = 1 << 20;

/// Adds what the strand changes between the cell's first corner and its children's: along the first
/// column up to row j, then along row j.
void addWindings(Points points, const Strand& strand, const Square& square, std::array<int, 16>& windings) {
    const Coord step = square.side / 4;
    const LatticePoint from = points[strand.first], to = points[strand.last];
    const bool crossesColumn = (from.x < square.x0) != (to.x < square.x0);
    for (int j = 0; j < 4; ++j) {
        const Coord y = square.y0 + j * step;
        if (j > 0 && crossesColumn)
            if (const int up = windingAlongY(points, strand, square.x0, square.y0, y); up != 0)
                for (int i = 0; i < 4; ++i)
                    windings[static_cast<std::size_t>(4 * j + i)] += up;
        const std::uint32_t c = chordAtY(points, strand, y);
        if (c == strand.last)
            continue;
        const LatticePoint a = points[c], b = points[c + 1];
        const int before = cornerOnLeft(a, b, {square.x0, y});
        for (int i = 1; i < 4; ++i)
            windings[static_cast<std::size_t>(4 * j + i)] +=
                int{cornerOnLeft(a, b, {square.x0 + i * step, y})} - before;
    }
}

void pushStrand(Points points, const Strand& strand, const Square& square, std::array<Cell, 16>& children) {
    const Coord step = square.side / 4;
    const auto place = [&](Coord v, Coord origin) {
        const std::int64_t offset = std::int64_t{v} - origin;
        return offset < step ? 0 : static_cast<int>(std::min<std::int64_t>(offset / step, 3));
    };
    const LatticePoint from = points[strand.first], to = points[strand.last];
    const auto [left, right] = std::minmax(from.x, to.x);
    const auto [low, high] = std::minmax(from.y, to.y);
    const int i0 = place(left, square.x0), i1 = place(right, square.x0);
    const int j0 = place(low, square.y0), j1 = place(high, square.y0);
    for (int j = j0; j <= j1; ++j)
        for (int i = i0; i <= i1; ++i) {
            Cell& child = children[static_cast<std::size_t>(4 * j + i)];
            const Strand part = narrowed(points, strand, child.square);
            if (part.first != part.last)
                child.strands.push_back(part);
        }
}

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
        for (; s < cell.strands.size() && cell.strands[s].layer == layer; ++s) {
            pushStrand(points, cell.strands[s], cell.square, children);
            addWindings(points, cell.strands[s], cell.square, windings);
        }
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
