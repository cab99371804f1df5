#include "asset/src/gradient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

vec4 premultiplied(vec4 c) { return {glm::vec3(c) * c.a, c.a}; }

/// How many stops have an offset <= u; of several at one offset the last counts from there on.
std::size_t stopsUpTo(const GradientView& gradient, float u) {
    std::size_t low = 0, high = gradient.size();
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (gradient.offset(middle) <= u)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// Between two stops. Straight colours are interpolated, then premultiplied (SVG 2 section 14.2.4).
vec4 colorBetween(const GradientView& gradient, std::size_t before, std::size_t after, float u) {
    const float start = gradient.offset(before), gap = gradient.offset(after) - start;
    return premultiplied(
        glm::mix(gradient.color(before), gradient.color(after), gap > 0 ? (u - start) / gap : 0.0f));
}

// ---- Means over pixels ------------------------------------------------------------------------------

/// The padded ramp's integral from a to b. Between stops it is a quadratic, which Simpson's rule integrates
/// exactly; at the same time that serves what lies before the first stop and behind the last.
vec4 integral(const GradientView& gradient, float a, float b) {
    std::size_t next = stopsUpTo(gradient, a);
    vec4 sum(0);
    for (float from = a; from < b; ++next) {
        const std::size_t before = next == 0 ? 0 : next - 1, after = std::min(next, gradient.size() - 1);
        const float to = next == gradient.size() ? b : std::min(b, gradient.offset(after));
        sum += (colorBetween(gradient, before, after, from) +
                4.0f * colorBetween(gradient, before, after, 0.5f * (from + to)) +
                colorBetween(gradient, before, after, to)) *
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

/// A ramp that is asked for neighbours: it keeps the stretch between two stops that it was asked for last.
class Ramp {
public:
    explicit Ramp(const GradientView& gradient)
        : gradient_(gradient), spread_(gradient.gradient().spread), isPadded_(spread_ == Spread::Pad) {
        find(0);
    }

    /// The mean over a pixel whose sides change u by `sides`. Its longer side makes a box, exactly; the other
    /// one's box is replaced by two points with the same variance. Where the pixel has nothing but a little
    /// of one stretch, it is the colour in the middle.
    vec4 over(float u, vec2 sides) {
        sides = glm::min(glm::abs(sides), vec2(widestPadded));
        const float longer = std::max(sides.x, sides.y), shorter = std::min(sides.x, sides.y);
        const float place = isPadded_ ? u : spreadOffset(spread_, u), reach = 0.5f * (longer + shorter);
        if (!holds(place, reach)) {
            find(place);
            if (!holds(place, reach)) {
                const float apart = shorter * 0.28867513f;  // 1 / √12
                return 0.5f * (mean(gradient_, u - apart, longer) + mean(gradient_, u + apart, longer));
            }
        }
        return premultiplied(color_ + (place - start_) * slope_);
    }

private:
    bool holds(float place, float reach) const {
        return place - reach >= low_ && place + reach <= high_ && place < next_ && reach <= widest_;
    }
    void find(float place) {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const std::size_t upTo = stopsUpTo(gradient_, place), count = gradient_.size();
        const bool isBefore = upTo == 0, isBehind = upTo == count;
        const std::size_t before = isBefore ? 0 : upTo - 1, after = std::min(upTo, count - 1);
        low_ = isBefore ? (isPadded_ ? -infinity : 0) : gradient_.offset(before);
        high_ = isBehind ? (isPadded_ ? infinity : 1) : gradient_.offset(after);
        const bool isFlat = isBefore || isBehind;
        next_ = isBehind ? infinity : high_;
        widest_ = isFlat ? infinity : 0.5f * straightWidth;
        color_ = gradient_.color(before);
        start_ = isFlat ? 0 : low_;
        const float gap = high_ - low_;
        slope_ = isFlat || !(gap > 0) ? vec4(0) : (gradient_.color(after) - color_) / gap;
    }

    const GradientView& gradient_;
    Spread spread_;
    bool isPadded_;
    // The stretch, of which its upper end is not a part: straight colours at `start_` and what they change
    // by; up to which reach it is straight.
    float low_ = 0, high_ = 0, next_ = 0, widest_ = 0, start_ = 0;
    vec4 color_{0}, slope_{0};
};

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

void linearColors(const GradientView& view, vec2 point, vec2 step, const glm::mat2& pixel,
                  std::span<vec4> colors) {
    const std::array<float, 6>& m = view.gradient().matrix;
    const vec2 row(m[0], m[2]), sides = row * pixel;
    const float first = applyMatrix(m, point).x, change = glm::dot(row, step);
    Ramp ramp(view);
    for (std::size_t i = 0; i < colors.size(); ++i)
        colors[i] = ramp.over(first + float(i) * change, sides);
}

void radialColors(const GradientView& view, vec2 point, vec2 step, const glm::mat2& pixel,
                  std::span<vec4> colors) {
    const Gradient& gradient = view.gradient();
    const std::array<float, 6>& m = gradient.matrix;
    const glm::mat2 linear(m[0], m[1], m[2], m[3]), sides = linear * pixel;
    const vec2 focus(gradient.fx, gradient.fy), first = applyMatrix(m, point) - focus, change = linear * step;
    const float atFocus = besideFocus * glm::length(sides[0]);
    Ramp ramp(view);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        vec2 d = first + float(i) * change;
        if (glm::dot(d, d) < atFocus * atFocus)
            d = besideFocus * sides[0];
        const Root root = radialOffset(focus + d, focus, gradient.fr);
        colors[i] = vec4(0);
        if (root.real) {
            const Spot spot = conePixel(root, d, sides);
            colors[i] = ramp.over(spot.u, spot.sides);
        }
    }
}

}  // namespace vtm::asset
