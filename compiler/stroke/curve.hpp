/// \file
/// Cubic Bézier segments as strokes need them: tangents, parts, arc length, special parameters.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <vtm/scene/path.hpp>
#include "geometry/cubic.hpp"

namespace vtm::compiler::stroke {

using scene::Point;

inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
/// Turned by +90° (x towards y).
inline Point perp(Point v) { return {-v.y, v.x}; }
/// `v` must not be zero.
inline Point unit(Point v) {
    const double square = v.x * v.x + v.y * v.y;
    // Beyond these, squares lose digits or overflow.
    constexpr double minimum = 1e-280, maximum = 1e280;
    if (square > minimum && square < maximum)
        return v * (1 / std::sqrt(square));
    return v / std::hypot(v.x, v.y);
}
Point rotate(Point v, double angle);
/// Signed angle from `a` to `b`, in (-π, π].
double angleBetween(Point a, Point b);

using geometry::Cubic;

/// γ' over [t0, t1] as a Bernstein polynomial. Not from the piece's control points: those of a short one
/// beside a cusp lie closer together than the digits of their coordinates tell apart.
inline std::array<Point, 3> velocityOver(const Cubic& c, double t0, double t1) {
    const double s0 = 1 - t0, s1 = 1 - t1;
    const Point between =
        3.0 * ((c.p1 - c.p0) * (s0 * s1) + (c.p2 - c.p1) * (s0 * t1 + t0 * s1) + (c.p3 - c.p2) * (t0 * t1));
    return {c.derivative(t0), between, c.derivative(t1)};
}
/// A cubic by powers of its parameter.
struct PowerForm {
    Point cubed, squared, linear, start;

    explicit PowerForm(const Cubic& c)
        : cubed(c.p3 - c.p0 + 3.0 * (c.p1 - c.p2)),
          squared(3.0 * (c.p0 - 2.0 * c.p1 + c.p2)),
          linear(3.0 * (c.p1 - c.p0)),
          start(c.p0) {}
    Point at(double t) const { return ((cubed * t + squared) * t + linear) * t + start; }
    Point velocity(double t) const { return (3.0 * cubed * t + 2.0 * squared) * t + linear; }
    Point acceleration(double t) const { return 6.0 * cubed * t + 2.0 * squared; }
};

/// Largest distance of a control point from the start.
double extent(const Cubic& c);

/// Unit tangents. Where control points coincide, the direction of the next derivative; the cubic
/// must not be a point and must have no cusp inside.
Point startTangent(const Cubic& c);
Point endTangent(const Cubic& c);
Point tangentAt(const Cubic& c, double t);

/// γ' × γ'' and |γ'|² as Bernstein polynomials over a piece of a curve: their coefficients bound them,
/// and vanishing ends vanish exactly.
struct Curvature {
    std::array<double, 3> cross;
    std::array<double, 5> speedSquared;
};

Curvature curvature(const Cubic& c);

/// de Casteljau.
template <std::size_t N>
double bernstein(std::array<double, N> b, double t) {
    for (std::size_t n = N - 1; n > 0; --n)
        for (std::size_t i = 0; i < n; ++i)
            b[i] += (b[i + 1] - b[i]) * t;
    return b[0];
}

/// Of lengths, as a share of the control polygon's.
inline constexpr double usualLengthError = 1e-9;
/// Arc length over [t0, t1].
double arcLength(const Cubic& c, double t0, double t1, double relativeError = usualLengthError);
/// The t >= t0 at which arcLength(c, t0, t) is `length`, at most 1.
double parameterAtLength(const Cubic& c, double t0, double length, double relativeError = usualLengthError);

/// Arc of a circle from `center + from`, turning by `angle`, as cubics.
std::vector<Cubic> circleArc(Point center, Point from, double angle, double tolerance);
struct Circle {
    Point center;
    double radius;
};

/// Cubics, and the circle that they follow if it is one.
struct Arc {
    std::vector<Cubic> pieces;
    std::optional<Circle> circle;
};

/// SVG's endpoint arc as cubics (SVG 2 section B.2). Zero radii give a straight line; coincident end
/// points give nothing.
Arc ellipticalArc(Point from, const scene::ArcTo& arc, double tolerance);

}  // namespace vtm::compiler::stroke
