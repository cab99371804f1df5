/// \file
/// Segments of paths, one by one (specification sections 8.3 to 8.5), and as rational Bézier curves in
/// homogeneous coordinates: what lines, curves and arcs all are, and remain under projective maps
/// (VG_NDS_projective_geometry, section 8.4a).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <VG/vgext.h>

#include <vtm/scene/path.hpp>
#include "geometry/arc.hpp"

namespace vtm::openvg {

using Point = glm::dvec2;

/// Numbers that a segment takes (table 6). `segment`: a VGPathCommand or VGPathSegment.
int coordinateCount(unsigned segment);

/// A VGPathCommand, or closing with either of its spellings. Those of VG_NDS_projective_geometry are only
/// legal for programs that know of extensions.
bool isCommand(unsigned segment, bool knowsExtensions);

/// A segment with all that is implicit made explicit (sections 8.5.1 and 8.5.2): absolute points, one of
/// VG_CLOSE_PATH, VG_MOVE_TO, VG_LINE_TO, VG_QUAD_TO, VG_CUBIC_TO, the four arcs, VG_RQUAD_TO_NDS and
/// VG_RCUBIC_TO_NDS.
struct Segment {
    unsigned type = VG_CLOSE_PATH;
    Point from{0};  ///< (ox, oy)
    Point control1{0}, control2{0};
    Point radii{0};       ///< of arcs, as given
    double rotation = 0;  ///< of arcs, degrees
    Point to{0};
    std::array<double, 4> weights{1, 1, 1, 1};  ///< of rational curves' points, in their order

    bool isRational() const { return type == VG_RQUAD_TO_NDS || type == VG_RCUBIC_TO_NDS; }
    bool isArc() const { return type >= VG_SCCWARC_TO && type <= VG_LCWARC_TO; }
};

/// The path as outlines are made of it; rational curves as cubic ones.
scene::Path outline(const std::vector<Segment>& segments);
/// The other way.
std::vector<Segment> segmentsOf(const scene::Path& outline);

/// An arc by its centre (section 18.4); nothing if it is drawn as a line, or is no arc.
std::optional<geometry::EllipticalArc> arcOf(const Segment& segment);

/// The affine image of an ellipse: radii and rotation (degrees) of what becomes of them.
void transformEllipse(const glm::dmat2& linear, Point& radii, double& rotation);

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
