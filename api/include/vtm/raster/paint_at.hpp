/// \file
/// Finds the region that contains a point from the curves themselves, not from pixels.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// Returns the paint index at a point of an exact asset, user units; 0 outside its maps. `asset` must be
/// valid. In double precision: right unless the point is nearer to a boundary than rounding (some 2^-50 of
/// the map's side, 2^-36 of a leaf's); there it may return either side. Throws std::invalid_argument in
/// compat mode.
std::uint32_t paintAt(const AssetView& asset, glm::dvec2 point);

}  // namespace vtm::asset

#pragma GCC visibility pop
