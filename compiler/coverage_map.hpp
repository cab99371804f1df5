/// \file
/// An outline in, the planar map of its inside out, without an asset between.
#pragma once

#include <memory>

#include <glm/vec2.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/scene/path.hpp>
#include "raster/planar_map.hpp"

namespace vtm::compiler {

/// What of the picture [0, picture.x] × [0, picture.y] lies inside `outline`, which `toPicture` maps there:
/// paint 0 outside, another inside. Boundaries are within the tolerance as compile() has them, and errors are
/// the same. Of an outline of few chords they are straight, since fitting curves to them takes as long as the
/// rest.
asset::PlanarMap coverageMap(const std::shared_ptr<const scene::Path>& outline, scene::FillRule rule,
                             const scene::Affine& toPicture, glm::dvec2 picture, const Options& options);

}  // namespace vtm::compiler
