#include "compiler/stroke/stretch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace vtm::compiler::stroke {

namespace {

constexpr int maxPieces = 8;

/// How many pieces bring the error of a fit below the tolerance, by its sixth order.
int pieceCount(double error, double tolerance) {
    if (!std::isfinite(error))
        return 2;
    return int(std::clamp(std::ceil(std::pow(error / tolerance, 1.0 / 6)), 2.0, double(maxPieces)));
}

/// Ends of the pieces as shares of the stretch, the first 0. Pieces take equal sums of the square roots of
/// the turns between samples: shorter ones where the curve bends, longer ones where it hardly does. A tenth
/// goes by the parameter alone, so that no piece is without end.
std::array<double, maxPieces + 1> cuts(const Samples& s, int count) {
    constexpr double evenShare = 0.1;
    constexpr std::size_t steps = std::tuple_size_v<Samples> - 1;
    std::array<double, steps + 1> sums{};
    for (std::size_t i = 0; i < steps; ++i)
        sums[i + 1] = sums[i] + std::sqrt(std::abs(cross(s[i].tangent, s[i + 1].tangent)));
    const double even = sums[steps] > 0 ? sums[steps] * evenShare / steps : 1;
    for (std::size_t i = 0; i <= steps; ++i)
        sums[i] += even * double(i);
    std::array<double, maxPieces + 1> result{};
    std::size_t at = 0;
    for (int k = 1; k < count; ++k) {
        const double goal = sums[steps] * k / count;
        while (sums[at + 1] < goal)
            ++at;
        result[std::size_t(k)] = (double(at) + (goal - sums[at]) / (sums[at + 1] - sums[at])) / steps;
    }
    result[std::size_t(count)] = 1;
    return result;
}

void appendFit(const OffsetCurve& curve, double u0, double u1, double tolerance, int depth, Side& side) {
    const Samples samples = curve.samples(u0, u1);
    if (depth == 0 || isChord(samples, tolerance))
        return side.lineTo(samples.back().at, gapShare * tolerance);
    const Fit fit = fitCubic(samples, tolerance);
    if (fit.error <= tolerance)
        return side.cubicTo(fit.cubic.p1, fit.cubic.p2, fit.cubic.p3);
    const int count = pieceCount(fit.error, tolerance);
    const auto shares = cuts(samples, count);
    for (std::size_t i = 0; i < std::size_t(count); ++i)
        appendFit(curve, u0 + (u1 - u0) * shares[i], u0 + (u1 - u0) * shares[i + 1], tolerance, depth - 1,
                  side);
}

}  // namespace

void appendFit(const OffsetCurve& curve, double tolerance, Side& side) {
    side.lineTo(curve.stretch.offset(0, curve.distance).at, gapShare * tolerance);
    appendFit(curve, 0, 1, tolerance, maxFitDepth, side);
}

struct Evolute::Parabola {
    Point from, control, to;

    /// Of the triangle, in which the evolute lies, over the chord; if that is short, a side.
    double height() const {
        const Point chord = to - from, side = control - from;
        const double length = glm::length(chord), shorter = glm::length(side);
        return length > 0 ? std::min(shorter, std::abs(cross(chord, side)) / length) : shorter;
    }
};

Evolute::Evolute(const Cubic& c, const Stretch& stretch, double signedRadius, const OffsetOptions& options)
    : curvature_(curvature(c)),
      stretch_(stretch),
      radius_(signedRadius),
      tolerance_(options.tolerance),
      straight_(options.straight()) {}

Point Evolute::at(double u) const {
    const double t = stretch_.parameter(u);
    return stretch_.pointAt(t) + normal(t) * centreDistance(t);
}

bool Evolute::isTighterAtEnd() const {
    return centreDistance(stretch_.parameter(1)) < centreDistance(stretch_.parameter(0));
}

double Evolute::depth() const { return std::abs(radius_) - centreDistance(stretch_.parameter(tightest())); }

void Evolute::append(Side& side) const { append(0, 1, maxFitDepth, side); }

void Evolute::append(double u0, double u1, int depth, Side& side) const {
    const Parabola arc{at(u0), meeting(u0, u1), at(u1)};
    if (depth == 0 || arc.height() <= straight_)
        return side.lineTo(arc.to, gapShare * tolerance_);
    if (error(arc, u0, u1) > tolerance_) {
        append(u0, (u0 + u1) / 2, depth - 1, side);
        append((u0 + u1) / 2, u1, depth - 1, side);
        return;
    }
    const Cubic c = geometry::raised(arc.from, arc.control, arc.to);
    side.cubicTo(c.p1, c.p2, c.p3);
}

/// Of the ends and some places between.
double Evolute::tightest() const {
    constexpr int places = 4;
    double best = 0, least = centreDistance(stretch_.parameter(0));
    for (int i = 1; i <= places; ++i) {
        const double u = double(i) / places, distance = centreDistance(stretch_.parameter(u));
        if (distance < least)
            best = u, least = distance;
    }
    return best;
}

/// Distance of parallel tangents: where the parabola runs along the normal, the evolute touches it.
double Evolute::error(const Parabola& arc, double u0, double u1) const {
    double worst = 0;
    for (const double share : {0.25, 0.5, 0.75}) {
        const double parameter = stretch_.parameter(u0 + (u1 - u0) * share);
        const Point n = normal(parameter);
        const double a = cross(arc.control - arc.from, n), b = cross(arc.to - arc.control, n);
        const double t = a == b ? 0.5 : std::clamp(a / (a - b), 0.0, 1.0), s = 1 - t;
        const Point on = arc.from * (s * s) + arc.control * (2 * s * t) + arc.to * (t * t);
        const Point here = stretch_.pointAt(parameter) + n * centreDistance(parameter);
        worst = std::max(worst, std::abs(cross(on - here, n)));
    }
    return worst;
}

/// Towards the centre of curvature.
Point Evolute::normal(double t) const { return perp(stretch_.tangentAt(t)) * (radius_ < 0 ? -1.0 : 1.0); }

double Evolute::centreDistance(double t) const {
    const double r = std::abs(radius_);
    const double q = std::max(0.0, bernstein(curvature_.speedSquared, t)), cube = q * std::sqrt(q);
    const double bend = std::abs(bernstein(curvature_.cross, t));
    return cube < r * bend ? cube / bend : (cube > 0 ? r : 0);
}

/// Where the normals meet, always between curve and offset.
Point Evolute::meeting(double u0, double u1) const {
    const double t0 = stretch_.parameter(u0), t1 = stretch_.parameter(u1);
    const Point n0 = normal(t0), n1 = normal(t1), p0 = stretch_.pointAt(t0);
    const double sine = cross(n0, n1);
    constexpr double parallel = 1e-9;  // below, rounding moves the crossing by more than the evolute is long
    if (std::abs(sine) < parallel)
        return (at(u0) + at(u1)) / 2.0;
    const double s = cross(stretch_.pointAt(t1) - p0, n1) / sine;
    return p0 + n0 * std::clamp(s, 0.0, std::abs(radius_));
}

}  // namespace vtm::compiler::stroke
