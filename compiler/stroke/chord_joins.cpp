#include "compiler/stroke/chord_joins.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>

#include "compiler/stroke/curve.hpp"

namespace vtm::compiler::stroke {
namespace {

/// Whether the edges that end in the vertices `first` to `last` are there, and straight.
bool areStraight(const Side& side, std::size_t first, std::size_t last) {
    return last < side.ends.size() && (side.curves.empty() || side.curves.back().edge < first);
}

void leaveOut(Side& side, std::size_t vertex) { side.ends.erase(side.ends.begin() + std::ptrdiff_t(vertex)); }

/// Of evolutes, which cross the offset, this is not true.
bool isAlong(Point chord, Point tangent) {
    constexpr double cosine = 0.9;
    return glm::dot(chord, tangent) >= cosine * glm::length(chord);
}

void cutDetour(const ChordJoin& join) {
    const auto [side, vertex] = join.detour;
    if (!side || vertex == 0 || !areStraight(*side, vertex - 1, vertex + 2) ||
        glm::dot(join.before, join.after) <= 0)
        return;
    std::vector<Point>& ends = side->ends;
    const Point from = vertex > 1 ? ends[vertex - 2] : side->start, to = ends[vertex + 1],
                a = ends[vertex - 1] - from, b = ends[vertex + 2] - to;
    if (!isAlong(a, join.before) || !isAlong(b, join.after))
        return;
    const double turn = cross(a, b), u = cross(to - from, b) / turn, v = cross(to - from, a) / turn;
    if (!(u >= 0.5 && u <= 1 && v >= 0 && v <= 0.5))
        return;
    ends[vertex - 1] = from + a * u;
    leaveOut(*side, vertex + 1);
    leaveOut(*side, vertex);
}

/// isLittle(twice the area of a triangle, a side of it).
template <class IsLittle>
void leaveOutBesideTip(const Tip& tip, const IsLittle& isLittle) {
    const auto [side, at, isAfterChord, isBeforeChord] = tip;
    const std::size_t last = at + (isBeforeChord ? 2 : 1);
    if (!side || !(isAfterChord || isBeforeChord) || at < 2 || !areStraight(*side, at - 1, last))
        return;
    std::vector<Point>& ends = side->ends;
    const Point here = ends[at], from = ends[at - (isAfterChord ? 2 : 1)], to = ends[last];
    const double before = isAfterChord ? cross(ends[at - 1] - from, here - from) : 0,
                 after = isBeforeChord ? cross(ends[at + 1] - here, to - here) : 0;
    if (!isLittle(before, here - from) || !isLittle(after, to - here))
        return;
    const Point way = to - from;
    const double square = glm::dot(way, way);
    if (!(std::abs(before + after) <= 0.5 * square))  // the tip would move far
        return;
    ends[at] = here - perp(way) * ((before + after) / square);
    if (isBeforeChord)
        leaveOut(*side, at + 1);
    if (isAfterChord)
        leaveOut(*side, at - 1);
}

}  // namespace

void shorten(const ChordJoin& join, const ChordTolerance& tolerance, double gap) {
    cutDetour(join);
    constexpr double areaShare = 0.25;  // a chord misplaces four times as much
    leaveOutBesideTip(join.tip, [&](double twice, Point base) {
        return tolerance.area > 0 ? std::abs(twice) <= 2 * areaShare * tolerance.area
                                  : std::abs(twice) <= gap * glm::length(base);
    });
}

}  // namespace vtm::compiler::stroke
