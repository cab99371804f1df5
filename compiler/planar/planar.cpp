#include "compiler/planar/planar.hpp"
#include <vtm/limits/limits.hpp>

#include <algorithm>
#include <cmath>

namespace vtm::compiler {
namespace {

int sign(std::int64_t v) { return (v > 0) - (v < 0); }

/// Sides 0 and 2 are followed along +x, 1 and 3 along +y.
bool isInsideOnLeft(std::size_t side) { return side < 2; }

}  // namespace

/// A direction of sweeping over the edges: along +x at a height between two lattice rows, or along
/// +y at a position between two columns. `u` is measured along the sweep, `v` across it.
struct Planariser::Axis {
    bool alongX;
    Coord u(LatticePoint p) const { return alongX ? p.x : p.y; }
    Coord v(LatticePoint p) const { return alongX ? p.y : p.x; }
    /// Change of winding, in multiples of the edge's own, on crossing it in the sweep's direction:
    /// along +x an upward edge (dy > 0) is met from its left; along +y a rightward one (dx > 0) from
    /// its right.
    int crossingSign(const Edge& e) const { return alongX ? -sign(e.b.y - e.a.y) : sign(e.b.x - e.a.x); }
    /// Whether the edge meets the line v = m + ½, on which no vertex lies.
    bool meets(const Edge& e, Coord m) const { return (v(e.a) <= m) != (v(e.b) <= m); }
};

const PlanarLeaf& Planariser::run(const Square& square, Points points,
                                  std::span<const ClippedRun> clippedRuns, RegionPaints& regions,
                                  double maxBend) {
    square_ = square;
    regions_ = &regions;
    leaf_.certified = false;
    leaf_.set = snapper_.run(square, points, clippedRuns, maxBend);
    if (!leaf_.set)
        return leaf_;
    leaf_.sides.assign(leaf_.set->edges.size(), {});
    leftSums_.resize(leaf_.set->edges.size());
    consistent_ = true;
    leaf_.vertices.collect(*leaf_.set, square);
    visited_.clear();
    for (const Vertices::Vertex& v : leaf_.vertices.all())
        visited_.push_back(!v.isInner());
    const bool cornersAgree = labelFromBorder();
    for (std::uint32_t e = 0; e < leaf_.sides.size(); ++e)
        if (!leaf_.sides[e].known) {
            sweepTo(e);
            walkFrom(e);
        }
    findFlows();
    leaf_.certified = cornersAgree && consistent_ && certifyVertices() && certifySides();
    return leaf_;
}

// ---- label ------------------------------------------------------------------------------------

void Planariser::cross(std::uint32_t edge, int times) {
    for (const Change& c : leaf_.set->of(leaf_.set->edges[edge]))
        regions_->change(c.layer, times * c.winding);
}

/// The edge's chord that meets the line v = m + ½.
Chord Planariser::chordAt(const Axis& axis, const Edge& e, Coord m) const {
    const bool low = axis.v(e.a) <= m;
    const std::uint32_t k = firstWhere(0, e.chordCount() - 1, [&](std::uint32_t i) {
        return (axis.v(leaf_.set->vertex(e, i + 1)) <= m) != low;
    });
    return {leaf_.set->vertex(e, k), leaf_.set->vertex(e, k + 1)};
}

/// Where a chord meets the line v = m + ½: u + du · rise / (2 dv).
struct Planariser::Place {
    std::int64_t u, du, dv, rise;

    Place(const Axis& axis, const Chord& c, Coord m)
        : u(axis.u(c.a)),
          du(std::int64_t{axis.u(c.b)} - axis.u(c.a)),
          dv(std::int64_t{axis.v(c.b)} - axis.v(c.a)),
          rise(2 * std::int64_t{m} + 1 - 2 * std::int64_t{axis.v(c.a)}) {}

    double value() const {
        return static_cast<double>(u) +
               static_cast<double>(du) * static_cast<double>(rise) / (2.0 * static_cast<double>(dv));
    }
};

/// In doubles the places are within 2^-20 steps; nearer ones are compared exactly.
bool Planariser::isBefore(const Place& f, const Place& e) {
    constexpr double sure = 1e-3;
    const double difference = f.value() - e.value();
    if (std::abs(difference) > sure)
        return difference < 0;
    struct Ratio {
        Int128 numerator;
        std::int64_t denominator;
    };
    const auto exact = [](const Place& p) {
        Ratio r{Int128{2 * p.u} * p.dv + Int128{p.rise} * p.du, 2 * p.dv};
        return r.denominator < 0 ? Ratio{-r.numerator, -r.denominator} : r;
    };
    const Ratio rf = exact(f), re = exact(e);
    return rf.numerator * re.denominator < re.numerator * rf.denominator;
}

void Planariser::sweepTo(std::uint32_t index) {
    limits::check();
    const std::vector<Edge>& edges = leaf_.set->edges;
    const Edge& e = edges[index];
    const Axis axis{e.a.y != e.b.y};
    const Coord m = std::min(axis.v(e.a), axis.v(e.b));
    // From the first corner along the border to the start of the sweep line v = m + ½.
    regions_->toCorner();
    const Axis border{!axis.alongX};
    for (const EdgeEnd end : leaf_.vertices.border(axis.alongX ? 3 : 0))
        if (axis.v(leaf_.vertices.all()[leaf_.vertices.of(end)].at) <= m)
            cross(end / 2, border.crossingSign(edges[end / 2]));
    const Place place(axis, chordAt(axis, e, m), m);
    const auto [low, high] = std::minmax({axis.u(e.a), axis.u(e.b)});
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        const Edge& f = edges[i];
        if (i == index || !axis.meets(f, m))
            continue;
        const auto [fLow, fHigh] = std::minmax({axis.u(f.a), axis.u(f.b)});
        if (fHigh < low || (fLow <= high && isBefore(Place(axis, chordAt(axis, f, m), m), place)))
            cross(i, axis.crossingSign(f));
    }
    if (axis.crossingSign(e) > 0)  // met from its right
        cross(index, 1);
}

