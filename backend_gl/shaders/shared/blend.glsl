// Compositing of premultiplied colours. Source: W3C Compositing and Blending Level 1, sections 9 and 10.
// Requires: constants blend*. Twin of: raster/src/blend.cpp.
// Exports: over, blend, maskFactor.

vec4 over(vec4 source, vec4 backdrop) { return source + (1.0 - source.a) * backdrop; }

vec3 straight(vec4 c) { return mix(vec3(0.0), min(c.rgb / c.a, vec3(1.0)), bvec3(c.a > 0.0)); }

// ---- Separable modes: b the backdrop's channels, s the source's -----------------------------------

vec3 hardLight(vec3 b, vec3 s) {
    return mix(b + (2.0 * s - 1.0) - b * (2.0 * s - 1.0), b * 2.0 * s, lessThanEqual(s, vec3(0.5)));
}

vec3 colorDodge(vec3 b, vec3 s) {
    vec3 dodged = mix(min(b / (1.0 - s), vec3(1.0)), vec3(1.0), greaterThanEqual(s, vec3(1.0)));
    return mix(dodged, vec3(0.0), lessThanEqual(b, vec3(0.0)));
}

vec3 colorBurn(vec3 b, vec3 s) {
    vec3 burnt = mix(1.0 - min((1.0 - b) / s, vec3(1.0)), vec3(0.0), lessThanEqual(s, vec3(0.0)));
    return mix(burnt, vec3(1.0), greaterThanEqual(b, vec3(1.0)));
}

// max keeps the root's argument positive where the other value is taken.
vec3 softLight(vec3 b, vec3 s) {
    vec3 d = mix(sqrt(max(b, 0.0)), ((16.0 * b - 12.0) * b + 4.0) * b, lessThanEqual(b, vec3(0.25)));
    return mix(b + (2.0 * s - 1.0) * (d - b), b - (1.0 - 2.0 * s) * b * (1.0 - b), lessThanEqual(s, vec3(0.5)));
}

vec3 mixChannels(uint mode, vec3 b, vec3 s) {
    vec3 mixed = s;
    if (mode == blendMultiply)
        mixed = b * s;
    if (mode == blendScreen)
        mixed = b + s - b * s;
    if (mode == blendOverlay)
        mixed = hardLight(s, b);
    if (mode == blendDarken)
        mixed = min(b, s);
    if (mode == blendLighten)
        mixed = max(b, s);
    if (mode == blendColorDodge)
        mixed = colorDodge(b, s);
    if (mode == blendColorBurn)
        mixed = colorBurn(b, s);
    if (mode == blendHardLight)
        mixed = hardLight(b, s);
    if (mode == blendSoftLight)
        mixed = softLight(b, s);
    if (mode == blendDifference)
        mixed = abs(b - s);
    if (mode == blendExclusion)
        mixed = b + s - 2.0 * b * s;
    return mixed;
}

// ---- Non-separable modes --------------------------------------------------------------------------

float luminosity(vec3 c) { return dot(c, vec3(0.3, 0.59, 0.11)); }
float lowest(vec3 c) { return min(c.r, min(c.g, c.b)); }
float highest(vec3 c) { return max(c.r, max(c.g, c.b)); }
float saturation(vec3 c) { return highest(c) - lowest(c); }

vec3 clipColor(vec3 c) {
    float l = luminosity(c), n = lowest(c), x = highest(c);
    c = mix(c, l + (c - l) * (l / (l - n)), bvec3(n < 0.0));
    return mix(c, l + (c - l) * ((1.0 - l) / (x - l)), bvec3(x > 1.0));
}

vec3 setLuminosity(vec3 c, float l) { return clipColor(c + (l - luminosity(c))); }

vec3 setSaturation(vec3 c, float s) {
    float range = saturation(c);
    return mix(vec3(0.0), (c - lowest(c)) * (s / range), bvec3(range > 0.0));
}

// Hue and Color take the source's hue, Saturation and Luminosity the backdrop's.
vec3 mixColors(uint mode, vec3 b, vec3 s) {
    bool isLuminosity = mode == blendLuminosity, isColor = mode == blendColor;
    bool isHue = mode == blendHue, isSaturation = mode == blendSaturation;
    bvec3 ofBackdrop = bvec3(isSaturation || isLuminosity);
    vec3 color = mix(s, b, ofBackdrop), other = mix(b, s, ofBackdrop), mixed = mixChannels(mode, b, s);
    if (isHue || isSaturation)
        color = setSaturation(color, saturation(other));
    if (isHue || isSaturation || isColor || isLuminosity)
        mixed = setLuminosity(color, luminosity(mix(b, s, bvec3(isLuminosity))));
    return mixed;
}

vec4 blend(uint mode, vec4 source, vec4 backdrop) {
    vec4 color = mix(over(source, backdrop), min(source + backdrop, 1.0), bvec4(mode == blendPlusLighter));
    if (mode != blendNormal && mode != blendPlusLighter) {
        vec3 mixed = mixColors(mode, straight(backdrop), straight(source));
        color = vec4((1.0 - backdrop.a) * source.rgb + (1.0 - source.a) * backdrop.rgb + source.a * backdrop.a * mixed,
                     source.a + backdrop.a - source.a * backdrop.a);
    }
    return color;
}

// ---- Masks ----------------------------------------------------------------------------------------

// IEC 61966-2-1. max keeps pow's base positive where the other branch is taken.
vec3 linearLight(vec3 c) {
    return mix(c / 12.92, pow((max(c, 0.0) + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

float maskFactor(uint op, vec4 mask) {
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
    float factor = mix(mask.a, dot(mask.rgb, luminance), op == opPopMaskLuminance);
    if (op != opPopMaskAlpha && op != opPopMaskLuminance)
        factor = mask.a * dot(linearLight(straight(mask)), luminance);
    return factor;
}
