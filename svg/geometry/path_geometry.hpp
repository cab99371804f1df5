/// \file
/// What the importer has to know about outlines: boxes, lengths, directions, mapped copies.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>

namespace vtm::svg {

/// Beyond this a coordinate is an accident or an attack: doubles keep 1e-6 of a unit up to here.
inline constexpr double maxCoordinate = 1e9;

struct Box {
    scene::Point min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};

    bool empty() const { return !(min.x <= max.x && min.y <= max.y); }
    double width() const { return max.x - min.x; }
    double height() const { return max.y - min.y; }
    void add(scene::Point p);
    void add(const Box& other);
    bool contains(const Box& other) const;
};

/// Maps the unit square to the box.
scene::Affine unitSquareTo(const Box& box);
/// Box of the mapped corners.
Box mapBox(const scene::Affine& transform, const Box& box);

/// An elliptical arc by its centre: p(a) = center + cos(a) u + sin(a) v for a from `start` on
/// through `sweep` radians (SVG 2 appendix B.2.4).
struct CenterArc {
    scene::Point center, u, v;
    double start, sweep;
    scene::Point at(double angle) const;
    /// Towards growing parameters.
    scene::Point direction(double angle) const;
};

/// Nothing where the arc is a straight line (a radius of zero) or nothing at all.
std::optional<CenterArc> centerForm(scene::Point from, const scene::ArcTo& arc);

/// Tight box of the mapped outline, strokes not counted. A MoveTo that nothing follows counts.
Box boundingBox(const scene::Path& path, const scene::Affine& transform);

/// Within about 1e-4 of the true length.
double lengthOf(const scene::Path& path);

/// The mapped outline; arcs become cubics (within 4e-6 of their radius).
scene::Path mapPath(const scene::Affine& transform, const scene::Path& path);

/// A vertex of a path and the directions in which the path reaches and leaves it (not normalised;
/// zero where there is none). Source: SVG 2 section 9.5.5 (path segments of zero length).
struct Vertex {
    scene::Point at;
    glm::dvec2 incoming{0}, outgoing{0};
};

std::vector<Vertex> verticesOf(const scene::Path& path);

/// Whether all coordinates are finite and below what can be drawn once mapped.
bool isDrawable(const scene::Path& path, const scene::Affine& transform);

}  // namespace vtm::svg
