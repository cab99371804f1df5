/// \file
/// The box of a stroke. Source: SVG 2 section 8.10, CSS Masking 1 section 5.1 (stroke-box).
#pragma once

#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>
#include "geometry/box.hpp"

namespace vtm::svg {

/// Tight box of the stroke without dashes, with its joins and caps; empty for an empty path. A mitre that is
/// clipped counts up to the middle of its clipped edge.
geometry::Box strokeBox(const scene::Path& path, const scene::StrokeStyle& stroke);

}  // namespace vtm::svg
