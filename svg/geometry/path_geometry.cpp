#include "svg/geometry/path_geometry.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "svg/geometry/segments.hpp"

namespace vtm::svg {
namespace {

using geometry::Cubic;
using scene::Affine;
using scene::Path;
using scene::Point;

/// Of arcs that become cubics: within 4.3e-6 of the radius (geometry::cubicArcError).
constexpr double mappedArcAngle = std::numbers::pi / 4;

struct BoxBuilder {
    const Affine& transform;
    Box box;

    Point map(Point p) const { return scene::apply(transform, p); }
    void operator()(const MoveSegment& move) { box.add(map(move.to)); }
    void operator()(const LineSegment& line) { box.add(map(line.to)); }
    void operator()(const Cubic& c) {
        box.add(geometry::bounds(Cubic{map(c.p0), map(c.p1), map(c.p2), map(c.p3)}));
    }
    void operator()(const ArcSegment& arc) {
        box.add(map(arc.to));
        box.add(geometry::bounds(geometry::mapped(arc.arc, transform)));
    }
};

struct PathMapper {
    const Affine& transform;
    Path out;

    Point map(Point p) const { return scene::apply(transform, p); }
    void operator()(const MoveSegment& move) { out.push_back(scene::MoveTo{map(move.to)}); }
    void operator()(const LineSegment& line) {
        if (line.closes)
            out.push_back(scene::Close{});
        else
            out.push_back(scene::LineTo{map(line.to)});
    }
    void operator()(const Cubic& c) { out.push_back(scene::CubicTo{map(c.p1), map(c.p2), map(c.p3)}); }
    void operator()(const ArcSegment& arc) {
        const geometry::EllipticalArc mapped = geometry::mapped(arc.arc, transform);
        for (const Cubic& c : geometry::cubics(mapped, geometry::cubicCount(mapped, mappedArcAngle)))
            out.push_back(scene::CubicTo{c.p1, c.p2, c.p3});
    }
};

}  // namespace

Affine unitSquareTo(const Box& box) { return {box.width(), 0, 0, box.height(), box.min.x, box.min.y}; }

Box boundingBox(const Path& path, const Affine& transform) {
    BoxBuilder builder{transform, {}};
    forEachSegment(path, builder);
    return builder.box;
}

Path mapPath(const Affine& transform, const Path& path) {
    PathMapper mapper{transform, {}};
    forEachSegment(path, mapper);
    return std::move(mapper.out);
}

bool isDrawable(const Path& path, const Affine& transform) {
    const auto fine = [&](Point p) {
        const Point mapped = scene::apply(transform, p);
        return std::abs(p.x) <= maxCoordinate && std::abs(p.y) <= maxCoordinate &&
               std::abs(mapped.x) <= maxCoordinate && std::abs(mapped.y) <= maxCoordinate;
    };
    return std::all_of(path.begin(), path.end(), [&](const scene::Command& command) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command))
            return fine(move->to);
        if (const auto* line = std::get_if<scene::LineTo>(&command))
            return fine(line->to);
        if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            return fine(quad->control) && fine(quad->to);
        if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
            return fine(cubic->control1) && fine(cubic->control2) && fine(cubic->to);
        if (const auto* arc = std::get_if<scene::ArcTo>(&command))
            return fine(arc->radii) && fine(arc->to) && std::isfinite(arc->rotation);
        return true;
    });
}

}  // namespace vtm::svg
