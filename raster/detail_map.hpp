/// \file
/// A planar map with no more detail than pixels show (docs/coverage.md): what others than the scanner draw.
#pragma once

#include "raster/planar_map.hpp"

namespace vtm::asset {

/// Nothing of a boundary that is shorter than a pixel moves further, pixels.
inline constexpr double detailTolerance = 0.02;

/// The map without those that are placed in it, for pixels of that many lattice steps and larger ones: where
/// pieces are shorter than a quarter of a pixel in the mean, fewer straight ones that change no pixel by
/// 1/255, those that the scanner draws. Where pieces meet other regions nothing moves, and all is as closed
/// as before. Ends of pieces are no whole numbers of steps.
PlanarMap mapForPixels(const AssetView& asset, const Map& map, double pixel);

}  // namespace vtm::asset
