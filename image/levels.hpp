/// \file
/// Coarser levels of a picture, for showing it smaller. Source: Williams, Pyramidal Parametrics (1983).
#pragma once

#include <cstdint>
#include <vector>

#include <vtm/image/bitmap.hpp>

namespace vtm::image {

/// Premultiplied sRGB with alpha, rows top to bottom, no padding.
struct Level {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4
};

/// Levels 1, 2 ... to the first of one texel; none of a picture of one pixel. Texel (i, j) of level l is the
/// mean of the pixels (x, y) with x >> l == i and y >> l == j, premultiplied: exactly, then rounded to a
/// byte. So level l has ceil(width / 2^l) × ceil(height / 2^l) texels.
std::vector<Level> levelsOf(const Bitmap& bitmap);
/// How many these are.
unsigned levelCount(const Bitmap& bitmap);

}  // namespace vtm::image
