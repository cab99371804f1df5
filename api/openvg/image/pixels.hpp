/// \file
/// A rectangle of pixels: what images and drawing surfaces store, row 0 at the bottom.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "api/openvg/image/pixel_format.hpp"

namespace vtm::openvg {

/// Half open.
struct Rectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    bool empty() const { return x0 >= x1 || y0 >= y1; }
    Rectangle intersected(const Rectangle& o) const {
        return {x0 > o.x0 ? x0 : o.x0, y0 > o.y0 ? y0 : o.y0, x1 < o.x1 ? x1 : o.x1, y1 < o.y1 ? y1 : o.y1};
    }
};

/// Formats of less than a byte take a whole one here.
class Pixels {
public:
    /// All words are 0. Sides are at least 1.
    Pixels(int width, int height, const PixelFormat& format)
        : width_(width),
          height_(height),
          format_(format),
          pixelBytes_(format.bits < 8 ? 1 : format.bits / 8),
          bytes_(std::size_t(width) * std::size_t(height) * pixelBytes_) {}

    int width() const { return width_; }
    int height() const { return height_; }
    const PixelFormat& format() const { return format_; }
    std::size_t pixelBytes() const { return pixelBytes_; }

    std::uint8_t* at(int x, int y) {
        return bytes_.data() + (std::size_t(y) * std::size_t(width_) + std::size_t(x)) * pixelBytes_;
    }
    const std::uint8_t* at(int x, int y) const { return const_cast<Pixels*>(this)->at(x, y); }

    std::uint32_t word(int x, int y) const {
        const std::uint8_t* p = at(x, y);
        if (pixelBytes_ == 4) {
            std::uint32_t word;
            std::memcpy(&word, p, 4);
            return word;
        }
        if (pixelBytes_ == 1)
            return *p;
        std::uint16_t word;
        std::memcpy(&word, p, 2);
        return word;
    }
    void setWord(int x, int y, std::uint32_t word) {
        std::uint8_t* p = at(x, y);
        if (pixelBytes_ == 4) {
            std::memcpy(p, &word, 4);
        } else if (pixelBytes_ == 1) {
            *p = std::uint8_t(word);
        } else {
            const auto half = std::uint16_t(word);
            std::memcpy(p, &half, 2);
        }
    }

    /// Columns first to end - 1 of a row.
    void fill(int first, int end, int y, std::uint32_t word) {
        if (pixelBytes_ == 1) {
            std::memset(at(first, y), int(word & 255), std::size_t(end - first));
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

}  // namespace vtm::openvg
