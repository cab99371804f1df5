/// \file
/// Adding one map to a raster: the sum of all its leaves over every pixel.
#pragma once

#include <vtm/raster/pixel_box.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include "asset/instances.hpp"
#include "raster/src/paint.hpp"

namespace vtm::asset {

/// The pixels of `view` whose boxes can meet the image of [0, 1]².
PixelBox pixelsOf(const View& view, const Affine2& toPicture);

/// The view that sees only `box` of `view`.
View crop(const View& view, const PixelBox& box);
/// Where that goes in the view's target.
inline ByteTarget partOf(const ByteTarget& target, const PixelBox& box) {
    return {target.pixels + std::size_t(box.min.y) * target.rowBytes + std::size_t(box.min.x) * 4,
            target.rowBytes};
}

/// target += coverage of each pixel's box, of a map with the paints 0 and 1.
void addCoverage(const Paints& paints, const Map& map, const View& view, image::Raster& target);

/// target += ∫ colour over each pixel's box; of rough pixels, so many levels finer (raster/src/rough.hpp).
void addColors(const Paints& paints, const Map& map, const View& view, const MaterialFunction& materials,
               int finerLevels, image::Raster& target);

}  // namespace vtm::asset
