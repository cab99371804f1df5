#include "api/openvg/src/color.hpp"

#include <cmath>

namespace vtm::openvg {

float encodeGamma(float x) { return x <= 0.00304f ? 12.92f * x : 1.0556f * std::pow(x, 1 / 2.4f) - 0.0556f; }

float decodeGamma(float x) { return x <= 0.03928f ? x / 12.92f : std::pow((x + 0.0556f) / 1.0556f, 2.4f); }

namespace {

Color decoded(Color c) { return {decodeGamma(c.r), decodeGamma(c.g), decodeGamma(c.b), c.a}; }
Color encoded(Color c) { return {encodeGamma(c.r), encodeGamma(c.g), encodeGamma(c.b), c.a}; }

}  // namespace

Color converted(Color color, ColorSpace from, ColorSpace to) {
    if (from.linear == to.linear && from.luminance == to.luminance)
        return color;
    // Luminance is a sum of linear light. Grey stands for itself in all spaces of its kind.
    const bool toGrey = to.luminance && !from.luminance;
    bool linear = from.linear;
    if (!linear && (toGrey || to.linear)) {
        color = decoded(color);
        linear = true;
    }
    if (toGrey)
        color = Color(glm::vec3(luminance(glm::vec3(color))), color.a);
    return linear && !to.linear ? encoded(color) : color;
}

Color fullyConverted(Color color, ColorSpace from, ColorSpace to) {
    if (from == to)
        return color;
    if (from.premultiplied)
        color = unpremultiplied(color);
    color = converted(color, from, to);
    return to.premultiplied ? premultiplied(color) : color;
}

}  // namespace vtm::openvg
