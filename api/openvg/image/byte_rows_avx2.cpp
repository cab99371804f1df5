// What byte_rows.cpp does with four pixels at a time, with eight; results are the same bit for bit.

#include "api/openvg/image/byte_rows.hpp"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace vtm::openvg::wide {

#ifdef __x86_64__

namespace {

constexpr int pixelsAtOnce = 8;

bool hasAvx2() {
    static const bool has = __builtin_cpu_supports("avx2");
    return has;
}

int wholeOnes(int count) { return hasAvx2() ? count / pixelsAtOnce * pixelsAtOnce : 0; }

/// Four bytes of a pixel to its alpha's.
__attribute__((target("avx2"))) __m256i alphaShuffle(int alphaByte) {
    return _mm256_add_epi8(_mm256_setr_epi8(0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12, 0, 0, 0, 0, 4,
                                            4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12),
                           _mm256_set1_epi8(char(alphaByte)));
}

/// There · kept + added, in 8.8 fixed point, of the lower or the upper pixels of both halves.
__attribute__((target("avx2"))) __m256i blended(__m256i words, __m256i kept, __m256i added) {
    return _mm256_srli_epi16(_mm256_add_epi16(_mm256_mulhi_epu16(words, kept), added), 8);
}

__attribute__((target("avx2"))) void overColor(std::uint8_t* pixels, int count, std::uint64_t added,
                                               std::uint64_t kept) {
    const __m256i zero = _mm256_setzero_si256(), a = _mm256_set1_epi64x(std::int64_t(added)),
                  k = _mm256_set1_epi64x(std::int64_t(kept));
    for (auto* p = reinterpret_cast<__m256i*>(pixels); count > 0; count -= pixelsAtOnce, ++p) {
        const __m256i there = _mm256_loadu_si256(p);
        _mm256_storeu_si256(p, _mm256_packus_epi16(blended(_mm256_unpacklo_epi8(zero, there), k, a),
                                                   blended(_mm256_unpackhi_epi8(zero, there), k, a)));
    }
}

__attribute__((target("avx2"))) void overPixels(std::uint8_t* pixels, const std::uint8_t* sources, int count,
                                                int alphaByte) {
    const __m256i zero = _mm256_setzero_si256(), shuffle = alphaShuffle(alphaByte),
                  half = _mm256_set1_epi16(128);
    const auto* s = reinterpret_cast<const __m256i*>(sources);
    for (auto* p = reinterpret_cast<__m256i*>(pixels); count > 0; count -= pixelsAtOnce, ++p, ++s) {
        const __m256i source = _mm256_loadu_si256(s), there = _mm256_loadu_si256(p),
                      missing = _mm256_shuffle_epi8(_mm256_xor_si256(source, _mm256_set1_epi8(-1)), shuffle);
        const __m256i low = blended(_mm256_unpacklo_epi8(zero, there), _mm256_unpacklo_epi8(missing, missing),
                                    half),
                      high = blended(_mm256_unpackhi_epi8(zero, there),
                                     _mm256_unpackhi_epi8(missing, missing), half);
        _mm256_storeu_si256(p, _mm256_add_epi8(source, _mm256_packus_epi16(low, high)));
    }
}

/// Reads some before it writes them: where both places are nearly the same in their pages, reading waits for
/// what was written last.
template <int vectors>
__attribute__((target("avx2"))) void clampSome(const __m256i* from, __m256i* to, __m256i alphas) {
    __m256i given[vectors];
#pragma GCC unroll 4
    for (int i = 0; i < vectors; ++i)
        given[i] = _mm256_loadu_si256(from + i);
#pragma GCC unroll 4
    for (int i = 0; i < vectors; ++i)
        _mm256_storeu_si256(to + i, _mm256_min_epu8(given[i], _mm256_shuffle_epi8(given[i], alphas)));
}

__attribute__((target("avx2"))) void clampPixels(const std::uint8_t* from, std::uint8_t* to, int count,
                                                 int alphaByte) {
    const __m256i shuffle = alphaShuffle(alphaByte);
    const auto* f = reinterpret_cast<const __m256i*>(from);
    auto* t = reinterpret_cast<__m256i*>(to);
    for (; count >= 4 * pixelsAtOnce; count -= 4 * pixelsAtOnce, t += 4, f += 4)
        clampSome<4>(f, t, shuffle);
    for (; count > 0; count -= pixelsAtOnce, ++t, ++f)
        clampSome<1>(f, t, shuffle);
}

/// By the formula of byte_rows.cpp.
__attribute__((target("avx2"))) __m256i premultiplied(__m256i words, __m256i alphas) {
    const __m256i t = _mm256_add_epi16(_mm256_mullo_epi16(words, alphas), _mm256_set1_epi16(128));
    return _mm256_srli_epi16(_mm256_add_epi16(t, _mm256_srli_epi16(t, 8)), 8);
}

__attribute__((target("avx2"))) void premultiplyPixels(const std::uint8_t* from, std::uint8_t* to, int count,
                                                       int alphaByte) {
    const __m256i zero = _mm256_setzero_si256(), shuffle = alphaShuffle(alphaByte),
                  alphaIsKept = _mm256_set1_epi32(int(255u << 8 * alphaByte));
    const auto* f = reinterpret_cast<const __m256i*>(from);
    for (auto* t = reinterpret_cast<__m256i*>(to); count > 0; count -= pixelsAtOnce, ++t, ++f) {
        const __m256i given = _mm256_loadu_si256(f),
                      alphas = _mm256_or_si256(_mm256_shuffle_epi8(given, shuffle), alphaIsKept);
        _mm256_storeu_si256(
            t, _mm256_packus_epi16(
                   premultiplied(_mm256_unpacklo_epi8(given, zero), _mm256_unpacklo_epi8(alphas, zero)),
                   premultiplied(_mm256_unpackhi_epi8(given, zero), _mm256_unpackhi_epi8(alphas, zero))));
    }
}

/// Of the first pixel. A negative place gives 0.
std::uint32_t shuffleOf(const int (&places)[4]) {
    std::uint32_t shuffle = 0;
    for (int i = 3; i >= 0; --i) {
        const int place = places[i];
        shuffle = shuffle << 8 | std::uint32_t(place < 0 ? 0x80 : place);
    }
    return shuffle;
}

/// Negative places stay so in all pixels of a half.
__attribute__((target("avx2"))) __m256i ofEveryPixel(std::uint32_t shuffle) {
    constexpr int next = 0x04040404;
    const __m256i steps = _mm256_setr_epi32(0, next, 2 * next, 3 * next, 0, next, 2 * next, 3 * next);
    return _mm256_add_epi32(_mm256_set1_epi32(int(shuffle)), steps);
}

__attribute__((target("avx2"))) void movePixels(const std::uint8_t* from, std::uint8_t* to, int count,
                                                std::uint32_t moved, std::uint32_t added) {
    const __m256i shuffle = ofEveryPixel(moved), add = _mm256_set1_epi32(int(added));
    const auto* f = reinterpret_cast<const __m256i*>(from);
    for (auto* t = reinterpret_cast<__m256i*>(to); count > 0; count -= pixelsAtOnce, ++t, ++f)
        _mm256_storeu_si256(t, _mm256_or_si256(_mm256_shuffle_epi8(_mm256_loadu_si256(f), shuffle), add));
}

/// Values of a half of the table. What is left of a byte after 16 were taken from it k times is not negative
/// where the k-th part, or one after it, is its own: the exclusive or of the steps so far is its value.
template <int first>
__attribute__((target("avx2"))) __m256i halfLookedUp(__m256i bytes, const ByteTable& table) {
    const __m256i sixteen = _mm256_set1_epi8(16);
    __m256i values = _mm256_setzero_si256();
    for (int k = first; k < first + 8; ++k) {
        const auto* const step = reinterpret_cast<const __m128i*>(table.steps[k]);
        const __m256i part = _mm256_broadcastsi128_si256(_mm_loadu_si128(step));
        values = _mm256_xor_si256(values, _mm256_shuffle_epi8(part, bytes));
        bytes = _mm256_subs_epi8(bytes, sixteen);
    }
    return values;
}

__attribute__((target("avx2"))) int lookUpPixels(const std::uint8_t* from, std::uint8_t* to, int count,
                                                 const ByteTable& table, std::uint32_t moved,
                                                 std::uint32_t added, bool opaqueOnly) {
    const __m256i shuffle = ofEveryPixel(moved), add = _mm256_set1_epi32(int(added)),
                  alphas = _mm256_set1_epi32(int(255u << 8 * table.alphaByte)),
                  upper = _mm256_set1_epi8(char(0x80));
    const auto* f = reinterpret_cast<const __m256i*>(from);
    auto* t = reinterpret_cast<__m256i*>(to);
    for (int done = 0; done < count; done += pixelsAtOnce, ++t, ++f) {
        const __m256i given = _mm256_loadu_si256(f);
        if (opaqueOnly && !_mm256_testc_si256(given, alphas))
            return done;
        const __m256i values = _mm256_xor_si256(halfLookedUp<0>(given, table),
                                                halfLookedUp<8>(_mm256_xor_si256(given, upper), table)),
                      pixels = _mm256_blendv_epi8(values, given, alphas);
        _mm256_storeu_si256(t, _mm256_or_si256(_mm256_shuffle_epi8(pixels, shuffle), add));
    }
    return count;
}

std::uint64_t joined(const std::uint16_t (&words)[4]) {
    return std::uint64_t(words[0]) | std::uint64_t(words[1]) << 16 | std::uint64_t(words[2]) << 32 |
           std::uint64_t(words[3]) << 48;
}

}  // namespace

