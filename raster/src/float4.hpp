/// \file
/// Four floats that are added and multiplied at once: a colour in a register.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/vec4.hpp>

namespace vtm::asset {

using Float4 = float __attribute__((vector_size(16)));

inline Float4 float4(const glm::vec4& v) { return Float4{v.x, v.y, v.z, v.w}; }
inline glm::vec4 toVec4(Float4 v) { return {v[0], v[1], v[2], v[3]}; }

/// The largest magnitude of a channel.
inline float largest(Float4 v) {
    float max = 0;
    for (int c = 0; c < 4; ++c)
        max = std::max(max, std::abs(v[c]));
    return max;
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

}  // namespace vtm::asset
