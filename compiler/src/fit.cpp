#include "compiler/src/fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace vtm::compiler {
namespace {

using glm::dvec2;
using Paint = std::uint16_t;

/// Consecutive boundary points with one paint on the left and one on the right.
struct Chain {
    std::vector<LatticePoint> points;
    Paint left = 0, right = 0;
};

// ---- chains -----------------------------------------------------------------------------------

/// Links edges into chains through vertices where exactly two of them meet.
class Linker {
public:
    explicit Linker(const std::vector<PlanarEdge>& edges) : edges_(edges), used_(edges.size()) {
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            ends_.push_back({edges[e].a, e});
            ends_.push_back({edges[e].b, e});
        }
        std::sort(ends_.begin(), ends_.end(), [](const End& p, const End& q) { return p.at < q.at; });
    }

    std::vector<Chain> run() {
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            if (!used_[e] && (isJunction(edges_[e].a, e) || isJunction(edges_[e].b, e)))
                follow(e, isJunction(edges_[e].a, e));
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            if (!used_[e])
                follow(e, true);  // a closed loop
        return std::move(chains_);
    }

private:
    struct End {
        LatticePoint at;
        std::uint32_t edge;
    };

    /// The other edge at a vertex of degree two that carries on with the same paints.
    const End* next(LatticePoint at, std::uint32_t edge) const {
        const auto range = std::equal_range(ends_.begin(), ends_.end(), End{at, 0},
                                            [](const End& p, const End& q) { return p.at < q.at; });
        if (range.second - range.first != 2)
            return nullptr;
        const End* other = &(range.first->edge == edge ? range.first[1] : range.first[0]);
        const PlanarEdge &e = edges_[edge], &f = edges_[other->edge];
        const bool sameDirection = (e.b == at) == (f.a == at);
        const bool matches =
            sameDirection ? e.left == f.left && e.right == f.right : e.left == f.right && e.right == f.left;
        return matches ? other : nullptr;
    }
    bool isJunction(LatticePoint at, std::uint32_t edge) const { return next(at, edge) == nullptr; }

    void follow(std::uint32_t edge, bool fromA) {
        const PlanarEdge& first = edges_[edge];
        Chain chain{
            {fromA ? first.a : first.b}, fromA ? first.left : first.right, fromA ? first.right : first.left};
        for (LatticePoint at = chain.points[0];;) {
            used_[edge] = true;
            at = edges_[edge].a == at ? edges_[edge].b : edges_[edge].a;
            chain.points.push_back(at);
            const End* end = next(at, edge);
            if (!end || used_[end->edge])
                break;
            edge = end->edge;
        }
        chains_.push_back(std::move(chain));
    }

    const std::vector<PlanarEdge>& edges_;
    std::vector<End> ends_;
    std::vector<std::uint8_t> used_;
    std::vector<Chain> chains_;
};

// ---- quantise ---------------------------------------------------------------------------------

using Steps = std::array<std::uint16_t, 2>;

constexpr double extent = asset::leafExtent;

class Quantiser {
public:
    explicit Quantiser(const Square& square) : square_(square) {}

    double leafStepsPerStep() const { return extent / square_.side; }
    /// Leaf coordinates, unrounded.
    dvec2 exact(LatticePoint p) const {
        return dvec2{p.x - square_.x0, p.y - square_.y0} * leafStepsPerStep();
    }
    Steps round(LatticePoint p) const {
        const dvec2 u = exact(p);
        return {round(u.x, p.x, square_.x0, square_.x1()), round(u.y, p.y, square_.y0, square_.y1())};
    }

private:
    /// The border's coordinates are kept for points on the border.
    static std::uint16_t round(double u, Coord at, Coord low, Coord high) {
        if (at == low)
            return 0;
        if (at == high)
            return asset::leafExtent;
        return static_cast<std::uint16_t>(std::clamp(std::lround(u), 1L, long{asset::leafExtent} - 1));
    }
    const Square square_;
};

// ---- fit --------------------------------------------------------------------------------------

/// Slopes of a piece over its chord.
struct Slopes {
    double a = 0, b = 0;
};

/// Slopes beyond tan 22.5° are not fitted: longer turns take more pieces, which keeps four chords a
/// piece enough for the renderers (docs/coverage.md).
const double maxSlope = 0.4142135623730951;

