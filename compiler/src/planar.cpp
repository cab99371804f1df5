#include "compiler/src/planar.hpp"

#include <cmath>

#include "compiler/src/small_sort.hpp"

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

const PlanarLeaf& Planariser::run(const Square& square, Points points, std::span<const Strand> strands,
                                  RegionPaints& regions) {
    square_ = square;
    regions_ = &regions;
    leaf_.certified = false;
    leaf_.set = snapper_.run(square, points, strands);
    if (!leaf_.set)
        return leaf_;
    leaf_.sides.assign(leaf_.set->edges.size(), {});
    consistent_ = true;
    collectEnds();
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

// ---- structure --------------------------------------------------------------------------------

void Planariser::collectEnds() {
    const std::vector<Edge>& edges = leaf_.set->edges;
    std::vector<End>& ends = leaf_.ends;
    ends.clear();
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        ends.push_back({edges[e].a, e, true});
        ends.push_back({edges[e].b, e, false});
    }
    sortByKey(ends, spareEnds_, [](const End& end) { return sortKey(end.at); });
    leaf_.endOf.resize(ends.size());
    leaf_.firstOf.resize(ends.size());
    visited_.assign(ends.size(), false);
    for (auto& side : border_)
        side.clear();
    for (std::uint32_t first = 0; first < ends.size();) {
        const LatticePoint at = ends[first].at;
        std::uint32_t last = first + 1;
        while (last < ends.size() && ends[last].at == at)
            ++last;
        if (((at.x | at.y) & 1) != 0) {  // on the border
            const int side = sideOf(at);
            visited_[first] = true;
            if (last > first + 1)
                sortAlong(first, last, side);
            auto& border = border_[static_cast<std::size_t>(side)];
            border.insert(border.end(), ends.begin() + first, ends.begin() + last);
        } else if (last > first + 2) {
            sortRound(first, last);
        }
        for (std::uint32_t i = first; i < last; ++i) {
            leaf_.endOf[2 * ends[i].edge + !ends[i].isA] = i;
            leaf_.firstOf[i] = first;
        }
        first = last;
    }
}

/// The vertex after the end's own on its edge.
LatticePoint Planariser::next(const End& end) const {
    const Edge& e = leaf_.set->edges[end.edge];
    return leaf_.set->vertex(e, end.isA ? 1 : e.chordCount() - 1);
}

/// Counter-clockwise by direction, from -y.
void Planariser::sortRound(std::uint32_t first, std::uint32_t last) {
    const LatticePoint at = leaf_.ends[first].at;
    const auto isRight = [&](LatticePoint p) { return p.x > at.x || (p.x == at.x && p.y < at.y); };
    std::sort(leaf_.ends.begin() + first, leaf_.ends.begin() + last, [&](const End& p, const End& q) {
        const LatticePoint a = next(p), b = next(q);
        if (isRight(a) != isRight(b))
            return isRight(a);
        return orient(at, a, b) > 0;
    });
}

/// In the order in which one crosses them on the way along their side: clockwise where the inside is on the
/// left, and all directions lie in half a plane.
void Planariser::sortAlong(std::uint32_t first, std::uint32_t last, int side) {
    const LatticePoint at = leaf_.ends[first].at;
    std::sort(leaf_.ends.begin() + first, leaf_.ends.begin() + last, [&](const End& p, const End& q) {
        const std::int64_t o = orient(at, next(p), next(q));
        return isInsideOnLeft(static_cast<std::size_t>(side)) ? o < 0 : o > 0;
    });
}

/// The side a point lies on, or -1 inside.
int Planariser::sideOf(LatticePoint p) const {
    return p.y == square_.y0     ? 0
           : p.x == square_.x1() ? 1
           : p.y == square_.y1() ? 2
           : p.x == square_.x0   ? 3
                                 : -1;
}

// ---- label ------------------------------------------------------------------------------------

void Planariser::cross(const Edge& e, int times) {
    for (const Change& c : leaf_.set->of(e))
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
    const std::vector<Edge>& edges = leaf_.set->edges;
    const Edge& e = edges[index];
    const Axis axis{e.a.y != e.b.y};
    const Coord m = std::min(axis.v(e.a), axis.v(e.b));
    // From the first corner along the border to the start of the sweep line v = m + ½.
    regions_->toCorner();
    const Axis border{!axis.alongX};
    for (const End& end : border_[axis.alongX ? 3 : 0])
        if (axis.v(end.at) <= m)
            cross(edges[end.edge], border.crossingSign(edges[end.edge]));
    const Place place(axis, chordAt(axis, e, m), m);
    const auto [low, high] = std::minmax({axis.u(e.a), axis.u(e.b)});
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        const Edge& f = edges[i];
        if (i == index || !axis.meets(f, m))
            continue;
        const auto [fLow, fHigh] = std::minmax({axis.u(f.a), axis.u(f.b)});
        if (fHigh < low || (fLow <= high && isBefore(Place(axis, chordAt(axis, f, m), m), place)))
            cross(f, axis.crossingSign(f));
    }
    if (axis.crossingSign(e) > 0)  // met from its right
        cross(e, 1);
}

