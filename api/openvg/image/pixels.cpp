#include "api/openvg/image/pixels.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace vtm::openvg {

namespace {

float decodedChannel(Channel channel, std::uint32_t word) {
    const std::uint32_t maximum = (1u << channel.bits) - 1;
    return float((word >> channel.shift) & maximum) / float(maximum);
}

std::uint32_t encodedChannel(Channel channel, float value) {
    if (channel.bits == 0)
        return 0;
    const std::uint32_t maximum = (1u << channel.bits) - 1;
    // max first: it makes 0 of what is no number.
    const float unit = std::min(std::max(0.0f, value), 1.0f);
    return std::uint32_t(unit * float(maximum) + 0.5f) << channel.shift;
}

}  // namespace

Color PixelFormat::decode(std::uint32_t word) const {
    const float a = alpha.bits == 0 ? 1 : decodedChannel(alpha, word);
    glm::vec3 color(1);
    if (grey.bits != 0)
        color = glm::vec3(decodedChannel(grey, word));
    else if (red.bits != 0)
        color = {decodedChannel(red, word), decodedChannel(green, word), decodedChannel(blue, word)};
    return {space.premultiplied ? glm::min(color, a) : color, a};
}

std::uint32_t PixelFormat::encode(Color color) const {
    if (space.premultiplied && alpha.bits != 0)
        color = Color(glm::min(glm::vec3(color), color.a), color.a);
    if (grey.bits != 0)
        return encodedChannel(grey, color.r) | encodedChannel(alpha, color.a);
    return encodedChannel(red, color.r) | encodedChannel(green, color.g) | encodedChannel(blue, color.b) |
           encodedChannel(alpha, color.a);
}

std::optional<PixelFormat> imageFormat(VGint format) {
    constexpr VGint alphaFirst = 1 << 6, reversed = 1 << 7;
    const VGint base = format & 63;
    if (format < 0 || format > (alphaFirst | reversed | 63) || base > VG_A_4)
        return std::nullopt;
    PixelFormat f;
    // Widths of red, green, blue and alpha or padding, in this order from the most significant bit.
    std::uint8_t widths[4]{};
    const auto set = [&](unsigned bits, std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t a) {
        f.bits = bits;
        widths[0] = r;
        widths[1] = g;
        widths[2] = b;
        widths[3] = a;
    };
    bool hasAlpha = true;
    switch (base) {
        case VG_lRGBX_8888:
            f.space.linear = true;
            [[fallthrough]];
        case VG_sRGBX_8888:
            set(32, 8, 8, 8, 8);
            hasAlpha = false;
            break;
        case VG_lRGBA_8888:
        case VG_lRGBA_8888_PRE:
            f.space.linear = true;
            [[fallthrough]];
        case VG_sRGBA_8888:
        case VG_sRGBA_8888_PRE:
            set(32, 8, 8, 8, 8);
            f.space.premultiplied = base == VG_sRGBA_8888_PRE || base == VG_lRGBA_8888_PRE;
            break;
        case VG_sRGB_565:
            set(16, 5, 6, 5, 0);
            hasAlpha = false;
            break;
        case VG_sRGBA_5551:
            set(16, 5, 5, 5, 1);
            break;
        case VG_sRGBA_4444:
            set(16, 4, 4, 4, 4);
            break;
        default:
            // One channel: no order to choose.
            if (format != base)
                return std::nullopt;
            break;
    }
    if (base == VG_sRGB_565 && (format & alphaFirst))
        return std::nullopt;
    switch (base) {
        case VG_sL_8:
        case VG_lL_8:
        case VG_BW_1:
            f.bits = base == VG_BW_1 ? 1 : 8;
            f.grey = {std::uint8_t(f.bits), 0};
            f.space = {base != VG_sL_8, false, true};
            return f;
        case VG_A_8:
        case VG_A_1:
        case VG_A_4:
            f.bits = base == VG_A_8 ? 8 : base == VG_A_4 ? 4 : 1;
            f.alpha = {std::uint8_t(f.bits), 0};
            f.space = {true, false, false};
            return f;
        default:
            break;
    }
    unsigned shift = f.bits;
    const auto take = [&](std::uint8_t bits) {
        shift -= bits;
        return Channel{bits, std::uint8_t(shift)};
    };
    Channel last;
    if (format & alphaFirst)
        last = take(widths[3]);
    f.red = take(widths[format & reversed ? 2 : 0]);
    f.green = take(widths[1]);
    f.blue = take(widths[format & reversed ? 0 : 2]);
    if (!(format & alphaFirst))
        last = take(widths[3]);
    if (format & reversed)
        std::swap(f.red, f.blue);
    if (hasAlpha)
        f.alpha = last;
    return f;
}

void MemoryPixels::unpackRow(int x, int y, int count, std::uint8_t* to) const {
    const std::uint8_t* row = first + y * stride;
    const int perByte = 8 / int(layout.bits), mask = (1 << layout.bits) - 1;
    for (const int end = x + count; x < end; ++x)
        *to++ = std::uint8_t(row[x / perByte] >> (int(layout.bits) * (x % perByte)) & mask);
}

void MemoryPixels::packRow(int x, int y, int count, const std::uint8_t* from) const {
    std::uint8_t* row = first + y * stride;
    const int perByte = 8 / int(layout.bits), mask = (1 << layout.bits) - 1;
    for (const int end = x + count; x < end; ++x) {
        const int shift = int(layout.bits) * (x % perByte);
        std::uint8_t& byte = row[x / perByte];
        byte = std::uint8_t((byte & ~(mask << shift)) | (*from++ & mask) << shift);
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
        if (left <= skip)
            return false;
        size = int(left - skip);
        d = int(d + skip);
        s = int(s + skip);
        return true;
    };
    const bool meets =
        along(a.dx, a.sx, a.width, dstWidth, srcWidth) && along(a.dy, a.sy, a.height, dstHeight, srcHeight);
    return meets ? a : CopyArea{};
}

}  // namespace vtm::openvg
