#include <vtm/image/bitmap.hpp>

#include <algorithm>
#include <cstring>
#include <vector>

#include "image/pixel_writer.hpp"

namespace vtm::image {
namespace {

/// NaN becomes 0.
float clamped(float value) { return value > 0 ? std::min(value, 1.0f) : 0.0f; }

/// In doubles, where the product and the sum are exact.
unsigned rounded(float value, int max) { return unsigned(double(clamped(value)) * max + 0.5); }

}  // namespace

PixelWriter::PixelWriter(const std::array<float, 4>& ground, int depth)
    : ground_{ground[0] * ground[3], ground[1] * ground[3], ground[2] * ground[3], ground[3]},
      depth_(depth) {}

void PixelWriter::write(const float* premultiplied, std::uint8_t* to) const {
    const float through = 1 - premultiplied[3], alpha = premultiplied[3] + through * ground_[3];
    const float shown = 0.5f / (depth_ == 8 ? 255.0f : 65535.0f);  // alpha that is not rounded to 0
    const float scale = alpha >= shown ? 1 / alpha : 0;
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

void writePixels(const PixelWriter& writer, const float* premultiplied, std::size_t count, std::uint8_t* to) {
    const std::size_t bytes = writer.pixelBytes();
    for (std::size_t x = 0; x < count; ++x, premultiplied += 4, to += bytes)
        if (x > 0 && std::memcmp(premultiplied, premultiplied - 4, 4 * sizeof(float)) == 0)
            std::memcpy(to, to - bytes, bytes);
        else
            writer.write(premultiplied, to);
}

void giveRows(const Raster& picture, const PixelWriter& writer, const RowSink& sink) {
    std::vector<std::uint8_t> row(std::size_t(picture.width) * writer.pixelBytes());
    for (int y = 0; y < picture.height; ++y) {
        writePixels(writer, picture.pixel(0, y), std::size_t(picture.width), row.data());
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
    writePixels(PixelWriter(), raster.rgba.data(), raster.rgba.size() / 4, bitmap.rgba.data());
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
