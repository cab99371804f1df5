/// \file
/// Strokes as filled outlines.
#pragma once

#include "scene/path.hpp"
#include "scene/stroke.hpp"

namespace vtm::compiler {

/// A path whose non-zero fill is the stroke of `path` in `style`, in the path's own space: dashes,
/// offsets, joins and caps, each contour closed. Boundary within `tolerance` (> 0, path units) of
/// the true offset curve; interiors may overlap. Non-finite input points must have been rejected.
/// Source: SVG 2 section 13.5 and 13.6 (zero-length subpaths, dashes, caps).
scene::Path strokeOutline(const scene::Path& path, const scene::StrokeStyle& style, double tolerance);

}  // namespace vtm::compiler
