/// \file
/// cairo's pixels as ours. For sources that are built with cairo only.
#pragma once

#include <cstdint>
#include <cstring>

#include <cairo.h>

#include <vtm/image/bitmap.hpp>

namespace vtm::bench {

/// Of an image surface in CAIRO_FORMAT_ARGB32, flushed.
inline image::Bitmap bitmapOf(cairo_surface_t* surface) {
    image::Raster raster(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
    const unsigned char* bytes = cairo_image_surface_get_data(surface);
    for (int y = 0; y < raster.height; ++y)
        for (int x = 0; x < raster.width; ++x) {
            std::uint32_t argb = 0;
            std::memcpy(&argb, bytes + y * cairo_image_surface_get_stride(surface) + 4 * x, sizeof argb);
            float* pixel = raster.pixel(x, y);
            for (int channel = 0; channel < 4; ++channel)
                pixel[channel] = float(argb >> (channel == 3 ? 24 : 16 - 8 * channel) & 255) / 255;
        }
    return image::toBitmap(raster);
}

}  // namespace vtm::bench
