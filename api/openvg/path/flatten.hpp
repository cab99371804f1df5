/// \file
/// Outlines as lines on the surface, for what needs no exact coverage.
#pragma once

#include <functional>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <vtm/scene/path.hpp>
#include "geometry/box.hpp"

namespace vtm::openvg {

/// Calls line(a, b) along the outline under `map`, in surface coordinates, every subpath closed. The lines
/// are nowhere further than a 64th of a pixel from the curves. A segment that runs the other way is cut at
/// the same points, bit for bit.
void flatten(const scene::Path& outline, const glm::mat3& map,
             const std::function<void(glm::dvec2 a, glm::dvec2 b)>& line);

/// A box around all end points, control points and ellipses of an outline; empty if the path is.
geometry::Box boxOf(const scene::Path& outline);

}  // namespace vtm::openvg
