#include "raster/map_part.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "asset/walk.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;

/// The side of a cell in cells of the deepest level, and so a step of its leaf in lattice steps.
std::uint64_t stepOf(Cell cell) { return std::uint64_t(1) << (2 * (maxLevel - cell.level)); }

/// Of a leaf's point, or with the numbers 0 and leafExtent of a square's corner.
dvec2 onLattice(Cell cell, std::uint32_t x, std::uint32_t y) {
    const std::uint64_t step = stepOf(cell);
    return {double(step * (std::uint64_t(cell.x) * leafExtent + x)),
            double(step * (std::uint64_t(cell.y) * leafExtent + y))};
}

PlanarPiece planar(Cell cell, const Piece& piece) {
    PlanarPiece planar = planarPiece(piece);
    planar.a = onLattice(cell, piece.a[0], piece.a[1]);
    planar.b = onLattice(cell, piece.b[0], piece.b[1]);
    return planar;
}

// ---- Borders --------------------------------------------------------------------------------------

std::uint32_t along(int side, const std::array<std::uint16_t, 2>& p) {
    const std::uint32_t x = p[0], y = p[1];
    switch (side) {
        case 0:
            return x;
        case 1:
            return y;
        case 2:
            return leafExtent - x;
        default:
            return leafExtent - y;
    }
}

using ChangesBySide = std::array<std::vector<Change>, 4>;

/// B on a side: the region on the piece's right lies before it, the one on its left behind. A: the reverse.
void changesOf(std::span<const Piece> pieces, ChangesBySide& sides) {
    for (std::vector<Change>& side : sides)
        side.clear();
    for (const Piece& p : pieces) {
        if (const int side = sideOf(p.a); side >= 0)
            sides[unsigned(side)].push_back({along(side, p.a), p.left, p.right});
        if (const int side = sideOf(p.b); side >= 0)
            sides[unsigned(side)].push_back({along(side, p.b), p.right, p.left});
    }
    for (std::vector<Change>& side : sides)
        std::ranges::sort(side, {}, &Change::at);
}

void addStretches(Cell cell, std::uint32_t corner, std::span<const Change> changes, unsigned side,
                  std::array<Borders, 2>& borders) {
    const bool horizontal = side % 2 == 0, forward = side < 2;
    const std::uint64_t step = stepOf(cell);
    const std::uint64_t first = step * leafExtent * (horizontal ? cell.x : cell.y),
                        last = first + step * leafExtent;
    const std::uint64_t low = step * (horizontal ? cell.y : cell.x);
    // The square lies above its own lower border; of the other, the line before is the number.
    const bool above = side == 0 || side == 3;
    Borders& borderLines = borders[horizontal ? 0 : 1];
    std::vector<Stretch>& stretches = above ? borderLines.above : borderLines.below;
    const std::uint64_t line = (above ? low : low + step - 1) << Stretch::fromBits;
    forEachStretch(corner, changes, leafExtent,
                   [&](std::uint32_t from, std::uint32_t to, std::uint32_t paint) {
                       if (forward)
                           stretches.push_back({line | (first + from * step), first + to * step, paint});
                       else
                           stretches.push_back({line | (last - to * step), last - from * step, paint});
                   });
}

void addSeams(Borders& borders, bool horizontal, std::vector<PlanarPiece>& pieces) {
    std::ranges::sort(borders.below, {}, &Stretch::key);
    std::ranges::sort(borders.above, {}, &Stretch::key);
    const auto add = [&](std::uint64_t cells, std::uint64_t start, std::uint64_t end, std::uint32_t below,
                         std::uint32_t above) {
        if (below == above || start >= end)
            return;
        const auto line = double(cells * leafExtent), from = double(start), to = double(end);
        if (horizontal)  // towards +x, higher y is on the left
            pieces.push_back({{from, line}, {to, line}, 0, 0, above, below});
        else
            pieces.push_back({{line, from}, {line, to}, 0, 0, below, above});
    };
    constexpr std::uint64_t noLine = std::numeric_limits<std::uint64_t>::max();
    std::size_t i = 0, j = 0;
    const auto &low = borders.below, &high = borders.above;
    // Both lists tile their lines; where one has nothing, paint 0 is.
    std::uint64_t line = noLine, done = 0;
    while (i < low.size() || j < high.size()) {
        const std::uint64_t lowLine = i < low.size() ? low[i].line() + 1 : noLine,
                            highLine = j < high.size() ? high[j].line() : noLine;
        const std::uint64_t next = std::min(lowLine, highLine);
        if (next != line) {
            line = next;
            done = 0;
        }
        const Stretch* a = lowLine == line ? &low[i] : nullptr;
        const Stretch* b = highLine == line ? &high[j] : nullptr;
        const std::uint64_t startA = a ? std::max(a->from(), done) : noLine,
                            startB = b ? std::max(b->from(), done) : noLine;
        const std::uint64_t from = std::min(startA, startB);
        std::uint64_t to = noLine;
        if (a)
            to = std::min(to, startA > from ? startA : a->to);
        if (b)
            to = std::min(to, startB > from ? startB : b->to);
        add(line, from, to, a && startA <= from ? a->paint : 0, b && startB <= from ? b->paint : 0);
        done = to;
        if (a && a->to <= done)
            ++i;
        if (b && b->to <= done)
            ++j;
    }
}

