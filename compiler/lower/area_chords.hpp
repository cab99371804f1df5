/// \file
/// Chords of a curve that cover what the curve covers, for pictures that are drawn once.
///
/// Over a step h along a curve of curvature κ, a chord between points of the curve is off by h² κ / 12 in the
/// mean. If the points are moved outwards by that, it covers exactly what the curve does, as long as κ
/// changes evenly. The curve's ends stay where they are, so the first and the last chord, of which one end
/// stays, are shorter by √½. Then an edge through a pixel misplaces something only in the chords in which it
/// enters and leaves: a part of one up to 0.0080 h³ κ, of a first or last one 0.0087 h³ κ. Both together are
/// within an area a if h³ κ <= a / 0.0174, and parts with equal shares of ∫ ∛κ ds make the fewest chords. A
/// bound on the distance, h² κ / 8, takes two or three times as many where curves are as small as letters.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "compiler/lower/pairs.hpp"

namespace vtm::compiler {

/// How near chords are to their curve.
struct ChordTolerance {
    ChordTolerance(double d, double a = 0, double t = 1) : distance(d), area(a), turn(t) {}

    double distance;  ///< no chord is farther from it
    /// If not 0, this much of a pixel's area is misplaced where an edge passes through it; curves that are
    /// one chord keep to the distance.
    double area;
    double turn;  ///< radians of a curve in a chord, about, if there is an area

    /// In a space in which lengths are so many times as long.
    ChordTolerance scaled(double by) const { return {distance * by, area * by * by, turn}; }
};

namespace area_chords {

/// h³ κ may be so many times the area, as was said.
inline constexpr double perArea = 1 / 0.0174;
/// The first and the last chord, in whole ones.
inline constexpr double endShare = std::numbers::sqrt2 / 2;

/// How many chords an interval of so many whole ones takes.
inline int count(double whole) { return 2 + int(std::ceil(std::max(0.0, whole - 2 * endShare))); }

/// By the exponent.
inline double roughCubeRoot(double v) {
    constexpr std::uint64_t third = 0x2A9F'7893'0000'0000;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(v) / 3 + third);
}
inline Pair roughCubeRoot(Pair v) { return Pair{roughCubeRoot(v[0]), roughCubeRoot(v[1])}; }
/// Within 1/2000: after a step of Halley's.
template <class Number>
Number cubeRoot(Number v) {
    const Number root = roughCubeRoot(v), cubed = root * root * root;
    return root * (cubed + 2 * v) / (2 * cubed + v);
}

/// Whole chords per unit of a curve's parameter, of which these are the derivatives: ∛κ ds, and more where
/// the curve turns by radians in a chord, of which what was said is not true; and no fewer than that it turns
/// by 1 / `perTurn` in each. `per`: 1 / (h³ κ).
template <class Number>
Number density(double per, Number turn, Number speed, double perTurn = 1) {
    turn = magnitude(turn);
    const Number chords = cubeRoot(per * turn * speed * speed) + turn, byTurn = turn * perTurn;
    return chords < byTurn ? byTurn : chords;
}

/// By how much of its distance from the line between its neighbours, `before` and `after` it, a vertex moves:
/// that distance is κ |before| |after| / 2.
inline glm::dvec2 outwards(glm::dvec2 before, glm::dvec2 after, double first, double last) {
    const glm::dvec2 line = before + after;
    const double a = glm::dot(before, before), b = glm::dot(after, after), square = glm::dot(line, line);
    // Where the curve all but turns back, the line says nothing.
    if (!(glm::dot(before, after) > 0.5 * std::sqrt(a * b)))
        return glm::dvec2(0);
    const double share = (first * a + last * b) / (12 * std::sqrt(a * b));
    return glm::dvec2(-line.y, line.x) * (share * (line.x * before.y - line.y * before.x) / square);
}

/// Moves all points but the first and the last, which stand on a curve.
template <class At>
void moveOutwards(std::size_t size, const At& at) {
    glm::dvec2 before = at(0), here = at(1);
    for (std::size_t i = 1; i + 1 < size; ++i) {
        const glm::dvec2 after = at(i + 1);
        // A chord whose other end stays is to be moved by twice as much at this one.
        const double first = i == 1 ? 2 : 1, last = i + 2 == size ? 2 : 1;
        at(i) = here + outwards(here - before, after - here, first, last);
        before = here;
        here = after;
    }
}

}  // namespace area_chords
}  // namespace vtm::compiler
