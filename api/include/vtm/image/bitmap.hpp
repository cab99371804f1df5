/// \file
/// Pictures as arrays of pixels: the plain types that every other module shares.
#pragma once

#include <cstdint>
#include <vector>

#pragma GCC visibility push(default)

namespace vtm::image {

/// 8-bit straight (not premultiplied) sRGB with alpha, rows top to bottom, no padding.
struct Bitmap {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4
};

/// Premultiplied sRGB-encoded floats, nominally in [0, 1]: what every engine renders into and what
/// comparisons are made on. Rows top to bottom, no padding.
struct Raster {
    int width = 0, height = 0;
    std::vector<float> rgba;  ///< width * height * 4

    Raster() = default;
    Raster(int w, int h) : width(w), height(h), rgba(std::size_t(w) * std::size_t(h) * 4) {}
    float* pixel(int x, int y) { return &rgba[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4]; }
    const float* pixel(int x, int y) const {
        return &rgba[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4];
    }
};

/// Rounds to nearest after un-premultiplying; values outside [0, 1] are clamped.
Bitmap toBitmap(const Raster& raster);
Raster toRaster(const Bitmap& bitmap);

}  // namespace vtm::image

#pragma GCC visibility pop
