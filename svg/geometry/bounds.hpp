/// \file
/// Where finished nodes can have drawn something.
#pragma once

#include <vector>

#include <vtm/scene/scene.hpp>
#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {

/// Whether the nodes, mapped from the picture by `transform`, certainly draw nothing outside `box`.
bool liesInside(const std::vector<scene::Node>& nodes, const scene::Affine& transform, const Box& box);

/// Where the item can draw: its outline, or its stroke with enough room for joins and caps.
Box boxOf(const scene::Item& item);

/// Where the nodes can draw: of outlines and strokes, not cut by clips and masks. Empty where they cannot.
Box boxAround(const std::vector<scene::Node>& nodes);

}  // namespace vtm::svg
