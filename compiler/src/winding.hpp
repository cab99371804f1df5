/// \file
/// How a chord changes a layer's winding number between corners of cells.
///
/// Going along +x across an edge that runs upward (dy > 0) one steps from its left to its right: the
/// winding falls by one. Going along +y across one that runs to +x one steps from right to left: it
/// rises by one. All decisions use cornerOnLeft, so they agree with each other and with clipping.
#pragma once

#include "compiler/src/outline.hpp"

namespace vtm::compiler {

/// From (x, y0) to (x, y1), y0 < y1, all odd.
inline int windingAlongY(const Chord& c, Coord x, Coord y0, Coord y1) {
    if ((c.a.x < x) == (c.b.x < x))
        return 0;
    const bool below = cornerOnLeft(c.a, c.b, {x, y0}), above = cornerOnLeft(c.a, c.b, {x, y1});
    return int{above} - int{below};
}

/// From (x0, y) to (x1, y), x0 < x1, all odd.
inline int windingAlongX(const Chord& c, Coord y, Coord x0, Coord x1) {
    if ((c.a.y < y) == (c.b.y < y))
        return 0;
    const bool before = cornerOnLeft(c.a, c.b, {x0, y}), after = cornerOnLeft(c.a, c.b, {x1, y});
    return int{after} - int{before};
}

/// From (from.x, from.y) along y, then along x, to `to`; to.x >= from.x, to.y >= from.y.
inline int windingBetween(const Chord& c, LatticePoint from, LatticePoint to) {
    return (to.y > from.y ? windingAlongY(c, from.x, from.y, to.y) : 0) +
           (to.x > from.x ? windingAlongX(c, to.y, from.x, to.x) : 0);
}

/// Whether the chord passes through the square's inside.
inline bool meets(const Chord& c, const Square& s) {
    if ((c.a.x < s.x0 && c.b.x < s.x0) || (c.a.x > s.x1() && c.b.x > s.x1()) ||
        (c.a.y < s.y0 && c.b.y < s.y0) || (c.a.y > s.y1() && c.b.y > s.y1()))
        return false;
    const bool left = cornerOnLeft(c.a, c.b, s.corner(0));
    return cornerOnLeft(c.a, c.b, s.corner(1)) != left || cornerOnLeft(c.a, c.b, s.corner(2)) != left ||
           cornerOnLeft(c.a, c.b, s.corner(3)) != left;
}

}  // namespace vtm::compiler
