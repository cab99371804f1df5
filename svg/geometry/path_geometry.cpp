#include "svg/geometry/path_geometry.hpp"
#include "svg/geometry/stroke_box.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <vtm/limits/limits.hpp>
#include "scene/stroke_reach.hpp"

namespace vtm::svg {

// ---- Boxes and mapped copies --------------------------------------------------------------------

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

std::shared_ptr<const scene::Path> withoutTinyControls(const scene::Path& path, double reach) {
    std::shared_ptr<scene::Path> result;
    scene::Point from{}, start{};
    const auto isTiny = [&](scene::Point control, scene::Point end) {
        return control != end && glm::distance(control, end) < reach;
    };
    for (std::size_t i = 0; i < path.size(); ++i) {
        const auto change = [&](const scene::Command& command) {
            if (!result)
                result = std::make_shared<scene::Path>(path);
            (*result)[i] = command;
        };
        if (const auto* move = std::get_if<scene::MoveTo>(&path[i])) {
            start = move->to;
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&path[i])) {
            const bool first = isTiny(cubic->control1, from), second = isTiny(cubic->control2, cubic->to);
            if (first || second)
                change(scene::CubicTo{first ? from : cubic->control1, second ? cubic->to : cubic->control2,
                                      cubic->to});
        } else if (const auto* quad = std::get_if<scene::QuadTo>(&path[i])) {
            if (isTiny(quad->control, from) || isTiny(quad->control, quad->to))
                change(scene::LineTo{quad->to});
        }
        from = scene::endOf(path[i]).value_or(start);
    }
    return result;
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

// ---- Vertices, for markers (SVG 2 sections 9.5.5 and 11.6.3) ------------------------------------

namespace {

using scene::Point;

/// The first of the differences that is not zero.
glm::dvec2 firstNonZero(std::initializer_list<glm::dvec2> differences) {
    for (const glm::dvec2 d : differences)
        if (d != glm::dvec2(0))
            return d;
    return glm::dvec2(0);
}

class VertexBuilder {
public:
    void operator()(const MoveSegment& move) {
        endSubpath();
        subpath_ = vertices_.size();
        vertices_.push_back({move.to});
    }
    void operator()(const LineSegment& line) {
        segment(line.to, line.to - line.from, line.to - line.from, line.closes);
    }
    void operator()(const geometry::Cubic& c) {
        segment(c.p3, firstNonZero({c.p1 - c.p0, c.p2 - c.p0, c.p3 - c.p0}),
                firstNonZero({c.p3 - c.p2, c.p3 - c.p1, c.p3 - c.p0}), false);
    }
    void operator()(const ArcSegment& a) {
        const double sign = a.arc.sweep < 0 ? -1 : 1;
        segment(a.to, sign * a.arc.derivative(a.arc.start),
                sign * a.arc.derivative(a.arc.start + a.arc.sweep), false);
    }

    std::vector<Vertex> finish() {
        endSubpath();
        return std::move(vertices_);
    }

private:
    void segment(Point to, glm::dvec2 leaving, glm::dvec2 arriving, bool closes) {
        if (closed_) {  // drawing goes on after Close: a new subpath from the vertex of the closing line
            endSubpath();
            subpath_ = vertices_.size() - 1;
        }
        vertices_.back().outgoing = leaving;
        vertices_.push_back({to, arriving});
        closed_ = closes;
    }

    /// Segments of no length take their direction from their neighbours, first those before, then
    /// those after. SVG 2 would let the first and last vertex of a closed subpath share the bisector of
    /// both directions; the renderers in use do not, and neither do we.
    void endSubpath() {
        if (subpath_ >= vertices_.size())
            return;
        glm::dvec2 direction = vertices_[subpath_].incoming;
        for (std::size_t i = subpath_ + 1; i < vertices_.size(); ++i)
            carry(vertices_[i - 1].outgoing, vertices_[i].incoming, direction);
        direction = glm::dvec2(0);
        for (std::size_t i = vertices_.size(); --i > subpath_;)
            carry(vertices_[i].incoming, vertices_[i - 1].outgoing, direction);
        closed_ = false;
    }

    /// One segment's two directions, in the order in which they are met.
    static void carry(glm::dvec2& first, glm::dvec2& second, glm::dvec2& direction) {
        if (first == glm::dvec2(0))
            first = direction;
        if (second == glm::dvec2(0))
            second = direction;
        direction = second;
    }

    std::vector<Vertex> vertices_;
    std::size_t subpath_ = 0;
    bool closed_ = false;
};

}  // namespace

std::vector<Vertex> verticesOf(const scene::Path& path) {
    VertexBuilder builder;
    forEachSegment(path, builder);
    return builder.finish();
}

// ---- Nodes --------------------------------------------------------------------------------------

namespace {

/// Share of the box's size by which an outline may stand over without being worth a clip: below what
/// an 8-bit pixel of the largest target shows, above the noise of decimal path data.
constexpr double tolerance = 1e-6;

Box itemBox(const scene::Item& item, const scene::Affine& transform) {
    const scene::Affine map = scene::compose(transform, item.transform);
    Box box = boundingBox(*item.path, map);
    if (const auto* stroke = std::get_if<scene::StrokeStyle>(&item.geometry)) {
        const scene::Point growth =
            scene::strokeReach(*stroke) *
            scene::Point(std::hypot(map[0].x, map[1].x), std::hypot(map[0].y, map[1].y));
        box.min -= growth;
        box.max += growth;
    }
    return box;
}

}  // namespace

bool liesInside(const std::vector<scene::Node>& nodes, const scene::Affine& transform, const Box& box) {
    const scene::Point margin = tolerance * scene::Point(box.width(), box.height());
    const Box grown{box.min - margin, box.max + margin};
    return std::all_of(nodes.begin(), nodes.end(), [&](const scene::Node& node) {
        limits::check();
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return grown.contains(itemBox(*item, transform));
        return liesInside(std::get<scene::Group>(node.value).children, transform, box);
    });
}

Box boxOf(const scene::Item& item) { return itemBox(item, scene::identity); }

Box strokedBox(const std::vector<scene::Node>& nodes) {
    Box box;
    for (const scene::Node& node : nodes) {
        limits::check();
        if (const auto* group = std::get_if<scene::Group>(&node.value)) {
            box.add(strokedBox(group->children));
        } else if (const auto* item = std::get_if<scene::Item>(&node.value)) {
            if (const auto* stroke = std::get_if<scene::StrokeStyle>(&item->geometry))
                box.add(geometry::mapped(strokeBox(*item->path, *stroke), item->transform));
        }
    }
    return box;
}

Box boxAround(const std::vector<scene::Node>& nodes) {
    Box box;
    for (const scene::Node& node : nodes) {
        limits::check();
        const auto* item = std::get_if<scene::Item>(&node.value);
        box.add(item ? itemBox(*item, scene::identity)
                     : boxAround(std::get<scene::Group>(node.value).children));
    }
    return box;
}

}  // namespace vtm::svg