int overBytes(std::uint8_t* pixels, int count, const std::uint16_t (&added)[4],
              const std::uint16_t (&kept)[4]) {
    const int whole = wholeOnes(count);
    if (whole > 0)
        overColor(pixels, whole, joined(added), joined(kept));
    return whole;
}

int overBytes(std::uint8_t* pixels, const std::uint8_t* sources, int count, int alphaByte) {
    const int whole = wholeOnes(count);
    if (whole > 0)
        overPixels(pixels, sources, whole, alphaByte);
    return whole;
}

int clampBytes(const std::uint8_t* from, std::uint8_t* to, int count, int alphaByte) {
    const int whole = wholeOnes(count);
    if (whole > 0)
        clampPixels(from, to, whole, alphaByte);
    return whole;
}

int premultiplyBytes(const std::uint8_t* from, std::uint8_t* to, int count, int alphaByte) {
    const int whole = wholeOnes(count);
    if (whole > 0)
        premultiplyPixels(from, to, whole, alphaByte);
    return whole;
}

int moveBytes(const std::uint8_t* from, std::uint8_t* to, int count, const int (&places)[4],
              std::uint32_t added) {
    const int whole = wholeOnes(count);
    if (whole > 0)
        movePixels(from, to, whole, shuffleOf(places), added);
    return whole;
}

