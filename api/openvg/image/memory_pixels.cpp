#include "api/openvg/image/memory_pixels.hpp"

#include <algorithm>
#include <cstring>

namespace vtm::openvg {

std::uint32_t MemoryPixels::word(int x, int y) const {
    const std::uint8_t* row = first + y * stride;
    switch (layout.bits) {
        case 1:
            return (row[x / 8] >> (x % 8)) & 1u;
        case 4:
            return (row[x / 2] >> (4 * (x % 2))) & 15u;
        case 8:
            return row[x];
        case 16: {
            std::uint16_t half;
            std::memcpy(&half, row + 2 * std::ptrdiff_t(x), 2);
            return half;
        }
        default: {
            std::uint32_t word;
            std::memcpy(&word, row + 4 * std::ptrdiff_t(x), 4);
            return word;
        }
    }
}

void MemoryPixels::setWord(int x, int y, std::uint32_t word) const {
    std::uint8_t* row = first + y * stride;
    const auto setBits = [&](std::uint8_t& byte, unsigned shift, unsigned mask) {
        byte = std::uint8_t((byte & ~(mask << shift)) | (word & mask) << shift);
    };
    switch (layout.bits) {
        case 1:
            return setBits(row[x / 8], unsigned(x % 8), 1);
        case 4:
            return setBits(row[x / 2], 4 * unsigned(x % 2), 15);
        case 8:
            row[x] = std::uint8_t(word);
            return;
        case 16: {
            const auto half = std::uint16_t(word);
            std::memcpy(row + 2 * std::ptrdiff_t(x), &half, 2);
            return;
        }
        default:
            std::memcpy(row + 4 * std::ptrdiff_t(x), &word, 4);
            return;
    }
}

MemoryPixels memoryPixels(const void* data, VGint stride, VGImageFormat format, VGint width, VGint height) {
    const std::optional<PixelFormat> pixelFormat = imageFormat(VGint(format));
    require(pixelFormat.has_value(), VG_UNSUPPORTED_IMAGE_FORMAT_ERROR);
    require(width > 0 && height > 0);
    const auto address = reinterpret_cast<std::uintptr_t>(data);
    require(data != nullptr && address % std::max(1u, pixelFormat->bits / 8) == 0);
    return {static_cast<std::uint8_t*>(const_cast<void*>(data)), stride, *pixelFormat};
}

CopyArea clipped(CopyArea a, int dstWidth, int dstHeight, int srcWidth, int srcHeight) {
    // In 64 bits: places and sizes may be any numbers.
    const auto along = [](int& d, int& s, int& size, int dstSize, int srcSize) {
        const std::int64_t skip = std::max({std::int64_t(0), -std::int64_t(d), -std::int64_t(s)});
        const std::int64_t left =
            std::min({std::int64_t(size), std::int64_t(dstSize) - d, std::int64_t(srcSize) - s});
        size = int(std::max(std::int64_t(0), left - skip));
        if (size > 0) {
            d = int(d + skip);
            s = int(s + skip);
        }
    };
    along(a.dx, a.sx, a.width, dstWidth, srcWidth);
    along(a.dy, a.sy, a.height, dstHeight, srcHeight);
    return a;
}

}  // namespace vtm::openvg
