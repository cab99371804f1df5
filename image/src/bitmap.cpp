#include <vtm/image/bitmap.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/pixel_writer.hpp"

namespace vtm::image {
namespace {

/// NaN becomes 0.
float clamped(float value) { return value > 0 ? std::min(value, 1.0f) : 0.0f; }

unsigned rounded(float value, float max) { return unsigned(std::lround(clamped(value) * max)); }

}  // namespace

PixelWriter::PixelWriter(const std::array<float, 4>& ground, int depth)
    : ground_{ground[0] * ground[3], ground[1] * ground[3], ground[2] * ground[3], ground[3]},
      depth_(depth) {}

void PixelWriter::write(const float* premultiplied, std::uint8_t* to) const {
    const float through = 1 - premultiplied[3], alpha = premultiplied[3] + through * ground_[3];
    const float scale = alpha > 0 ? 1 / alpha : 0;
    for (std::size_t c = 0; c < 4; ++c) {
        const float value = c == 3 ? alpha : (premultiplied[c] + through * ground_[c]) * scale;
        if (depth_ == 8) {
            *to++ = std::uint8_t(rounded(value, 255));
        } else {
            const unsigned word = rounded(value, 65535);
            *to++ = std::uint8_t(word >> 8);
            *to++ = std::uint8_t(word);
        }
    }
}

void giveRows(const Raster& picture, const PixelWriter& writer, const RowSink& sink) {
    std::vector<std::uint8_t> row(std::size_t(picture.width) * writer.pixelBytes());
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x)
            writer.write(picture.pixel(x, y), &row[std::size_t(x) * writer.pixelBytes()]);
        sink(row);
    }
}

void giveRows(const Bitmap& picture, const PixelWriter& writer, const RowSink& sink) {
    const std::size_t rowBytes = std::size_t(picture.width) * 4;
    for (std::size_t y = 0; y < std::size_t(picture.height); ++y) {
        const auto row = std::span(picture.rgba).subspan(y * rowBytes, rowBytes);
        if (!writer.hasGround() && writer.depth() == 8)
            sink(row);
        else
            giveRows(toRaster({picture.width, 1, {row.begin(), row.end()}}), writer, sink);
    }
}

Bitmap toBitmap(const Raster& raster) {
    Bitmap bitmap{raster.width, raster.height, std::vector<std::uint8_t>(raster.rgba.size())};
    const PixelWriter writer;
    for (std::size_t i = 0; i < raster.rgba.size(); i += 4)
        writer.write(&raster.rgba[i], &bitmap.rgba[i]);
    return bitmap;
}

Raster toRaster(const Bitmap& bitmap) {
    Raster raster(bitmap.width, bitmap.height);
    for (std::size_t i = 0; i < bitmap.rgba.size(); i += 4) {
        const float alpha = static_cast<float>(bitmap.rgba[i + 3]) / 255.0f;
        for (std::size_t c = 0; c < 3; ++c)
            raster.rgba[i + c] = static_cast<float>(bitmap.rgba[i + c]) / 255.0f * alpha;
        raster.rgba[i + 3] = alpha;
    }
    return raster;
}

}  // namespace vtm::image
