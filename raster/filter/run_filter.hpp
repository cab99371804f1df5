/// \file
/// A filter's graph on pixels: the pictures that were drawn for it in, its result out.
#pragma once

#include <vector>

#include "raster/filter_place.hpp"
#include "raster/src/canvas.hpp"

namespace vtm::asset {

/// `pictures`: under the views that `place` says. Returns the result under the view of the picture below.
Canvas runFilter(const AssetView& asset, const Filter& filter, const FilterPlace& place,
                 std::vector<Canvas> pictures, const View& below);

}  // namespace vtm::asset
