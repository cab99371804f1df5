/// \file
/// Adding one map to a raster: the sum of all its leaves over every pixel.
#pragma once

#include <glm/vec2.hpp>

#include "asset/src/paint.hpp"
#include "asset/view.hpp"

namespace vtm::asset {

/// Pixels [min, max) of a raster.
struct PixelBox {
    glm::ivec2 min{0}, max{0};
    bool empty() const { return min.x >= max.x || min.y >= max.y; }
};

/// The pixels of `view` whose boxes can meet the square with min corner `corner`.
PixelBox pixelsOf(const View& view, glm::dvec2 corner, double side);

/// The view that sees only `box` of `view`.
View crop(const View& view, const PixelBox& box);

/// What a paint index of a map stands for.
enum class PaintMeaning {
    Color,    ///< Asset::paints
    Coverage  ///< the index itself, 0 or 1
};

/// target += ∫ colour over each pixel's box.
void addMap(const Paints& paints, const Map& map, const View& view, PaintMeaning meaning,
            const MaterialFunction& materials, image::Raster& target);

}  // namespace vtm::asset
