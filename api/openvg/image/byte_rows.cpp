#include "api/openvg/image/byte_rows.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace vtm::openvg {

namespace {

/// Four pixels, or channels of two pixels in 8.8 fixed point.
using Bytes = std::uint8_t __attribute__((vector_size(16)));
using Words = std::uint16_t __attribute__((vector_size(16)));

constexpr Words half{128, 128, 128, 128, 128, 128, 128, 128};

/// The upper halves of products.
Words upper(Words a, Words b) {
#ifdef __SSE2__
    using Shorts = short __attribute__((vector_size(16)));
    return Words(__builtin_ia32_pmulhuw128(Shorts(a), Shorts(b)));
#else
    Words product;
    for (int i = 0; i < 8; ++i)
        product[i] = std::uint16_t(std::uint32_t(a[i]) * b[i] >> 16);
    return product;
#endif
}

/// Each byte above one of another vector: words `high * 256 + low`.
Words lowerPixels(Bytes low, Bytes high) {
    return Words(__builtin_shufflevector(low, high, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
}
Words upperPixels(Bytes low, Bytes high) {
    return Words(
        __builtin_shufflevector(low, high, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31));
}
Bytes whole(Words a, Words b) {
    return __builtin_shufflevector(Bytes(a), Bytes(b), 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29,
                                   31);
}

/// Calls f with four pixels at a time; those that are missing from the last four are 0.
template <class Function>
void inFours(int count, Function&& f) {
    for (; count >= 4; count -= 4)
        f(16);
    if (count > 0)
        f(4 * std::size_t(count));
}
Bytes bytesAt(const std::uint8_t* p, std::size_t bytes) {
    Bytes v{};
    std::memcpy(&v, p, bytes);
    return v;
}

/// Shares of what is there, and what is added to both in fixed point.
Bytes blended(Bytes there, Words shareLow, Words shareHigh, Words added) {
    return whole(upper(lowerPixels(Bytes{}, there), shareLow) + added,
                 upper(upperPixels(Bytes{}, there), shareHigh) + added);
}

template <int alpha>
Words alphasOf(Words pixels) {
    return __builtin_shufflevector(pixels, pixels, alpha, alpha, alpha, alpha, 4 + alpha, 4 + alpha,
                                   4 + alpha, 4 + alpha);
}

template <int alpha>
void over(std::uint8_t* pixels, const std::uint8_t* sources, int count) {
    inFours(count, [&](std::size_t bytes) {
        const Bytes s = bytesAt(sources, bytes), missing = ~s;
        const Bytes result =
            s + blended(bytesAt(pixels, bytes), alphasOf<alpha>(lowerPixels(missing, missing)),
                        alphasOf<alpha>(upperPixels(missing, missing)), half);
        std::memcpy(pixels, &result, bytes);
        pixels += bytes;
        sources += bytes;
    });
}

/// With c and a up to 255 and t = c a + 128, (t + t / 256) / 256 is c a / 255, rounded to nearest.
template <int alpha>
void premultiply(const std::uint8_t* from, std::uint8_t* to, int count) {
    Words alphaIsKept{};
    alphaIsKept[alpha] = alphaIsKept[4 + alpha] = 255;
    const auto multiplied = [&](Words pixels) {
        const Words t = pixels * (alphasOf<alpha>(pixels) | alphaIsKept) + half;
        return t + (t >> 8);
    };
    inFours(count, [&](std::size_t bytes) {
        const Bytes there = bytesAt(from, bytes);
        const Bytes result =
            whole(multiplied(lowerPixels(there, Bytes{})), multiplied(upperPixels(there, Bytes{})));
        std::memcpy(to, &result, bytes);
        from += bytes;
        to += bytes;
    });
}

/// No byte above the pixel's alpha.
template <int alpha>
void clamp(const std::uint8_t* from, std::uint8_t* to, int count) {
    using Quads = std::uint32_t __attribute__((vector_size(16)));
    inFours(count, [&](std::size_t bytes) {
        const Bytes there = bytesAt(from, bytes);
        Quads most = std::endian::native == std::endian::little ? Quads(there) >> 8 * alpha
                                                                : Quads(there) >> (24 - 8 * alpha);
        most &= 255;
        most |= most << 8;
        most |= most << 16;
        const Bytes limit = Bytes(most), result = limit < there ? limit : there;
        std::memcpy(to, &result, bytes);
        from += bytes;
        to += bytes;
    });
}

}  // namespace

void overBytes(std::uint8_t* pixels, int count, Color color, bool keepsAlpha) {
    std::uint16_t addedOnce[4], keptOnce[4];
    for (int i = 0; i < 4; ++i) {
        const bool stays = keepsAlpha && i == 3;
        addedOnce[i] = std::uint16_t((stays ? 0 : std::min(color[i], color.a) * (255 * 256.0f) + 0.5f) + 128);
        keptOnce[i] = std::uint16_t(stays ? 65535 : (1 - color.a) * 65535 + 0.5f);
    }
    const int done = wide::overBytes(pixels, count, addedOnce, keptOnce);
    pixels += 4 * std::ptrdiff_t(done);
    Words added, kept;
    for (int i = 0; i < 8; ++i) {
        added[i] = addedOnce[i % 4];
        kept[i] = keptOnce[i % 4];
    }
    inFours(count - done, [&](std::size_t bytes) {
        const Bytes result = blended(bytesAt(pixels, bytes), kept, kept, added);
        std::memcpy(pixels, &result, bytes);
        pixels += bytes;
    });
}

void overBytes(std::uint8_t* pixels, const std::uint8_t* sources, int count, int alphaByte) {
    const int done = wide::overBytes(pixels, sources, count, alphaByte);
    pixels += 4 * std::ptrdiff_t(done);
    sources += 4 * std::ptrdiff_t(done);
    return alphaByte == 0 ? over<0>(pixels, sources, count - done) : over<3>(pixels, sources, count - done);
}

void clampBytes(const std::uint8_t* from, std::uint8_t* to, int count, int alphaByte) {
    const int done = wide::clampBytes(from, to, count, alphaByte);
    from += 4 * std::ptrdiff_t(done);
    to += 4 * std::ptrdiff_t(done);
    return alphaByte == 0 ? clamp<0>(from, to, count - done) : clamp<3>(from, to, count - done);
}

void premultiplyBytes(const std::uint8_t* from, std::uint8_t* to, int count, int alphaByte) {
    const int done = wide::premultiplyBytes(from, to, count, alphaByte);
    from += 4 * std::ptrdiff_t(done);
    to += 4 * std::ptrdiff_t(done);
    return alphaByte == 0 ? premultiply<0>(from, to, count - done) : premultiply<3>(from, to, count - done);
}

bool isOpaque(const std::uint8_t* pixels, int count, int alphaByte) {
    std::uint8_t all = 255;
    for (int i = 0; i < count; ++i)
        all &= pixels[4 * i + alphaByte];
    return all == 255;
}

}  // namespace vtm::openvg
