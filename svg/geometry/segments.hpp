/// \file
/// A path as segments that know where they begin; quadratics raised to cubics, arcs by their centre.
#pragma once

#include <variant>

#include <vtm/limits/limits.hpp>
#include <vtm/scene/path.hpp>
#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {

struct MoveSegment {
    scene::Point to;
};
struct LineSegment {
    scene::Point from, to;
    bool closes = false;
};
struct CubicSegment {
    scene::Point from, control1, control2, to;
    scene::Point at(double t) const {
        const double s = 1 - t;
        return s * s * s * from + 3 * s * s * t * control1 + 3 * s * t * t * control2 + t * t * t * to;
    }
};
struct ArcSegment {
    scene::Point from, to;
    CenterArc arc;
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
            visit(CubicSegment{from, (from + 2.0 * quad->control) / 3.0,
                               (quad->to + 2.0 * quad->control) / 3.0, quad->to});
            from = quad->to;
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            visit(CubicSegment{from, cubic->control1, cubic->control2, cubic->to});
            from = cubic->to;
        } else if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
            if (const auto center = centerForm(from, *arc))
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
