#include "compiler/planar/clipped_run.hpp"

namespace vtm::compiler {

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

}  // namespace vtm::compiler
