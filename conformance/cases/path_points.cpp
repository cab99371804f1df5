#include "conformance/cases/path_points.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <vtm/scene/affine.hpp>

namespace vtm::cases {

using scene::Point;

namespace {

/// An elliptical arc: `linear` maps the unit circle's plane to the path's. SVG 2, B.2.4.
struct Ellipse {
    scene::Affine linear;
    Point centre;                 ///< in the unit circle's plane
    double start = 0, sweep = 0;  ///< no sweep: it is a line, or nothing

    Ellipse(Point from, const scene::ArcTo& arc) {
        const Point axis(std::cos(arc.rotation), std::sin(arc.rotation)), radii = glm::abs(arc.radii);
        linear = {axis.x * radii.x, axis.y * radii.x, -axis.y * radii.y, axis.x * radii.y, 0, 0};
        const auto inverse = scene::inverse(linear);
        if (!inverse || from == arc.to)
            return;  // a line, or nothing
        Point a = scene::apply(*inverse, from), b = scene::apply(*inverse, arc.to);
        const double half = glm::distance(a, b) / 2, growth = std::max(1.0, half);
        linear[0] *= growth, linear[1] *= growth, a /= growth, b /= growth;
        const Point along = (b - a) / (2 * half / growth), across(-along.y, along.x);
        const double height = std::sqrt(std::max(0.0, 1 - half * half));
        centre = (a + b) / 2.0 + across * (arc.largeArc != arc.sweep ? height : -height);
        start = std::atan2(a.y - centre.y, a.x - centre.x);
        sweep = std::atan2(b.y - centre.y, b.x - centre.x) - start;
        constexpr double turn = 6.283185307179586;
        if (arc.sweep != (sweep > 0))
            sweep += arc.sweep ? turn : -turn;
    }
    Point at(double t) const {
        const double angle = start + sweep * t;
        return scene::apply(linear, centre + Point(std::cos(angle), std::sin(angle)));
    }
    Point derivative(double t) const {
        const double angle = start + sweep * t;
        return scene::apply(linear, sweep * Point(-std::sin(angle), std::cos(angle)));
    }
};

}  // namespace

Point interpolate(Point from, const scene::Command& command, double t) {
    const double u = 1 - t;
    if (const auto* line = std::get_if<scene::LineTo>(&command))
        return u * from + t * line->to;
    if (const auto* quad = std::get_if<scene::QuadTo>(&command))
        return u * u * from + 2 * u * t * quad->control + t * t * quad->to;
    if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
        return u * u * u * from + 3 * u * u * t * cubic->control1 + 3 * u * t * t * cubic->control2 +
               t * t * t * cubic->to;
    if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
        const Ellipse ellipse(from, *arc);
        return ellipse.sweep != 0 ? ellipse.at(t) : u * from + t * arc->to;
    }
    return from;
}

Point derivative(Point from, const scene::Command& command, double t) {
    const double u = 1 - t;
    if (const auto* line = std::get_if<scene::LineTo>(&command))
        return line->to - from;
    if (const auto* quad = std::get_if<scene::QuadTo>(&command))
        return 2.0 * (u * (quad->control - from) + t * (quad->to - quad->control));
    if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
        return 3.0 * (u * u * (cubic->control1 - from) + 2 * u * t * (cubic->control2 - cubic->control1) +
                      t * t * (cubic->to - cubic->control2));
    if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
        const Ellipse ellipse(from, *arc);
        return ellipse.sweep != 0 ? ellipse.derivative(t) : arc->to - from;
    }
    return Point(0);
}

}  // namespace vtm::cases
