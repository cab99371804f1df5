/// \file
/// Clipped runs: what of a layer's monotone runs passes through a cell, and how it changes the layer's
/// winding number between corners of cells.
///
/// Going along +x across an edge that runs upward (dy > 0) one steps from its left to its right: the
/// winding falls by one. Going along +y across one that runs to +x one steps from right to left: it
/// rises by one. All decisions use cornerOnLeft, so they agree with each other and with clipping.
#pragma once

#include <algorithm>
#include <span>

#include "compiler/lower/outline.hpp"

namespace vtm::compiler {

/// Chords first .. last - 1 of one run: points[first] to points[last], monotone in x and in y.
struct ClippedRun {
    std::uint32_t first = 0, last = 0;
    std::uint32_t layer = 0;
};

using Points = std::span<const LatticePoint>;

/// Whether the chord passes through the square's inside.
inline bool meets(LatticePoint a, LatticePoint b, const Square& s) {
    if ((a.x < s.x0 && b.x < s.x0) || (a.x > s.x1() && b.x > s.x1()) || (a.y < s.y0 && b.y < s.y0) ||
        (a.y > s.y1() && b.y > s.y1()))
        return false;
    const bool left = cornerOnLeft(a, b, s.corner(0));
    return cornerOnLeft(a, b, s.corner(1)) != left || cornerOnLeft(a, b, s.corner(2)) != left ||
           cornerOnLeft(a, b, s.corner(3)) != left;
}

/// The first of first .. last - 1 for which `holds` is true, given that it stays true from there on; else
/// last. Its steps depend on the count alone: which way each goes is as good as random.
template <class Holds>
std::uint32_t firstWhere(std::uint32_t first, std::uint32_t last, const Holds& holds) {
    std::uint32_t count = last - first;
    for (; count > 1; count -= count / 2)
        first += holds(first + count / 2 - 1) ? 0 : count / 2;
    return first + (count == 1 && !holds(first));
}

/// The part of the clipped run whose chords pass through the square's inside; empty (first == last) if
/// there is none. Two or more neighbours whose boxes meet the square share a vertex inside it, so only a
/// single chord can miss it.
ClippedRun narrowed(Points points, ClippedRun clippedRun, const Square& square);

/// The chord of the clipped run that crosses the line y = `y` (odd), or `clippedRun.last` if none does.
inline std::uint32_t chordAtY(Points points, const ClippedRun& clippedRun, Coord y) {
    const bool below = points[clippedRun.first].y < y;
    if (below == (points[clippedRun.last].y < y))
        return clippedRun.last;
    return firstWhere(clippedRun.first, clippedRun.last,
                      [&](std::uint32_t i) { return (points[i + 1].y < y) != below; });
}

inline std::uint32_t chordAtX(Points points, const ClippedRun& clippedRun, Coord x) {
    const bool before = points[clippedRun.first].x < x;
    if (before == (points[clippedRun.last].x < x))
        return clippedRun.last;
    return firstWhere(clippedRun.first, clippedRun.last,
                      [&](std::uint32_t i) { return (points[i + 1].x < x) != before; });
}

/// From (x, y0) to (x, y1), y0 < y1, all odd.
inline int windingAlongY(Points points, const ClippedRun& clippedRun, Coord x, Coord y0, Coord y1) {
    const std::uint32_t i = chordAtX(points, clippedRun, x);
    if (i == clippedRun.last)
        return 0;
    const LatticePoint a = points[i], b = points[i + 1];
    return int{cornerOnLeft(a, b, {x, y1})} - int{cornerOnLeft(a, b, {x, y0})};
}

/// From (x0, y) to (x1, y), x0 < x1, all odd.
inline int windingAlongX(Points points, const ClippedRun& clippedRun, Coord y, Coord x0, Coord x1) {
    const std::uint32_t i = chordAtY(points, clippedRun, y);
    if (i == clippedRun.last)
        return 0;
    const LatticePoint a = points[i], b = points[i + 1];
    return int{cornerOnLeft(a, b, {x1, y})} - int{cornerOnLeft(a, b, {x0, y})};
}

/// From (from.x, from.y) along y, then along x, to `to`; to.x >= from.x, to.y >= from.y.
inline int windingBetween(Points points, const ClippedRun& clippedRun, LatticePoint from, LatticePoint to) {
    return (to.y > from.y ? windingAlongY(points, clippedRun, from.x, from.y, to.y) : 0) +
           (to.x > from.x ? windingAlongX(points, clippedRun, to.y, from.x, to.x) : 0);
}

inline bool isStrictlyInside(const Square& s, LatticePoint p) {
    return (p.x > s.x0) & (p.x < s.x1()) & (p.y > s.y0) & (p.y < s.y1());
}

/// Where a chord that passes through the square's inside, or ends there, comes in from its first end, which
/// is outside. Cuts are rounded to even positions of the odd border, so they keep their order along it and
/// never meet a corner.
LatticePoint cutAtEntry(const Square& square, const Chord& chord);

}  // namespace vtm::compiler