/// From the left of an edge, all round the part of the map that it is connected with.
void Planariser::walkFrom(std::uint32_t edge) {
    const Edge& e = leaf_.set->edges[edge];
    const PaintId left = regions_->paint();
    arrive(leaf_.endOf[2 * edge + 1]);
    walk();
    cross(e, -1);
    label(edge, {left, regions_->paint(), true});
    arrive(leaf_.endOf[2 * edge]);
    walk();
}

/// At the end of an edge that has been followed with the region on its left.
void Planariser::arrive(std::uint32_t end) {
    const std::uint32_t first = leaf_.firstOf[end];
    if (visited_[first])
        return;
    visited_[first] = true;
    std::uint32_t count = 1;
    while (first + count < leaf_.ends.size() && leaf_.firstOf[first + count] == first)
        ++count;
    visits_.push_back({first, count, end - first, 0, false, regions_->windingSum()});
}

/// Going clockwise round a vertex from the edge by which one came, one stands on the left of the next
/// edge, as seen from the vertex: follow it, walk round the vertex at its other end, which leads back
/// here, then cross it.
void Planariser::walk() {
    while (!visits_.empty()) {
        Visit& visit = visits_.back();
        const std::uint32_t step = visit.crossed + 1;
        const End& end =
            leaf_.ends[visit.first + (visit.arrival + visit.count - step % visit.count) % visit.count];
        const Edge& e = leaf_.set->edges[end.edge];
        if (step < visit.count && !visit.followed) {
            visit.followed = true;
            arrive(leaf_.endOf[2 * end.edge + (end.isA ? 1 : 0)]);
            continue;
        }
        const PaintId left = regions_->paint();
        cross(e, end.isA ? -1 : 1);
        const PaintId right = regions_->paint();
        label(end.edge, end.isA ? Sides{left, right, true} : Sides{right, left, true});
        visit.followed = false;
        if (++visit.crossed == visit.count) {
            consistent_ = consistent_ && regions_->windingSum() == visit.windingSum;
            visits_.pop_back();
        }
    }
}

void Planariser::label(std::uint32_t edge, const Sides& sides) {
    Sides& known = leaf_.sides[edge];
    consistent_ = consistent_ && (!known.known || (known.left == sides.left && known.right == sides.right));
    known = sides;
}

/// Along a side to its other corner, and all round the parts of the map that one meets there. One comes to
/// an edge on its left, as seen from the border, where the inside is on the left.
void Planariser::along(std::size_t side) {
    const Axis axis{side % 2 == 0};
    const bool fromLeft = isInsideOnLeft(side);
    for (const End& end : border_[side]) {
        const Edge& e = leaf_.set->edges[end.edge];
        const bool isNew = !leaf_.sides[end.edge].known;
        const auto walkOn = [&] {
            arrive(leaf_.endOf[2 * end.edge + (end.isA ? 1 : 0)]);
            walk();
        };
        if (isNew && fromLeft)
            walkOn();
        const PaintId before = regions_->paint();
        cross(e, axis.crossingSign(e));
        const PaintId after = regions_->paint();
        label(end.edge, fromLeft == end.isA ? Sides{before, after, true} : Sides{after, before, true});
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

/// Of each edge: mixed(left) - mixed(right), as seen going from a to b.
void Planariser::findFlows() {
    flows_.clear();
    for (const Sides& sides : leaf_.sides)
        flows_.push_back(mixed(sides.left) - mixed(sides.right));
}

/// As seen going to the vertex.
std::uint64_t Planariser::flow(const End& end) const {
    const std::uint64_t back = -std::uint64_t{end.isA};
    return (flows_[end.edge] ^ back) - back;
}

bool Planariser::certifyVertices() const {
    std::uint64_t sum = 0, open = 0;
    for (std::uint32_t i = 0; i < leaf_.ends.size(); ++i) {
        const End& end = leaf_.ends[i];
        const bool begins = leaf_.firstOf[i] == i, isInner = ((end.at.x | end.at.y) & 1) == 0;
        open |= begins ? sum : 0;  // of the vertex before
        sum = (begins ? 0 : sum) + (isInner ? flow(end) : 0);
    }
    return (open | sum) == 0;
}

bool Planariser::certifySides() const {
    for (std::size_t side = 0; side < 4; ++side) {
        std::uint64_t sum = mixed(leaf_.corners[side]) - mixed(leaf_.corners[(side + 1) % 4]);
        for (const End& end : border_[side])
            sum += flow(end);
        if (sum != 0)
            return false;
    }
    return true;
}

}  // namespace vtm::compiler
