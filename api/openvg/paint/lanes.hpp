/// \file
/// Four floats that are added and multiplied at once: a colour in a register.
#pragma once

#include <cmath>
#include <cstring>
#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "api/openvg/paint/color.hpp"

namespace vtm::openvg {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

inline Float4 loaded(const Color& color) {
    Float4 v;
    std::memcpy(&v, &color, sizeof v);
    return v;
}
inline void assign(Color& color, Float4 v) { std::memcpy(&color, &v, sizeof v); }
inline Color colorOf(Float4 v) { return {v[0], v[1], v[2], v[3]}; }

inline Float4 splat(float v) { return Float4{v, v, v, v}; }
/// A colour's alpha in every lane.
inline Float4 alphas(Float4 c) { return __builtin_shufflevector(c, c, 3, 3, 3, 3); }
/// The colour's first three lanes, and the last of another.
inline Float4 withAlpha(Float4 c, Float4 last) {
    const Int4 mask{-1, -1, -1, 0};
    return Float4((Int4(c) & mask) | (Int4(last) & ~mask));
}

/// The first where they are equal or one is NaN.
inline Float4 lesser(Float4 a, Float4 b) { return b < a ? b : a; }
/// The second where one is NaN.
inline Float4 greater(Float4 a, Float4 b) { return a > b ? a : b; }
/// In [0, 1]; NaN becomes 0.
inline Float4 unit(Float4 v) { return lesser(greater(v, Float4{}), splat(1)); }

/// Of numbers that are not negative.
inline Float4 root(Float4 v) {
#ifdef __SSE2__
    return _mm_sqrt_ps(v);
#else
    return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

inline Float4 premultiplied(Float4 c) { return c * withAlpha(alphas(c), splat(1)); }
/// As unpremultiplied(Color).
inline Float4 unpremultiplied(Float4 c) {
    const Float4 alpha = alphas(c);
    const Float4 straight = lesser(greater(c, Float4{}), alpha) / alpha;
    return alpha > Float4{} ? withAlpha(straight, c) : Float4{};
}

}  // namespace vtm::openvg
