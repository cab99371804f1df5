/// \file
/// Paths: outlines of items, clips and masks.
///
/// Coordinates are finite doubles in the space of the path's owner, without a unit, y down as in SVG.
/// Commands have absolute points. Source: SVG 2 section 9.3, OpenVG 1.1 section 8.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

using Point = glm::dvec2;

/// Starts a subpath.
struct MoveTo {
    Point to;
};
struct LineTo {
    Point to;
};
struct QuadTo {
    Point control, to;
};
struct CubicTo {
    Point control1, control2, to;
};
/// Elliptical arc in SVG's endpoint form (SVG 2 section 9.5.1). Radii that are too small for the chord are
/// scaled up uniformly; equal end points draw nothing.
struct ArcTo {
    Point radii;      ///< along the ellipse's own axes; the sign is ignored, and 0 makes a straight line
    double rotation;  ///< of the ellipse's x axis, radians
    bool largeArc;    ///< the arc of more than half the ellipse
    bool sweep;       ///< in the direction from the positive x axis to the positive y axis
    Point to;
};
/// A straight line back to the subpath's start. Strokes have a join there instead of two caps.
struct Close {};

using Command = std::variant<MoveTo, LineTo, QuadTo, CubicTo, ArcTo, Close>;

/// A list of subpaths. It must be empty or begin with MoveTo. After Close, a command other than MoveTo starts
/// a new subpath at the start of the closed one.
using Path = std::vector<Command>;

enum class FillRule { NonZero, EvenOdd };

/// Returns the rectangle with these corners as a closed subpath.
Path rectangle(Point min, Point max);
/// Returns a closed subpath through the points. There must be at least one.
Path polygon(const std::vector<Point>& points);

/// Returns the command's end point; nullopt for Close, which has none of its own.
std::optional<Point> endOf(const Command& command);

}  // namespace vtm::scene

#pragma GCC visibility pop
