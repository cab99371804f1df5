/// \file
/// Rows of pixels as colours and back, and from format to format (specification section 3.4.4): what
/// PixelFormat::decode, encode and fullyConverted() are for one pixel.
///
/// A row is given by its first pixel's address, as Pixels stores it: a byte or more each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "api/openvg/image/pixels.hpp"

namespace vtm::openvg {

/// Pixels that are worked on at a time: their colours stay in the first cache.
inline constexpr int rowChunk = 128;

/// Calls part(first, count) for parts of no more than rowChunk, from left to right.
template <class Part>
void inChunks(int count, Part&& part) {
    for (int first = 0; first < count; first += rowChunk)
        part(first, std::min(rowChunk, count - first));
}

/// Four bytes a pixel; where in memory each channel's byte is. Without alpha, `alpha` is that of the padding.
struct ByteOrder {
    int red, green, blue, alpha;

    friend bool operator==(const ByteOrder&, const ByteOrder&) = default;
};
/// Nothing for formats with other channels than four bytes.
std::optional<ByteOrder> byteOrder(const PixelFormat& format);

/// From numbers up to 255 in a format's order to colours.
void colorsOfBytes(ByteOrder order, std::span<Color> colors);

/// In the format's space.
void decodeRow(const PixelFormat& format, const std::uint8_t* pixels, std::span<Color> colors);
/// Takes colours in the format's space, as PixelFormat::encode does.
void encodeRow(const PixelFormat& format, std::span<const Color> colors, std::uint8_t* pixels);

/// From one space to another, like fullyConverted(), within 1e-5.
void convertColors(std::span<Color> colors, ColorSpace from, ColorSpace to);

/// Copies pixels, converted from one format to another. Rows must not overlap.
using RowConversion = void(const std::uint8_t* from, const PixelFormat& fromFormat, std::uint8_t* to,
                           const PixelFormat& toFormat, int count);
RowConversion convertRow;

/// The same of what a program gave: premultiplied colours above their alpha are clamped to it.
RowConversion takeRow;

class ConversionTable;

/// A conversion for about so many pixels, by rows: many are converted by a table (conversion_table.hpp).
class RowConverter {
public:
    RowConverter(const PixelFormat& from, const PixelFormat& to, RowConversion* convert, std::int64_t pixels);

    void operator()(const std::uint8_t* from, std::uint8_t* to, int count) const;

private:
    PixelFormat from_, to_;
    RowConversion* convert_;
    std::shared_ptr<const ConversionTable> table_;
};

/// `stride` bytes from row to row.
template <class Byte>
struct PixelRows {
    Byte* first;
    std::ptrdiff_t stride;
};
/// Rows by either of them, in the way of RowConverter.
void convertRows(PixelRows<const std::uint8_t> from, const PixelFormat& fromFormat,
                 PixelRows<std::uint8_t> to, const PixelFormat& toFormat, int width, int height,
                 RowConversion* convert);

}  // namespace vtm::openvg
