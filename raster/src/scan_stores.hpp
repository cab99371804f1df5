/// \file
/// Where the scanner's colours go: a store takes the runs and the rows of pixels of a picture, from the top,
/// in every row from the left.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <glm/common.hpp>

#include <vtm/raster/scan.hpp>
#include "raster/src/float4.hpp"
#include "raster/src/row_colors.hpp"
#include "raster/src/row_sums.hpp"

namespace vtm::asset {

// ---- Bytes ----------------------------------------------------------------------------------------

#if defined(__SSE2__)

/// Rounded to nearest. Packing makes 0 of what is below, and of the least number, which NaN becomes.
inline __m128i toBytes(Float4 color) {
    const __m128 most = _mm_min_ps(_mm_set1_ps(1), color);  // of NaN it is the second one
    return _mm_cvttps_epi32(_mm_add_ps(_mm_mul_ps(most, _mm_set1_ps(255)), _mm_set1_ps(0.5f)));
}

inline std::uint32_t packed(Float4 color) {
    const __m128i words = toBytes(color), halves = _mm_packs_epi32(words, words);
    return std::uint32_t(_mm_cvtsi128_si32(_mm_packus_epi16(halves, halves)));
}

inline void packFour(__m128i a, __m128i b, __m128i c, __m128i d, std::uint8_t* bytes) {
    const __m128i low = _mm_packs_epi32(a, b), high = _mm_packs_epi32(c, d);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(bytes), _mm_packus_epi16(low, high));
}

inline void packFour(const Float4* colors, std::uint8_t* bytes) {
    packFour(toBytes(colors[0]), toBytes(colors[1]), toBytes(colors[2]), toBytes(colors[3]), bytes);
}

/// Colours of a row, which are near [0, 1], as bytes: packing makes 0 and 255 of what is beyond.
template <bool isStraight>
void packRow(const RowColors& row, std::uint8_t* bytes, int count) {
    RowColors scaled = row.scaled(255);
    scaled.color += 0.5f;
    ColorSteps<isStraight> steps(scaled);
    const auto word = [&](std::size_t k) { return _mm_cvttps_epi32(steps.colors[k]); };
    int left = count;
    for (; left >= 4; left -= 4, bytes += 16) {
        packFour(word(0), word(1), word(2), word(3), bytes);
        steps.next();
    }
    if (left > 0) {
        std::uint8_t last[16];
        packFour(word(0), word(1), word(2), word(3), last);
        std::memcpy(bytes, last, 4 * std::size_t(left));
    }
}

#else

inline std::uint32_t packed(Float4 color) {
    std::uint32_t word;
    std::uint8_t bytes[4];
    for (int c = 0; c < 4; ++c)
        bytes[c] = std::uint8_t(unit(color[c]) * 255.0f + 0.5f);
    std::memcpy(&word, bytes, 4);
    return word;
}

inline void packFour(const Float4* colors, std::uint8_t* bytes) {
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t word = packed(colors[i]);
        std::memcpy(bytes + 4 * i, &word, 4);
    }
}

template <bool isStraight>
void packRow(const RowColors& row, std::uint8_t* bytes, int count) {
    for (int i = 0; i < count; ++i) {
        const std::uint32_t word = packed(row.at(float(i)));
        std::memcpy(bytes + 4 * i, &word, 4);
    }
}

#endif

// ---- Stores ---------------------------------------------------------------------------------------

class ByteStore {
public:
    ByteStore(const ByteTarget& target, int width) : target_(target), width_(width) {}

    /// Four pixels at a time, of which the next run overwrites those that are too many.
    [[gnu::always_inline]] void operator()(int row, int first, int end, Float4 color) const {
        std::uint8_t* at = place(row, first);
        const std::uint32_t word = packed(color), four[]{word, word, word, word};
        const int last = std::min(end, width_ - 3);
        for (; first < last; first += 4, at += 16)
            std::memcpy(at, four, 16);
        for (; first < end; ++first, at += 4)
            std::memcpy(at, &word, 4);
    }

