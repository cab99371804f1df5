#include "compiler/stroke/bend.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "compiler/stroke/roots.hpp"

namespace vtm::compiler::stroke {

namespace {

/// Halvings in search of the places where a curve becomes tight: 2^-24 of a segment.
constexpr int maxSearchDepth = 24;

/// In a piece in which the curvature is monotone, fewer will do.
constexpr int maxSearchSteps = 60;
constexpr double smallestStep = 0x1p-24;

/// A piece of a curve: Bernstein coefficients of γ', of γ' × γ'' and of |γ'|².
struct CurvePart {
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

/// Whether κ = c / q^(3/2) keeps its sign and is monotone: κ' has the sign of 2c'q - 3cq', whose Bernstein
/// coefficients these are, but for positive factors. Not where q all but vanishes at an end, and c with it:
/// what is left there is rounding.
bool isMonotone(const Curvature& k) {
    const auto& [c, q] = k;
    constexpr double vanishing = 1e-12;
    const double minimum = vanishing * *std::max_element(q.begin(), q.end());
    const auto [low, high] = std::minmax({c[0], c[1], c[2]});
    if (!(q.front() > minimum && q.back() > minimum && (low >= 0 || high <= 0)))
        return false;
    constexpr std::array<double, 5> four{1, 4, 6, 4, 1};
    constexpr std::array<double, 4> three{1, 3, 3, 1};
    constexpr std::array<double, 3> two{1, 2, 1};
    std::array<double, 6> slope{};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 5; ++j)
            slope[i + j] += four[j] * q[j] * (c[i + 1] - c[i]);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            slope[i + j] -= 3 * two[i] * three[j] * c[i] * (q[j + 1] - q[j]);
    const auto [steepestFall, steepestRise] = std::minmax_element(slope.begin(), slope.end());
    return *steepestFall >= 0 || *steepestRise <= 0;
}

double cube(double q) { return q > 0 ? q * std::sqrt(q) : 0; }

/// Finds the tight stretches by halving until the bounds of κ decide. |κ|r > 1 is tested as
/// |c|r > q^(3/2), with c = γ' × γ'' and q = |γ'|².
///
/// Beside a control point that coincides with its end the curvature grows without limit, while the
/// curve turns less and less: what is left to turn there is soon too small to matter. Elsewhere, what a
/// piece of so little turn is in its middle goes for all of it. Where κ is monotone, its values at the ends
/// decide, unless the curve is tight where it begins or ends.
class BendSearch {
public:
    explicit BendSearch(const BendOptions& options) : o_(options) {}

