#include "compiler/src/stroke_bend.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "compiler/src/stroke_roots.hpp"

namespace vtm::compiler::stroke {

namespace {

/// Halvings in search of the places where a curve becomes tight: 2^-24 of a segment.
constexpr int maxSearchDepth = 24;

/// The two halves of a Bernstein polynomial's interval.
template <class T, std::size_t N>
std::pair<std::array<T, N>, std::array<T, N>> halves(std::array<T, N> b) {
    std::array<T, N> left{};
    for (std::size_t n = N; n > 0; --n) {
        left[N - n] = b[0];
        for (std::size_t i = 0; i + 1 < n; ++i)
            b[i] = (b[i] + b[i + 1]) * 0.5;
    }
    return {left, b};
}

/// A piece of a curve: Bernstein coefficients of γ', of γ' × γ'' and of |γ'|².
struct Piece {
    std::array<Point, 3> velocity;
    Curvature k;
};

void append(std::vector<Span>& spans, const Span& next) {
    if (!spans.empty() && spans.back().bend == next.bend)
        spans.back().t1 = next.t1;
    else
        spans.push_back(next);
}

/// Up to half a turn.
double turnBetween(const Cubic& c, double t0, double t1) {
    return std::abs(angleBetween(tangentAt(c, t0), tangentAt(c, t1)));
}

/// Finds the tight stretches by halving until the bounds of κ decide. |κ|r > 1 is tested as
/// |c|r > q^(3/2), with c = γ' × γ'' and q = |γ'|².
///
/// Beside a control point that coincides with its end the curvature grows without limit, while the
/// curve turns less and less: what is left to turn there is soon too small to matter. Elsewhere, what a
/// piece of so little turn is in its middle goes for all of it.
class BendSearch {
public:
    explicit BendSearch(const BendOptions& options) : o_(options) {}

    std::vector<Span> run(const Cubic& c) {
        visit({{c.p1 - c.p0, c.p2 - c.p1, c.p3 - c.p2}, curvature(c)}, 0, 1, 0);
        return std::move(spans_);
    }

private:
    static double cube(double q) { return q > 0 ? q * std::sqrt(q) : 0; }

    bool gentle(const Curvature& k) const {
        const auto [low, high] = std::minmax({k.cross[0], k.cross[1], k.cross[2]});
        const double least = *std::min_element(k.speedSquared.begin(), k.speedSquared.end());
        return std::max(-low, high) * o_.radius <= cube(least) * o_.slack;
    }
    bool tight(const Curvature& k) const {
        const auto [low, high] = std::minmax({k.cross[0], k.cross[1], k.cross[2]});
        const double most = *std::max_element(k.speedSquared.begin(), k.speedSquared.end());
        return std::max(low, -high) * o_.radius >= cube(most);
    }

    bool tightInTheMiddle(const Curvature& k) const {
        const double middle = std::abs(bernstein(k.cross, 0.5));
        return middle * o_.radius > cube(bernstein(k.speedSquared, 0.5)) * o_.slack;
    }

    /// γ' keeps within the cone of its coefficients: the widest angle between two of them bounds the turn.
    /// Tested by sines, sin θ >= 2θ/π up to a right angle.
    bool negligible(const std::array<Point, 3>& velocity) const {
        return closeTo(velocity[0], velocity[1]) && closeTo(velocity[1], velocity[2]) &&
               closeTo(velocity[0], velocity[2]);
    }
    bool closeTo(Point a, Point b) const {
        const double sine = o_.smallTurn / std::numbers::pi;  // half of smallTurn
        const double lengths = std::sqrt(glm::dot(a, a)) * std::sqrt(glm::dot(b, b));
        return glm::dot(a, b) >= 0 && std::abs(cross(a, b)) <= sine * lengths;
    }

    void visit(const Piece& piece, double t0, double t1, int depth) {
        const Curvature& k = piece.k;
        if (gentle(k))
            return add({t0, t1, Bend::Gentle});
        const bool small = negligible(piece.velocity), atAnEnd = t0 == 0 || t1 == 1;
        if (small && (atAnEnd || !tightInTheMiddle(k)))
            return add({t0, t1, Bend::Gentle});
        if (small || depth == maxSearchDepth || tight(k))
            return add({t0, t1, bernstein(k.cross, 0.5) > 0 ? Bend::Left : Bend::Right});
        const auto [velocityLeft, velocityRight] = halves(piece.velocity);
        const auto [crossLeft, crossRight] = halves(k.cross);
        const auto [speedLeft, speedRight] = halves(k.speedSquared);
        const double middle = (t0 + t1) / 2;
        visit({velocityLeft, {crossLeft, speedLeft}}, t0, middle, depth + 1);
        visit({velocityRight, {crossRight, speedRight}}, middle, t1, depth + 1);
    }

