#include "compiler/planar/clipped_run.hpp"

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

ClippedRun narrowed(Points points, ClippedRun clippedRun, const Square& square) {
    const LatticePoint from = points[clippedRun.first], to = points[clippedRun.last];
    const bool right = to.x >= from.x, up = to.y >= from.y;
    const Coord x0 = square.x0, x1 = square.x1(), y0 = square.y0, y1 = square.y1();
    // Along the clipped run, "the end of this chord has come to the square" and "its start has gone beyond
    // it" change once each, from false to true.
    const auto arrived = [&](LatticePoint p) {
        return (right ? p.x > x0 : p.x < x1) && (up ? p.y > y0 : p.y < y1);
    };
    const auto gone = [&](LatticePoint p) {
        return (right ? p.x > x1 : p.x < x0) || (up ? p.y > y1 : p.y < y0);
    };
    ClippedRun part = clippedRun;
    if (!arrived(points[part.first + 1]))
        part.first =
            firstWhere(part.first + 1, part.last, [&](std::uint32_t i) { return arrived(points[i + 1]); });
    if (part.first < part.last && gone(points[part.last - 1]))
        part.last = firstWhere(part.first, part.last - 1, [&](std::uint32_t i) { return gone(points[i]); });
    if (part.last == part.first + 1 && !meets(points[part.first], points[part.last], square))
        part.last = part.first;
    return part;
}

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
