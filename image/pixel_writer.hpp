/// \file
/// From the colours that engines make to the bytes that files and callers want.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include <vtm/image/bitmap.hpp>

namespace vtm::image {

/// Takes rows from the top, each once, as Encoder does: straight sRGB with alpha, 8 bits a channel or 16 with
/// the higher byte first.
using RowSink = std::function<void(std::span<const std::uint8_t> row)>;

/// Lays colours over a ground, un-premultiplies them and rounds to nearest. Values outside [0, 1] are
/// clamped, NaN becomes 0. A pixel whose alpha is rounded to 0 is black: programs that ignore alpha show it.
class PixelWriter {
public:
    /// Straight red, green, blue, alpha in [0, 1]; `depth`: bits a channel, 8 or 16.
    explicit PixelWriter(const std::array<float, 4>& ground = {}, int depth = 8);

    int depth() const { return depth_; }
    bool hasGround() const { return ground_[3] > 0; }
    std::size_t pixelBytes() const { return std::size_t(depth_) / 2; }
    /// From premultiplied red, green, blue, alpha to pixelBytes() bytes.
    void write(const float* premultiplied, std::uint8_t* to) const;

private:
    std::array<float, 4> ground_;  ///< premultiplied
    int depth_;
};

/// A run of pixels. Pictures have long runs of one colour: what is as the pixel before is copied.
void writePixels(const PixelWriter& writer, const float* premultiplied, std::size_t count, std::uint8_t* to);

/// All rows of a picture.
void giveRows(const Raster& picture, const PixelWriter& writer, const RowSink& sink);
void giveRows(const Bitmap& picture, const PixelWriter& writer, const RowSink& sink);

}  // namespace vtm::image
