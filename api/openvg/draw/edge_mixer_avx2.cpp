// Edges of glyphs, eight pixels at a time. Curves are polynomials: eight values at once are not faster from
// tables, which also take the first cache from pixels and coverage.

#include <cstring>

#include "api/openvg/draw/edge_mixer.hpp"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace vtm::openvg::wide {

#ifdef __x86_64__

namespace {

constexpr std::size_t atOnce = 8;

__attribute__((target("avx2,fma"))) inline __m256 all(float v) { return _mm256_set1_ps(v); }
__attribute__((target("avx2,fma"))) inline __m256i either(__m256i a, __m256i b) {
    return _mm256_or_si256(a, b);
}

/// γ⁻¹ of bytes, to [0, 1]: within 0.08 of a byte's step.
__attribute__((target("avx2,fma"))) inline __m256 decoded(__m256 byte) {
    const __m256 square = byte * byte,
                 upper = all(8.4164162e-6f) + byte * all(3.3088404e-8f) - square * all(3.0525386e-11f),
                 curve = all(9.4564377e-4f) + byte * all(1.2371999e-4f) + square * upper,
                 isLow = _mm256_cmp_ps(byte, all(0.03928f * 255), _CMP_LE_OQ);
    return _mm256_blendv_ps(curve, byte * all(1 / (12.92f * 255)), isLow);
}

/// γ of [0, 1], to bytes: within 0.09 of a step.
__attribute__((target("avx2,fma"))) inline __m256 encoded(__m256 light) {
    const __m256 root = light * _mm256_rsqrt_ps(light), square = root * root,
                 upper = all(-359.717255f) + root * all(522.365597f) +
                         square * (all(-418.229447f) + root * all(133.417931f)),
                 curve = all(-10.40039f) + root * all(387.647585f) + square * upper,
                 isLow = _mm256_cmp_ps(light, all(0.00304f), _CMP_LE_OQ);
    return _mm256_blendv_ps(curve, light * all(12.92f * 255), isLow);
}

/// One channel, from bytes to bytes.
template <EdgeRule rule>
__attribute__((target("avx2,fma"))) inline __m256 mixed(__m256 before, __m256 share, float source,
                                                        float kept) {
    if constexpr (rule == EdgeRule::linear)
        return before + share * (all(255 * source) - all(1 - kept) * before);
    const __m256 light = decoded(before);
    if constexpr (rule == EdgeRule::opaque)
        return encoded(light + share * (all(source) - light));
    const __m256 after = decoded(_mm256_min_ps(all(255 * source) + before * all(kept), all(255)));
    return encoded(light + share * (after - light));
}

template <EdgeRule rule>
__attribute__((target("avx2,fma"))) inline __m256i channel(__m256i pixels, int c, __m256 share,
                                                           const EdgeColor& color) {
    const __m256i byte = _mm256_and_si256(_mm256_srli_epi32(pixels, 8 * c), _mm256_set1_epi32(255));
    const __m256 result =
        mixed<rule>(_mm256_cvtepi32_ps(byte), share, color.source[std::size_t(c)], color.kept);
    return _mm256_slli_epi32(_mm256_cvttps_epi32(result + all(0.5f)), 8 * c);
}

template <EdgeRule rule>
__attribute__((target("avx2,fma"))) inline __m256i mixedPixels(__m256i pixels, __m256 share,
                                                               const EdgeColor& color) {
    const __m256i red = channel<rule>(pixels, 0, share, color),
                  alpha = _mm256_and_si256(pixels, _mm256_set1_epi32(int(0xff000000)));
    // Text mostly is grey on grey.
    const __m256i change = _mm256_xor_si256(pixels, _mm256_srli_epi32(pixels, 8));
    if (color.isGrey && _mm256_testz_si256(change, _mm256_set1_epi32(0xffff)))
        return either(either(alpha, red), either(_mm256_slli_epi32(red, 8), _mm256_slli_epi32(red, 16)));
    return either(either(alpha, red),
                  either(channel<rule>(pixels, 1, share, color), channel<rule>(pixels, 2, share, color)));
}

__attribute__((target("avx2,fma"))) inline __m128i twoPixels(std::uint8_t* const* p) {
    return _mm_unpacklo_epi32(_mm_loadu_si32(p[0]), _mm_loadu_si32(p[1]));
}
__attribute__((target("avx2,fma"))) inline __m256i eightPixels(std::uint8_t* const* p) {
    return _mm256_set_m128i(_mm_unpacklo_epi64(twoPixels(p + 4), twoPixels(p + 6)),
                            _mm_unpacklo_epi64(twoPixels(p), twoPixels(p + 2)));
}

template <EdgeRule rule>
__attribute__((target("avx2,fma"))) std::size_t mixAll(std::uint8_t* corner, std::ptrdiff_t stride,
                                                       std::span<const EdgePixel> edges,
                                                       const EdgeColor& color) {
    const __m256i opaque = _mm256_set1_epi32(color.groundHasAlpha ? int(0xff000000) : 0);
    std::uint32_t unused = ~0u;
    for (std::size_t i = 0; i < edges.size(); i += atOnce) {
        const EdgePixel* e = edges.data() + i;
        const std::size_t count = edges.size() - i;
        EdgePixel last[atOnce]{};
        if (count < atOnce)
            e = static_cast<const EdgePixel*>(std::memcpy(last, e, count * sizeof(EdgePixel)));
        std::uint8_t* p[atOnce];
#pragma GCC unroll 8
        for (std::size_t k = 0; k < atOnce; ++k)
            p[k] = e[k].in(corner, stride);
        for (std::size_t k = count; k < atOnce; ++k)
            p[k] = reinterpret_cast<std::uint8_t*>(&unused);
        const __m256i pixels = eightPixels(p);
        if (!_mm256_testc_si256(pixels, opaque))
            return i;
        const __m256i shares = _mm256_srli_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(e)), 16);
        alignas(32) std::uint32_t words[atOnce];
        _mm256_store_si256(
            reinterpret_cast<__m256i*>(words),
            mixedPixels<rule>(pixels, _mm256_cvtepi32_ps(shares) * all(1.0f / wholeShare), color));
#pragma GCC unroll 8
        for (std::size_t k = 0; k < atOnce; ++k)
            std::memcpy(p[k], &words[k], 4);
    }
    return edges.size();
}

}  // namespace

std::size_t mixEdges(std::uint8_t* corner, std::ptrdiff_t stride, std::span<const EdgePixel> edges,
                     const EdgeColor& color) {
    static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (!has)
        return 0;
    return color.rule == EdgeRule::linear   ? mixAll<EdgeRule::linear>(corner, stride, edges, color)
           : color.rule == EdgeRule::opaque ? mixAll<EdgeRule::opaque>(corner, stride, edges, color)
                                            : mixAll<EdgeRule::translucent>(corner, stride, edges, color);
}

#else

std::size_t mixEdges(std::uint8_t*, std::ptrdiff_t, std::span<const EdgePixel>, const EdgeColor&) {
    return 0;
}

#endif

}  // namespace vtm::openvg::wide