/// Moves what is seen from one side along a line to `to`.
void takeLine(std::vector<Stretch>& from, std::uint64_t line, std::vector<Stretch>& to) {
    const auto rest =
        std::partition(from.begin(), from.end(), [&](const Stretch& s) { return s.line() != line; });
    to.assign(rest, from.end());
    from.erase(rest, from.end());
}

/// Those along the sides of a square, which the others lose.
Borders takeSides(Borders& all, std::uint64_t low, std::uint64_t side) {
    Borders sides;
    takeLine(all.above, low, sides.above);
    takeLine(all.below, low + side - 1, sides.below);
    return sides;
}

struct Counts {
    std::size_t squares = 0, pieces = 0;
};

Counts countsOf(const AssetView& asset, Entry entry) {
    Counts counts;
    walk(asset, entry, [&](Cell, Entry e) {
        ++counts.squares;
        if (e.kind() == Entry::Kind::Leaf)
            counts.pieces += asset.leaves[e.payload()].pieceCount;
    });
    return counts;
}

}  // namespace

MapPart mapPart(const AssetView& asset, Cell cell, Entry entry) {
    MapPart part{cell, {}, {}};
    const Counts counts = countsOf(asset, entry);
    part.pieces.reserve(counts.pieces + counts.pieces / 4);
    std::array<Borders, 2> borders;
    for (Borders& lines : borders) {
        lines.below.reserve(counts.squares + counts.pieces / 2);
        lines.above.reserve(counts.squares + counts.pieces / 2);
    }
    ChangesBySide sides;
    walk(
        asset, entry,
        [&](Cell square, Entry e) {
            std::array<std::uint32_t, 4> corners;
            std::span<const Piece> own;
            corners.fill(e.payload());
            for (std::vector<Change>& side : sides)
                side.clear();
            if (e.kind() == Entry::Kind::Leaf) {
                const Leaf& leaf = asset.leaves[e.payload()];
                std::ranges::copy(leaf.corners, corners.begin());
                own = asset.pieces.subspan(leaf.firstPiece, leaf.pieceCount);
                changesOf(own, sides);
            }
            for (unsigned side = 0; side < 4; ++side)
                addStretches(square, corners[side], sides[side], side, borders);
            for (const Piece& piece : own)
                if (piece.a != piece.b && piece.left != piece.right)
                    part.pieces.push_back(planar(square, piece));
        },
        cell);
    const std::uint64_t side = stepOf(cell);
    part.borders = {takeSides(borders[0], side * cell.y, side), takeSides(borders[1], side * cell.x, side)};
    addSeams(borders[0], true, part.pieces);
    addSeams(borders[1], false, part.pieces);
    return part;
}

std::vector<MapPart> mapParts(const AssetView& asset, Cell cell, Entry entry, std::size_t pieces) {
    std::vector<MapPart> parts;
    if (entry.kind() != Entry::Kind::Node || countsOf(asset, entry).pieces <= pieces) {
        parts.push_back(mapPart(asset, cell, entry));
        return parts;
    }
    for (std::uint32_t i = 0; i < 16; ++i)
        std::ranges::move(mapParts(asset, childOf(cell, i), asset.nodes[entry.payload()].children[i], pieces),
                          std::back_inserter(parts));
    return parts;
}

std::vector<PlanarPiece> seams(std::array<Borders, 2> borders) {
    std::vector<PlanarPiece> pieces;
    addSeams(borders[0], true, pieces);
    addSeams(borders[1], false, pieces);
    return pieces;
}

}  // namespace vtm::asset
