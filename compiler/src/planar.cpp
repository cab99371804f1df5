#include "compiler/src/planar.hpp"

#include <cmath>

namespace vtm::compiler {
namespace {

int sign(std::int64_t v) { return (v > 0) - (v < 0); }

/// 64 well-mixed bits for a paint (SplitMix64): sums of them vanish by chance once in 2^64.
std::uint64_t hash(PaintId paint) {
    std::uint64_t z = (paint + std::uint64_t{1}) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

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
                                  std::span<const int> windings, RegionPaints& paints) {
    square_ = square;
    corner_ = windings;
    paints_ = &paints;
    leaf_.certified = false;
    leaf_.set = snapper_.run(square, points, strands);
    if (!leaf_.set)
        return leaf_;
    leaf_.sides.assign(leaf_.set->edges.size(), {});
    collectEnds();
    for (std::uint32_t e = 0; e < leaf_.sides.size(); ++e)
        if (!leaf_.sides[e].known) {
            sweepTo(e);
            spread(e);
        }
    leaf_.certified = labelCorners() && certifyVertices() && certifySides();
    return leaf_;
}

// ---- structure --------------------------------------------------------------------------------

void Planariser::collectEnds() {
    const std::vector<Edge>& edges = leaf_.set->edges;
    ends_.clear();
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        ends_.push_back({edges[e].a, e, true});
        ends_.push_back({edges[e].b, e, false});
    }
    std::sort(ends_.begin(), ends_.end(),
              [](const End& p, const End& q) { return p.at != q.at ? p.at < q.at : p.edge < q.edge; });
    endOf_.resize(ends_.size());
    for (auto& side : border_)
        side.clear();
    for (std::uint32_t i = 0; i < ends_.size(); ++i) {
        endOf_[2 * ends_[i].edge + (ends_[i].isA ? 0 : 1)] = i;
        if (const int side = sideOf(ends_[i].at); side >= 0)
            border_[static_cast<std::size_t>(side)].push_back(ends_[i]);
    }
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

void Planariser::cross(Windings& w, const Edge& e, int times) const {
    for (const Change& c : leaf_.set->of(e))
        w[c.layer] += times * c.winding;
}

/// The edge's chord that meets the line v = m + ½.
Chord Planariser::chordAt(const Axis& axis, const Edge& e, Coord m) const {
    const bool low = axis.v(e.a) <= m;
    const std::uint32_t k = firstWhere(
        0, e.innerCount, [&](std::uint32_t i) { return (axis.v(leaf_.set->vertex(e, i + 1)) <= m) != low; });
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
    swept_.assign(corner_.begin(), corner_.end());
    const Axis border{!axis.alongX};
    for (const End& end : border_[axis.alongX ? 3 : 0])
        if (axis.v(end.at) <= m)
            cross(swept_, edges[end.edge], border.crossingSign(edges[end.edge]));
    const Place place(axis, chordAt(axis, e, m), m);
    const auto [low, high] = std::minmax(axis.u(e.a), axis.u(e.b));
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        const Edge& f = edges[i];
        if (i == index || !axis.meets(f, m))
            continue;
        const auto [fLow, fHigh] = std::minmax(axis.u(f.a), axis.u(f.b));
        if (fHigh < low || (fLow <= high && isBefore(Place(axis, chordAt(axis, f, m), m), place)))
            cross(swept_, f, axis.crossingSign(f));
    }
    // We stand on the left of an edge that is crossed with -1, on the right of the other kind.
    const int crossing = axis.crossingSign(e);
    const PaintId here = paints_->paint(swept_);
    cross(swept_, e, crossing);
    const PaintId there = paints_->paint(swept_);
    leaf_.sides[index] = crossing < 0 ? Sides{here, there, true} : Sides{there, here, true};
}

/// Carries an edge's labels along both ways through inner vertices of degree two.
void Planariser::spread(std::uint32_t from) {
    for (const bool fromA : {true, false}) {
        std::uint32_t edge = from;
        bool isA = fromA;
        while (const End* next = other(edge, isA)) {
            if (leaf_.sides[next->edge].known)
                break;
            const Sides& l = leaf_.sides[edge];
            const bool sameDirection = next->isA != isA;
            leaf_.sides[next->edge] =
                sameDirection ? Sides{l.left, l.right, true} : Sides{l.right, l.left, true};
            edge = next->edge;
            isA = !next->isA;
        }
    }
}

/// The only other edge's end at this end's vertex, if there is just one and it is inside.
const Planariser::End* Planariser::other(std::uint32_t edge, bool isA) const {
    const std::uint32_t i = endOf_[2 * edge + (isA ? 0 : 1)];
    const LatticePoint at = ends_[i].at;
    if (sideOf(at) >= 0)
        return nullptr;
    const auto same = [&](std::size_t k) { return k < ends_.size() && ends_[k].at == at; };
    const bool before1 = i > 0 && same(i - 1), before2 = i > 1 && same(i - 2);
    const bool after1 = same(i + 1), after2 = same(i + 2);
    if (before1 && !before2 && !after1)
        return &ends_[i - 1];
    if (after1 && !after2 && !before1)
        return &ends_[i + 1];
    return nullptr;
}

// ---- certify ----------------------------------------------------------------------------------

void Planariser::along(Windings& w, std::size_t side) const {
    const Axis axis{side % 2 == 0};
    for (const End& end : border_[side])
        cross(w, leaf_.set->edges[end.edge], axis.crossingSign(leaf_.set->edges[end.edge]));
}

/// Both ways from corner 0 to corner 2 must agree.
bool Planariser::labelCorners() {
    swept_.assign(corner_.begin(), corner_.end());
    leaf_.corners[0] = paints_->paint(swept_);
    along(swept_, 0);
    leaf_.corners[1] = paints_->paint(swept_);
    along(swept_, 1);
    leaf_.corners[2] = paints_->paint(swept_);
    other_.assign(corner_.begin(), corner_.end());
    along(other_, 3);
    leaf_.corners[3] = paints_->paint(other_);
    along(other_, 2);
    return other_ == swept_;
}

/// hash(left) - hash(right), as seen going to the vertex.
std::uint64_t Planariser::flow(const End& end) const {
    const Sides& l = leaf_.sides[end.edge];
    const std::uint64_t d = hash(l.left) - hash(l.right);
    return end.isA ? 0 - d : d;
}

bool Planariser::certifyVertices() const {
    for (std::size_t i = 0; i < ends_.size();) {
        std::uint64_t sum = 0;
        const LatticePoint at = ends_[i].at;
        for (; i < ends_.size() && ends_[i].at == at; ++i)
            sum += flow(ends_[i]);
        if (sum != 0 && sideOf(at) < 0)
            return false;
    }
    return true;
}

bool Planariser::certifySides() const {
    for (std::size_t side = 0; side < 4; ++side) {
        std::uint64_t sum = hash(leaf_.corners[side]) - hash(leaf_.corners[(side + 1) % 4]);
        for (const End& end : border_[side])
            sum += flow(end);
        if (sum != 0)
            return false;
    }
    return true;
}

}  // namespace vtm::compiler
