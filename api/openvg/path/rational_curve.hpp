/// \file
/// Rational Bézier curves, in homogeneous coordinates: what lines, curves and arcs all are, and remain under
/// projective maps (VG_NDS_projective_geometry, section 8.4a).
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "api/openvg/path/segment.hpp"

namespace vtm::openvg {

/// Points are (w x, w y, w).
struct RationalCurve {
    int degree = 1;  ///< 1 to 3: as many points, and one more
    std::array<glm::dvec3, 4> points{};

    const glm::dvec3& start() const { return points[0]; }
    const glm::dvec3& end() const { return points[std::size_t(degree)]; }
    glm::dvec3 at(double t) const;
    /// Of (x, y).
    Point derivative(double t) const;
    /// Of t from `first` to `last`, which has the very ends of the curve where that has 0 and 1.
    RationalCurve part(double first, double last) const;
};

/// A segment's curves: nothing for a move, quadratic ones of at most a quarter of a turn for an arc. Together
/// they start and end just where the segment does.
std::vector<RationalCurve> rationalCurves(const Segment& segment);

/// x / w, y / w; far out where there is no such number.
Point projected(glm::dvec3 p);

/// The other way: a line, a quadratic or cubic curve, a rational one only where points' weights differ
/// from 1.
Segment segmentOf(const RationalCurve& curve);

/// Appends plain curves that are the curve but for `tolerance`, tested at three points each; what is not as
/// near after `halvings` becomes a line.
inline constexpr int maxHalvings = 10;
void appendAsPlain(std::vector<Segment>& segments, const RationalCurve& curve, double tolerance,
                   int halvings = maxHalvings);

/// All rational curves as plain ones, within 2^-22 of the size of their points' box; where not all weights
/// are above 0 a curve may reach into the infinite, and is drawn by a few pieces.
std::vector<Segment> withoutRationals(std::span<const Segment> segments);

}  // namespace vtm::openvg
