#include "compiler/fit/chains.hpp"

#include "compiler/lower/pairs.hpp"

namespace vtm::compiler {
namespace {

constexpr EdgeEnd noEnd = 0xFFFFFFFFu;

bool isVisible(const Sides& sides) { return sides.left != sides.right; }

}  // namespace

void Chains::link(const PlanarLeaf& leaf, const Square& square, double scale) {
    origin_ = {square.x0, square.y0};
    scale_ = scale;
    points_ = 0;
    all.clear();
    meet(leaf);
    const auto count = static_cast<std::uint32_t>(leaf.sides.size());
    for (std::uint32_t e = 0; e < count; ++e)
        if (!used_[e]) {
            if (partner(leaf, endAtA(e)) == noEnd)
                follow(leaf, endAtA(e));
            else if (partner(leaf, endAtB(e)) == noEnd)
                follow(leaf, endAtB(e));
        }
    for (std::uint32_t e = 0; e < count; ++e)
        if (!used_[e])
            follow(leaf, endAtA(e));  // a closed loop
}

/// Finds the meetings, and makes room for the points of all edges.
void Chains::meet(const PlanarLeaf& leaf) {
    const auto count = static_cast<std::uint32_t>(leaf.sides.size());
    used_.resize(count);
    meetings_.assign(leaf.vertices.all().size(), {});
    std::size_t points = 2;
    for (std::uint32_t e = 0; e < count; ++e) {
        used_[e] = !isVisible(leaf.sides[e]);
        if (used_[e])
            continue;
        points += leaf.set->edges[e].chordCount() + 1;
        for (const EdgeEnd end : {endAtA(e), endAtB(e)}) {
            Meeting& meeting = meetings_[leaf.vertices.of(end)];
            ++meeting.count;
            meeting.ends ^= end;
        }
    }
    if (x.size() < points) {
        x.resize(points);
        y.resize(points);
    }
}

/// The end at which the boundary that comes in at a visible end goes on: with the same paints, at a vertex
/// where but one other visible edge ends.
EdgeEnd Chains::partner(const PlanarLeaf& leaf, EdgeEnd end) const {
    const Meeting& meeting = meetings_[leaf.vertices.of(end)];
    if (meeting.count != 2)
        return noEnd;
    const EdgeEnd other = meeting.ends ^ end;
    const Sides &s = leaf.sides[end / 2], &t = leaf.sides[other / 2];
    const bool sameDirection = isAtA(end) != isAtA(other);
    const bool matches =
        sameDirection ? s.left == t.left && s.right == t.right : s.left == t.right && s.right == t.left;
    return matches ? other : noEnd;
}

/// From an end of an edge along it and on.
void Chains::follow(const PlanarLeaf& leaf, EdgeEnd end) {
    const Sides& sides = leaf.sides[end / 2];
    Chain chain{points_, 0, isAtA(end) ? sides.left : sides.right, isAtA(end) ? sides.right : sides.left,
                {},      {}};
    for (bool isFirst = true; end != noEnd && !used_[end / 2]; isFirst = false) {
        const Edge& edge = leaf.set->edges[end / 2];
        const bool fromA = isAtA(end);
        used_[end / 2] = true;
        if (isFirst)
            chain.start = fromA ? edge.a : edge.b;
        else
            --points_;  // both edges have it
        append(leaf, edge, fromA);
        chain.end = fromA ? edge.b : edge.a;
        end = partner(leaf, otherEnd(end));
    }
    chain.count = points_ - chain.first;
    all.push_back(chain);
}

void Chains::append(const PlanarLeaf& leaf, const Edge& edge, bool fromA) {
    const std::uint32_t count = edge.chordCount() + 1;
    const LatticePoint* p = leaf.set->vertices.data() + (fromA ? edge.first : edge.last);
    double *toX = x.data() + points_, *toY = y.data() + points_;
    const Pair originX = both(origin_.x), originY = both(origin_.y), scale = both(scale_);
    const std::ptrdiff_t step = fromA ? 1 : -1;
    // An odd one's other is written over, or stands after the last.
    for (std::uint32_t i = 0; i < count; i += 2, p += 2 * step) {
        const LatticePoint q = i + 1 < count ? p[step] : *p;
        store(toX + i, (Pair{double(p->x), double(q.x)} - originX) * scale);
        store(toY + i, (Pair{double(p->y), double(q.y)} - originY) * scale);
    }
    points_ += count;
}

}  // namespace vtm::compiler