/// Hermite displacement: t(s) = mA s (1-s)² - mB s² (1-s).
double displacement(const Slopes& m, double s) { return m.a * s * (1 - s) * (1 - s) - m.b * s * s * (1 - s); }

/// Greatest |t''| on [0, 1]: t'' is linear, -4 mA - 2 mB at 0 and 2 mA + 4 mB at 1.
double maxSecondDerivative(const Slopes& m) {
    return std::max(std::abs(-4 * m.a - 2 * m.b), std::abs(2 * m.a + 4 * m.b));
}

/// A chain in leaf coordinates, fitted piece by piece.
class Fitter {
public:
    Fitter(const Chain& chain, const Quantiser& quantiser, double tolerance, std::vector<asset::Piece>& out)
        : chain_(chain), tolerance_(tolerance), out_(out) {
        for (LatticePoint p : chain.points) {
            exact_.push_back(quantiser.exact(p));
            rounded_.push_back(quantiser.round(p));
        }
    }

    void run() {
        const std::size_t last = exact_.size() - 1;
        for (std::size_t from = 0; from < last;)
            from = emitLongest(from, last);
    }

private:
    /// Emits the longest piece found by doubling and halving its reach; returns its last point.
    std::size_t emitLongest(std::size_t from, std::size_t last) {
        std::size_t good = from + 1, bad = last + 1;
        Slopes best;
        for (std::size_t reach = 2; good + 1 < bad;) {
            const std::size_t to = bad > last ? std::min(from + reach, last) : good + (bad - good) / 2;
            if (const auto slopes = tryFit(from, to)) {
                good = to;
                best = *slopes;
                if (to == last)
                    break;
                reach *= 2;
            } else {
                bad = to;
            }
        }
        emit(from, good, best);
        return good;
    }

    static dvec2 point(const Steps& s) { return {s[0], s[1]}; }

    /// Least squares over the points between, in the basis of the rounded chord; then the bound: at
    /// the points the measured distance, between them the sag of cubic and chain, |t''| ds² / 8.
    std::optional<Slopes> tryFit(std::size_t from, std::size_t to) {
        const dvec2 a = point(rounded_[from]), ab = point(rounded_[to]) - a;
        const double length2 = glm::dot(ab, ab);
        if (length2 == 0)
            return std::nullopt;
        const double length = std::sqrt(length2);
        local_.clear();
        double previous = 0;
        for (std::size_t i = from + 1; i < to; ++i) {
            const dvec2 d = exact_[i] - a;
            const dvec2 st{glm::dot(d, ab) / length2, (ab.x * d.y - ab.y * d.x) / length2};
            if (!(st.x > previous && st.x < 1))
                return std::nullopt;
            previous = st.x;
            local_.push_back(st);
        }
        const Slopes m = quantised(leastSquares());
        if (std::abs(m.a) > maxSlope || std::abs(m.b) > maxSlope)
            return std::nullopt;
        const double sag = maxSecondDerivative(m) * length / 8;
        double s = 0;
        for (std::size_t i = 0; i <= local_.size(); ++i) {
            const double here = i < local_.size() ? local_[i].x : 1;
            const double off =
                i < local_.size() ? std::abs(local_[i].y - displacement(m, local_[i].x)) * length : 0;
            if (off + sag * (here - s) * (here - s) > tolerance_)
                return std::nullopt;
            s = here;
        }
        return m;
    }

    /// Normal equations of t(s_i) = mA p_i + mB q_i; a whisper of regularisation keeps the case of
    /// one inner point solvable and prefers small slopes.
    Slopes leastSquares() const {
        constexpr double whisper = 1e-9;
        double pp = whisper, pq = 0, qq = whisper, pt = 0, qt = 0;
        for (const dvec2& st : local_) {
            const double s = st.x, p = s * (1 - s) * (1 - s), q = -s * s * (1 - s);
            pp += p * p, pq += p * q, qq += q * q, pt += p * st.y, qt += q * st.y;
        }
        const double det = pp * qq - pq * pq;
        return {(pt * qq - qt * pq) / det, (qt * pp - pt * pq) / det};
    }

    static std::int16_t stored(double slope) {
        return static_cast<std::int16_t>(
            std::lround(std::clamp(slope, -1.0, 1.0) * double{asset::slopeScale}));
    }
    static Slopes quantised(const Slopes& m) {
        const double scale = double{asset::slopeScale};
        return {stored(m.a) / scale, stored(m.b) / scale};
    }

