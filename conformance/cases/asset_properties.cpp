#include "conformance/cases/asset_properties.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include <fmt/core.h>

#include "asset/walk.hpp"

namespace vtm::cases {
namespace {

using asset::Asset;
using asset::Cell;
using asset::Entry;
using asset::Leaf;
using asset::leafExtent;
using asset::Piece;
using glm::dvec2;
using Point = std::array<std::uint16_t, 2>;

dvec2 at(Point p) { return {p[0], p[1]}; }
bool isCorner(Point p) { return (p[0] == 0 || p[0] == leafExtent) && (p[1] == 0 || p[1] == leafExtent); }

// ---- membership -------------------------------------------------------------------------------

constexpr double steepest = 0.41421356237309503;  ///< tan 22.5°
constexpr int samples = 32;                       ///< of a piece

dvec2 pointOf(const Piece& p, double s) {
    const dvec2 a = at(p.a), ab = at(p.b) - a;
    const double scale = double{asset::slopeScale},
                 t = p.slopeA / scale * s * (1 - s) * (1 - s) - p.slopeB / scale * s * s * (1 - s);
    return a + s * ab + t * dvec2{-ab.y, ab.x};
}

/// How far the curve leaves the leaf, in leaf steps.
double excursion(const Piece& p) {
    double furthest = 0;
    for (int i = 0; i <= samples; ++i) {
        const dvec2 q = pointOf(p, double(i) / samples);
        furthest = std::max({furthest, -q.x, -q.y, q.x - leafExtent, q.y - leafExtent});
    }
    return furthest;
}

const char* strayReason(const Asset& asset, const Piece& p, double reach) {
    const int steep = int(steepest * asset::slopeScale) + 1;
    if (p.a == p.b)
        return "its ends coincide";
    if (isCorner(p.a) || isCorner(p.b))
        return "an end lies on a corner";
    if (p.left == p.right)
        return "both sides have one paint";
    if (p.left >= asset.paints.size() || p.right >= asset.paints.size())
        return "a paint does not exist";
    if (std::abs(p.slopeA) > steep || std::abs(p.slopeB) > steep)
        return "it turns by more than 22.5 degrees";
    return excursion(p) > reach ? "it leaves its leaf" : nullptr;
}

std::string strayPieceOf(const Asset& asset, const asset::Map& map, Cell cell, const Leaf& leaf,
                         double tolerance) {
    const double leafSide = std::ldexp(map.side, -2 * int(cell.level));
    const double reach =
        dilation * tolerance * std::max(asset.width, asset.height) / leafSide * double{leafExtent};
    if (std::uint64_t{leaf.firstPiece} + leaf.pieceCount > asset.pieces.size())
        return "a leaf's pieces do not exist";
    for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
        const Piece& p = asset.pieces[leaf.firstPiece + i];
        if (const char* reason = strayReason(asset, p, reach))
            return fmt::format(
                "piece {}, {} -> {}, {} of leaf {}, {} at level {}: {} ({} steps out, {} allowed)", p.a[0],
                p.a[1], p.b[0], p.b[1], cell.x, cell.y, cell.level, reason, excursion(p), reach);
    }
    return {};
}

// ---- closure ----------------------------------------------------------------------------------

/// Sums of a few weights are equal only if the paints are.
std::uint64_t weight(std::uint16_t paint) {
    std::uint64_t z = (paint + 1u) * 0x9E3779B97F4A7C15u;  // SplitMix64's finaliser
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/// Sum of weight(left) - weight(right) of what arrives minus what departs, by point.
std::map<Point, std::uint64_t> flowsOf(const Asset& asset, const Leaf& leaf) {
    std::map<Point, std::uint64_t> flows;
    for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
        const Piece& p = asset.pieces[leaf.firstPiece + i];
        const std::uint64_t step = weight(p.left) - weight(p.right);
        flows[p.b] += step;
        flows[p.a] -= step;
    }
    return flows;
}

// ---- neighbours -------------------------------------------------------------------------------

/// Where pieces end on a side, and which paints they have there before and after.
struct Change {
    std::uint16_t place;  ///< in the direction of the side
    std::uint16_t before, after;
};

std::uint16_t along(Point p, int side) {
    const std::uint16_t c = side % 2 == 0 ? p[0] : p[1];
    return side < 2 ? c : std::uint16_t(leafExtent - c);
}

std::vector<Change> changesOn(const Asset& asset, const Leaf& leaf, int side) {
    std::vector<Change> changes;
    for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
        const Piece& p = asset.pieces[leaf.firstPiece + i];
        if (asset::sideOf(p.a) == side)
            changes.push_back({along(p.a, side), p.left, p.right});
        if (asset::sideOf(p.b) == side)
            changes.push_back({along(p.b, side), p.right, p.left});
    }
    std::ranges::sort(changes, {}, &Change::place);
    return changes;
}

/// The paint after changes at one place, which may stand in any order.
std::uint16_t after(std::span<const Change> changes, std::uint16_t paint) {
    std::map<std::uint16_t, int> surplus{{paint, 1}};
    for (const Change& c : changes)
        ++surplus[c.after], --surplus[c.before];
    for (const auto& [candidate, count] : surplus)
        if (count > 0)
            return candidate;
    return paint;
}