    std::vector<Span> run(const Cubic& c) {
        visit({{c.p1 - c.p0, c.p2 - c.p1, c.p3 - c.p2}, curvature(c)}, 0, 1, 0);
        return std::move(spans_);
    }

private:
    bool tight(const Curvature& k) const {
        const auto [low, high] = std::minmax({k.cross[0], k.cross[1], k.cross[2]});
        const double maximum = *std::max_element(k.speedSquared.begin(), k.speedSquared.end());
        return std::max(low, -high) * o_.radius >= cube(maximum);
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

    /// There a little turn is to be gentle.
    bool isTightAtAnEnd(const Curvature& k, double t0, double t1) const {
        return (t0 == 0 && !isGentleAt(k.cross[0], k.speedSquared[0])) ||
               (t1 == 1 && !isGentleAt(k.cross[2], k.speedSquared[4]));
    }

    /// Gentle, tight, or both.
    void monotone(const Curvature& k, double t0, double t1) {
        const Bend bend = bernstein(k.cross, 0.5) > 0 ? Bend::Left : Bend::Right;
        const bool startsGentle = isGentleAt(k.cross[0], k.speedSquared[0]),
                   endsGentle = isGentleAt(k.cross[2], k.speedSquared[4]);
        if (startsGentle == endsGentle)
            return add({t0, t1, startsGentle ? Bend::Gentle : bend});
        const double t = t0 + (t1 - t0) * limitBetween(k);
        add({t0, t, startsGentle ? Bend::Gentle : bend});
        add({t, t1, endsGentle ? Bend::Gentle : bend});
    }

    bool isGentleAt(double c, double q) const { return std::abs(c) * o_.radius <= cube(q) * o_.slack; }

    /// Where |κ|r is between 1 and the slack, found as a root between the ends by the rule of false position
    /// (Illinois).
    double limitBetween(const Curvature& k) const {
        const Polynomial<3> c = powers(k.cross);
        const Polynomial<5> q = powers(k.speedSquared);
        const double middle = (1 + o_.slack) / 2, half = (o_.slack - 1) / 2;
        const auto excess = [&](double cross, double limit) {
            return std::abs(cross) * o_.radius - middle * limit;
        };
        double low = 0, high = 1, atLow = excess(k.cross[0], cube(k.speedSquared[0])),
               atHigh = excess(k.cross[2], cube(k.speedSquared[4]));
        double s = 0.5;
        bool wasLow = false;
        for (int i = 0; i < maxSearchSteps && high - low > smallestStep; ++i) {
            s = low + (high - low) * (atLow / (atLow - atHigh));
            if (!(s > low && s < high))
                s = (low + high) / 2;
            const double limit = cube(evaluate(q, s)), here = excess(evaluate(c, s), limit);
            if (std::abs(here) <= half * limit)
                break;
            const bool isLow = (here < 0) == (atLow < 0);
            if (isLow)
                low = s, atLow = here, atHigh /= i > 0 && wasLow ? 2 : 1;
            else
                high = s, atHigh = here, atLow /= i > 0 && !wasLow ? 2 : 1;
            wasLow = isLow;
        }
        return s;
    }

    void visit(const CurvePart& piece, double t0, double t1, int depth) {
        const Curvature& k = piece.k;
        if (isSurelyGentle(k, o_.radius, o_.slack))
            return add({t0, t1, Bend::Gentle});
        const bool small = negligible(piece.velocity), atAnEnd = t0 == 0 || t1 == 1;
        if (small && (atAnEnd || !tightInTheMiddle(k)))
            return add({t0, t1, Bend::Gentle});
        if (small || depth == maxSearchDepth || tight(k))
            return add({t0, t1, bernstein(k.cross, 0.5) > 0 ? Bend::Left : Bend::Right});
        if (!isTightAtAnEnd(k, t0, t1) && isMonotone(k))
            return monotone(k, t0, t1);
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
Stops curvatureStops(const Cubic& c, bool inFirstHalf, bool inSecondHalf) {
    Stops stops;
    if (inFirstHalf)
        for (const double t : curvatureExtremes(c))
            if (t <= 0.5)
                stops.add(t);
    if (inSecondHalf) {
        const Roots<5> back = curvatureExtremes({c.p3, c.p2, c.p1, c.p0});
        for (std::size_t i = back.count; i-- > 0;)
            if (back.at[i] < 0.5)
                stops.add(1 - back.at[i]);
    }
    return stops;
}

/// Between places where the tangent points along a multiple of 45° a tight stretch turns by no more.
Stops octants(const Cubic& c) {
    Stops stops;
    for (const Point d : {Point{1, 0}, Point{1, 1}, Point{0, 1}, Point{-1, 1}}) {
        const double a = cross(c.p1 - c.p0, d), b = cross(c.p2 - c.p1, d), e = cross(c.p3 - c.p2, d);
        for (const double t : rootsInside(Polynomial<3>{a, 2 * (b - a), a - 2 * b + e}))
            stops.add(t);
    }
    std::sort(stops.at.begin(), stops.at.begin() + std::ptrdiff_t(stops.count));
    return stops;
}

/// Whether a span may be cut into pieces that turn by more than `smallTurn` each. It turns by no more than
/// the coefficients of its velocity do.
bool mayBeCut(const Cubic& c, const Span& span, double smallTurn) {
    if (span.bend == Bend::Gentle || span.isFold)
        return false;
    const auto [from, between, to] = velocityOver(c, span.t0, span.t1);
    const double turn = std::abs(angleBetween(from, between)) + std::abs(angleBetween(between, to));
    return std::max(turn, std::abs(angleBetween(from, to))) > 2 * smallTurn;  // `between` may vanish
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

bool isSurelyGentle(const Curvature& k, double radius, double slack) {
    const auto [low, high] = std::minmax({k.cross[0], k.cross[1], k.cross[2]});
    const double minimum = *std::min_element(k.speedSquared.begin(), k.speedSquared.end());
    return std::max(-low, high) * radius <= cube(minimum) * slack;
}

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
    bool inFirstHalf = false, inSecondHalf = false, acrossOctants = false;
    for (const Span& span : spans)
        if (mayBeCut(c, span, smallTurn)) {
            inFirstHalf |= span.t0 <= 0.5;
            inSecondHalf |= span.t1 > 0.5;
            acrossOctants |= mayBeCut(c, span, halfOctant);
        }
    std::vector<Span> result = spans;
    if (inFirstHalf || inSecondHalf)
        result = cutAt(c, result, curvatureStops(c, inFirstHalf, inSecondHalf), smallTurn);
    if (acrossOctants)
        result = cutAt(c, result, octants(c), halfOctant);
    return result;
}

}  // namespace vtm::compiler::stroke