    [[gnu::always_inline]] void operator()(int row, int first, std::span<const Float4> colors) const {
        std::uint8_t* at = place(row, first);
        std::size_t i = 0;
        for (; i + 4 <= colors.size(); i += 4, at += 16)
            packFour(&colors[i], at);
        for (; i < colors.size(); ++i, at += 4) {
            const std::uint32_t word = packed(colors[i]);
            std::memcpy(at, &word, 4);
        }
    }

    void operator()(int row, int first, int end, const RowColors& colors) const {
        if (colors.degree < 2)
            packRow<true>(colors, place(row, first), end - first);
        else
            packRow<false>(colors, place(row, first), end - first);
    }

private:
    std::uint8_t* place(int row, int first) const {
        return target_.pixels + std::size_t(row) * target_.rowBytes + std::size_t(first) * 4;
    }

    ByteTarget target_;
    int width_;
};

class AddStore {
public:
    explicit AddStore(const PixelsToAddTo& pixels) : pixels_(pixels) {}

    void operator()(int row, int first, int end, Float4 color) const {
        const Float4 added = unit(color);
        if (isNothing(added))
            return;
        float* at = pixels_(row, first, end);
        for (; first < end; ++first, at += 4)
            add(added, at);
    }

    void operator()(int row, int first, std::span<const Float4> colors) const {
        float* at = pixels_(row, first, first + int(colors.size()));
        for (const Float4& color : colors) {
            add(unit(color), at);
            at += 4;
        }
    }

    void operator()(int row, int first, int end, const RowColors& colors) const {
        float* at = pixels_(row, first, end);
        for (int i = 0; i < end - first; ++i, at += 4)
            add(unit(colors.at(float(i))), at);
    }

private:
    static void add(Float4 color, float* to) {
        Float4 sum;
        std::memcpy(&sum, to, sizeof sum);
        sum += color;
        std::memcpy(to, &sum, sizeof sum);
    }

    const PixelsToAddTo& pixels_;
};

/// Lays colours times an opacity over pixels.
class OverStore {
public:
    OverStore(const PixelsToAddTo& pixels, float opacity) : pixels_(pixels), opacity_(opacity) {}

    void operator()(int row, int first, int end, Float4 color) const {
        const Float4 source = opacity_ * unit(color);
        if (isNothing(source))
            return;
        float* at = pixels_(row, first, end);
        for (; first < end; ++first, at += 4)
            lay(source, at);
    }

    void operator()(int row, int first, std::span<const Float4> colors) const {
        float* at = pixels_(row, first, first + int(colors.size()));
        for (const Float4& color : colors) {
            lay(opacity_ * unit(color), at);
            at += 4;
        }
    }

    void operator()(int row, int first, int end, const RowColors& colors) const {
        float* at = pixels_(row, first, end);
        for (int i = 0; i < end - first; ++i, at += 4)
            lay(opacity_ * unit(colors.at(float(i))), at);
    }

private:
    static void lay(Float4 source, float* to) {
        Float4 backdrop;
        std::memcpy(&backdrop, to, sizeof backdrop);
        const Float4 both = over(source, backdrop);
        std::memcpy(to, &both, sizeof both);
    }

    const PixelsToAddTo& pixels_;
    float opacity_;
};

/// Calls pixels(row, first, end, colour), for single pixels too.
template <class Run>
class RunStore {
public:
    explicit RunStore(Run run) : run_(std::move(run)) {}

    void operator()(int row, int first, int end, Float4 color) const { run_(row, first, end, toVec4(color)); }
    void operator()(int row, int first, std::span<const Float4> colors) const {
        for (const Float4& color : colors) {
            run_(row, first, first + 1, toVec4(color));
            ++first;
        }
    }

    void operator()(int row, int first, int end, const RowColors& colors) const {
        for (int x = first; x < end; ++x)
            run_(row, x, x + 1, toVec4(colors.at(float(x - first))));
    }

private:
    Run run_;
};

}  // namespace vtm::asset
