/// \file
/// Where finished nodes can have drawn something.
#pragma once

#include <vector>

#include <vtm/scene/scene.hpp>
#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {

/// Whether the nodes, mapped from the picture by `transform`, certainly draw nothing outside `box`.
bool liesInside(const std::vector<scene::Node>& nodes, const scene::Affine& transform, const Box& box);

}  // namespace vtm::svg
