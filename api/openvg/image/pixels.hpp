/// \file
/// Pixels as words, as images and drawing surfaces store them, and as programs hand them over (specification
/// sections 3.4.4, 10.2 and 10.5).
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include <VG/openvg.h>

#include "api/openvg/paint/color.hpp"
#include "api/openvg/state/error.hpp"

namespace vtm::openvg {

/// Bits of a word that hold a number from 0 to 2^bits - 1; none if bits is 0.
struct Channel {
    std::uint8_t bits = 0, shift = 0;

    friend bool operator==(const Channel&, const Channel&) = default;
};

/// A word of 32 bits or less. Either red, green and blue have bits, or grey has, or only alpha, which then is
/// that of a white linear colour.
struct PixelFormat {
    unsigned bits = 0;  ///< of a pixel in memory: 1, 4, 8, 16 or 32
    Channel red, green, blue, alpha, grey;
    ColorSpace space;

    /// Of a pixel in Pixels: formats of less than a byte take a whole one there.
    std::size_t pixelBytes() const { return bits < 8 ? 1 : bits / 8; }

    /// In `space`; alpha is 1 where there is none. Premultiplied colours are clamped to [0, alpha].
    Color decode(std::uint32_t word) const;
    /// Rounds to nearest; takes a colour in `space`, clamps it to [0, 1] and, premultiplied, to [0, alpha].
    /// Bits that no channel has are 0.
    std::uint32_t encode(Color color) const;

    friend bool operator==(const PixelFormat&, const PixelFormat&) = default;
};

/// Nothing unless the value is one of VGImageFormat.
std::optional<PixelFormat> imageFormat(VGint format);

/// Half open.
struct Rectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    bool empty() const { return x0 >= x1 || y0 >= y1; }
    std::int64_t area() const { return empty() ? 0 : std::int64_t(x1 - x0) * (y1 - y0); }
    Rectangle intersected(const Rectangle& o) const {
        return {x0 > o.x0 ? x0 : o.x0, y0 > o.y0 ? y0 : o.y0, x1 < o.x1 ? x1 : o.x1, y1 < o.y1 ? y1 : o.y1};
    }

    friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

/// A word of one, two or four bytes.
inline std::uint32_t wordAt(const std::uint8_t* p, std::size_t bytes) {
    if (bytes == 4) {
        std::uint32_t word;
        std::memcpy(&word, p, 4);
        return word;
    }
    if (bytes == 1)
        return *p;
    std::uint16_t word;
    std::memcpy(&word, p, 2);
    return word;
}
inline void setWordAt(std::uint8_t* p, std::size_t bytes, std::uint32_t word) {
    if (bytes == 4) {
        std::memcpy(p, &word, 4);
    } else if (bytes == 1) {
        *p = std::uint8_t(word);
    } else {
        const auto half = std::uint16_t(word);
        std::memcpy(p, &half, 2);
    }
}

/// Formats of less than a byte take a whole one here. No premultiplied colour is above its alpha.
class Pixels {
public:
    /// All words are 0. Sides are at least 1.
    Pixels(int width, int height, const PixelFormat& format)
        : width_(width),
          height_(height),
          format_(format),
          pixelBytes_(format.pixelBytes()),
          bytes_(std::size_t(width) * std::size_t(height) * pixelBytes_) {}

    int width() const { return width_; }
    int height() const { return height_; }
    const PixelFormat& format() const { return format_; }
    std::size_t pixelBytes() const { return pixelBytes_; }
    /// Bytes from row to row.
    std::ptrdiff_t stride() const { return std::ptrdiff_t(width_) * std::ptrdiff_t(pixelBytes_); }

    std::uint8_t* at(int x, int y) {
        return bytes_.data() + (std::size_t(y) * std::size_t(width_) + std::size_t(x)) * pixelBytes_;
    }
    /// After the last pixel.
    const std::uint8_t* end() const { return bytes_.data() + bytes_.size(); }
    const std::uint8_t* at(int x, int y) const { return const_cast<Pixels*>(this)->at(x, y); }

    std::uint32_t word(int x, int y) const { return wordAt(at(x, y), pixelBytes_); }
    void setWord(int x, int y, std::uint32_t word) { setWordAt(at(x, y), pixelBytes_, word); }

    /// Columns first to end - 1 of a row.
    void fill(int first, int end, int y, std::uint32_t word) {
        if (pixelBytes_ == 1 || (pixelBytes_ == 4 && word == (word & 255) * 0x01010101u)) {
            std::memset(at(first, y), int(word & 255), std::size_t(end - first) * pixelBytes_);
            return;
        }
        if (pixelBytes_ == 4) {
            std::uint8_t* p = at(first, y);
            for (int x = first; x < end; ++x, p += 4)
                std::memcpy(p, &word, 4);
            return;
        }
        for (int x = first; x < end; ++x)
            setWord(x, y, word);
    }

private:
    int width_, height_;
    PixelFormat format_;
    std::size_t pixelBytes_;
    std::vector<std::uint8_t> bytes_;
};

/// A program's pixels: rows `stride` bytes apart, the first one's address given. Those of less than a byte
/// are packed, the first in the lowest bits.
struct MemoryPixels {
    std::uint8_t* first = nullptr;
    std::ptrdiff_t stride = 0;
    PixelFormat layout;

    const PixelFormat& format() const { return layout; }
    bool isPacked() const { return layout.bits < 8; }
    /// Of pixels that are not packed.
    std::uint8_t* at(int x, int y) const {
        return first + y * stride + std::ptrdiff_t(x) * std::ptrdiff_t(layout.pixelBytes());
    }
    /// `count` packed pixels from (x, y) on to a byte each, and back.
    void unpackRow(int x, int y, int count, std::uint8_t* to) const;
    void packRow(int x, int y, int count, const std::uint8_t* from) const;
};

/// Throws for what vgImageSubData and its like must not be given. A const address is not written to.
MemoryPixels memoryPixels(const void* data, VGint stride, VGImageFormat format, VGint width, VGint height);

/// From (sx, sy) on to (dx, dy) on.
struct CopyArea {
    int dx = 0, dy = 0, sx = 0, sy = 0, width = 0, height = 0;
};

/// What is within both; all 0 if nothing is.
CopyArea clipped(CopyArea area, int dstWidth, int dstHeight, int srcWidth, int srcHeight);

}  // namespace vtm::openvg
