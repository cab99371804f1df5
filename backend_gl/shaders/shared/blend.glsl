// Compositing of premultiplied colours. Source: W3C Compositing and Blending Level 1, sections 9 and 10.
// Requires: constants blend*. Twin of: raster/src/blend.cpp.
// Exports: over, blend, maskFactor.

vec4 over(vec4 source, vec4 backdrop) { return source + (1.0 - source.a) * backdrop; }

vec3 straight(vec4 c) { return c.a > 0.0 ? min(c.rgb / c.a, vec3(1.0)) : vec3(0.0); }

// ---- Separable modes: b the backdrop's channel, s the source's ------------------------------------

float hardLight(float b, float s) { return s <= 0.5 ? b * 2.0 * s : b + (2.0 * s - 1.0) - b * (2.0 * s - 1.0); }

float colorDodge(float b, float s) {
    if (b <= 0.0)
        return 0.0;
    return s >= 1.0 ? 1.0 : min(1.0, b / (1.0 - s));
}

float colorBurn(float b, float s) {
    if (b >= 1.0)
        return 1.0;
    return s <= 0.0 ? 0.0 : 1.0 - min(1.0, (1.0 - b) / s);
}

float softLight(float b, float s) {
    if (s <= 0.5)
        return b - (1.0 - 2.0 * s) * b * (1.0 - b);
    float d = b <= 0.25 ? ((16.0 * b - 12.0) * b + 4.0) * b : sqrt(b);
    return b + (2.0 * s - 1.0) * (d - b);
}

float mixChannel(uint mode, float b, float s) {
    switch (mode) {
        case blendMultiply: return b * s;
        case blendScreen: return b + s - b * s;
        case blendOverlay: return hardLight(s, b);
        case blendDarken: return min(b, s);
        case blendLighten: return max(b, s);
        case blendColorDodge: return colorDodge(b, s);
        case blendColorBurn: return colorBurn(b, s);
        case blendHardLight: return hardLight(b, s);
        case blendSoftLight: return softLight(b, s);
        case blendDifference: return abs(b - s);
        case blendExclusion: return b + s - 2.0 * b * s;
        default: return s;
    }
}

// ---- Non-separable modes --------------------------------------------------------------------------

float luminosity(vec3 c) { return dot(c, vec3(0.3, 0.59, 0.11)); }
float lowest(vec3 c) { return min(c.r, min(c.g, c.b)); }
float highest(vec3 c) { return max(c.r, max(c.g, c.b)); }
float saturation(vec3 c) { return highest(c) - lowest(c); }

vec3 clipColor(vec3 c) {
    float l = luminosity(c), n = lowest(c), x = highest(c);
    if (n < 0.0)
        c = l + (c - l) * (l / (l - n));
    if (x > 1.0)
        c = l + (c - l) * ((1.0 - l) / (x - l));
    return c;
}

vec3 setLuminosity(vec3 c, float l) { return clipColor(c + (l - luminosity(c))); }

vec3 setSaturation(vec3 c, float s) {
    float range = saturation(c);
    return range > 0.0 ? (c - lowest(c)) * (s / range) : vec3(0.0);
}

vec3 mixColors(uint mode, vec3 b, vec3 s) {
    switch (mode) {
        case blendHue: return setLuminosity(setSaturation(s, saturation(b)), luminosity(b));
        case blendSaturation: return setLuminosity(setSaturation(b, saturation(s)), luminosity(b));
        case blendColor: return setLuminosity(s, luminosity(b));
        case blendLuminosity: return setLuminosity(b, luminosity(s));
        default: return vec3(mixChannel(mode, b.r, s.r), mixChannel(mode, b.g, s.g), mixChannel(mode, b.b, s.b));
    }
}

vec4 blend(uint mode, vec4 source, vec4 backdrop) {
    if (mode == blendNormal)
        return over(source, backdrop);
    if (mode == blendPlusLighter)
        return min(source + backdrop, 1.0);
    vec3 mixed = mixColors(mode, straight(backdrop), straight(source));
    return vec4((1.0 - backdrop.a) * source.rgb + (1.0 - source.a) * backdrop.rgb + source.a * backdrop.a * mixed,
                source.a + backdrop.a - source.a * backdrop.a);
}

// ---- Masks ----------------------------------------------------------------------------------------

// IEC 61966-2-1. max keeps pow's base positive where the other branch is taken.
vec3 linearLight(vec3 c) {
    return mix(c / 12.92, pow((max(c, 0.0) + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

float maskFactor(uint op, vec4 mask) {
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
    if (op == opPopMaskAlpha)
        return mask.a;
    return op == opPopMaskLuminance ? dot(mask.rgb, luminance) : mask.a * dot(linearLight(straight(mask)), luminance);
}
