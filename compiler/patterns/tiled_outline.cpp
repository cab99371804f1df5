#include "compiler/patterns/tiled_outline.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/gtc/type_precision.hpp>

#include <vtm/limits/limits.hpp>

namespace vtm::compiler {
namespace {

using glm::i64vec2;
using Points = std::span<const LatticePoint>;
using Edge = std::array<LatticePoint, 2>;
using Edges = std::vector<Edge>;

enum Border : std::size_t { Left, Right, Top, Bottom };

/// Of two edges that run against each other neither is left.
Edges withoutOpposites(Edges edges) {
    const auto ends = [](const Edge& e) { return std::pair(std::min(e[0], e[1]), std::max(e[0], e[1])); };
    std::ranges::sort(edges, {}, ends);
    Edges kept;
    for (const Edge& edge : edges)
        if (!kept.empty() && kept.back() == Edge{edge[1], edge[0]})
            kept.pop_back();
        else
            kept.push_back(edge);
    return kept;
}

/// `before`, and `behind` from the other border of the next tile.
Edges between(Edges before, const Edges& behind, Coord LatticePoint::*axis, Coord side) {
    for (Edge edge : behind) {
        edge[0].*axis = edge[1].*axis = side;
        before.push_back(edge);
    }
    return withoutOpposites(std::move(before));
}

/// The contours of an outline in a tile, taken apart where they run along its borders.
class TileContours {
public:
    TileContours(const Outlines& tile, Coord side) : side_(side) {
        tile.forEachContour(0, std::uint32_t(tile.runs.size()), [this](Points contour) { take(contour); });
        for (Edges& edges : along_)
            edges = withoutOpposites(std::move(edges));
        betweenColumns_ = between(along_[Right], along_[Left], &LatticePoint::x, side);
        betweenRows_ = between(along_[Bottom], along_[Top], &LatticePoint::y, side);
    }

    /// Contours without an edge along a border; each ends where it begins.
    const std::vector<Points>& whole() const { return whole_; }
    /// What is left of the others without these edges.
    const std::vector<std::vector<LatticePoint>>& parts() const { return parts_; }
    const Edges& along(Border border) const { return along_[border]; }
    /// Edges on the right border of a tile where another follows: those of both that are left.
    const Edges& betweenColumns() const { return betweenColumns_; }
    /// On its lower border.
    const Edges& betweenRows() const { return betweenRows_; }

private:
    void take(Points points) {
        const std::size_t edges = points.size() - 1;
        std::size_t begin = 0;
        while (begin < edges && !borderOf(points[begin], points[begin + 1]))
            ++begin;
        if (begin == edges)
            return whole_.push_back(points);
        bool goesOn = false;
        for (std::size_t k = 0; k < edges; ++k) {
            const std::size_t i = (begin + k) % edges;
            const LatticePoint a = points[i], b = points[i + 1];
            const std::optional<Border> border = borderOf(a, b);
            if (border)
                along_[*border].push_back({a, b});
            else if (goesOn)
                parts_.back().push_back(b);
            else
                parts_.push_back({a, b});
            goesOn = !border;
        }
    }

    std::optional<Border> borderOf(LatticePoint a, LatticePoint b) const {
        if (a.x == b.x && (a.x == 0 || a.x == side_))
            return a.x == 0 ? Left : Right;
        if (a.y == b.y && (a.y == 0 || a.y == side_))
            return a.y == 0 ? Top : Bottom;
        return std::nullopt;
    }

    const Coord side_;
    std::vector<Points> whole_;
    std::vector<std::vector<LatticePoint>> parts_;
    std::array<Edges, 4> along_;
    Edges betweenColumns_, betweenRows_;
};

/// Makes contours of all tiles.
class TiledContours {
public:
    explicit TiledContours(const Tiling& tiling) : tiling_(tiling) {}

