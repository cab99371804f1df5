#include "api/openvg/draw/texel_rows.hpp"

#include <cmath>

namespace vtm::openvg {

using glm::dvec2;

namespace {

/// Four bytes as numbers.
Float4 numbers(const std::uint8_t* p) {
    using Bytes = std::uint8_t __attribute__((vector_size(16)));
    using Words = std::uint16_t __attribute__((vector_size(16)));
    std::uint32_t word;
    std::memcpy(&word, p, 4);
    const Bytes bytes = Bytes(Int4{int(word), 0, 0, 0});
    const Words words = Words(
        __builtin_shufflevector(bytes, Bytes{}, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
    const Int4 wide = Int4(__builtin_shufflevector(words, Words{}, 0, 8, 1, 9, 2, 10, 3, 11));
    return __builtin_convertvector(wide, Float4);
}

/// A lane of its own: all bits in it, none in the others.
template <int lane>
constexpr Int4 only{lane == 0 ? -1 : 0, 0, 0, lane == 3 ? -1 : 0};

template <int lane>
Float4 replaced(Float4 c, Float4 by) {
    return Float4((Int4(c) & ~only<lane>) | (Int4(by) & only<lane>));
}

/// Premultiplied.
struct ByteTexel {
    Float4 operator()(const std::uint8_t* p) const { return numbers(p); }
};

/// Without alpha, padding in its place.
template <int alpha>
struct OpaqueTexel {
    Float4 operator()(const std::uint8_t* p) const { return replaced<alpha>(numbers(p), splat(255)); }
};

/// Not premultiplied.
template <int alpha>
struct StraightTexel {
    Float4 operator()(const std::uint8_t* p) const {
        const Float4 c = numbers(p);
        const Float4 share = __builtin_shufflevector(c, c, alpha, alpha, alpha, alpha) * splat(1 / 255.0f);
        return c * replaced<alpha>(share, splat(1));
    }
};

/// Of any format.
struct ColorTexel {
    const PixelFormat& format;

    Float4 operator()(const std::uint8_t* p) const {
        const Float4 c = loaded(format.decode(wordAt(p, format.pixelBytes())));
        return format.space.premultiplied ? c : premultiplied(c);
    }
};

int floorOf(double v) {
    const int i = int(v);
    return i - (double(i) > v);
}

/// Places along a row in 32.32 fixed point: what 128 steps add up to is within 2^-26 of a texel.
class Places {
public:
    Places(double first, double step) : place_(fixed(first)), step_(fixed(step)) {}

    int texel() const { return int(place_ >> 32); }
    /// From the texel's corner.
    float fraction() const { return float(std::uint32_t(place_) >> 8) * 0x1p-24f; }
    void advance() { place_ += step_; }

private:
    static std::int64_t fixed(double v) { return std::llround(v * 0x1p32); }

    std::int64_t place_, step_;
};

}  // namespace

TexelRows::TexelRows(const Texels& texels)
    : texels_(texels), order_(byteOrder(texels.image().format())), fill_(loaded(texels.fill())) {
    if (order_) {
        Float4 bytes{};
        bytes[order_->red] = fill_[0];
        bytes[order_->green] = fill_[1];
        bytes[order_->blue] = fill_[2];
        bytes[order_->alpha] = fill_[3];
        fill_ = bytes * splat(255);
    }
}

template <class Function>
void TexelRows::withTexel(Function&& f) const {
    const PixelFormat& format = texels_.image().format();
    if (!order_)
        return f(ColorTexel{format});
    const bool isFirst = order_->alpha == 0;
    if (format.alpha.bits == 0)
        return isFirst ? f(OpaqueTexel<0>()) : f(OpaqueTexel<3>());
    if (format.space.premultiplied)
        return f(ByteTexel());
    return isFirst ? f(StraightTexel<0>()) : f(StraightTexel<3>());
}

template <class Texel>
Float4 TexelRows::anywhere(const Texel& texel, int x, int y) const {
    const int column = texels_.column(x), row = texels_.row(y);
    return column < 0 || row < 0 ? fill_ : texel(texels_.image().at(column, row));
}

void TexelRows::finish(std::span<Color> colors) const {
    if (order_)
        colorsOfBytes(*order_, colors);
}

template <class Function>
void TexelRows::walk(const glm::dmat3& map, dvec2 place, std::size_t count, Function&& f) const {
    // The product of the map and the place, part by part as it is summed: some are the same along the row.
    const dvec2 right(map[0]), up = dvec2(map[1]) * place.y, shift(map[2]);
    const auto each = [&](const auto& divided) {
        for (std::size_t i = 0; i < count; ++i) {
            const dvec2 p = divided(right * place.x + up + shift);
            f(floorOf(p.x), floorOf(p.y));
            place.x += 1;
        }
    };
    if (map[2].z == 1)
        each([](dvec2 p) { return p; });
    else
        each([z = map[2].z](dvec2 p) { return p / z; });
}

void TexelRows::nearest(const glm::dmat3& map, dvec2 place, std::span<Color> colors) const {
    const Image& image = texels_.image();
    const auto width = unsigned(image.width()), height = unsigned(image.height());
    const std::uint8_t* const corner = image.at(0, 0);
    const std::ptrdiff_t bytes = std::ptrdiff_t(image.format().pixelBytes()), rowBytes = image.stride();
    withTexel([&](const auto& texel) {
        Color* color = colors.data();
        walk(map, place, colors.size(), [&](int x, int y) {
            const bool isStored = unsigned(x) < width && unsigned(y) < height;
            assign(*color++, isStored ? texel(corner + y * rowBytes + x * bytes) : anywhere(texel, x, y));
        });
    });
    finish(colors);
}

void TexelRows::nearestStored(const glm::dmat3& map, dvec2 place, int count, std::uint8_t* pixels) const {
    const Image& image = texels_.image();
    const auto width = unsigned(image.width()), height = unsigned(image.height());
    const std::uint8_t* const corner = image.at(0, 0);
    const std::size_t bytes = image.format().pixelBytes();
    const std::ptrdiff_t rowBytes = image.stride();
    walk(map, place, std::size_t(count), [&](int x, int y) {
        const bool isStored = unsigned(x) < width && unsigned(y) < height;
        const int column = isStored ? x : texels_.column(x), row = isStored ? y : texels_.row(y);
        setWordAt(pixels, bytes, wordAt(corner + row * rowBytes + column * std::ptrdiff_t(bytes), bytes));
        pixels += bytes;
    });
}

void TexelRows::bilinear(dvec2 first, dvec2 step, std::span<Color> colors) const {
    const Image& image = texels_.image();
    const auto width = unsigned(image.width() - 1), height = unsigned(image.height() - 1);
    const std::uint8_t* const corner = image.at(0, 0);
    const std::ptrdiff_t bytes = std::ptrdiff_t(image.format().pixelBytes()), rowBytes = image.stride();
    first -= 0.5;
    withTexel([&](const auto& texel) {
        Places across(first.x, step.x), along(first.y, step.y);
        for (Color& color : colors) {
            const int x = across.texel(), y = along.texel();
            const Float4 right = splat(across.fraction()), up = splat(along.fraction());
            across.advance();
            along.advance();
            Float4 a, b, c, d;
            if (unsigned(x) < width && unsigned(y) < height) {
                const std::uint8_t* const p = corner + y * rowBytes + x * bytes;
                a = texel(p);
                b = texel(p + bytes);
                c = texel(p + rowBytes);
                d = texel(p + rowBytes + bytes);
            } else {
                a = anywhere(texel, x, y);
                b = anywhere(texel, x + 1, y);
                c = anywhere(texel, x, y + 1);
                d = anywhere(texel, x + 1, y + 1);
            }
            const Float4 low = a + right * (b - a), high = c + right * (d - c);
            assign(color, low + up * (high - low));
        }
    });
    finish(colors);
}

}  // namespace vtm::openvg
