/// \file
/// Where a map lands under a view, as leaf_vertex.glsl reads it.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/pixel_box.hpp>
#include <vtm/raster/view.hpp>
#include "backend_gl/layers/instances.hpp"

namespace vtm::gl {

using asset::PixelBox;

/// The pixels of `view` that a drawn mask can touch.
PixelBox pixelsOf(const DrawnMask& drawn, const asset::Map& map, const asset::View& view);

/// Four RGBA32F texels of the placements' texture, of which three are read. Squares of the deepest level are
/// the unit: 2^24 a side of the map. Floats hold their numbers exactly, and only differences from `baseCell`,
/// which lies near the view, meet the matrix: at 4096 pixels from it the error is below 4096 · 2^-23 pixels.
struct Placement {
    float linear[4];     ///< units to pixels, by columns
    float basePixel[2];  ///< where baseCell lands, pixels of the target
    float baseCell[2];   ///< units from the map's corner
    float box[4];        ///< of the target, which instances do not leave: min, max
    float unused[4];
};
static_assert(sizeof(Placement) == 64);

/// `view` must be invertible. `shift` is added to pixels; `box` is in shifted pixels.
Placement placementOf(const asset::Map& map, const asset::View& view, glm::ivec2 shift, const PixelBox& box);

/// Whether the view keeps areas; one that flattens the plane shows nothing.
bool isInvertible(const asset::View& view);

}  // namespace vtm::gl
