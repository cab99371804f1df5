/// \file
/// Pictures row by row: what engines make and files are written from.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include <vtm/image/bitmap.hpp>
#include <vtm/scene/paint.hpp>

namespace vtm::tools {

/// Takes rows from the top, each once, as image::Encoder does: straight sRGB with alpha, 8 bits a channel or
/// 16 with the higher byte first.
using RowSink = std::function<void(std::span<const std::uint8_t> row)>;

/// What a picture is laid on, and how many bits a channel has.
struct Sheet {
    scene::Color ground;
    int depth = 8;

    std::size_t pixelBytes() const { return std::size_t(depth) / 2; }
};

/// Lays colours over the ground and rounds them to nearest, as image::toBitmap does.
class PixelWriter {
public:
    explicit PixelWriter(const Sheet& sheet);
    /// From premultiplied red, green, blue, alpha to the bytes of a pixel.
    void write(const float* premultiplied, std::uint8_t* to) const;

private:
    std::array<float, 4> ground_;
    int depth_;
};

/// All rows of a picture that is there.
void giveRows(const image::Raster& picture, const Sheet& sheet, const RowSink& sink);
/// 8 bits a channel.
void giveRows(const image::Bitmap& picture, const scene::Color& ground, const RowSink& sink);

}  // namespace vtm::tools
