#include "compiler/tree/cell.hpp"

#include <bit>

namespace vtm::compiler {
namespace {

/// Further left than any geometry reaches.
constexpr Coord outside = 1 << 20;

/// Hands clipped runs down to 16 children. A square's side is a power of two.
///
/// A clipped run visits the children one after the other: where its next chord across a column's line and the
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

    void add(const ClippedRun& clippedRun, std::array<int, 16>& windings) {
        const LatticePoint from = points_[clippedRun.first], to = points_[clippedRun.last];
        const bool right = to.x >= from.x, up = to.y >= from.y;
        int i = column(from.x), j = row(from.y);
        const int iEnd = column(to.x), jEnd = row(to.y);
        addAtBorder(clippedRun, right, up, windings);
        const auto nextX = [&](std::uint32_t chord) {
            if (i == iEnd)
                return clippedRun.last;
            const Coord x = lineX(right ? i + 1 : i);
            return firstWhere(chord, clippedRun.last,
                              [&](std::uint32_t k) { return (points_[k + 1].x > x) == right; });
        };
        const auto nextY = [&](std::uint32_t chord) {
            if (j == jEnd)
                return clippedRun.last;
            const Coord y = lineY(up ? j + 1 : j);
            return firstWhere(chord, clippedRun.last,
                              [&](std::uint32_t k) { return (points_[k + 1].y > y) == up; });
        };
        ClippedRun part = clippedRun;
        std::uint32_t atX = nextX(clippedRun.first), atY = nextY(clippedRun.first);
        while (i != iEnd || j != jEnd) {
            const int lineI = right ? i + 1 : i, lineJ = up ? j + 1 : j;
            const bool x =
                atX < atY || (atX == atY && meetsXFirst(atX, {lineX(lineI), lineY(lineJ)}, right == up));
            const std::uint32_t chord = x ? atX : atY;
            part.last = chord + 1;
            add(clippedRun, part, i, j);
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
        part.last = clippedRun.last;
        add(clippedRun, part, i, j);
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
    void add(const ClippedRun& clippedRun, const ClippedRun& part, int i, int j) {
        Cell& child = children_[index(i, j)];
        const bool mayMiss =
            part.last == part.first + 1 && (part.first == clippedRun.first || part.last == clippedRun.last);
        if (!mayMiss || meets(points_[part.first], points_[part.last], child.square))
            child.clippedRuns.push_back(part);
    }

    /// The children's windings are those at their first corners, reached along the first column up to row
    /// j, then along row j.
    void addAtBorder(const ClippedRun& clippedRun, bool right, bool up, std::array<int, 16>& windings) const {
        const LatticePoint from = points_[clippedRun.first], to = points_[clippedRun.last];
        if ((from.x < square_.x0) != (to.x < square_.x0)) {
            const std::uint32_t c = right ? clippedRun.first : clippedRun.last - 1;
            const LatticePoint a = points_[c], b = points_[c + 1];
            const int before = cornerOnLeft(a, b, {square_.x0, square_.y0});
            for (int j = 1; j < 4; ++j) {
                const int change = int{cornerOnLeft(a, b, {square_.x0, lineY(j)})} - before;
                for (int i = 0; i < 4; ++i)
                    windings[index(i, j)] += change;
            }
        }
        if ((from.y < square_.y0) != (to.y < square_.y0))
            addAlongRow(up ? clippedRun.first : clippedRun.last - 1, 0, windings);
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
    for (const ClippedRun& s : clippedRuns)
        count += s.last - s.first;
    return count;
}

Cell rootCell(const LoweredScene& picture, const Square& square, std::span<const std::uint32_t> layers) {
    const Points points = picture.outlines.points;
    Cell cell{square, 0, {}, {}};
    for (std::uint32_t index : layers) {
        const Layer& layer = picture.layers[index];
        const limits::Stage stage("dividing the picture", layer.place);
        int winding = 0;
        for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r) {
            const Run& run = picture.outlines.runs[r];
            const ClippedRun whole{run.first, run.last, index};
            limits::check();
            // From a point left of everything, where the winding is zero.
            winding += windingAlongX(points, whole, square.y0, square.x0 - outside, square.x0);
            const ClippedRun part = narrowed(points, whole, square);
            if (part.first != part.last)
                cell.clippedRuns.push_back(part);
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
        child.clippedRuns.clear();
        child.clippedRuns.reserve(cell.clippedRuns.size() / 8);  // most clipped runs visit one child or two
        child.windings.clear();
    }
    Splitter splitter(points, cell.square, children);
    auto known = cell.windings.begin();
    const auto copyKnown = [&](std::uint32_t below) {
        for (; known != cell.windings.end() && known->layer < below; ++known)
            for (Cell& child : children)
                child.windings.push_back(*known);
    };
    for (std::size_t s = 0; s < cell.clippedRuns.size();) {
        const std::uint32_t layer = cell.clippedRuns[s].layer;
        copyKnown(layer);
        int base = 0;
        if (known != cell.windings.end() && known->layer == layer)
            base = (known++)->winding;
        std::array<int, 16> windings;
        windings.fill(base);
        limits::check();
        for (; s < cell.clippedRuns.size() && cell.clippedRuns[s].layer == layer; ++s)
            splitter.add(cell.clippedRuns[s], windings);
        for (std::size_t i = 0; i < 16; ++i)
            if (windings[i] != 0)
                children[i].windings.push_back({layer, windings[i]});
    }
    copyKnown(noIndex);
}

limits::Place AtCell::place(const void* self) {
    const auto& [picture, cell, stage] = *static_cast<const AtCell*>(self);
    std::uint32_t largest = noIndex;
    std::size_t maximum = 0, count = 0;
    for (std::size_t i = 0; i < cell.clippedRuns.size(); ++i) {
        const ClippedRun& s = cell.clippedRuns[i];
        const bool isNew = i == 0 || cell.clippedRuns[i - 1].layer != s.layer;
        count = (isNew ? 0 : count) + s.last - s.first;
        if (count > maximum)
            maximum = count, largest = s.layer;
    }
    if (largest == noIndex && !cell.windings.empty())
        largest = cell.windings.back().layer;
    return largest == noIndex ? limits::Place{} : picture.layers[largest].place;
}

void listLayers(const Cell& cell, std::vector<std::uint32_t>& layers) {
    layers.clear();
    auto known = cell.windings.begin();
    for (std::size_t s = 0; s < cell.clippedRuns.size(); ++s) {
        const std::uint32_t layer = cell.clippedRuns[s].layer;
        if (s > 0 && cell.clippedRuns[s - 1].layer == layer)
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
