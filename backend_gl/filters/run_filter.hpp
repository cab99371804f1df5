/// \file
/// A filter's graph on the GPU: the pictures that were drawn for it in, its result out.
#pragma once

#include <span>

#include "backend_gl/filters/filter_layers.hpp"

namespace vtm::gl {

/// `pictures`: under the views that `place` says; empty ones have no texture. Draws the result into `below`,
/// a transparent target of the picture below, and touches what it changes. Twin of:
/// raster/filter/run_filter.hpp.
void drawFilter(FilterLayers& layers, const asset::AssetView& asset, const asset::Filter& filter,
                const asset::FilterPlace& place, std::span<const Target> pictures, Target& below);

}  // namespace vtm::gl
