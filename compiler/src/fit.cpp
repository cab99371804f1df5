#include "compiler/src/fit.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace vtm::compiler {
namespace {

using glm::dvec2;

constexpr double extent = asset::leafExtent;

/// Slopes beyond tan 22.5° are not fitted: longer turns take more pieces, which keeps four chords a
/// piece enough for the renderers (docs/coverage.md).
constexpr double maxSlope = 0.4142135623730951;

/// Hermite displacement: t(s) = mA s (1-s)² - mB s² (1-s).
double displacement(double mA, double mB, double s) { return s * (1 - s) * (mA * (1 - s) - mB * s); }

/// t''(s), which is linear: 2 (mA + mB) (3 s - 1) - 2 mA.
double secondDerivative(double mA, double mB, double s) { return 2 * (mA + mB) * (3 * s - 1) - 2 * mA; }

/// By value: compilers make no branches of them.
double larger(double a, double b) { return a < b ? b : a; }
double smaller(double a, double b) { return b < a ? b : a; }

std::int16_t stored(double slope) {
    const double scaled = std::clamp(slope, -1.0, 1.0) * double{asset::slopeScale};
    return static_cast<std::int16_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

dvec2 point(const std::array<std::uint16_t, 2>& s) { return {s[0], s[1]}; }

}  // namespace

const FittedLeaf& Fitter::run(const Square& square, const PlanarLeaf& leaf, double tolerance) {
    square_ = square;
    scale_ = extent / square.side;
    tolerance_ = tolerance * scale_;
    leaf_.pieces.clear();
    leaf_.corners = leaf.corners;
    link(leaf);
    cutSlivers();
    for (const Chain& chain : chains_)
        fit(chain);
    return leaf_;
}

// ---- chains -----------------------------------------------------------------------------------

constexpr std::uint32_t noEdge = 0xFFFFFFFFu;

bool isVisible(const Sides& sides) { return sides.left != sides.right; }

/// Links visible edges into chains through vertices where exactly two of them meet.
void Fitter::link(const PlanarLeaf& leaf) {
    const auto count = static_cast<std::uint32_t>(leaf.sides.size());
    chains_.clear();
    points_.clear();
    used_.resize(count);
    for (std::uint32_t e = 0; e < count; ++e)
        used_[e] = !isVisible(leaf.sides[e]);
    for (std::uint32_t e = 0; e < count; ++e)
        if (!used_[e]) {
            const bool endsAtA = next(leaf, e, false) == noEdge;
            if (endsAtA || next(leaf, e, true) == noEdge)
                follow(leaf, e, endsAtA);
        }
    for (std::uint32_t e = 0; e < count; ++e)
        if (!used_[e])
            follow(leaf, e, true);  // a closed loop
}

/// The edge that carries on with the same paints at a vertex where but one other visible edge ends.
std::uint32_t Fitter::next(const PlanarLeaf& leaf, std::uint32_t edge, bool atB) {
    const EdgeEnd self = atB ? endAtB(edge) : endAtA(edge);
    EdgeEnd other = noEdge;
    for (const EdgeEnd end : leaf.vertices.ends(leaf.vertices.all()[leaf.vertices.of(self)])) {
        if (end == self || !isVisible(leaf.sides[end / 2]))
            continue;
        if (other != noEdge)
            return noEdge;
        other = end;
    }
    if (other == noEdge)
        return noEdge;
    const Sides &s = leaf.sides[edge], &t = leaf.sides[other / 2];
    const bool sameDirection = atB == isAtA(other);
    const bool matches =
        sameDirection ? s.left == t.left && s.right == t.right : s.left == t.right && s.right == t.left;
    return matches ? other / 2 : noEdge;
}

void Fitter::follow(const PlanarLeaf& leaf, std::uint32_t edge, bool fromA) {
    const std::vector<Edge>& edges = leaf.set->edges;
    const Sides& sides = leaf.sides[edge];
    Chain chain{static_cast<std::uint32_t>(points_.size()), 0, fromA ? sides.left : sides.right,
                fromA ? sides.right : sides.left};
    points_.push_back(fromA ? edges[edge].a : edges[edge].b);
    for (LatticePoint at = points_.back(); edge != noEdge && !used_[edge];) {
        used_[edge] = true;
        const Edge& e = edges[edge];
        const bool forward = e.a == at;
        const auto vertices = leaf.set->chain(e);
        if (forward)
            points_.insert(points_.end(), vertices.begin() + 1, vertices.end());
        else
            points_.insert(points_.end(), vertices.rbegin() + 1, vertices.rend());
        at = points_.back();
        edge = next(leaf, edge, forward);
    }
    chain.count = static_cast<std::uint32_t>(points_.size()) - chain.first;
    chains_.push_back(chain);
}

// ---- quantise ---------------------------------------------------------------------------------

/// Leaf coordinates, unrounded.
dvec2 Fitter::exact(LatticePoint p) const { return dvec2{p.x - square_.x0, p.y - square_.y0} * scale_; }

Fitter::Steps Fitter::roundInside(dvec2 u) {
    const auto one = [](double v) {
        return static_cast<std::uint16_t>(static_cast<int>(std::clamp(v + 0.5, 1.0, extent - 1)));
    };
    return {one(u.x), one(u.y)};
}

/// The border's coordinates are kept for points on the border.
Fitter::Steps Fitter::round(LatticePoint p) const {
    Steps r = roundInside(exact(p));
    if (p.x == square_.x0 || p.x == square_.x1())
        r[0] = p.x == square_.x0 ? std::uint16_t{0} : asset::leafExtent;
    if (p.y == square_.y0 || p.y == square_.y1())
        r[1] = p.y == square_.y0 ? std::uint16_t{0} : asset::leafExtent;
    return r;
}

// ---- fit --------------------------------------------------------------------------------------

void Fitter::fit(const Chain& chain) {
    const std::span<const LatticePoint> points(points_.data() + chain.first, chain.count);
    exact_.resize(chain.count);
    for (std::size_t i = 0; i < points.size(); ++i)
        exact_[i] = exact(points[i]);
    const std::uint32_t last = chain.count - 1;
    ends_ = {round(points.front()), round(points.back())};
    for (std::uint32_t from = 0; from < last;)
        from = emitLongest(chain, from, last);
}

/// Of point i of the chain at hand; only its ends can lie on the border.
Fitter::Steps Fitter::rounded(std::uint32_t i) const {
    if (i == 0)
        return ends_[0];
    return i + 1 == exact_.size() ? ends_[1] : roundInside(exact_[i]);
}

/// Emits the longest piece that the fit allows; returns its last point. The turn of the chain tells how far
/// it can reach; how far a try was beyond the tolerance, what to try next.
std::uint32_t Fitter::emitLongest(const Chain& chain, std::uint32_t from, std::uint32_t last) {
    std::uint32_t good = from + 1, bad = last + 1;
    Slopes best;
    for (std::uint32_t to = reach(from, last); good + 1 < bad;) {
        Slopes slopes;
        const double excess = to == from + 1 ? 0 : tryFit(from, to, slopes);
        if (excess <= 1) {
            good = to;
            best = slopes;
            if (bad > last)
                break;
            to = good + (bad - good) / 2;
        } else {
            bad = to;
            to = std::clamp(from + static_cast<std::uint32_t>((to - from) / excess), good, bad - 1);
        }
    }
    emit(chain, from, good, best);
    return good;
}

/// The first point beyond which the chain turns more than slopes allow, or the last.
std::uint32_t Fitter::reach(std::uint32_t from, std::uint32_t last) const {
    constexpr std::uint32_t most = 48;
    last = std::min(last, from + most);
    if (isFlat(from, last))
        return last;
    std::uint32_t to = from + 2;
    while (to < last && isFlat(from, to))
        ++to;
    return to - 1;
}

/// Whether the slopes of the first and the last chord over the chord of all are low enough. The curve's own
/// slopes at its ends are larger than those of n chords by n / (n - 1), if it bends evenly.
bool Fitter::isFlat(std::uint32_t from, std::uint32_t to) const {
    const dvec2 whole = exact_[to] - exact_[from], first = exact_[from + 1] - exact_[from],
                last = exact_[to] - exact_[to - 1];
    const double n = to - from, most = maxSlope * (n - 0.5);
    const auto isLow = [&](dvec2 chord) {
        return n * std::abs(whole.x * chord.y - whole.y * chord.x) <= most * glm::dot(whole, chord);
    };
    return isLow(first) && isLow(last);
}

/// By what factor the reach is too long, roughly; at most 1 if the fit is good. Least squares over some of
/// the points between, in the basis of the rounded chord; then the bound, which is a proof (`stray`).
double Fitter::tryFit(std::uint32_t from, std::uint32_t to, Slopes& slopes) {
    constexpr double beyond = 2;
    const dvec2 a = point(rounded(from)), ab = point(rounded(to)) - a;
    const double length2 = glm::dot(ab, ab);
    if (length2 == 0)
        return beyond;
    const dvec2 along = ab / length2;
    const std::uint32_t last = to - from;
    if (local_.size() < last + 1)
        local_.resize(last + 1);
    local_[0] = {0, 0};
    local_[last] = {1, 0};
    // Without branches on single points: which of them decides is random.
    bool rises = true;
    for (std::uint32_t i = 1; i < last; ++i) {
        const dvec2 d = exact_[from + i] - a;
        local_[i] = {glm::dot(d, along), along.x * d.y - along.y * d.x};
        rises &= local_[i].x > local_[i - 1].x;
    }
    if (!(rises && local_[last - 1].x < 1))
        return beyond;
    const Slopes m = leastSquares(last);
    const double steepest = std::max(std::abs(m.a), std::abs(m.b));
    if (!(steepest <= maxSlope))
        return std::max(steepest / maxSlope, 1.01);
    slopes = {stored(m.a) / double{asset::slopeScale}, stored(m.b) / double{asset::slopeScale}};
    const double most = tolerance_ / std::sqrt(length2), worst = stray(slopes, last);
    return worst <= most ? 1 : std::clamp(std::sqrt(std::sqrt(worst / most)), 1.01, beyond);
}

/// The slopes that come closest to the means of the chords by some of the points 1 .. last - 1: chords lie on
/// the inner side of points by up to a quarter of what these stray from the line of their neighbours, on
/// average by half of that.
Fitter::Slopes Fitter::leastSquares(std::uint32_t last) const {
    // Normal equations of t(s_i) = mA p_i + mB q_i; a whisper of regularisation keeps the case of one inner
    // point solvable and prefers small slopes.
    constexpr double whisper = 1e-9;
    constexpr std::uint32_t mostSamples = 8;
    constexpr double inwards = 1.0 / 8;
    const std::uint32_t stride = (last - 1 + mostSamples) / mostSamples;
    double pp = whisper, pq = 0, qq = whisper, pt = 0, qt = 0;
    for (std::uint32_t i = 1 + (stride - 1) / 2; i < last; i += stride) {
        const dvec2 before = local_[i - 1], at = local_[i], after = local_[i + 1];
        const double off = before.y + (after.y - before.y) * (at.x - before.x) / (after.x - before.x) - at.y;
        const double s = at.x, t = at.y + inwards * off, h = s * (1 - s), p = h * (1 - s), q = -h * s;
        pp += p * p, pq += p * q, qq += q * q, pt += p * t, qt += q * t;
    }
    const double whole = pp * qq - pq * pq;
    return {(pt * qq - qt * pq) / whole, (qt * pp - pt * pq) / whole};
}

/// How far the chain may be from a piece, as a share of its chord; that of rounded ends is counted on its
/// own. Between two points a step ds apart the chain's chord lies above that of the curve by no more than at
/// one of them, and the curve below its own chord by at most max(t'') ds² / 8, above it by at most max(-t'')
/// ds² / 8.
double Fitter::stray(const Slopes& m, std::uint32_t last) const {
    double high = 0, low = 0, off = 0, bend = secondDerivative(m.a, m.b, 0) / 8;
    for (std::uint32_t i = 1; i <= last; ++i) {
        const double s = local_[i].x, step = s - local_[i - 1].x, offBefore = off, bendBefore = bend;
        off = local_[i].y - displacement(m.a, m.b, s);
        bend = secondDerivative(m.a, m.b, s) / 8;
        const double below = larger(larger(bendBefore, bend), 0.0),
                     above = smaller(smaller(bendBefore, bend), 0.0);
        high = larger(high, larger(offBefore, off) + below * (step * step));
        low = smaller(low, smaller(offBefore, off) + above * (step * step));
    }
    return larger(high, -low);
}

void Fitter::emit(const Chain& chain, std::uint32_t from, std::uint32_t to, const Slopes& m) {
    const Steps a = rounded(from), b = rounded(to);
    if (a == b)
        return;  // shorter than half a step: no area
    leaf_.pieces.push_back({a, b, stored(m.a), stored(m.b), chain.left, chain.right});
}

}  // namespace vtm::compiler
