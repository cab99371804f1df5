/// \file
/// A path as segments that know where they begin: moves, lines, cubics (quadratics are raised) and arcs by
/// their centre.
#pragma once

#include <variant>

#include <vtm/limits/limits.hpp>
#include <vtm/scene/path.hpp>
#include "scene/center_form.hpp"
#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {

struct MoveSegment {
    scene::Point to;
};
struct LineSegment {
    scene::Point from, to;
    bool closes = false;
};
struct ArcSegment {
    scene::Point from, to;
    geometry::EllipticalArc arc;
};

/// Calls `visit` with each segment in turn.
template <class Visitor>
void forEachSegment(const scene::Path& path, Visitor&& visit) {
    scene::Point from{}, start{};
    for (const scene::Command& command : path) {
        limits::check();
        if (const auto* move = std::get_if<scene::MoveTo>(&command)) {
            visit(MoveSegment{move->to});
            from = start = move->to;
        } else if (const auto* line = std::get_if<scene::LineTo>(&command)) {
            visit(LineSegment{from, line->to});
            from = line->to;
        } else if (const auto* quad = std::get_if<scene::QuadTo>(&command)) {
            visit(geometry::raised(from, quad->control, quad->to));
            from = quad->to;
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            visit(geometry::Cubic{from, cubic->control1, cubic->control2, cubic->to});
            from = cubic->to;
        } else if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
            if (const auto center = scene::centerForm(from, *arc))
                visit(ArcSegment{from, arc->to, *center});
            else
                visit(LineSegment{from, arc->to});
            from = arc->to;
        } else {
            visit(LineSegment{from, start, true});
            from = start;
        }
    }
}

}  // namespace vtm::svg
