/// \file
/// How chords lie to each other, for snapping.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "compiler/lower/lattice.hpp"

namespace vtm::compiler {

inline bool isBetween(Coord low, Coord v, Coord high) { return low <= v && v <= high; }

/// Whether p, known to lie on the line of a→b, lies on the chord, ends included.
inline bool isOnChord(LatticePoint a, LatticePoint b, LatticePoint p) {
    return isBetween(std::min(a.x, b.x), p.x, std::max(a.x, b.x)) &&
           isBetween(std::min(a.y, b.y), p.y, std::max(a.y, b.y));
}

/// The first of first .. last - 1, whose x rise, that is not below x; else last. Its steps depend on the
/// count alone.
inline const LatticePoint* firstNotBelow(const LatticePoint* first, const LatticePoint* last, Coord x) {
    auto count = last - first;
    for (; count > 1; count -= count / 2)
        first += first[count / 2 - 1].x < x ? count / 2 : 0;
    return first + (count == 1 && first->x < x);
}

/// Whether both are on one side of zero, and farther from it than `reach`.
inline bool areBeyond(std::int64_t p, std::int64_t q, std::int64_t reach) {
    return ((p > reach) & (q > reach)) | ((p < -reach) & (q < -reach));
}

inline bool overlap(Coord a, Coord b, Coord c, Coord d) {
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

/// Steps, more than two edges that are bent by √2 come nearer to each other.
inline constexpr int bendReach = 3;

/// orient(a, b, ·) of points within bendReach of the line a→b is no more.
inline std::int64_t near(LatticePoint a, LatticePoint b) {
    return bendReach * (std::abs(std::int64_t{b.x} - a.x) + std::abs(std::int64_t{b.y} - a.y));
}

}  // namespace vtm::compiler
