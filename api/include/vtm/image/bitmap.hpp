/// \file
/// Images as arrays of pixels. All modules share these plain types.
#pragma once

#include <cstdint>
#include <vector>

#pragma GCC visibility push(default)

namespace vtm::image {

/// 8-bit straight (not premultiplied) sRGB with alpha: red, green, blue, alpha per pixel, rows from the top,
/// no padding.
struct Bitmap {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4
};

/// Premultiplied sRGB-encoded floats, nominally in [0, 1]: red, green, blue, alpha per pixel, rows from the
/// top, no padding. Engines render into it, and images are compared in it.
struct Raster {
    int width = 0, height = 0;
    std::vector<float> rgba;  ///< width * height * 4

    Raster() = default;
    /// Transparent black. The sides must not be negative.
    Raster(int w, int h) : width(w), height(h), rgba(std::size_t(w) * std::size_t(h) * 4) {}
    /// Returns the four channels of pixel (x, y), which must be in the image.
    float* pixel(int x, int y) { return &rgba[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4]; }
    const float* pixel(int x, int y) const {
        return &rgba[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4];
    }
};

/// Divides by alpha, clamps to [0, 1] and rounds to the nearest byte. NaN becomes 0. NaN becomes 0.
Bitmap toBitmap(const Raster& raster);
/// Multiplies by alpha.
Raster toRaster(const Bitmap& bitmap);

}  // namespace vtm::image

#pragma GCC visibility pop
