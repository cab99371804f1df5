/// \file
/// Arcs of ellipses.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "geometry/cubic.hpp"

namespace vtm::geometry {

/// p(θ) = center + cos θ axisX + sin θ axisY, θ from `start` on through `sweep` radians, which may be
/// negative; |sweep| <= 2π. The axes are perpendicular in what centerForm() gives, and need not be under a
/// map.
struct EllipticalArc {
    Point center{0}, axisX{0}, axisY{0};
    double start = 0, sweep = 0;

    Point at(double angle) const { return center + axisX * std::cos(angle) + axisY * std::sin(angle); }
    /// By the angle, whichever way the arc runs.
    Point derivative(double angle) const { return axisY * std::cos(angle) - axisX * std::sin(angle); }
};

/// An arc by its ends (SVG 2 section 9.5.1, OpenVG 1.1 section 8.4): radii along the ellipse's own axes, of
/// either sign; `rotation` of its x axis in radians; `sweep`: angles grow along the arc.
struct EndpointArc {
    Point from, radii;
    double rotation = 0;
    bool largeArc = false, sweep = false;
    Point to;
};

/// The arc by its centre (SVG 2 appendix B.2.4): radii too small for the chord grow until the ellipse reaches
/// both ends. Nothing where no ellipse is meant: a radius of zero, equal ends, or a chord whose square, in
/// units of the radii, double precision cannot hold or invert. Ends are met within rounding of the centre and
/// the axes.
std::optional<EllipticalArc> centerForm(const EndpointArc& arc);

EllipticalArc mapped(const EllipticalArc& arc, const glm::dmat3x2& map);

/// The least box round the arc, but for rounding.
Box bounds(const EllipticalArc& arc);

/// How far a cubic strays from an arc of `angle` radians, at most a quarter turn, on a circle: this share of
/// the radius, 2/27 sin⁶(angle/4) / cos²(angle/4) (Goldapp 1991). On an ellipse: of the larger radius.
inline double cubicArcError(double angle) {
    const double s = std::sin(angle / 4), c = std::cos(angle / 4);
    return 2.0 / 27 * s * s * s * s * s * s / (c * c);
}

/// The largest angle, at most a quarter turn, by which a cubic may turn on a circle of `radius` to stay
/// within `tolerance` of it.
double cubicArcAngle(double radius, double tolerance);

/// The arc as `count` >= 1 cubics of equal angles.
std::vector<Cubic> cubics(const EllipticalArc& arc, int count);

/// As many as needed for none to turn by more than `angle` > 0.
int cubicCount(const EllipticalArc& arc, double angle);

}  // namespace vtm::geometry