    void add(const Span& next) { append(spans_, next); }

    const BendOptions& o_;
    std::vector<Span> spans_;
};

/// At most five extremes of the curvature in each half, or two places for each of four directions; rising.
using Stops = Roots<10>;

/// κ = c / q^(3/2), so κ' vanishes with 2c'q - 3cq'.
Roots<5> curvatureExtremes(const Cubic& curve) {
    const Curvature k = curvature(curve);
    const Polynomial<3> c = powers(k.cross);
    const Polynomial<5> q = powers(k.speedSquared);
    Polynomial<6> slope = product(derivative(c), q);
    const Polynomial<6> other = product(c, derivative(q));
    for (std::size_t i = 0; i < slope.size(); ++i)
        slope[i] = 2 * slope[i] - 3 * other[i];
    return rootsInside(slope);
}

/// Each half of the curve seen from its own end: where a control point coincides with that, all terms vanish
/// there, and rounding would make extremes of what is left at the other.
void addCurvatureExtremes(const Cubic& c, Stops& stops) {
    for (const double t : curvatureExtremes(c))
        if (t <= 0.5)
            stops.add(t);
    const Roots<5> back = curvatureExtremes({c.p3, c.p2, c.p1, c.p0});
    for (std::size_t i = back.count; i-- > 0;)
        if (back.at[i] < 0.5)
            stops.add(1 - back.at[i]);
}

/// Between places where the tangent points along a multiple of 45° a tight stretch turns by no more.
void addOctants(const Cubic& c, Stops& stops) {
    for (const Point d : {Point{1, 0}, Point{1, 1}, Point{0, 1}, Point{-1, 1}}) {
        const double a = cross(c.p1 - c.p0, d), b = cross(c.p2 - c.p1, d), e = cross(c.p3 - c.p2, d);
        for (const double t : rootsInside(Polynomial<3>{a, 2 * (b - a), a - 2 * b + e}))
            stops.add(t);
    }
    std::sort(stops.at.begin(), stops.at.begin() + std::ptrdiff_t(stops.count));
}

/// Unless a piece would turn by less than `smallTurn`.
std::vector<Span> cutAt(const Cubic& c, const std::vector<Span>& spans, const Stops& stops,
                        double smallTurn) {
    const auto turns = [&](double t0, double t1) { return turnBetween(c, t0, t1) > smallTurn; };
    std::vector<Span> result;
    for (Span span : spans) {
        if (span.bend != Bend::Gentle && !span.isFold)
            for (const double t : stops)
                if (t > span.t0 && t < span.t1 && turns(span.t0, t) && turns(t, span.t1)) {
                    result.push_back({span.t0, t, span.bend});
                    span.t0 = t;
                }
        result.push_back(span);
    }
    return result;
}

}  // namespace

std::vector<Span> bends(const Cubic& c, const BendOptions& options) { return BendSearch(options).run(c); }

double turnOf(const Cubic& c, const Span& span) {
    const double middle = (span.t0 + span.t1) / 2;
    return turnBetween(c, span.t0, middle) + turnBetween(c, middle, span.t1);
}

std::vector<Span> withoutSmallTurns(const Cubic& c, const std::vector<Span>& spans, double smallTurn) {
    std::vector<Span> result;
    for (Span span : spans) {
        if (span.bend != Bend::Gentle && turnOf(c, span) <= smallTurn)
            span.bend = Bend::Gentle;
        append(result, span);
    }
    return result;
}

std::vector<Span> cutTight(const Cubic& c, const std::vector<Span>& spans, double smallTurn) {
    constexpr double halfOctant = std::numbers::pi / 8;
    Stops extremes, octants;
    addCurvatureExtremes(c, extremes);
    addOctants(c, octants);
    return cutAt(c, cutAt(c, spans, extremes, smallTurn), octants, halfOctant);
}

}  // namespace vtm::compiler::stroke
