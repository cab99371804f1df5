/// \file
/// Four floats that are added and multiplied at once: a colour in a register.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace vtm::asset {

using Float4 = float __attribute__((vector_size(16)));

inline Float4 float4(const glm::vec4& v) { return Float4{v.x, v.y, v.z, v.w}; }
/// Of four bytes, 0 to 255.
inline Float4 float4(const std::uint8_t* p) {
#if defined(__SSE2__)
    std::int32_t word;
    std::memcpy(&word, p, 4);
    const __m128i zero = _mm_setzero_si128();
    const __m128i words = _mm_unpacklo_epi8(_mm_cvtsi32_si128(word), zero);
    return _mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero));
#else
    return Float4{float(p[0]), float(p[1]), float(p[2]), float(p[3])};
#endif
}
inline glm::vec4 toVec4(Float4 v) { return {v[0], v[1], v[2], v[3]}; }

inline float largerOf(float a, float b) { return std::max(a, b); }
inline Float4 largerOf(Float4 a, Float4 b) { return a > b ? a : b; }
inline float squareRoot(float v) { return std::sqrt(v); }
inline Float4 squareRoot(Float4 v) {
#if defined(__SSE2__)
    return _mm_sqrt_ps(v);
#else
    return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

/// The largest magnitude of a channel.
inline float largest(Float4 v) {
    float max = 0;
    for (int c = 0; c < 4; ++c)
        max = std::max(max, std::abs(v[c]));
    return max;
}

/// Towards zero; below zero if it is no number of 32 bits.
inline int truncated(float value) {
#if defined(__SSE2__)
    return _mm_cvttss_si32(_mm_set_ss(value));
#else
    return std::abs(value) < 2147483648.0f ? int(value) : -1;
#endif
}

/// In [0, 1]: rounding leaves sums some 1e-7 outside. NaN, which a view or a paint's matrix beyond single
/// precision makes, becomes 0.
inline float unit(float value) { return value > 0 ? std::min(value, 1.0f) : 0.0f; }

inline Float4 unit(Float4 v) {
    const Float4 zero{}, one{1, 1, 1, 1};
    v = v > zero ? v : zero;
    return v < one ? v : one;
}

/// Of straight colours.
inline Float4 premultiplied(Float4 c) { return c * Float4{c[3], c[3], c[3], 1}; }
inline Float4 over(Float4 source, Float4 backdrop) {
    return source + (1 - Float4{source[3], source[3], source[3], source[3]}) * backdrop;
}

// ---- Two doubles ----------------------------------------------------------------------------------

using Double2 = double __attribute__((vector_size(16)));

inline Double2 double2(glm::dvec2 v) { return Double2{v.x, v.y}; }
inline glm::vec2 toFloats(Double2 v) {
    const auto floats = __builtin_convertvector(v, float __attribute__((vector_size(8))));
    return {floats[0], floats[1]};
}

}  // namespace vtm::asset
