/// \file
/// What of a path's stroke can reach a box.
#pragma once

#include <vector>

#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>
#include "compiler/lower/outline.hpp"
#include "compiler/stroke/subpath.hpp"

namespace vtm::compiler::stroke {

scene::Path moved(const scene::Path& path, Point by);

/// Appends to `near` the connected parts of a subpath whose strokes may reach the box: by their sides, joins
/// or caps. Where a part ends inside the subpath, the stroke has a cap that does not reach the box. Returns
/// whether the subpath was appended as it is.
bool nearParts(const Subpath& subpath, const scene::StrokeStyle& style, const PathBox& box, double tolerance,
               std::vector<Subpath>& near);

}  // namespace vtm::compiler::stroke
