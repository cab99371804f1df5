#include "conformance/reference/paint/blend.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace vtm::reference {
namespace {

using scene::BlendMode;
using Rgb = glm::dvec3;

// Section 10.1, separable modes: backdrop b, source s.

double hardLight(double b, double s) { return s <= 0.5 ? b * 2 * s : b + (2 * s - 1) - b * (2 * s - 1); }

double colorDodge(double b, double s) {
    if (b == 0)
        return 0;
    return s >= 1 ? 1 : std::min(1.0, b / (1 - s));
}

double colorBurn(double b, double s) {
    if (b >= 1)
        return 1;
    return s <= 0 ? 0 : 1 - std::min(1.0, (1 - b) / s);
}

double softLight(double b, double s) {
    if (s <= 0.5)
        return b - (1 - 2 * s) * b * (1 - b);
    const double d = b <= 0.25 ? ((16 * b - 12) * b + 4) * b : std::sqrt(b);
    return b + (2 * s - 1) * (d - b);
}

double blendChannel(BlendMode mode, double b, double s) {
    switch (mode) {
        case BlendMode::Multiply:
            return b * s;
        case BlendMode::Screen:
            return b + s - b * s;
        case BlendMode::Overlay:
            return hardLight(s, b);
        case BlendMode::Darken:
            return std::min(b, s);
        case BlendMode::Lighten:
            return std::max(b, s);
        case BlendMode::ColorDodge:
            return colorDodge(b, s);
        case BlendMode::ColorBurn:
            return colorBurn(b, s);
        case BlendMode::HardLight:
            return hardLight(b, s);
        case BlendMode::SoftLight:
            return softLight(b, s);
        case BlendMode::Difference:
            return std::abs(b - s);
        case BlendMode::Exclusion:
            return b + s - 2 * b * s;
        default:
            return s;
    }
}

// Section 10.2, the others.

double lum(const Rgb& c) { return 0.3 * c.r + 0.59 * c.g + 0.11 * c.b; }

double smallest(const Rgb& c) { return std::min({c.r, c.g, c.b}); }
double largest(const Rgb& c) { return std::max({c.r, c.g, c.b}); }
double saturation(const Rgb& c) { return largest(c) - smallest(c); }

Rgb clipColor(Rgb c) {
    const double l = lum(c), low = smallest(c), high = largest(c);
    if (low < 0)
        c = l + (c - l) * l / (l - low);
    if (high > 1)
        c = l + (c - l) * (1 - l) / (high - l);
    return c;
}

Rgb withLum(const Rgb& c, double l) { return clipColor(c + (l - lum(c))); }

/// Scales the channels so that the smallest is 0 and the largest is `s`.
Rgb withSaturation(const Rgb& c, double s) {
    const double range = saturation(c);
    return range > 0 ? (c - smallest(c)) * s / range : Rgb(0);
}

Rgb blendColor(BlendMode mode, const Rgb& b, const Rgb& s) {
    switch (mode) {
        case BlendMode::Hue:
            return withLum(withSaturation(s, saturation(b)), lum(b));
        case BlendMode::Saturation:
            return withLum(withSaturation(b, saturation(s)), lum(b));
        case BlendMode::Color:
            return withLum(s, lum(b));
        case BlendMode::Luminosity:
            return withLum(b, lum(s));
        default:
            return {blendChannel(mode, b.r, s.r), blendChannel(mode, b.g, s.g), blendChannel(mode, b.b, s.b)};
    }
}

Rgb straight(const Colour& c) { return c.a > 0 ? Rgb(c) / c.a : Rgb(0); }

double linearLight(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

}  // namespace

/// Sections 5 and 9; level 2 section 9.1 for PlusLighter: co = (1 - αb)·αs·Cs + (1 - αs)·αb·Cb + αb·αs·B(Cb,
/// Cs).
Colour blend(BlendMode mode, const Colour& backdrop, const Colour& source) {
    if (mode == BlendMode::Normal || backdrop.a <= 0 || source.a <= 0)
        return over(backdrop, source);
    if (mode == BlendMode::PlusLighter)
        return glm::min(backdrop + source, Colour(1));
    const Rgb mixed = blendColor(mode, straight(backdrop), straight(source));
    const Rgb colour =
        (1 - backdrop.a) * Rgb(source) + (1 - source.a) * Rgb(backdrop) + backdrop.a * source.a * mixed;
    return {colour, source.a + backdrop.a * (1 - source.a)};
}

double luminance(const Colour& colour, bool linear) {
    const Rgb weights(0.2126, 0.7152, 0.0722);
    if (!linear)
        return glm::dot(weights, Rgb(colour));
    const Rgb c = straight(colour);
    return colour.a * glm::dot(weights, Rgb(linearLight(c.r), linearLight(c.g), linearLight(c.b)));
}

}  // namespace vtm::reference
