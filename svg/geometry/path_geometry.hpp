/// \file
/// What the importer has to know about outlines: boxes, lengths, directions, mapped copies.
#pragma once

#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include "geometry/arc.hpp"
#include "geometry/box.hpp"

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
