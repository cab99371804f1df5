/// \file
/// A planar map with no more detail than pixels show (docs/coverage.md): what others than the scanner draw.
#pragma once

#include "raster/planar_map.hpp"

namespace vtm::asset {

/// For pixels of that many lattice steps and larger ones: fewer pieces, straight ones where they are shorter
/// than a pixel, which change no pixel by 1/255. Where pieces meet other regions nothing moves, and all is as
/// closed as before. Ends of pieces are no whole numbers of steps.
PlanarMap mapForPixels(const PlanarMap& map, double pixel);

}  // namespace vtm::asset