    void emit(std::size_t from, std::size_t to, const Slopes& m) {
        if (rounded_[from] == rounded_[to])
            return;  // shorter than half a step: no area
        out_.push_back({rounded_[from], rounded_[to], stored(m.a), stored(m.b), chain_.left, chain_.right});
    }

    const Chain& chain_;
    const double tolerance_;
    std::vector<asset::Piece>& out_;
    std::vector<dvec2> exact_;
    std::vector<Steps> rounded_;
    std::vector<dvec2> local_;
};

// ---- slivers ----------------------------------------------------------------------------------

/// Drops chains that run along the border, nowhere more than a lattice step inside: traces of shapes
/// that end on the cell's border. What lies between such a chain and the border is below the
/// lattice's resolution; the corners that the chain passes take the paint of its inner side.
class SliverCutter {
public:
    SliverCutter(const Quantiser& quantiser, FittedLeaf& leaf)
        : quantiser_(quantiser), reach_(1 + static_cast<int>(quantiser.leafStepsPerStep())), leaf_(leaf) {}

    void run(std::vector<Chain>& chains) {
        while (std::erase_if(chains, [&](const Chain& c) { return cut(c); }) > 0) {
        }
    }

private:
    using Side = std::size_t;

    bool cut(const Chain& chain) {
        const Steps first = quantiser_.round(chain.points.front()),
                    last = quantiser_.round(chain.points.back());
        const auto from = sideOf(first), to = sideOf(last);
        if (!from || !to)
            return false;
        return cutAlong(chain, *from, *to, chain.right, chain.left) ||
               cutAlong(chain, *to, *from, chain.left, chain.right);
    }

    /// Counter-clockwise from one side to another; the leaf's inside lies on the left.
    bool cutAlong(const Chain& chain, Side from, Side to, Paint outer, Paint inner) {
        const Side sides = (to + 4 - from) % 4;
        for (std::size_t i = 1; i < chain.points.size(); ++i)
            if (!hugs(quantiser_.round(chain.points[i - 1]), quantiser_.round(chain.points[i]), from, sides))
                return false;
        for (Side k = 1; k <= sides; ++k)
            if (leaf_.corners[(from + k) % 4] != outer)
                return false;
        for (Side k = 1; k <= sides; ++k)
            leaf_.corners[(from + k) % 4] = inner;
        return true;
    }

    /// Whether an edge runs within reach of one of the sides from `from` on. The first and the last
    /// side are met only near their corners, unless there is but one.
    bool hugs(Steps p, Steps q, Side from, Side sides) const {
        for (Side k = 0; k <= sides; ++k) {
            const Side side = (from + k) % 4;
            const bool whole = sides == 0 || (k > 0 && k < sides);
            const Side neighbour = k == 0 ? (side + 1) % 4 : (side + 3) % 4;
            if (near(p, q, side) && (whole || near(p, q, neighbour)))
                return true;
        }
        return false;
    }
    bool near(Steps p, Steps q, Side side) const {
        return distance(p, side) <= reach_ && distance(q, side) <= reach_;
    }

    static int distance(Steps p, Side side) {
        const int across = side % 2 == 0 ? p[1] : p[0];
        return side == 0 || side == 3 ? across : static_cast<int>(asset::leafExtent) - across;
    }
    static std::optional<Side> sideOf(Steps p) {
        for (Side side = 0; side < 4; ++side)
            if (distance(p, side) == 0)
                return side;
        return std::nullopt;
    }

    const Quantiser& quantiser_;
    const int reach_;  ///< leaf steps
    FittedLeaf& leaf_;
};

}  // namespace

FittedLeaf fit(const Square& square, const PlanarLeaf& leaf, double tolerance) {
    FittedLeaf fitted{{}, leaf.corners};
    const Quantiser quantiser(square);
    std::vector<Chain> chains = Linker(leaf.edges).run();
    SliverCutter(quantiser, fitted).run(chains);
    for (const Chain& chain : chains)
        Fitter(chain, quantiser, tolerance * quantiser.leafStepsPerStep(), fitted.pieces).run();
    return fitted;
}

}  // namespace vtm::compiler
