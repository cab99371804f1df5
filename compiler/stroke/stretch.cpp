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

/// A place of the curve, with the unit normal towards the centre of curvature, and how far that is.
struct Evolute::Place {
    double u;
    Point on, normal;
    double radius;

    Point centre() const { return on + normal * radius; }
};

struct Evolute::Parabola {
    Point from, control, to;

    /// Of the triangle, in which the evolute lies, over the chord; if that is short, a side.
    double height() const {
        const Point chord = to - from, side = control - from;
        const double length = glm::length(chord), shorter = glm::length(side);
        return length > 0 ? std::min(shorter, std::abs(cross(chord, side)) / length) : shorter;
    }
    /// Of parallel tangents: where the parabola runs along the normal, the evolute touches it.
    double distance(const Place& place) const {
        const double a = cross(control - from, place.normal), b = cross(to - control, place.normal);
        const double t = a == b ? 0.5 : std::clamp(a / (a - b), 0.0, 1.0), s = 1 - t;
        const Point on = from * (s * s) + control * (2 * s * t) + to * (t * t);
        return std::abs(cross(on - place.centre(), place.normal));
    }
};

Evolute::Evolute(const Cubic& c, const Stretch& stretch, double signedRadius, const OffsetOptions& options)
    : curvature_(curvature(c)),
      stretch_(stretch),
      radius_(signedRadius),
      tolerance_(options.tolerance),
      straight_(options.straight()) {}

Evolute::Place Evolute::place(double u) const {
    const auto [t, along] = stretch_.place(u);
    return {u, stretch_.pointAt(t), perp(along) * (radius_ < 0 ? -1.0 : 1.0), radiusAt(t)};
}

Point Evolute::at(double u) const { return place(u).centre(); }

bool Evolute::isTighterAtEnd() const {
    return radiusAt(stretch_.parameter(1)) < radiusAt(stretch_.parameter(0));
}

double Evolute::depth() const { return std::abs(radius_) - radiusAt(stretch_.parameter(tightest())); }

double Evolute::largestRadius() const {
    return std::max(radiusAt(stretch_.parameter(0)), radiusAt(stretch_.parameter(1)));
}

void Evolute::append(Side& side) const { append(place(0), place(1), maxFitDepth, side); }

void Evolute::append(const Place& from, const Place& to, int depth, Side& side) const {
    const Parabola arc{from.centre(), meeting(from, to), to.centre()};
    if (depth == 0 || arc.height() <= straight_)
        return side.lineTo(arc.to, gapShare * tolerance_);
    const auto between = [&](double share) { return place(from.u + (to.u - from.u) * share); };
    const Place middle = between(0.5);
    if (arc.distance(middle) > tolerance_ || arc.distance(between(0.25)) > tolerance_ ||
        arc.distance(between(0.75)) > tolerance_) {
        append(from, middle, depth - 1, side);
        append(middle, to, depth - 1, side);
        return;
    }
    const Cubic c = geometry::raised(arc.from, arc.control, arc.to);
    side.cubicTo(c.p1, c.p2, c.p3);
}

/// Of the ends and some places between.
double Evolute::tightest() const {
    constexpr int places = 4;
    double best = 0, least = radiusAt(stretch_.parameter(0));
    for (int i = 1; i <= places; ++i) {
        const double u = double(i) / places, radius = radiusAt(stretch_.parameter(u));
        if (radius < least)
            best = u, least = radius;
    }
    return best;
}

/// Of curvature, at the curve's parameter; no larger than the stroke's.
double Evolute::radiusAt(double t) const {
    const double r = std::abs(radius_);
    const double q = std::max(0.0, bernstein(curvature_.speedSquared, t)), cube = q * std::sqrt(q);
    const double bend = std::abs(bernstein(curvature_.cross, t));
    return cube < r * bend ? cube / bend : (cube > 0 ? r : 0);
}

/// Where the normals meet, always between curve and offset.
Point Evolute::meeting(const Place& from, const Place& to) const {
    const double sine = cross(from.normal, to.normal);
    constexpr double parallel = 1e-9;  // below, rounding moves the crossing by more than the evolute is long
    if (std::abs(sine) < parallel)
        return (from.centre() + to.centre()) / 2.0;
    const double s = cross(to.on - from.on, to.normal) / sine;
    return from.on + from.normal * std::clamp(s, 0.0, std::abs(radius_));
}

}  // namespace vtm::compiler::stroke
