/// \file
/// Boxes around what a scene draws and what its filters read: never too small.
#pragma once

#include <vtm/scene/scene.hpp>
#include "geometry/box.hpp"

namespace vtm::compiler {

/// Around what the nodes draw, in the space that `toPicture` maps to.
geometry::Box boundsOf(const scene::NodeList& nodes, const scene::Affine& toPicture);

/// How far from a place a filter reads to find its colour there, in its user space; infinite where nothing
/// bounds it but the filter's region. `deviations`: of a blur, so many; by default more than the engines
/// read.
scene::Point reachOf(const scene::Filter& filter, double deviations = 8);

}  // namespace vtm::compiler