/// From the left of an edge, all round the part of the map that it is connected with.
void Planariser::walkFrom(std::uint32_t edge) {
    arrive(endAtB(edge));
    walk();
    crossFrom(endAtA(edge));
    arrive(endAtA(edge));
    walk();
}

/// At the end of an edge that has been followed with the region on its left.
void Planariser::arrive(EdgeEnd end) {
    const std::uint32_t vertex = leaf_.vertices.of(end);
    if (visited_[vertex])
        return;
    visited_[vertex] = true;
    const auto ends = leaf_.vertices.ends(leaf_.vertices.all()[vertex]);
    visits_.push_back({ends, leaf_.vertices.place(end), static_cast<std::uint32_t>(ends.size()), false,
                       regions_->windingSum()});
}

/// Going clockwise round a vertex from the edge by which one came, one stands on the left of the next
/// edge, as seen from the vertex: follow it, walk round the vertex at its other end, which leads back
/// here, then cross it.
void Planariser::walk() {
    while (!visits_.empty()) {
        limits::check();
        Visit& visit = visits_.back();
        const std::uint32_t next =
            (visit.at == 0 ? static_cast<std::uint32_t>(visit.ends.size()) : visit.at) - 1;
        const EdgeEnd end = visit.ends[next];
        if (visit.left > 1 && !visit.followed) {
            visit.followed = true;
            const std::size_t depth = visits_.size();
            arrive(otherEnd(end));
            if (visits_.size() > depth)
                continue;
        }
        crossFrom(end);
        visit.at = next;
        visit.followed = false;
        if (--visit.left == 0) {
            consistent_ &= regions_->windingSum() == visit.windingSum;
            visits_.pop_back();
        }
    }
}

/// From the left to the right of an edge, as seen from one of its ends. The first time it gets its labels;
/// then the windings must be what they were.
void Planariser::crossFrom(EdgeEnd end) {
    const std::uint32_t edge = end / 2;
    const bool fromLeft = isAtA(end);
    Sides& sides = leaf_.sides[edge];
    const std::uint64_t before = regions_->windingSum();
    if (sides.known) {
        cross(edge, fromLeft ? -1 : 1);
    } else {
        const PaintId left = regions_->paint();
        cross(edge, fromLeft ? -1 : 1);
        const PaintId right = regions_->paint();
        sides = fromLeft ? Sides{left, right, true} : Sides{right, left, true};
        leftSums_[edge] = fromLeft ? before : regions_->windingSum();
    }
    consistent_ &= leftSums_[edge] == (fromLeft ? before : regions_->windingSum());
}

/// Along a side to its other corner, and all round the parts of the map that one meets there. One comes to
/// an edge on its left, as seen from the border, where the inside is on the left.
void Planariser::along(std::size_t side) {
    const bool fromLeft = isInsideOnLeft(side);
    for (const EdgeEnd end : leaf_.vertices.border(side)) {
        const bool isNew = !leaf_.sides[end / 2].known;
        const auto walkOn = [&] {
            arrive(otherEnd(end));
            walk();
        };
        if (isNew && fromLeft)
            walkOn();
        crossFrom(fromLeft ? end : otherEnd(end));
        if (isNew && !fromLeft)
            walkOn();
    }
}

/// Both ways from corner 0 to corner 2 must agree.
bool Planariser::labelFromBorder() {
    regions_->toCorner();
    leaf_.corners[0] = regions_->paint();
    along(0);
    leaf_.corners[1] = regions_->paint();
    along(1);
    leaf_.corners[2] = regions_->paint();
    const std::uint64_t sum = regions_->windingSum();
    regions_->toCorner();
    along(3);
    leaf_.corners[3] = regions_->paint();
    along(2);
    return regions_->windingSum() == sum;
}

// ---- certify ----------------------------------------------------------------------------------

/// Of each edge: hashValue(left) - hashValue(right), as seen going from a to b.
void Planariser::findFlows() {
    flows_.resize(leaf_.sides.size());
    std::transform(leaf_.sides.begin(), leaf_.sides.end(), flows_.begin(), [](const Sides& sides) {
        return sides.left == sides.right ? 0 : hashValue(sides.left) - hashValue(sides.right);
    });
}

/// As seen going to the vertex.
std::uint64_t Planariser::flow(EdgeEnd end) const {
    const std::uint64_t back = -std::uint64_t{isAtA(end)};
    return (flows_[end / 2] ^ back) - back;
}

bool Planariser::certifyVertices() const {
    std::uint64_t open = 0;
    for (const Vertices::Vertex& v : leaf_.vertices.all()) {
        std::uint64_t sum = 0;
        for (const EdgeEnd end : leaf_.vertices.ends(v))
            sum += flow(end);
        open |= v.isInner() ? sum : 0;
    }
    return open == 0;
}

bool Planariser::certifySides() const {
    for (std::size_t side = 0; side < 4; ++side) {
        std::uint64_t sum = hashValue(leaf_.corners[side]) - hashValue(leaf_.corners[(side + 1) % 4]);
        for (const EdgeEnd end : leaf_.vertices.border(side))
            sum += flow(end);
        if (sum != 0)
            return false;
    }
    return true;
}

}  // namespace vtm::compiler
