/// \file
/// What the importer has to know about outlines: segments, boxes, lengths, directions, mapped copies; and
/// where finished nodes can have drawn something.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include <vtm/limits/limits.hpp>
#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include <vtm/scene/scene.hpp>
#include "geometry/arc.hpp"
#include "geometry/box.hpp"
#include "scene/center_form.hpp"

namespace vtm::svg {

/// Beyond this a coordinate is an accident or an attack: doubles keep 1e-6 of a unit up to here.
inline constexpr double maxCoordinate = 1e9;

using geometry::Box;

/// Maps the unit square to the box.
scene::Affine unitSquareTo(const Box& box);
/// Tight box of the mapped outline, strokes not counted. A MoveTo that nothing follows counts.
Box boundingBox(const scene::Path& path, const scene::Affine& transform);

/// The mapped outline; arcs become cubics (within 4e-6 of their radius).
scene::Path mapPath(const scene::Affine& transform, const scene::Path& path);

/// Without what no one means: a control point that is nearer to its end than `reach` is put on it, where it
/// would turn a stroke's cap or join by any angle. Null if there is none.
std::shared_ptr<const scene::Path> withoutTinyControls(const scene::Path& path, double reach);

/// A vertex of a path and the directions in which the path reaches and leaves it (not normalised;
/// zero where there is none). Source: SVG 2 section 9.5.5 (path segments of zero length).
struct Vertex {
    scene::Point at;
    glm::dvec2 incoming{0}, outgoing{0};
};

std::vector<Vertex> verticesOf(const scene::Path& path);

/// Whether all coordinates are finite and below what can be drawn once mapped.
bool isDrawable(const scene::Path& path, const scene::Affine& transform);

/// Segments know where they begin: moves, lines, cubics (quadratics are raised) and arcs by their centre.
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

/// Whether the nodes, mapped from the picture by `transform`, certainly draw nothing outside `box`.
bool liesInside(const std::vector<scene::Node>& nodes, const scene::Affine& transform, const Box& box);

/// Where the item can draw: its outline, or its stroke with enough room for joins and caps.
Box boxOf(const scene::Item& item);

/// Tight box of the strokes among the nodes, dashes filled in.
Box strokedBox(const std::vector<scene::Node>& nodes);

/// Where the nodes can draw: of outlines and strokes, not cut by clips and masks. Empty where they cannot.
Box boxAround(const std::vector<scene::Node>& nodes);

}  // namespace vtm::svg
