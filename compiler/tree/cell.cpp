#include "compiler/tree/cell.hpp"

#include <bit>

namespace vtm::compiler {
namespace {

/// Further left than any geometry reaches.
constexpr Coord outside = 1 << 20;

/// Hands strands down to 16 children. A square's side is a power of two.
///
/// A strand visits the children one after the other: where its next chord across a column's line and the
/// next across a row's line are found, the earlier one leads to the neighbour. All vertices but its ends are
/// inside the square, so a line of the square's own border is crossed by the first or the last chord.
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
        const bool right = to.x >= from.x, up = to.y >= from.y;
        int i = column(from.x), j = row(from.y);
        const int iEnd = column(to.x), jEnd = row(to.y);
        addAtBorder(strand, right, up, windings);
        const auto nextX = [&](std::uint32_t chord) {
            if (i == iEnd)
                return strand.last;
            const Coord x = lineX(right ? i + 1 : i);
            return firstWhere(chord, strand.last,
                              [&](std::uint32_t k) { return (points_[k + 1].x > x) == right; });
        };
        const auto nextY = [&](std::uint32_t chord) {
            if (j == jEnd)
                return strand.last;
            const Coord y = lineY(up ? j + 1 : j);
            return firstWhere(chord, strand.last,
                              [&](std::uint32_t k) { return (points_[k + 1].y > y) == up; });
        };
        Strand part = strand;
        std::uint32_t atX = nextX(strand.first), atY = nextY(strand.first);
        while (i != iEnd || j != jEnd) {
            const int lineI = right ? i + 1 : i, lineJ = up ? j + 1 : j;
            const bool x =
                atX < atY || (atX == atY && meetsXFirst(atX, {lineX(lineI), lineY(lineJ)}, right == up));
            const std::uint32_t chord = x ? atX : atY;
            part.last = chord + 1;
            add(strand, part, i, j);
            part.first = chord;
            if (x) {
                i += right ? 1 : -1;
                atX = nextX(chord);
            } else {
                addAlongRow(chord, lineJ, windings);
                j += up ? 1 : -1;
                atY = nextY(chord);
            }
        }
        part.last = strand.last;
        add(strand, part, i, j);
    }

private:
    static std::size_t index(int i, int j) { return static_cast<std::size_t>(4 * j + i); }
    int place(std::int64_t offset) const {
        return static_cast<int>(std::clamp<std::int64_t>(offset >> shift_, 0, 3));
    }
    int column(Coord x) const { return place(x - std::int64_t{square_.x0}); }
    int row(Coord y) const { return place(y - std::int64_t{square_.y0}); }
    Coord lineX(int i) const { return square_.x0 + i * step_; }
    Coord lineY(int j) const { return square_.y0 + j * step_; }

    /// Whether a chord across both lines through `corner` meets the column's first.
    bool meetsXFirst(std::uint32_t chord, LatticePoint corner, bool risesToTheRight) const {
        return cornerOnLeft(points_[chord], points_[chord + 1], corner) == risesToTheRight;
    }

    /// The first and the last chord may come from outside and pass the child by.
    void add(const Strand& strand, const Strand& part, int i, int j) {
        Cell& child = children_[index(i, j)];
        const bool mayMiss =
            part.last == part.first + 1 && (part.first == strand.first || part.last == strand.last);
        if (!mayMiss || meets(points_[part.first], points_[part.last], child.square))
            child.strands.push_back(part);
    }

    /// The children's windings are those at their first corners, reached along the first column up to row
    /// j, then along row j.
    void addAtBorder(const Strand& strand, bool right, bool up, std::array<int, 16>& windings) const {
        const LatticePoint from = points_[strand.first], to = points_[strand.last];
        if ((from.x < square_.x0) != (to.x < square_.x0)) {
            const std::uint32_t c = right ? strand.first : strand.last - 1;
            const LatticePoint a = points_[c], b = points_[c + 1];
            const int before = cornerOnLeft(a, b, {square_.x0, square_.y0});
            for (int j = 1; j < 4; ++j) {
                const int change = int{cornerOnLeft(a, b, {square_.x0, lineY(j)})} - before;
                for (int i = 0; i < 4; ++i)
                    windings[index(i, j)] += change;
            }
        }
        if ((from.y < square_.y0) != (to.y < square_.y0))
            addAlongRow(up ? strand.first : strand.last - 1, 0, windings);
    }
    void addAlongRow(std::uint32_t chord, int j, std::array<int, 16>& windings) const {
        const LatticePoint a = points_[chord], b = points_[chord + 1];
        const int before = cornerOnLeft(a, b, {square_.x0, lineY(j)});
        for (int i = 1; i < 4; ++i)
            windings[index(i, j)] += int{cornerOnLeft(a, b, {lineX(i), lineY(j)})} - before;
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
            limits::check();
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
        child.strands.reserve(cell.strands.size() / 8);  // most strands visit one child or two
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
        limits::check();
        for (; s < cell.strands.size() && cell.strands[s].layer == layer; ++s)
            splitter.push(cell.strands[s], windings);
        for (std::size_t i = 0; i < 16; ++i)
            if (windings[i] != 0)
                children[i].windings.push_back({layer, windings[i]});
    }
    copyKnown(none);
}

limits::Place AtCell::place(const void* self) {
    const auto& [picture, cell, stage] = *static_cast<const AtCell*>(self);
    std::uint32_t largest = none;
    std::size_t most = 0, count = 0;
    for (std::size_t i = 0; i < cell.strands.size(); ++i) {
        const Strand& s = cell.strands[i];
        const bool isNew = i == 0 || cell.strands[i - 1].layer != s.layer;
        count = (isNew ? 0 : count) + s.last - s.first;
        if (count > most)
            most = count, largest = s.layer;
    }
    return largest == none ? limits::Place{} : picture.layers[largest].place;
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
