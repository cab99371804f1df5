// The vertices of a path, for markers. Source: SVG 2 sections 9.5.5 and 11.6.3.

#include <glm/geometric.hpp>

#include "svg/geometry/path_geometry.hpp"
#include "svg/geometry/segments.hpp"

namespace vtm::svg {
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

}  // namespace vtm::svg
