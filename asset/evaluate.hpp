/// \file
/// The CPU evaluator: the fragment shaders' twin, in the same single precision, for finding which
/// side of the backend is wrong and for drawing where there is no GPU.
#pragma once

#include "asset/asset.hpp"
#include "asset/view.hpp"

namespace vtm::asset {

/// Draws the asset on transparent black. Throws std::length_error if the view is beyond its limits.
image::Raster evaluate(const AssetView& asset, const View& view);

}  // namespace vtm::asset
