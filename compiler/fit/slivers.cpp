#include <algorithm>
#include <optional>

#include "compiler/fit/fit.hpp"

namespace vtm::compiler {
namespace {

using Side = std::size_t;

double distance(Pair p, Side side) {
    const double across = side % 2 == 0 ? p[1] : p[0];
    return side == 0 || side == 3 ? across : asset::leafExtent - across;
}

std::optional<Side> borderSide(const Square& square, LatticePoint p) {
    for (Side side = 0; side < 4; ++side)
        if ((side % 2 == 0 ? p.y : p.x) == square.line(side))
            return side;
    return std::nullopt;
}

}  // namespace

/// Drops chains that run along the border, nowhere more than a lattice step inside: traces of shapes
/// that end on the cell's border. What lies between such a chain and the border is below the
/// lattice's resolution; the corners that the chain passes take the paint of its inner side.
void Fitter::cutSlivers() {
    leaf_.slivers = false;
    while (std::erase_if(chains_.all, [&](const Chain& c) { return isSliver(c); }) > 0)
        leaf_.slivers = true;
}

/// Within twice the reach of a sliver from the border.
bool Fitter::isNearBorder(Pair u) const {
    const double margin = 2 * (sliverReach() + scale_), maximum = asset::leafExtent - margin;
    return (u[0] <= margin) | (u[0] >= maximum) | (u[1] <= margin) | (u[1] >= maximum);
}

bool Fitter::isSliver(const Chain& chain) {
    const auto isInner = [](LatticePoint p) { return ((p.x | p.y) & 1) == 0; };
    if (isInner(chain.start) || isInner(chain.end) || !isNearBorder(exact(chain.first + chain.count / 2)))
        return false;
    return cutAlong(chain, chain.start, chain.end, chain.right, chain.left) ||
           cutAlong(chain, chain.end, chain.start, chain.left, chain.right);
}

/// Along the border counter-clockwise from one end of the chain to the other; the leaf's inside lies on the
/// left.
bool Fitter::cutAlong(const Chain& chain, LatticePoint start, LatticePoint end, PaintId outer,
                      PaintId inner) {
    const Side from = *borderSide(square_, start), sides = (*borderSide(square_, end) + 4 - from) % 4;
    for (std::uint32_t i = 1; i < chain.count; ++i)
        if (!hugs(rounded(chain, i - 1), rounded(chain, i), from, sides))
            return false;
    for (Side k = 1; k <= sides; ++k)
        if (leaf_.corners[(from + k) % 4] != outer)
            return false;
    if (!isBorderFree(start, end))
        return false;
    for (Side k = 1; k <= sides; ++k)
        leaf_.corners[(from + k) % 4] = inner;
    return true;
}

/// Whether no chain ends on the border between two of its points, counter-clockwise. One that does lies
/// between the border and a sliver, and has to be cut before it.
bool Fitter::isBorderFree(LatticePoint from, LatticePoint to) const {
    const auto along = [&](LatticePoint p) -> std::optional<std::int64_t> {
        const auto side = borderSide(square_, p);
        if (!side)
            return std::nullopt;
        const std::int64_t x = p.x - std::int64_t{square_.x0}, y = p.y - std::int64_t{square_.y0},
                           length = square_.side;
        const std::array<std::int64_t, 4> behind{x, y, length - x, length - y};
        return static_cast<std::int64_t>(*side) * length + behind[*side];
    };
    const std::int64_t perimeter = 4 * std::int64_t{square_.side}, start = *along(from);
    const auto distanceTo = [&](std::int64_t place) { return (place - start + perimeter) % perimeter; };
    const std::int64_t end = distanceTo(*along(to));
    return std::ranges::none_of(chains_.all, [&](const Chain& c) {
        const auto isBetween = [&](LatticePoint p) {
            const auto place = along(p);
            return place && *place != start && distanceTo(*place) < end;
        };
        return isBetween(c.start) || isBetween(c.end);
    });
}

/// Whether an edge runs within reach of one of the sides from `from` on. The first and the last
/// side are met only near their corners, unless there is but one.
bool Fitter::hugs(Pair p, Pair q, Side from, Side sides) const {
    const double reach = sliverReach();
    const auto near = [&](Side side) { return distance(p, side) <= reach && distance(q, side) <= reach; };
    for (Side k = 0; k <= sides; ++k) {
        const Side side = (from + k) % 4;
        const bool whole = sides == 0 || (k > 0 && k < sides);
        const Side neighbour = k == 0 ? (side + 1) % 4 : (side + 3) % 4;
        if (near(side) && (whole || near(neighbour)))
            return true;
    }
    return false;
}

}  // namespace vtm::compiler
