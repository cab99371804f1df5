/// \file
/// A filter's graph on pixels: the pictures that were drawn for it in, its result out.
#pragma once

#include <vector>

#include "raster/filter_place.hpp"
#include "raster/src/canvas.hpp"

namespace vtm::asset {

/// The pixels that the picture below may show of the result.
PixelBox shownOf(const FilterPlace& place, const View& below);

/// `pictures`: under the views that `place` says. Returns the result under the view of the picture below.
Canvas runFilter(const AssetView& asset, const Filter& filter, const FilterPlace& place,
                 std::vector<Canvas> pictures, const View& below);

}  // namespace vtm::asset
