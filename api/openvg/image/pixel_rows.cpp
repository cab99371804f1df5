#include "api/openvg/image/pixel_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "api/openvg/image/byte_rows.hpp"
#include "api/openvg/image/conversion_table.hpp"
#include "api/openvg/paint/lanes.hpp"

namespace vtm::openvg {

namespace {

float* floats(std::span<Color> colors) { return &colors.data()->r; }

// ---- Four bytes a pixel ---------------------------------------------------------------------------

/// Calls f with the shuffle from colours to bytes. Every order is its own inverse or that of another one.
template <class Function>
void withOrder(ByteOrder order, Function&& f) {
    if (order.red == 0)
        f(std::integer_sequence<int, 0, 1, 2, 3>());
    else if (order.red == 3)
        f(std::integer_sequence<int, 3, 2, 1, 0>());
    else if (order.red == 2)
        f(std::integer_sequence<int, 2, 1, 0, 3>());
    else
        f(std::integer_sequence<int, 1, 2, 3, 0>());
}

void decodeBytes(const PixelFormat& format, ByteOrder order, const std::uint8_t* pixels,
                 std::span<Color> colors) {
    float* const values = floats(colors);
    for (std::size_t i = 0; i < 4 * colors.size(); ++i)
        values[i] = float(pixels[i]);
    colorsOfBytes(order, colors);
    if (format.alpha.bits == 0)
        for (Color& color : colors)
            color.a = 1;
    else if (format.space.premultiplied)
        for (Color& color : colors)
            assign(color, lesser(loaded(color), alphas(loaded(color))));
}

void encodeBytes(const PixelFormat& format, ByteOrder order, std::span<const Color> colors,
                 std::uint8_t* pixels) {
    const bool isOpaque = format.alpha.bits == 0, isPremultiplied = format.space.premultiplied && !isOpaque;
    std::array<Float4, rowChunk> scaled;
    const auto scale = [&]<int r, int g, int b, int a>(std::integer_sequence<int, r, g, b, a>) {
        // Where in a colour each byte's channel is.
        constexpr auto at = [](int byte) { return byte == r ? 0 : byte == g ? 1 : byte == b ? 2 : 3; };
        const Float4 factor = isOpaque ? Float4{255, 255, 255, 0} : splat(255),
                     half = isOpaque ? Float4{0.5f, 0.5f, 0.5f, 0} : splat(0.5f);
        for (std::size_t i = 0; i < colors.size(); ++i) {
            Float4 c = unit(loaded(colors[i]));
            if (isPremultiplied)
                c = lesser(c, alphas(c));
            c = c * factor + half;
            scaled[i] = __builtin_shufflevector(c, c, at(0), at(1), at(2), at(3));
        }
    };
    withOrder(order, scale);
    const auto* values = reinterpret_cast<const float*>(scaled.data());
    for (std::size_t i = 0; i < 4 * colors.size(); ++i)
        pixels[i] = std::uint8_t(int(values[i]));
}

/// A word's bytes moved to their places in another format. `from` and `to` are both premultiplied or both
/// not.
void reorderBytes(const std::uint8_t* from, const PixelFormat& f, std::uint8_t* to, const PixelFormat& t,
                  int count) {
    const unsigned red = f.red.shift, green = f.green.shift, blue = f.blue.shift, alpha = f.alpha.shift,
                   toRed = t.red.shift, toGreen = t.green.shift, toBlue = t.blue.shift,
                   toAlpha = t.alpha.shift;
    const std::uint32_t kept = f.alpha.bits != 0 && t.alpha.bits != 0 ? 255 : 0,
                        added = f.alpha.bits == 0 && t.alpha.bits != 0 ? 255u << toAlpha : 0;
    int places[4];
    const ByteOrder order = *byteOrder(f), toOrder = *byteOrder(t);
    places[toOrder.red] = order.red;
    places[toOrder.green] = order.green;
    places[toOrder.blue] = order.blue;
    places[toOrder.alpha] = kept != 0 ? order.alpha : -1;
    const int done = wide::moveBytes(from, to, count, places, added);
    from += 4 * std::size_t(done);
    to += 4 * std::size_t(done);
    for (int i = done; i < count; ++i, from += 4, to += 4) {
        std::uint32_t w;
        std::memcpy(&w, from, 4);
        w = (w >> red & 255) << toRed | (w >> green & 255) << toGreen | (w >> blue & 255) << toBlue |
            (w >> alpha & kept) << toAlpha | added;
        std::memcpy(to, &w, 4);
    }
}

/// Whether reorderBytes() is all that a conversion does.
bool isReordered(const PixelFormat& from, const PixelFormat& to) {
    return byteOrder(from) && byteOrder(to) && from.space.linear == to.space.linear &&
           (from.alpha.bits == 0 || (from.space.premultiplied == to.space.premultiplied &&
                                     !(from.space.premultiplied && to.alpha.bits == 0)));
}

/// Whether a conversion multiplies by alpha, and moves bytes.
bool isPremultiplied(const PixelFormat& from, const PixelFormat& to) {
    return byteOrder(from) && byteOrder(to) && from.space.linear == to.space.linear && from.alpha.bits != 0 &&
           to.alpha.bits != 0 && !from.space.premultiplied && to.space.premultiplied;
}

void premultiplyRow(const std::uint8_t* from, const PixelFormat& f, std::uint8_t* to, const PixelFormat& t,
                    int count) {
    const ByteOrder order = *byteOrder(t);
    if (*byteOrder(f) == order)
        return premultiplyBytes(from, to, count, order.alpha);
    reorderBytes(from, f, to, t, count);
    premultiplyBytes(to, to, count, order.alpha);
}

}  // namespace

std::optional<ByteOrder> byteOrder(const PixelFormat& format) {
    if (format.bits != 32 || format.red.bits != 8)
        return std::nullopt;
    const auto place = [](unsigned shift) {
        return int(std::endian::native == std::endian::little ? shift / 8 : 3 - shift / 8);
    };
    ByteOrder order{place(format.red.shift), place(format.green.shift), place(format.blue.shift), 0};
    order.alpha = 6 - order.red - order.green - order.blue;
    return order;
}

void colorsOfBytes(ByteOrder order, std::span<Color> colors) {
    withOrder(order, [&]<int r, int g, int b, int a>(std::integer_sequence<int, r, g, b, a>) {
        for (Color& color : colors) {
            const Float4 bytes = loaded(color);
            assign(color, __builtin_shufflevector(bytes, bytes, r, g, b, a) * splat(1 / 255.0f));
        }
    });
}

void decodeRow(const PixelFormat& format, const std::uint8_t* pixels, std::span<Color> colors) {
    if (const std::optional<ByteOrder> order = byteOrder(format))
        return decodeBytes(format, *order, pixels, colors);
    const std::size_t bytes = format.pixelBytes();
    for (std::size_t i = 0; i < colors.size(); ++i)
        colors[i] = format.decode(wordAt(pixels + i * bytes, bytes));
}

void encodeRow(const PixelFormat& format, std::span<const Color> colors, std::uint8_t* pixels) {
    const std::optional<ByteOrder> order = byteOrder(format);
    const std::size_t bytes = format.pixelBytes();
    inChunks(int(colors.size()), [&](int first, int count) {
        const std::span<const Color> part = colors.subspan(std::size_t(first), std::size_t(count));
        std::uint8_t* const to = pixels + std::size_t(first) * bytes;
        if (order)
            return encodeBytes(format, *order, part, to);
        for (std::size_t i = 0; i < part.size(); ++i)
            setWordAt(to + i * bytes, bytes, format.encode(part[i]));
    });
}

void convertColors(std::span<Color> colors, ColorSpace from, ColorSpace to) {
    if (from == to)
        return;
    const bool isSame = from.linear == to.linear && from.luminance == to.luminance;
    if (from.premultiplied && !(isSame && to.premultiplied))
        for (Color& color : colors)
            assign(color, unpremultiplied(loaded(color)));
    if (!isSame) {
        // Luminance is a sum of linear light. Grey stands for itself in all spaces of its kind.
        const bool toGrey = to.luminance && !from.luminance,
                   isDecoded = !from.linear && (toGrey || to.linear);
        if (isDecoded)
            fastDecode(colors);
        if (toGrey)
            for (Color& color : colors)
                color = Color(glm::vec3(luminance(glm::vec3(color))), color.a);
        if ((from.linear || isDecoded) && !to.linear)
            fastEncode(colors);
    }
    if (to.premultiplied && !(isSame && from.premultiplied))
        for (Color& color : colors)
            assign(color, premultiplied(loaded(color)));
}

void convertRow(const std::uint8_t* from, const PixelFormat& f, std::uint8_t* to, const PixelFormat& t,
                int count) {
    const std::size_t fromBytes = f.pixelBytes(), toBytes = t.pixelBytes();
    if (f == t) {
        std::memcpy(to, from, std::size_t(count) * fromBytes);
        return;
    }
    if (isReordered(f, t))
        return reorderBytes(from, f, to, t, count);
    if (isPremultiplied(f, t))
        return premultiplyRow(from, f, to, t, count);
    std::array<Color, rowChunk> buffer;
    inChunks(count, [&](int first, int size) {
        const std::span<Color> colors = std::span(buffer).first(std::size_t(size));
        decodeRow(f, from + std::size_t(first) * fromBytes, colors);
        convertColors(colors, f.space, t.space);
        encodeRow(t, colors, to + std::size_t(first) * toBytes);
    });
}

void takeRow(const std::uint8_t* from, const PixelFormat& f, std::uint8_t* to, const PixelFormat& t,
             int count) {
    const bool mayBeAbove = f.space.premultiplied && t.space.premultiplied && t.alpha.bits != 0;
    const std::optional<ByteOrder> order = mayBeAbove ? byteOrder(t) : std::nullopt;
    if (order && f == t)
        return clampBytes(from, to, count, order->alpha);
    convertRow(from, f, to, t, count);
    if (order)
        clampBytes(to, to, count, order->alpha);
}

RowConverter::RowConverter(const PixelFormat& from, const PixelFormat& to, RowConversion* convert,
                           std::int64_t pixels)
    : from_(from), to_(to), convert_(convert) {
    // A table is made in the time of 65536 pixels, once.
    constexpr int enoughForTable = 1 << 14;
    if (from != to && !isReordered(from, to) && !isPremultiplied(from, to) && pixels >= enoughForTable)
        table_ = ConversionTable::of(from, to, convert);
}

void RowConverter::operator()(const std::uint8_t* from, std::uint8_t* to, int count) const {
    if (table_)
        table_->apply(from, to, count);
    else
        convert_(from, from_, to, to_, count);
}

void convertRows(PixelRows<const std::uint8_t> from, const PixelFormat& f, PixelRows<std::uint8_t> to,
                 const PixelFormat& t, int width, int height, RowConversion* convert) {
    const RowConverter row(f, t, convert, std::int64_t(width) * height);
    // Rows without gaps are one.
    if (from.stride == width * std::ptrdiff_t(f.pixelBytes()) &&
        to.stride == width * std::ptrdiff_t(t.pixelBytes()))
        return row(from.first, to.first, width * height);
    for (int y = 0; y < height; ++y)
        row(from.first + y * from.stride, to.first + y * to.stride, width);
}

}  // namespace vtm::openvg
