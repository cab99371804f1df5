#include "compiler/planar/clip.hpp"

#include <algorithm>

namespace vtm::compiler {
namespace {

/// Where a→b meets the line x = at (or y = at, with the axes exchanged), rounded to an even position
/// strictly inside the side. Differences fit 30 bits, so all sums fit 62.
Coord cutPosition(Coord a, Coord b, Coord aAcross, Coord bAcross, Coord at, Coord low, Coord high) {
    const std::int64_t run = std::int64_t{bAcross} - aAcross, rise = std::int64_t{b} - a;
    const std::int64_t numerator = a * run + rise * (std::int64_t{at} - aAcross);
    const Coord cut = run > 0 ? roundToEven(numerator, run) : roundToEven(-numerator, -run);
    return std::clamp(cut, low + 1, high - 1);
}

}  // namespace

LatticePoint cutAtEntry(const Square& s, const Chord& c) {
    const bool right = c.b.x >= c.a.x, up = c.b.y >= c.a.y;
    const Coord x = right ? s.x0 : s.x1(), y = up ? s.y0 : s.y1();
    bool acrossX = right ? c.a.x < x : c.a.x > x;
    if (acrossX && (up ? c.a.y < y : c.a.y > y))  // in by the line that it meets last
        acrossX = cornerOnLeft(c.a, c.b, {x, y}) != (right == up);
    if (acrossX)
        return {x, cutPosition(c.a.y, c.b.y, c.a.x, c.b.x, x, s.y0, s.y1())};
    return {cutPosition(c.a.x, c.b.x, c.a.y, c.b.y, y, s.x0, s.x1()), y};
}

}  // namespace vtm::compiler
