/// \file
/// The mapping from a picture to a raster.
#pragma once

#include <glm/mat3x2.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// A raster of `width` by `height` pixels. `toPixels` maps picture coordinates to pixel coordinates:
/// pixel (i, j) is the box [i, i+1] × [j, j+1], j downwards. It may rotate, shear and mirror.
struct View {
    int width = 0, height = 0;
    glm::dmat3x2 toPixels{1, 0, 0, 1, 0, 0};
};

/// Max side of a raster in pixels, and max number of pixels in it.
inline constexpr int maxViewSide = 16384;
inline constexpr long long maxViewPixels = 1LL << 27;

/// Largest magnitude in `toPixels`: products with an asset's lengths stay within single precision.
inline constexpr double maxViewNumber = 1e18;

/// Throws std::length_error unless the raster (which may be empty) and every number are within the
/// limits.
void validate(const View& view);

}  // namespace vtm::asset

#pragma GCC visibility pop
