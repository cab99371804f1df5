#include "compiler/instances/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <glm/common.hpp>

namespace vtm::compiler {
namespace {

using asset::PlanarPiece;
using glm::dvec2;

/// A piece turns by 45° at most, so that chords are within a 64th of a 16th of its length.
constexpr int chordsOfCurve = 4;
constexpr int maxCells = 64;

double side(dvec2 a, dvec2 b, dvec2 p) { return asset::cross(b - a, p - a); }

bool overlap(double a0, double a1, double b0, double b1) {
    return std::min(a0, a1) <= std::max(b0, b1) && std::min(b0, b1) <= std::max(a0, a1);
}

bool intersect(Segment2 s, Segment2 t) {
    if (!overlap(s.a.x, s.b.x, t.a.x, t.b.x) || !overlap(s.a.y, s.b.y, t.a.y, t.b.y))
        return false;
    const auto separates = [](Segment2 line, Segment2 other) {
        const double a = side(line.a, line.b, other.a), b = side(line.a, line.b, other.b);
        return (a > 0 && b > 0) || (a < 0 && b < 0);
    };
    return !separates(s, t) && !separates(t, s);
}

/// Parts of a map that hang together, by the ends of their pieces.
class Parts {
public:
    explicit Parts(std::span<const PlanarPiece> pieces) {
        std::map<std::pair<double, double>, std::uint32_t> points;
        const auto pointOf = [&](dvec2 p) {
            const auto number = std::uint32_t(points.size());
            const auto [entry, isNew] = points.try_emplace({p.x, p.y}, number);
            if (isNew)
                parents_.push_back(number);
            return entry->second;
        };
        for (const PlanarPiece& piece : pieces) {
            const std::uint32_t a = pointOf(piece.a), b = pointOf(piece.b);
            parents_[rootOf(a)] = rootOf(b);
            ends_.push_back(a);
        }
    }
    std::uint32_t of(std::size_t piece) { return rootOf(ends_[piece]); }
    std::size_t points() const { return parents_.size(); }

private:
    std::uint32_t rootOf(std::uint32_t point) {
        while (parents_[point] != point)
            point = parents_[point] = parents_[parents_[point]];
        return point;
    }
    std::vector<std::uint32_t> parents_, ends_;
};

}  // namespace

SymbolBoundary::SymbolBoundary(const asset::PlanarMap& map) : index_(map) {
    min_ = dvec2(HUGE_VAL);
    max_ = dvec2(-HUGE_VAL);
    for (const PlanarPiece& piece : index_.map().pieces) {
        const int chords = piece.slopeA == 0 && piece.slopeB == 0 ? 1 : chordsOfCurve;
        dvec2 from = piece.a / map.extent;
        for (int i = 1; i <= chords; ++i) {
            const dvec2 to = piece.at(double(i) / chords) / map.extent;
            segments_.push_back({from, to});
            min_ = glm::min(min_, glm::min(from, to));
            max_ = glm::max(max_, glm::max(from, to));
            from = to;
        }
    }
    cells_ = std::clamp(int(std::sqrt(double(segments_.size()))), 1, maxCells);
    grid_.resize(std::size_t(cells_) * std::size_t(cells_));
    for (std::uint32_t i = 0; i < segments_.size(); ++i)
        forEachCell(segments_[i], [&](std::size_t cell) {
            grid_[cell].push_back(i);
            return true;
        });
}

/// Until visit returns false.
template <class Visit>
void SymbolBoundary::forEachCell(Segment2 s, Visit&& visit) const {
    const auto cellOf = [&](dvec2 p) {
        return glm::ivec2(glm::clamp(glm::floor(p * double(cells_)), dvec2(0), dvec2(cells_ - 1)));
    };
    const glm::ivec2 from = cellOf(glm::min(s.a, s.b)), to = cellOf(glm::max(s.a, s.b));
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x)
            if (!visit(std::size_t(y) * std::size_t(cells_) + std::size_t(x)))
                return;
}

bool SymbolBoundary::meets(Segment2 s) const {
    if (!overlap(s.a.x, s.b.x, min_.x, max_.x) || !overlap(s.a.y, s.b.y, min_.y, max_.y))
        return false;
    bool met = false;
    forEachCell(s, [&](std::size_t cell) {
        met = std::ranges::any_of(grid_[cell], [&](std::uint32_t i) { return intersect(s, segments_[i]); });
        return !met;
    });
    return met;
}

std::vector<dvec2> SymbolBoundary::pointsInside() const {
    const std::vector<PlanarPiece>& pieces = index_.map().pieces;
    Parts parts(pieces);
    std::vector<bool> isDone(parts.points()), isThere(parts.points());
    std::vector<dvec2> points;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const PlanarPiece& piece = pieces[i];
        const std::uint32_t part = parts.of(i);
        isThere[part] = true;
        if (isDone[part])
            continue;
        const dvec2 d = piece.b - piece.a, left(-d.y, d.x);
        for (const double away : {0.05, 0.01, 0.001}) {
            const dvec2 p = (piece.at(0.5) + (piece.left != 0 ? away : -away) * left) / index_.map().extent;
            if (regionAt(p) != 0) {
                points.push_back(p);
                isDone[part] = true;
                break;
            }
        }
    }
    return isDone == isThere ? points : std::vector<dvec2>{};
}

}  // namespace vtm::compiler
