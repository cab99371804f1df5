#include "raster/src/scanned_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "asset/walk.hpp"
#include "raster/detail_map.hpp"

namespace vtm::asset {

namespace {

/// Pieces of a square: making it anew takes some ten microseconds, and its borders hold few of them.
constexpr std::size_t piecesPerSquare = 512;

/// Pixels: where pieces are longer in the mean, merging them gains less than making the level costs.
constexpr double longPiece = 0.25;

bool contains(Cell outer, Cell inner) {
    if (inner.level < outer.level)
        return false;
    const unsigned shift = 2 * (inner.level - outer.level);
    return inner.x >> shift == outer.x && inner.y >> shift == outer.y;
}

/// Of a square of the tree; one that is within a leaf or a solid square has no entry of its own, and gets
/// theirs.
std::pair<Cell, Entry> entryAt(const AssetView& asset, Entry entry, Cell wanted) {
    Cell cell;
    while (cell.level < wanted.level && entry.kind() == Entry::Kind::Node) {
        const unsigned shift = 2 * (wanted.level - cell.level - 1);
        const std::uint32_t x = (wanted.x >> shift) % 4, y = (wanted.y >> shift) % 4;
        entry = asset.nodes[entry.payload()].children[y * 4 + x];
        cell = childOf(cell, y * 4 + x);
    }
    return {cell, entry};
}

}  // namespace

BoundaryBox::BoundaryBox(std::span<const PlanarPiece> pieces, std::optional<DetailSquare> square)
    : boundaries_(pieces), square_(square) {
    double length = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const PlanarPiece& p = pieces[i];
        const double bulge = p.bulge();
        const glm::dvec2 low = glm::min(p.a, p.b) - bulge, high = glm::max(p.a, p.b) + bulge;
        min_ = i == 0 ? low : glm::min(min_, low);
        max_ = i == 0 ? high : glm::max(max_, high);
        length += glm::distance(p.a, p.b);
    }
    if (!pieces.empty())
        meanLength_ = length / double(pieces.size());
}

const Boundaries& BoundaryBox::at(double pixel) const {
    if (!square_ || meanLength_ > longPiece * pixel)
        return boundaries_;
    const int octave = std::ilogb(pixel);
    return levels_.get(octave, [&] {
        return Boundaries(mergeChains(boundaries_.pieces(), *square_, std::ldexp(1.0, octave)));
    });
}

ScannedMap::ScannedMap(const AssetView& asset, const Map& map) : place_{{map.x, map.y}, map.side} {
    for (MapPart& part : mapParts(asset, {}, map.root, piecesPerSquare))
        add(std::move(part));
    std::vector<LineNumber> lines;
    for (const Square& square : squares_)
        addLines(square, lines);
    makeSeams(std::move(lines));
}

ScannedMap::ScannedMap(const PlanarMap& map) : place_(map) { boxes_.emplace_back(map.pieces, noBorder); }

void ScannedMap::add(MapPart part) {
    const double side = std::ldexp(place_.extent, -2 * int(part.cell.level));
    const glm::dvec2 corner = side * glm::dvec2(part.cell.x, part.cell.y);
    const BoundaryBox& box = boxes_.emplace_back(part.pieces, DetailSquare{corner, corner + side});
    squares_.push_back({part.cell, std::move(part.borders), corner, corner + side});
    if (!box.empty()) {
        squares_.back().min = glm::min(corner, box.min());
        squares_.back().max = glm::max(corner + side, box.max());
    }
}

void ScannedMap::addBorders(const Square& square, std::array<Borders, 2>& borders) {
    for (std::size_t i = 0; i < 2; ++i) {
        std::ranges::copy(square.borders[i].below, std::back_inserter(borders[i].below));
        std::ranges::copy(square.borders[i].above, std::back_inserter(borders[i].above));
    }
}

void ScannedMap::addLines(const Square& square, std::vector<LineNumber>& lines) {
    const std::uint64_t side = std::uint64_t(1) << (2 * (maxLevel - square.cell.level));
    for (const std::uint64_t end : {0, 1}) {
        lines.push_back({0, (square.cell.y + end) * side});
        lines.push_back({1, (square.cell.x + end) * side});
    }
}

void ScannedMap::makeSeams(std::vector<LineNumber> wanted) {
    std::ranges::sort(wanted);
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    std::erase_if(lines_, [&](const Line& line) { return std::ranges::binary_search(wanted, line.line); });
    std::vector<std::array<Borders, 2>> borders(wanted.size());
    const auto add = [&](std::size_t direction, std::uint64_t number, const std::vector<Stretch>& stretches,
                         std::vector<Stretch> Borders::*side) {
        const auto at = std::ranges::lower_bound(wanted, LineNumber{direction, number});
        if (stretches.empty() || at == wanted.end() || *at != LineNumber{direction, number})
            return;
        std::ranges::copy(stretches,
                          std::back_inserter(borders[std::size_t(at - wanted.begin())][direction].*side));
    };
    for (const Square& square : squares_)
        for (std::size_t direction = 0; direction < 2; ++direction) {
            const Borders& sides = square.borders[direction];
            if (!sides.above.empty())
                add(direction, sides.above[0].line(), sides.above, &Borders::above);
            if (!sides.below.empty())
                add(direction, sides.below[0].line() + 1, sides.below, &Borders::below);
        }
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (BoundaryBox made(seams(std::move(borders[i]))); !made.empty())
            lines_.push_back({wanted[i], std::move(made)});
    std::ranges::sort(lines_, {}, &Line::line);
}

void ScannedMap::update(const AssetView& asset, const Map& map, std::span<const Cell> changed) {
    // Whole squares, old or new, none within another.
    std::vector<Cell> whole;
    for (Cell cell : changed) {
        cell = entryAt(asset, map.root, cell).first;
        for (const Square& square : squares_)
            if (contains(square.cell, cell))
                cell = square.cell;
        if (std::ranges::none_of(whole, [&](Cell other) { return contains(other, cell); })) {
            std::erase_if(whole, [&](Cell other) { return contains(cell, other); });
            whole.push_back(cell);
        }
    }
    std::vector<LineNumber> lines;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < squares_.size(); ++i)
        if (std::ranges::any_of(whole, [&](Cell cell) { return contains(cell, squares_[i].cell); })) {
            addLines(squares_[i], lines);
        } else {
            if (kept != i) {
                squares_[kept] = std::move(squares_[i]);
                boxes_[kept] = std::move(boxes_[i]);
            }
            ++kept;
        }
    squares_.erase(squares_.begin() + std::ptrdiff_t(kept), squares_.end());
    boxes_.erase(boxes_.begin() + std::ptrdiff_t(kept), boxes_.end());
    for (const Cell cell : whole)
        for (MapPart& part : mapParts(asset, cell, entryAt(asset, map.root, cell).second, piecesPerSquare)) {
            add(std::move(part));
            addLines(squares_.back(), lines);
        }
    makeSeams(std::move(lines));
}

PlanarMap mapForPixels(const AssetView& asset, const Map& map, double pixel) {
    const ScannedMap scanned(asset, map);
    PlanarMap all{scanned.place(), {}};
    for (std::size_t i = 0; i < scanned.boxCount(); ++i)
        std::ranges::copy(scanned.box(i).at(pixel).pieces(), std::back_inserter(all.pieces));
    return all;
}

}  // namespace vtm::asset
