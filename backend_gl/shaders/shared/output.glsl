// From the colours of regions, premultiplied sRGB, to the numbers that a framebuffer wants.
// Requires: LINEAR_LIGHT, LINEAR_OUT, STRAIGHT_OUT, ENCODED_STORE, DITHER defined as 1 or 0 (backend_gl/core/features.hpp);
// blend.glsl if one is 1.
// Exports: regionValue and regionValueIn, what is added up for a region; outputColor, what is made of the sum.

#if LINEAR_LIGHT || LINEAR_OUT || ENCODED_STORE
vec4 decoded(vec4 c) { return vec4(linearLight(straight(c)) * c.a, c.a); }

// IEC 61966-2-1. max keeps pow's base positive where the other branch is taken.
vec3 encodedLight(vec3 c) {
    return mix(c * 12.92, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}
#endif

vec4 regionValue(vec4 c) {
#if LINEAR_LIGHT
    return decoded(c);
#else
    return c;
#endif
}

// The same where `whole` stands for 1.
vec4 regionValueIn(float whole, vec4 c) {
#if LINEAR_LIGHT
    return decoded(c / whole) * whole;
#else
    return c;
#endif
}

#if DITHER
// Bayer's matrix of 8 × 8, in (-1/2, 1/2).
float threshold(uvec2 pixel) {
    uint x = pixel.x ^ pixel.y, y = pixel.y;
    uint order = (x & 1u) << 5 | (y & 1u) << 4 | (x & 2u) << 2 | (y & 2u) << 1 | (x & 4u) >> 1 | (y & 4u) >> 2;
    return (float(order) + 0.5) / 64.0 - 0.5;
}

// The same offset for all four keeps colours at most alpha.
vec4 dithered(vec4 c) {
    float offset = threshold(uvec2(gl_FragCoord.xy)) / 255.0;
#if ENCODED_STORE
    // Rounded here, since drivers' own encoding may be off by more than what keeps a colour in its place.
    vec3 stored = floor(clamp(encodedLight(c.rgb) + offset, 0.0, 1.0) * 255.0 + 0.5) / 255.0;
    return vec4(linearLight(stored), c.a + offset);
#else
    return c + offset;
#endif
}
#endif

vec4 outputColor(vec4 c) {
    // Rounding leaves sums some 1e-5 outside.
    c = clamp(c, 0.0, 1.0);
#if LINEAR_OUT && !LINEAR_LIGHT
    c = decoded(c);
#elif LINEAR_LIGHT && !LINEAR_OUT
    c.rgb = encodedLight(straight(c)) * c.a;
#endif
#if STRAIGHT_OUT
    c.rgb = straight(c);
#endif
#if DITHER
    c = dithered(c);
#endif
    return c;
}
