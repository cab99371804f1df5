/// \file
/// How far two pictures are apart.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <vtm/image/bitmap.hpp>

namespace vtm::compare {

/// Differences of premultiplied channels, in units of 1/255.
struct Difference {
    double max = 0;
    double mean = 0;  ///< mean absolute, over all channels of all pixels
    double rms = 0;
    double p999 = 0;  ///< 99.9th percentile (nearest rank) of the absolute difference over channel values
    std::size_t over = 0;  ///< pixels with a channel beyond the threshold
    int worstX = 0, worstY = 0;
};

/// Not-a-number counts as an infinite difference. Throws std::invalid_argument if the sizes differ.
Difference compare(const image::Raster& a, const image::Raster& b, double threshold = 2.0);

/// |a - b| per channel, amplified, opaque, for looking at; a difference of alpha shows in all
/// three channels. Throws std::invalid_argument if the sizes differ.
image::Bitmap differencePicture(const image::Raster& a, const image::Raster& b, double gain = 8);

/// Reads a PNG as a raster without losing depth: 8-bit is straight, 16-bit RGBA is premultiplied
/// (value / 65535), the convention of our ground truth, unless a text chunk "Alpha" says "straight", as in
/// files of vtm/image/encode.hpp. Throws std::runtime_error, which names the
/// path, where the file cannot be read, is no PNG, is a 16-bit one without RGBA, or has more pixels
/// than image::maxDecodedPixels.
image::Raster readPng(const std::string& path);
/// The same of a file that was read; `name` stands for it in errors.
image::Raster readPng(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace vtm::compare
