/// \file
/// cairo's pixels as ours. For sources that are built with cairo only.
#pragma once

#include <cairo.h>

#include "bench/engines/argb_pixels.hpp"

namespace vtm::bench {

/// Of an image surface in CAIRO_FORMAT_ARGB32, flushed.
inline image::Bitmap bitmapOf(cairo_surface_t* surface) {
    return bitmapOf(cairo_image_surface_get_data(surface), cairo_image_surface_get_stride(surface),
                    cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
}

}  // namespace vtm::bench
