#include "raster/blend.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace vtm::asset {

namespace {

using glm::vec3;
using glm::vec4;

vec3 straight(vec4 c) { return c.a > 0 ? glm::min(vec3(c) / c.a, vec3(1)) : vec3(0); }

// ---- Separable modes, section 10.1: b the backdrop's channel, s the source's ----------------------

float hardLight(float b, float s) { return s <= 0.5f ? b * 2 * s : b + (2 * s - 1) - b * (2 * s - 1); }

float colorDodge(float b, float s) {
    if (b <= 0)
        return 0;
    return s >= 1 ? 1 : std::min(1.0f, b / (1 - s));
}

float colorBurn(float b, float s) {
    if (b >= 1)
        return 1;
    return s <= 0 ? 0 : 1 - std::min(1.0f, (1 - b) / s);
}

float softLight(float b, float s) {
    if (s <= 0.5f)
        return b - (1 - 2 * s) * b * (1 - b);
    const float d = b <= 0.25f ? ((16 * b - 12) * b + 4) * b : std::sqrt(b);
    return b + (2 * s - 1) * (d - b);
}

float mixChannel(Blend mode, float b, float s) {
    switch (mode) {
        case Blend::Multiply:
            return b * s;
        case Blend::Screen:
            return b + s - b * s;
        case Blend::Overlay:
            return hardLight(s, b);
        case Blend::Darken:
            return std::min(b, s);
        case Blend::Lighten:
            return std::max(b, s);
        case Blend::ColorDodge:
            return colorDodge(b, s);
        case Blend::ColorBurn:
            return colorBurn(b, s);
        case Blend::HardLight:
            return hardLight(b, s);
        case Blend::SoftLight:
            return softLight(b, s);
        case Blend::Difference:
            return std::abs(b - s);
        case Blend::Exclusion:
            return b + s - 2 * b * s;
        default:
            return s;
    }
}

// ---- Non-separable modes, section 10.2 ------------------------------------------------------------

float luminosity(vec3 c) { return glm::dot(c, vec3(0.3f, 0.59f, 0.11f)); }
float lowest(vec3 c) { return std::min({c.r, c.g, c.b}); }
float highest(vec3 c) { return std::max({c.r, c.g, c.b}); }
float saturation(vec3 c) { return highest(c) - lowest(c); }

vec3 clipColor(vec3 c) {
    const float l = luminosity(c), n = lowest(c), x = highest(c);
    if (n < 0)
        c = l + (c - l) * (l / (l - n));
    if (x > 1)
        c = l + (c - l) * ((1 - l) / (x - l));
    return c;
}

vec3 setLuminosity(vec3 c, float l) { return clipColor(c + (l - luminosity(c))); }

/// Section 10.2's SetSat sorts the channels; scaling the offsets from the lowest does the same.
vec3 setSaturation(vec3 c, float s) {
    const float range = saturation(c);
    return range > 0 ? (c - lowest(c)) * (s / range) : vec3(0);
}

vec3 mixColors(Blend mode, vec3 b, vec3 s) {
    switch (mode) {
        case Blend::Hue:
            return setLuminosity(setSaturation(s, saturation(b)), luminosity(b));
        case Blend::Saturation:
            return setLuminosity(setSaturation(b, saturation(s)), luminosity(b));
        case Blend::Color:
            return setLuminosity(s, luminosity(b));
        case Blend::Luminosity:
            return setLuminosity(b, luminosity(s));
        default:
            return {mixChannel(mode, b.r, s.r), mixChannel(mode, b.g, s.g), mixChannel(mode, b.b, s.b)};
    }
}

// ---- Masks ----------------------------------------------------------------------------------------

/// IEC 61966-2-1.
float linearLight(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

float maskLuminance(vec3 c) { return glm::dot(c, vec3(0.2126f, 0.7152f, 0.0722f)); }

}  // namespace

vec4 blend(Blend mode, vec4 source, vec4 backdrop) {
    if (mode == Blend::Normal)
        return over(source, backdrop);
    if (mode == Blend::PlusLighter)
        return glm::min(source + backdrop, vec4(1));
    const vec3 mixed = mixColors(mode, straight(backdrop), straight(source));
    const vec3 color =
        (1 - backdrop.a) * vec3(source) + (1 - source.a) * vec3(backdrop) + source.a * backdrop.a * mixed;
    return {color, source.a + backdrop.a - source.a * backdrop.a};
}

vec4 light(vec4 color) {
    const vec3 c = straight(color);
    return {color.a * vec3(linearLight(c.r), linearLight(c.g), linearLight(c.b)), color.a};
}

float maskFactor(Op op, vec4 mask) {
    if (op == Op::PopMaskAlpha)
        return mask.a;
    return maskLuminance(vec3(op == Op::PopMaskLuminance ? mask : light(mask)));
}

}  // namespace vtm::asset
