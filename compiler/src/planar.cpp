#include "compiler/src/planar.hpp"

#include <algorithm>
#include <cmath>

#include "compiler/src/snap.hpp"

namespace vtm::compiler {
namespace {

using Windings = std::vector<int>;

int sign(std::int64_t v) { return (v > 0) - (v < 0); }

/// A direction of sweeping over the edges: along +x at a height between two lattice rows, or along
/// +y at a position between two columns. `u` is measured along the sweep, `v` across it.
struct Axis {
    bool alongX;
    Coord u(LatticePoint p) const { return alongX ? p.x : p.y; }
    Coord v(LatticePoint p) const { return alongX ? p.y : p.x; }
    /// Change of winding, in multiples of the edge's own, on crossing it in the sweep's direction:
    /// along +x an upward edge (dy > 0) is met from its left; along +y a rightward one (dx > 0) from
    /// its right.
    int crossingSign(const Edge& e) const { return alongX ? -sign(e.b.y - e.a.y) : sign(e.b.x - e.a.x); }
};

/// A line v = m + ½, on which no vertex lies.
bool meets(const Axis& axis, const Edge& e, Coord m) {
    return std::min(axis.v(e.a), axis.v(e.b)) <= m && std::max(axis.v(e.a), axis.v(e.b)) > m;
}

/// Whether f meets the line v = m + ½ before e does. In doubles the positions are within 2^-20 steps;
/// nearer ones are compared exactly.
bool before(const Axis& axis, const Edge& f, const Edge& e, Coord m) {
    constexpr double sure = 1e-3;
    struct Ratio {
        Int128 numerator;
        std::int64_t denominator;
        double value() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
    };
    const auto position = [&](const Edge& g) {
        const std::int64_t du = std::int64_t{axis.u(g.b)} - axis.u(g.a),
                           dv = std::int64_t{axis.v(g.b)} - axis.v(g.a);
        const std::int64_t rise = 2 * std::int64_t{m} + 1 - 2 * std::int64_t{axis.v(g.a)};
        Ratio r{Int128{2 * std::int64_t{axis.u(g.a)}} * dv + Int128{rise} * du, 2 * dv};
        if (r.denominator < 0)
            r = {-r.numerator, -r.denominator};
        return r;
    };
    const Ratio pf = position(f), pe = position(e);
    const double difference = pf.value() - pe.value();
    if (std::abs(difference) > sure)
        return difference < 0;
    return pf.numerator * pe.denominator < pe.numerator * pf.denominator;
}

struct Labels {
    std::uint16_t left = 0, right = 0;
    bool known = false;
};

/// 64 well-mixed bits for a paint (SplitMix64): sums of them vanish by chance once in 2^64.
std::uint64_t hash(std::uint16_t paint) {
    std::uint64_t z = (paint + std::uint64_t{1}) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/// An edge's end at a vertex.
struct End {
    LatticePoint at;
    std::uint32_t edge;
    bool isA;
};

class Labelling {
public:
    Labelling(const Square& square, const EdgeSet& set, std::span<const int> windings,
              const Labeller& labeller)
        : square_(square),
          set_(set),
          corner_(windings.begin(), windings.end()),
          labeller_(labeller),
          labels_(set.edges.size()) {
        collectEnds();
        collectBorder();
    }

    PlanarLeaf run() {
        for (std::uint32_t e = 0; e < set_.edges.size(); ++e)
            if (!labels_[e].known) {
                sweepTo(e);
                spread(e);
            }
        PlanarLeaf leaf;
        const bool closed = labelCorners(leaf.corners);
        leaf.certified = closed && certifyVertices() && certifySides(leaf.corners);
        for (std::uint32_t e = 0; e < set_.edges.size(); ++e)
            if (labels_[e].left != labels_[e].right)
                leaf.edges.push_back({set_.edges[e].a, set_.edges[e].b, labels_[e].left, labels_[e].right});
        return leaf;
    }

private:
    // ---- structure ----------------------------------------------------------------------------

    void collectEnds() {
        for (std::uint32_t e = 0; e < set_.edges.size(); ++e) {
            ends_.push_back({set_.edges[e].a, e, true});
            ends_.push_back({set_.edges[e].b, e, false});
        }
        std::sort(ends_.begin(), ends_.end(), [](const End& p, const End& q) { return p.at < q.at; });
        endOf_.resize(2 * set_.edges.size());
        for (std::uint32_t i = 0; i < ends_.size(); ++i)
            endOf_[2 * ends_[i].edge + (ends_[i].isA ? 0 : 1)] = i;
    }

    /// The side a point lies on, or -1 inside.
    int sideOf(LatticePoint p) const {
        return p.y == square_.y0     ? 0
               : p.x == square_.x1() ? 1
               : p.y == square_.y1() ? 2
               : p.x == square_.x0   ? 3
                                     : -1;
    }

    void collectBorder() {
        for (const End& end : ends_)
            if (const int side = sideOf(end.at); side >= 0)
                border_[static_cast<std::size_t>(side)].push_back(end);
    }

    // ---- label --------------------------------------------------------------------------------

    void cross(Windings& w, const Edge& e, int times) const {
        for (const Change& c : set_.of(e))
            w[c.layer] += times * c.winding;
    }

    /// Windings at the start of the sweep line v = m + ½: from the first corner along the border.
    Windings atBorder(const Axis& axis, Coord m) const {
        Windings w = corner_;
        const Axis along{!axis.alongX};
        for (const End& end : border_[axis.alongX ? 3 : 0])
            if (axis.v(end.at) <= m)
                cross(w, set_.edges[end.edge], along.crossingSign(set_.edges[end.edge]));
        return w;
    }

    void sweepTo(std::uint32_t index) {
        const Edge& e = set_.edges[index];
        const Axis axis{e.a.y != e.b.y};
        const Coord m = std::min(axis.v(e.a), axis.v(e.b));
        Windings w = atBorder(axis, m);
        for (std::uint32_t f = 0; f < set_.edges.size(); ++f)
            if (f != index && meets(axis, set_.edges[f], m) && before(axis, set_.edges[f], e, m))
                cross(w, set_.edges[f], axis.crossingSign(set_.edges[f]));
        // We stand on the left of an edge that is crossed with -1, on the right of the other kind.
        const int crossing = axis.crossingSign(e);
        const std::uint16_t here = label(w);
        cross(w, e, crossing);
        const std::uint16_t there = label(w);
        labels_[index] = crossing < 0 ? Labels{here, there, true} : Labels{there, here, true};
    }

    std::uint16_t label(const Windings& w) {
        for (const auto& [windings, paint] : seen_)
            if (windings == w)
                return paint;
        seen_.emplace_back(w, labeller_(w));
        return seen_.back().second;
    }

    /// Carries an edge's labels along both ways through inner vertices of degree two.
    void spread(std::uint32_t from) {
        for (const bool fromA : {true, false}) {
            std::uint32_t edge = from;
            bool isA = fromA;
            while (const End* next = other(edge, isA)) {
                if (labels_[next->edge].known)
                    break;
                const Labels& l = labels_[edge];
                const bool sameDirection = next->isA != isA;
                labels_[next->edge] =
                    sameDirection ? Labels{l.left, l.right, true} : Labels{l.right, l.left, true};
                edge = next->edge;
                isA = !next->isA;
            }
        }
    }

    /// The only other edge's end at this end's vertex, if there is just one and it is inside.
    const End* other(std::uint32_t edge, bool isA) const {
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

    // ---- certify ------------------------------------------------------------------------------

    Windings along(Windings w, std::size_t side) const {
        const Axis axis{side % 2 == 0};
        for (const End& end : border_[side])
            cross(w, set_.edges[end.edge], axis.crossingSign(set_.edges[end.edge]));
        return w;
    }

    /// Both ways from corner 0 to corner 2 must agree.
    bool labelCorners(std::array<std::uint16_t, 4>& corners) {
        const Windings c1 = along(corner_, 0), c2 = along(c1, 1);
        const Windings c3 = along(corner_, 3);
        corners = {label(corner_), label(c1), label(c2), label(c3)};
        return along(c3, 2) == c2;
    }

    /// hash(left) - hash(right), as seen going to the vertex.
    std::uint64_t flow(const End& end) const {
        const Labels& l = labels_[end.edge];
        const std::uint64_t d = hash(l.left) - hash(l.right);
        return end.isA ? 0 - d : d;
    }

    bool certifyVertices() const {
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

    bool certifySides(const std::array<std::uint16_t, 4>& corners) const {
        for (std::size_t side = 0; side < 4; ++side) {
            std::uint64_t sum = hash(corners[side]) - hash(corners[(side + 1) % 4]);
            for (const End& end : border_[side])
                sum += flow(end);
            if (sum != 0)
                return false;
        }
        return true;
    }

    const Square square_;
    const EdgeSet& set_;
    const Windings corner_;
    const Labeller& labeller_;
    std::vector<Labels> labels_;
    std::vector<End> ends_;             ///< sorted by vertex
    std::vector<std::uint32_t> endOf_;  ///< place in ends_ of edge e's a (2e) and b (2e + 1)
    std::array<std::vector<End>, 4> border_;
    std::vector<std::pair<Windings, std::uint16_t>> seen_;
};

}  // namespace

PlanarLeaf planarise(const Square& square, std::span<const LeafChord> chords, std::span<const int> windings,
                     const Labeller& labeller) {
    const auto set = snap(square, chords);
    if (!set)
        return {};
    return Labelling(square, *set, windings, labeller).run();
}

}  // namespace vtm::compiler
