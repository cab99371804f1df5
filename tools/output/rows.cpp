#include "tools/output/rows.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vtm::tools {

namespace {

unsigned rounded(float value, float max) {
    return unsigned(std::lround(std::clamp(value, 0.0f, 1.0f) * max));
}

}  // namespace

PixelWriter::PixelWriter(const Sheet& sheet)
    : ground_{sheet.ground.r * sheet.ground.a, sheet.ground.g * sheet.ground.a,
              sheet.ground.b * sheet.ground.a, sheet.ground.a},
      depth_(sheet.depth) {}

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

void giveRows(const image::Raster& picture, const Sheet& sheet, const RowSink& sink) {
    const PixelWriter writer(sheet);
    std::vector<std::uint8_t> row(std::size_t(picture.width) * sheet.pixelBytes());
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x)
            writer.write(picture.pixel(x, y), &row[std::size_t(x) * sheet.pixelBytes()]);
        sink(row);
    }
}

void giveRows(const image::Bitmap& picture, const scene::Color& ground, const RowSink& sink) {
    const std::size_t rowBytes = std::size_t(picture.width) * 4;
    for (std::size_t y = 0; y < std::size_t(picture.height); ++y) {
        const auto row = std::span(picture.rgba).subspan(y * rowBytes, rowBytes);
        if (ground.a == 0)
            sink(row);
        else
            giveRows(image::toRaster({picture.width, 1, {row.begin(), row.end()}}), {ground}, sink);
    }
}

}  // namespace vtm::tools