/// A part of a border line with one paint, in shares of the map's side.
struct Stretch {
    double from, to;
    std::uint32_t paint;
};

/// A border line: its direction and its place in squares of the last level.
struct Line {
    bool vertical;
    std::uint64_t place;
    friend auto operator<=>(const Line&, const Line&) = default;
};

/// What lies on both sides of each line.
using Borders = std::map<Line, std::array<std::vector<Stretch>, 2>>;

class BorderCollector {
public:
    explicit BorderCollector(const Asset& asset) : asset_(asset) {}

    void add(Cell cell, Entry entry) {
        for (int side = 0; side < 4; ++side) {
            if (entry.kind() == Entry::Kind::Solid)
                addStretch(cell, side, 0, leafExtent, entry.payload());
            else
                addLeaf(cell, side, asset_.leaves[entry.payload()]);
        }
    }
    Borders take() { return std::move(borders_); }

private:
    void addLeaf(Cell cell, int side, const Leaf& leaf) {
        const std::vector<Change> changes = changesOn(asset_, leaf, side);
        std::uint16_t paint = leaf.corners[std::size_t(side)], from = 0;
        for (std::size_t i = 0; i < changes.size();) {
            std::size_t end = i;
            while (end < changes.size() && changes[end].place == changes[i].place)
                ++end;
            addStretch(cell, side, from, changes[i].place, paint);
            paint = after(std::span(changes).subspan(i, end - i), paint);
            from = changes[i].place;
            i = end;
        }
        addStretch(cell, side, from, leafExtent, paint);
    }

    void addStretch(Cell cell, int side, std::uint32_t from, std::uint32_t to, std::uint32_t paint) {
        if (from >= to)
            return;
        if (side >= 2) {
            std::swap(from, to);
            from = leafExtent - from, to = leafExtent - to;
        }
        const bool vertical = side % 2 == 1, far = side == 1 || side == 2;
        const std::uint32_t across = (vertical ? cell.x : cell.y) + (far ? 1 : 0);
        const std::uint32_t first = vertical ? cell.y : cell.x;
        const Line line{vertical, std::uint64_t{across} << (2 * (asset::maxLevel - cell.level))};
        const auto place = [&](std::uint32_t steps) {
            return std::ldexp(first + double(steps) / leafExtent, -2 * int(cell.level));
        };
        borders_[line][far ? 0 : 1].push_back({place(from), place(to), paint});
    }

    const Asset& asset_;
    Borders borders_;
};

/// Calls visit(from, to) for each longest part where both sides have different paints.
template <class Visit>
void compareSides(std::array<std::vector<Stretch>, 2>& sides, Visit&& visit) {
    for (auto& side : sides)
        std::ranges::sort(side, {}, &Stretch::from);
    double from = 0, to = -1;
    for (std::size_t i = 0, k = 0; i < sides[0].size() && k < sides[1].size();) {
        const Stretch &a = sides[0][i], &b = sides[1][k];
        const double begin = std::max(a.from, b.from), end = std::min(a.to, b.to);
        if (begin < end && a.paint != b.paint) {
            if (begin > to) {
                visit(from, to);
                from = begin;
            }
            to = end;
        }
        if (a.to < b.to)
            ++i;
        else
            ++k;
    }
    visit(from, to);
}

}  // namespace

std::string strayPiece(const Asset& asset, double tolerance) {
    std::string found;
    for (const asset::Map& map : asset.maps)
        asset::walk(asset, map.root, [&](Cell cell, Entry entry) {
            if (found.empty() && entry.kind() == Entry::Kind::Leaf)
                found = strayPieceOf(asset, map, cell, asset.leaves[entry.payload()], tolerance);
        });
    return found;
}

std::string openLoop(const Asset& asset) {
    for (std::size_t i = 0; i < asset.leaves.size(); ++i) {
        const Leaf& leaf = asset.leaves[i];
        std::array<std::uint64_t, 4> sides{};
        for (const auto& [point, flow] : flowsOf(asset, leaf)) {
            const int side = asset::sideOf(point);
            if (side >= 0)
                sides[std::size_t(side)] += flow;
            else if (flow != 0)
                return fmt::format("leaf {}: paints do not cancel at {}, {}", i, point[0], point[1]);
        }
        for (std::size_t k = 0; k < 4; ++k)
            if (sides[k] != weight(leaf.corners[(k + 1) % 4]) - weight(leaf.corners[k]))
                return fmt::format("leaf {}: side {} does not lead from corner to corner", i, k);
    }
    return {};
}

std::vector<BorderGap> borderGaps(const Asset& asset, const asset::Map& map, double slack) {
    BorderCollector collector(asset);
    asset::walk(asset, map.root, [&](Cell cell, Entry entry) { collector.add(cell, entry); });
    std::vector<BorderGap> gaps;
    Borders borders = collector.take();
    for (auto& [line, sides] : borders) {
        const double place = std::ldexp(double(line.place), -2 * int(asset::maxLevel));
        const auto point = [&](double share) {
            const dvec2 p = line.vertical ? dvec2{place, share} : dvec2{share, place};
            return dvec2{map.x, map.y} + map.side * p;
        };
        compareSides(sides, [&](double from, double to) {
            if ((to - from) * map.side > slack)
                gaps.push_back({point(from), point(to)});
        });
    }
    return gaps;
}

}  // namespace vtm::cases
