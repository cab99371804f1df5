/// \file
/// Paths: the outlines that everything else is made of.
///
/// Coordinates are doubles in the user space of whoever owns the path (y down, as in SVG); no unit
/// is attached. Commands carry absolute points. Source: SVG 2 section 9.3, OpenVG 1.1 section 8.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

using Point = glm::dvec2;

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
/// Elliptical arc in SVG's endpoint form: radii along the ellipse's own axes (either sign; zero
/// means a straight line), `rotation` of its x axis in radians. Radii too small for the chord are
/// scaled up uniformly (SVG 2 section 9.5.1).
struct ArcTo {
    Point radii;
    double rotation;
    bool largeArc;
    bool sweep;
    Point to;
};
/// A straight line back to the subpath's start; strokes join there instead of capping.
struct Close {};

using Command = std::variant<MoveTo, LineTo, QuadTo, CubicTo, ArcTo, Close>;

/// A list of subpaths. Valid if empty or if it begins with MoveTo; after Close a command other than
/// MoveTo starts a new subpath at the closed one's start.
using Path = std::vector<Command>;

enum class FillRule { NonZero, EvenOdd };

/// Corner-to-corner rectangle, as a closed subpath.
Path rectangle(Point min, Point max);
/// A closed subpath through the points, of which there is at least one.
Path polygon(const std::vector<Point>& points);

/// Where the command ends; nothing for Close, which does not name its place.
std::optional<Point> endOf(const Command& command);

}  // namespace vtm::scene

#pragma GCC visibility pop
