/// \file
/// Pixels as most engines have them, as ours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <vtm/image/bitmap.hpp>

namespace vtm::bench {

/// Of rows that begin `stride` bytes apart, a 32-bit word a pixel: premultiplied, alpha in the highest byte,
/// then red, green, blue.
inline image::Bitmap bitmapOf(const unsigned char* bytes, std::ptrdiff_t stride, int width, int height) {
    image::Raster raster(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint32_t argb = 0;
            std::memcpy(&argb, bytes + y * stride + 4 * x, sizeof argb);
            float* pixel = raster.pixel(x, y);
            for (int channel = 0; channel < 4; ++channel)
                pixel[channel] = float(argb >> (channel == 3 ? 24 : 16 - 8 * channel) & 255) / 255;
        }
    return image::toBitmap(raster);
}

}  // namespace vtm::bench
