#include "asset/src/gradient.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace vtm::asset {

namespace {

using glm::vec2;
using glm::vec4;

float spreadOffset(Spread spread, float u) {
    switch (spread) {
        case Spread::Reflect:
            return 1 - std::abs(1 - (u - 2 * std::floor(u / 2)));
        case Spread::Repeat:
            return u - std::floor(u);
        default:
            return std::clamp(u, 0.0f, 1.0f);
    }
}

vec4 unpack(const GradientStop& stop) {
    return vec4(stop.rgba[0], stop.rgba[1], stop.rgba[2], stop.rgba[3]) / 65535.0f;
}

vec4 premultiplied(vec4 c) { return {glm::vec3(c) * c.a, c.a}; }

/// How many stops have an offset <= u; of several at one offset the last counts from there on.
std::size_t stopsUpTo(const GradientView& gradient, float u) {
    std::size_t low = 0, high = gradient.size();
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (gradient.stop(middle).offset <= u)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// Straight colours are interpolated, then premultiplied (SVG 2 section 14.2.4).
vec4 colorBetween(const GradientStop& before, const GradientStop& after, float u) {
    const float gap = after.offset - before.offset;
    return premultiplied(glm::mix(unpack(before), unpack(after), gap > 0 ? (u - before.offset) / gap : 0.0f));
}

// ---- Means over pixels ------------------------------------------------------------------------------

/// The padded ramp's integral from a to b. Between stops it is a quadratic, which Simpson's rule integrates
/// exactly; at the same time that serves what lies before the first stop and behind the last.
vec4 integral(const GradientView& gradient, float a, float b) {
    std::size_t next = stopsUpTo(gradient, a);
    vec4 sum(0);
    for (float from = a; from < b; ++next) {
        const GradientStop before = gradient.stop(next == 0 ? 0 : next - 1),
                           after = gradient.stop(std::min(next, gradient.size() - 1));
        const float to = next == gradient.size() ? b : std::min(b, after.offset);
        sum += (colorBetween(before, after, from) + 4.0f * colorBetween(before, after, 0.5f * (from + to)) +
                colorBetween(before, after, to)) *
               ((to - from) / 6);
        from = to;
    }
    return sum;
}

/// A reflected ramp repeats after two, so no mean is over more; a padded one is all but two colours beyond.
constexpr float widestPeriodic = 2, widestPadded = 1024;

/// The mean from u - width / 2 to u + width / 2, width > 0.
vec4 mean(const GradientView& gradient, float u, float width) {
    const Spread spread = gradient.gradient().spread;
    width = std::min(width, spread == Spread::Pad ? widestPadded : widestPeriodic);
    if (spread == Spread::Pad)
        return integral(gradient, u - 0.5f * width, u + 0.5f * width) / width;
    u -= 2 * std::floor(0.5f * u);
    const float from = u - 0.5f * width, to = u + 0.5f * width;
    vec4 sum(0);
    for (float n = std::floor(from); n < to; ++n) {
        const float a = std::max(from - n, 0.0f), b = std::min(to - n, 1.0f);
        const bool isMirrored = spread == Spread::Reflect && n != 0 && n != 2;
        sum += isMirrored ? integral(gradient, 1 - b, 1 - a) : integral(gradient, a, b);
    }
    return sum / width;
}

/// Ramps narrower than this in a pixel are as good as straight there, but for stops: what interpolating
/// straight colours bends them by is below width² / 12 = 1/3000.
constexpr float straightWidth = 1.0f / 16;

/// The mean over a pixel whose sides change u by `sides`. Its longer side makes a box, exactly; the other
/// one's box is replaced by two points with the same variance. Where the pixel has nothing but a little of
/// one stretch between two stops, it is the colour in the middle.
vec4 colorOver(const GradientView& gradient, float u, vec2 sides) {
    sides = glm::min(glm::abs(sides), vec2(widestPadded));
    const float longer = std::max(sides.x, sides.y), shorter = std::min(sides.x, sides.y),
                width = longer + shorter;
    const Spread spread = gradient.gradient().spread;
    const bool isPadded = spread == Spread::Pad;
    const float offset = spreadOffset(spread, u), place = isPadded ? u : offset;
    const std::size_t upTo = stopsUpTo(gradient, place);
    const GradientStop before = gradient.stop(upTo == 0 ? 0 : upTo - 1),
                       after = gradient.stop(std::min(upTo, gradient.size() - 1));
    const bool isBefore = isPadded && upTo == 0, isBehind = isPadded && upTo == gradient.size();
    const float low = upTo > 0 ? before.offset : 0, high = upTo < gradient.size() ? after.offset : 1;
    if ((width <= straightWidth || isBefore || isBehind) && (isBefore || place - 0.5f * width >= low) &&
        (isBehind || place + 0.5f * width <= high))
        return colorBetween(before, after, offset);
    const float apart = shorter * 0.28867513f;  // 1 / √12
    return 0.5f * (mean(gradient, u - apart, longer) + mean(gradient, u + apart, longer));
}

// ---- Radial gradients -------------------------------------------------------------------------------

struct Root {
    float u = 0;
    vec2 slope{0};  ///< what u changes by with the point
    bool real = false;
};

/// The larger root u of |p - (1-u) f| = (1-u) fr + u with (1-u) fr + u >= 0. With d = p - f it is
/// a u² - 2 b u - c = 0, a = (1-fr)² - |f|², b = d·f - fr (1-fr), c = |d|² - fr²; its roots are q / a
/// and -c / q with q = b ± sqrt(b² + a c), the sign chosen so that nothing cancels. Its slope is
/// (u f + d) / (a u - b).
Root radialOffset(vec2 p, vec2 f, float fr) {
    const vec2 d = p - f;
    const float grow = 1 - fr;
    const float a = grow * grow - glm::dot(f, f), b = glm::dot(d, f) - fr * grow;
    const float c = glm::dot(d, d) - fr * fr, discriminant = b * b + a * c;
    if (discriminant < 0)
        return {};
    const float q = b + (b < 0 ? -1.0f : 1.0f) * std::sqrt(discriminant);
    const float one = q == 0 ? 0 : -c / q, other = a == 0 ? one : q / a;
    const float larger = std::max(one, other), smaller = std::min(one, other);
    const float u = fr + larger * grow >= 0 ? larger : smaller;
    const float divisor = std::max(std::abs(a * u - b), 1e-6f);
    return {u, (u * f + d) / divisor, fr + u * grow >= 0};
}

/// A radial gradient is a cone over the plane, about its focus. Over a pixel, u has not the mean that it has
/// in the middle; with D = |slope| |p - f|, T = |slope|² (|side 0|² + |side 1|²) and R what of T lies along
/// the slope,
///     mean² = D² + (T - R) / 12 + tip,  tip = 0.0315 T / (1 + 3.3 D² / (T / 2))²,
/// and variance R / 12 - tip: exact at the tip of a circular gradient and far from it, and within 0.006
/// pixels for square pixels in between.
struct Spot {
    float u;
    vec2 sides;  ///< what the pixel's sides change u by, scaled to the variance
};

/// Eight pixels from the tip it moves u by less than a 380th of what a pixel does.
constexpr float farFromTip = 64;

Spot conePixel(const Root& root, vec2 d, const glm::mat2& sides) {
    const vec2 along = root.slope * sides;
    const float steep = glm::dot(root.slope, root.slope), above = steep * glm::dot(d, d);
    const float all = steep * (glm::dot(sides[0], sides[0]) + glm::dot(sides[1], sides[1]));
    const float radial = glm::dot(along, along);
    if (!(radial > 0) || above > farFromTip * all)
        return {root.u, along};
    const float near = 1 / (1 + 6.6f * above / all), tip = 0.0315f * all * near * near;
    const float squared = above + std::max(all - radial, 0.0f) / 12 + tip;
    return {root.u + std::sqrt(squared) - std::sqrt(above),
            along * std::sqrt(std::max(0.0f, 1 - 12 * tip / radial))};
}

/// Where the middle of a pixel is nearer to the focus than this share of its side, it is put there: at the
/// focus itself there is no slope.
constexpr float besideFocus = 1e-3f;

}  // namespace

vec4 linearColor(const GradientView& view, vec2 point, const glm::mat2& pixel) {
    const std::array<float, 6>& m = view.gradient().matrix;
    return colorOver(view, applyMatrix(m, point).x, vec2(m[0], m[2]) * pixel);
}

vec4 radialColor(const GradientView& view, vec2 point, const glm::mat2& pixel) {
    const Gradient& gradient = view.gradient();
    const std::array<float, 6>& m = gradient.matrix;
    const glm::mat2 sides = glm::mat2(m[0], m[1], m[2], m[3]) * pixel;
    const vec2 focus(gradient.fx, gradient.fy);
    vec2 d = applyMatrix(m, point) - focus;
    if (glm::length(d) < besideFocus * glm::length(sides[0]))
        d = besideFocus * sides[0];
    const Root root = radialOffset(focus + d, focus, gradient.fr);
    if (!root.real)
        return vec4(0);
    const Spot spot = conePixel(root, d, sides);
    return colorOver(view, spot.u, spot.sides);
}

}  // namespace vtm::asset
