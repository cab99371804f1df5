/// \file
/// Cutting clipped runs at a square: cuts are rounded to even positions of the odd border, so they keep
/// their order along it and never meet a corner.
#pragma once

#include "compiler/lower/outline.hpp"

namespace vtm::compiler {

/// Strictly inside.
inline bool isInside(const Square& s, LatticePoint p) {
    return (p.x > s.x0) & (p.x < s.x1()) & (p.y > s.y0) & (p.y < s.y1());
}

/// Where a chord that passes through the square's inside, or ends there, comes in from its first end, which
/// is outside.
LatticePoint cutAtEntry(const Square& square, const Chord& chord);

}  // namespace vtm::compiler
