/// \file
/// The program's pixels in memory (specification section 10.5), and rectangles of them to copy.
#pragma once

#include <cstdint>
#include <vector>

#include "api/openvg/image/pixel_format.hpp"
#include "api/openvg/state/error.hpp"

namespace vtm::openvg {

/// Rows `stride` bytes apart, the first one's address given.
struct MemoryPixels {
    std::uint8_t* first = nullptr;
    std::ptrdiff_t stride = 0;
    PixelFormat layout;

    const PixelFormat& format() const { return layout; }
    std::uint32_t word(int x, int y) const;
    void setWord(int x, int y, std::uint32_t word) const;
};

/// Throws for what vgImageSubData and its like must not be given. Only setWord writes.
MemoryPixels memoryPixels(const void* data, VGint stride, VGImageFormat format, VGint width, VGint height);

/// From (sx, sy) on to (dx, dy) on.
struct CopyArea {
    int dx, dy, sx, sy, width, height;
};

/// What is within both; width and height are 0 or less if nothing is.
CopyArea clipped(CopyArea area, int dstWidth, int dstHeight, int srcWidth, int srcHeight);

/// The words of the source, row by row: a copy whose source and destination may overlap goes through it.
template <class Word>
std::vector<std::uint32_t> copied(const CopyArea& area, Word&& word) {
    std::vector<std::uint32_t> words;
    if (area.width <= 0 || area.height <= 0)
        return words;
    words.reserve(std::size_t(area.width) * std::size_t(area.height));
    for (int j = 0; j < area.height; ++j)
        for (int i = 0; i < area.width; ++i)
            words.push_back(word(area.sx + i, area.sy + j));
    return words;
}

}  // namespace vtm::openvg