    FlatContours make(const TileContours& tile) {
        for (int y = 0; y < int(tiling_.rows.size()); ++y) {
            limits::check();
            const TileSpan row = tiling_.rows[std::size_t(y)];
            for (int x = row.first; x < row.end; ++x) {
                const i64vec2 by = std::int64_t(tiling_.side) * i64vec2(x, y);
                for (const Points contour : tile.whole())
                    addWhole(contour, by);
                for (const std::vector<LatticePoint>& part : tile.parts())
                    addPart(part, by);
                if (!isSeen(x - 1, y))
                    addEdges(tile.along(Left), by);
                if (!isSeen(x, y - 1))
                    addEdges(tile.along(Top), by);
                addEdges(isSeen(x + 1, y) ? tile.betweenColumns() : tile.along(Right), by);
                addEdges(isSeen(x, y + 1) ? tile.betweenRows() : tile.along(Bottom), by);
            }
        }
        link();
        return std::move(contours_);
    }

private:
    /// Of a contour.
    struct Part {
        i64vec2 start, end;
        Points points;  ///< in its tile
        i64vec2 by;     ///< the tile's corner
        bool isTaken = false;
    };
    struct ByStart {
        static auto key(i64vec2 p) { return std::pair(p.x, p.y); }
        auto operator()(const Part& part) const { return key(part.start); }
    };

    bool isSeen(int x, int y) const {
        return y >= 0 && y < int(tiling_.rows.size()) && tiling_.rows[std::size_t(y)].holds(x);
    }
    static i64vec2 moved(LatticePoint p, i64vec2 by) { return i64vec2(p.x, p.y) + by; }

    void addEdges(const Edges& edges, i64vec2 by) {
        for (const Edge& edge : edges)
            addPart(edge, by);
    }
    void addPart(Points points, i64vec2 by) {
        parts_.push_back({moved(points.front(), by), moved(points.back(), by), points, by});
    }
    void addWhole(Points points, i64vec2 by) {
        begin();
        for (const LatticePoint p : points)
            put(moved(p, by));
    }

    void begin() { contours_.starts.push_back(std::uint32_t(contours_.points.size())); }
    void put(i64vec2 p) { contours_.points.push_back(scene::apply(tiling_.toOutside, glm::dvec2(p))); }

    /// As many parts begin at each point as end there: contours are closed, and so are pairs of opposite
    /// edges. So one that ends goes on, until it is back where it began.
    void link() {
        std::ranges::sort(parts_, {}, ByStart{});
        for (Part& first : parts_) {
            if (first.isTaken)
                continue;
            limits::check();
            line_.clear();
            line_.push_back(first.start);
            for (Part* part = &first; part; part = part->end == first.start ? nullptr : nextFrom(part->end))
                follow(*part);
            begin();
            std::ranges::for_each(line_, [&](i64vec2 p) { put(p); });
        }
    }

    Part* nextFrom(i64vec2 start) {
        auto part = std::ranges::lower_bound(parts_, ByStart::key(start), {}, ByStart{});
        while (part != parts_.end() && part->start == start && part->isTaken)
            ++part;
        return part != parts_.end() && part->start == start ? &*part : nullptr;
    }

    void follow(Part& part) {
        part.isTaken = true;
        const i64vec2 second = moved(part.points[1], part.by);
        if (line_.size() > 1 && isStraight(line_[line_.size() - 2], line_.back(), second))
            line_.pop_back();
        for (const LatticePoint p : part.points.subspan(1))
            line_.push_back(moved(p, part.by));
    }

    /// Whether b lies on the way from a to c.
    static bool isStraight(i64vec2 a, i64vec2 b, i64vec2 c) {
        const i64vec2 d = b - a, e = c - b;
        return Int128(d.x) * e.y == Int128(d.y) * e.x && Int128(d.x) * e.x + Int128(d.y) * e.y > 0;
    }

    const Tiling& tiling_;
    FlatContours contours_;
    std::vector<Part> parts_;
    std::vector<i64vec2> line_;
};

}  // namespace

void addTiled(Outlines& outlines, const Outlines& tile, const Tiling& tiling, glm::dvec2 clampMin,
              glm::dvec2 clampMax) {
    const TileContours contours(tile, tiling.side);
    addCutContours(outlines, TiledContours(tiling).make(contours), clampMin, clampMax);
}

}  // namespace vtm::compiler
