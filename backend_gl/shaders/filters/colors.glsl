// Colours as operations of filters want them. Requires: blend.glsl. Twin of: raster/filter/layer.hpp, curves.hpp.
// Exports: straightened, premultiplied, inLight, encoded.

// What is more transparent has no colour of its own: it would be that of rounding.
const float leastAlpha = 1.0 / 1024.0;

vec4 straightened(vec4 c) { return c.a >= leastAlpha ? vec4(c.rgb / c.a, c.a) : vec4(0.0); }
vec4 premultiplied(vec4 c) { return vec4(c.rgb * c.a, c.a); }

// IEC 61966-2-1. max keeps pow's base positive where the other branch is taken.
vec3 encodedLight(vec3 c) {
    return mix(c * 12.92, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec4 inLight(vec4 c) {
    c = straightened(c);
    return premultiplied(vec4(linearLight(min(c.rgb, 1.0)), c.a));
}

vec4 encoded(vec4 c) {
    c = straightened(c);
    return premultiplied(vec4(encodedLight(min(c.rgb, 1.0)), c.a));
}
