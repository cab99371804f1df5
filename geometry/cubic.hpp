/// \file
/// Cubic Bézier curves.
#pragma once

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "geometry/box.hpp"

namespace vtm::geometry {

/// p(t) = (1 - t)³ p0 + 3 (1 - t)² t p1 + 3 (1 - t) t² p2 + t³ p3, t in [0, 1].
struct Cubic {
    Point p0, p1, p2, p3;

    Point at(double t) const {
        const double s = 1 - t;
        return p0 * (s * s * s) + p1 * (3 * s * s * t) + p2 * (3 * s * t * t) + p3 * (t * t * t);
    }
    Point derivative(double t) const {
        const double s = 1 - t;
        return 3.0 * ((p1 - p0) * (s * s) + (p2 - p1) * (2 * s * t) + (p3 - p2) * (t * t));
    }
};

/// A straight line, run through at even speed.
Cubic straightCubic(Point from, Point to);

/// The quadratic curve from, control, to: exactly the same points at the same parameters.
Cubic raised(Point from, Point control, Point to);

/// The piece over [t0, t1], parametrised over [0, 1] again. Ends at 0 and 1 are kept bit for bit.
Cubic part(const Cubic& c, double t0, double t1);

/// The pieces over [0, 1/2] and [1/2, 1] (de Casteljau).
std::array<Cubic, 2> halves(const Cubic& c);

/// How far the curve strays from its chord at most, run through at even speed: max|p''| / 8, where |p''| <= 6
/// max |second difference of the control points| (Wang, Shen 1988). NaN or infinite for infinite curves. Of a
/// curve's half it is a quarter.
inline double chordError(const Cubic& c) {
    const Point d0 = c.p0 - c.p1 * 2.0 + c.p2, d1 = c.p1 - c.p2 * 2.0 + c.p3;
    return 0.75 * std::sqrt(std::max(glm::dot(d0, d0), glm::dot(d1, d1)));
}

/// The least box round the control points: the curve lies within.
Box controlBox(const Cubic& c);

/// The least box round the curve, but for rounding.
Box bounds(const Cubic& c);

}  // namespace vtm::geometry
