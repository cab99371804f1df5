/// \file
/// Strokes as filled outlines.
#pragma once

#include <cstddef>

#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>

#pragma GCC visibility push(default)

namespace vtm::compiler {

/// Max number of dashes in one path; more throw LimitError (vtm/compiler/compile.hpp).
inline constexpr std::size_t maxDashes = 1'000'000;

/// Returns a path whose non-zero fill is the stroke of `path` in `style`, in the path's own space: dashes,
/// offsets, joins and caps, each contour closed. Boundary within `tolerance` (> 0, path units) of the true
/// offset curve; interiors may overlap. Cusps inside a curve get round joins. A tolerance above 1/32 of the
/// width is lowered to that, so that hairlines keep their coverage; one below 1e-11 of the coordinates is
/// raised to that. Non-finite input points must have been rejected; coordinates beyond 1e48 are a LimitError.
/// Source: SVG 2 section 13.5 and 13.6 (zero-length subpaths, dashes, caps).
scene::Path strokeOutline(const scene::Path& path, const scene::StrokeStyle& style, double tolerance);

/// Returns whether the outline has offsets of curves other than circles. Their distance from the true offsets
/// is tested at fifteen points of every piece; that of all other parts is proven.
bool hasSampledOffsets(const scene::Path& path);

}  // namespace vtm::compiler

#pragma GCC visibility pop