int lookUpBytes(const std::uint8_t* from, std::uint8_t* to, int count, const ByteTable& table,
                const int (&places)[4], std::uint32_t added, bool opaqueOnly) {
    const int whole = wholeOnes(count);
    return whole > 0 ? lookUpPixels(from, to, whole, table, shuffleOf(places), added, opaqueOnly) : 0;
}

#else

int overBytes(std::uint8_t*, int, const std::uint16_t (&)[4], const std::uint16_t (&)[4]) { return 0; }
int overBytes(std::uint8_t*, const std::uint8_t*, int, int) { return 0; }
int clampBytes(const std::uint8_t*, std::uint8_t*, int, int) { return 0; }
int premultiplyBytes(const std::uint8_t*, std::uint8_t*, int, int) { return 0; }
int moveBytes(const std::uint8_t*, std::uint8_t*, int, const int (&)[4], std::uint32_t) { return 0; }

int lookUpBytes(const std::uint8_t*, std::uint8_t*, int, const ByteTable&, const int (&)[4], std::uint32_t,
                bool) {
    return 0;
}

#endif

ByteTable::ByteTable(const std::uint8_t* values, int fromAlpha) : alphaByte(fromAlpha) {
    for (int i = 0; i < 256; ++i)
        steps[i / 16][i % 16] = std::uint8_t(values[i] ^ (i % 128 < 16 ? 0 : values[i - 16]));
}

}  // namespace vtm::openvg::wide
