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

__attribute__((target("avx2,fma"))) inline __m256 byteOf(__m256i pixels, int c) {
    return _mm256_cvtepi32_ps(_mm256_and_si256(_mm256_srli_epi32(pixels, 8 * c), _mm256_set1_epi32(255)));
}
/// A number from 0 to 255, rounded, in its place in a pixel.
__attribute__((target("avx2,fma"))) inline __m256i placed(__m256 value, int c) {
    return _mm256_slli_epi32(_mm256_cvttps_epi32(value + all(0.5f)), 8 * c);
}

template <EdgeRule rule>
__attribute__((target("avx2,fma"))) inline __m256i channel(__m256i pixels, int c, __m256 share,
                                                           const EdgeColor& color) {
    return placed(mixed<rule>(byteOf(pixels, c), share, color.source[std::size_t(c)], color.kept), c);
}

/// On opaque grounds.
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

/// On any grounds: alpha of what is below, of all of a pixel under the colour, and of the result.
struct Alphas {
    __m256 below, above, mixed;
};

/// Where there is no alpha, there is nothing to divide.
__attribute__((target("avx2,fma"))) inline __m256 inverse(__m256 alpha) {
    return all(1) / _mm256_max_ps(alpha, all(1e-6f));
}

/// One channel: the light of both, multiplied by alpha, is mixed.
template <EdgeRule rule, bool isPremultiplied>
__attribute__((target("avx2,fma"))) inline __m256 mixedOver(__m256 before, __m256 share, const Alphas& alphas,
                                                            float source, float kept) {
    const __m256 below = isPremultiplied ? before : before * alphas.below;
    if constexpr (rule == EdgeRule::linear) {
        const __m256 sum = mixed<rule>(below, share, source, kept);
        return isPremultiplied ? sum : sum * inverse(alphas.mixed);
    }
    __m256 light = share * all(source);
    if constexpr (rule == EdgeRule::translucent) {
        const __m256 after = (all(255 * source) + below * all(kept)) * inverse(alphas.above);
        light = share * alphas.above * decoded(_mm256_min_ps(after, all(255)));
    }
    const __m256 straight = isPremultiplied ? before * inverse(alphas.below) : before;
    light = light + (all(1) - share) * alphas.below * decoded(straight);
    const __m256 result = encoded(_mm256_min_ps(light * inverse(alphas.mixed), all(1)));
    return isPremultiplied ? result * alphas.mixed : result;
}

template <EdgeRule rule, bool isPremultiplied>
__attribute__((target("avx2,fma"))) inline __m256i mixedPixelsOver(__m256i pixels, __m256 share,
                                                                   const EdgeColor& color) {
    Alphas alphas;
    alphas.below = byteOf(pixels, 3) * all(1.0f / 255);
    alphas.above = all(1 - color.kept) + all(color.kept) * alphas.below;
    alphas.mixed = alphas.below + share * (alphas.above - alphas.below);
    const __m256 most = all(255) * (isPremultiplied ? alphas.mixed : all(1));
    __m256i result = placed(all(255) * alphas.mixed, 3);
    for (int c = 0; c < 3; ++c) {
        const __m256 value = mixedOver<rule, isPremultiplied>(byteOf(pixels, c), share, alphas,
                                                              color.source[std::size_t(c)], color.kept);
        result = either(result, placed(_mm256_min_ps(value, most), c));
    }
    return result;
}

__attribute__((target("avx2,fma"))) inline __m128i twoPixels(std::uint8_t* const* p) {
    return _mm_unpacklo_epi32(_mm_loadu_si32(p[0]), _mm_loadu_si32(p[1]));
}
__attribute__((target("avx2,fma"))) inline __m256i eightPixels(std::uint8_t* const* p) {
    return _mm256_set_m128i(_mm_unpacklo_epi64(twoPixels(p + 4), twoPixels(p + 6)),
                            _mm_unpacklo_epi64(twoPixels(p), twoPixels(p + 2)));
}

template <EdgeRule rule, bool isPremultiplied>
__attribute__((target("avx2,fma"))) void mixAll(std::uint8_t* corner, std::ptrdiff_t stride,
                                                std::span<const EdgePixel> edges, const EdgeColor& color) {
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
        const __m256i shares = _mm256_srli_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(e)), 16);
        const __m256 share = _mm256_cvtepi32_ps(shares) * all(1.0f / wholeShare);
        alignas(32) std::uint32_t words[atOnce];
        _mm256_store_si256(reinterpret_cast<__m256i*>(words),
                           _mm256_testc_si256(pixels, opaque)
                               ? mixedPixels<rule>(pixels, share, color)
                               : mixedPixelsOver<rule, isPremultiplied>(pixels, share, color));
#pragma GCC unroll 8
        for (std::size_t k = 0; k < atOnce; ++k)
            std::memcpy(p[k], &words[k], 4);
    }
}

template <EdgeRule rule>
void mixBy(std::uint8_t* corner, std::ptrdiff_t stride, std::span<const EdgePixel> edges,
           const EdgeColor& color) {
    return color.groundIsPremultiplied ? mixAll<rule, true>(corner, stride, edges, color)
                                       : mixAll<rule, false>(corner, stride, edges, color);
}

}  // namespace

bool mixEdges(std::uint8_t* corner, std::ptrdiff_t stride, std::span<const EdgePixel> edges,
              const EdgeColor& color) {
    static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (!has)
        return false;
    if (color.rule == EdgeRule::linear)
        mixBy<EdgeRule::linear>(corner, stride, edges, color);
    else if (color.rule == EdgeRule::opaque)
        mixBy<EdgeRule::opaque>(corner, stride, edges, color);
    else
        mixBy<EdgeRule::translucent>(corner, stride, edges, color);
    return true;
}

#else

bool mixEdges(std::uint8_t*, std::ptrdiff_t, std::span<const EdgePixel>, const EdgeColor&) { return false; }

#endif

}  // namespace vtm::openvg::wide
