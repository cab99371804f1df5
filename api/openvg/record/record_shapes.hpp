/// \file
/// What a recording's layers are cut to.
#pragma once

#include <vector>

#include <vtm/scene/scene.hpp>
#include "api/openvg/state/objects.hpp"
#include "api/openvg/state/state.hpp"

namespace vtm::openvg {

scene::Path rectangleOf(double x, double y, double width, double height);

/// Scissoring rectangles that hold something: x, y, width, height. The corners may be beyond what integers
/// hold.
std::vector<VGint> rectanglesOf(const State& state);

/// Of all rectangles, to be filled by the non-zero rule.
scene::Path outlineOf(const std::vector<VGint>& rectangles);

/// Where a path is painted, in its own space; an empty path where it is nowhere.
scene::Shape shapeOf(const State& state, const Path& path, VGPaintMode mode, const scene::Affine& transform);

}  // namespace vtm::openvg
