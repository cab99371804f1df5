#include "asset/src/ramp.hpp"

#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace vtm::asset {

namespace {

using glm::vec2;

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
Float4 colorBetween(const GradientView& gradient, std::size_t before, std::size_t after, float u) {
    const float start = gradient.offset(before), gap = gradient.offset(after) - start;
    const Float4 from = float4(gradient.color(before)), to = float4(gradient.color(after));
    return premultiplied(from + (gap > 0 ? (u - start) / gap : 0.0f) * (to - from));
}

// ---- Means over pixels ------------------------------------------------------------------------------

/// The padded ramp's integral from a to b. Between stops it is a quadratic, which Simpson's rule integrates
/// exactly; at the same time that serves what lies before the first stop and behind the last.
Float4 integral(const GradientView& gradient, float a, float b) {
    std::size_t next = stopsUpTo(gradient, a);
    Float4 sum{};
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
Float4 mean(const GradientView& gradient, float u, float width) {
    const Spread spread = gradient.gradient().spread;
    width = std::min(width, spread == Spread::Pad ? widestPadded : widestPeriodic);
    if (spread == Spread::Pad)
        return integral(gradient, u - 0.5f * width, u + 0.5f * width) / width;
    u -= 2 * std::floor(0.5f * u);
    const float from = u - 0.5f * width, to = u + 0.5f * width;
    Float4 sum{};
    for (float n = std::floor(from); n < to; ++n) {
        const float a = std::max(from - n, 0.0f), b = std::min(to - n, 1.0f);
        const bool isMirrored = spread == Spread::Reflect && n != 0 && n != 2;
        sum += isMirrored ? integral(gradient, 1 - b, 1 - a) : integral(gradient, a, b);
    }
    return sum / width;
}

/// Ramps narrower than this in a pixel are as good as straight there, but for stops: what interpolating
/// straight colours bends them by is below width² / 12 = 1/3000. Where alpha does not change they are
/// straight.
constexpr float straightWidth = 1.0f / 16;

}  // namespace

float spreadOffset(Spread spread, float u) {
    switch (spread) {
        case Spread::Reflect:
            return 1 - std::abs(1 - (u - 2 * std::floor(u / 2)));
        case Spread::Repeat:
            return u - std::floor(u);
        default:
            return u;
    }
}

Float4 Ramp::over(float place, vec2 sides) {
    sides = glm::min(glm::abs(sides), vec2(widestPadded));
    const float longer = std::max(sides.x, sides.y), shorter = std::min(sides.x, sides.y);
    if (finds(place, 0.5f * (longer + shorter)))
        return at(place);
    const float apart = shorter * 0.28867513f;  // 1 / √12
    return 0.5f * (mean(gradient_, place - apart, longer) + mean(gradient_, place + apart, longer));
}

void Ramp::find(float place) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::size_t upTo = stopsUpTo(gradient_, place), count = gradient_.size();
    const bool isBefore = upTo == 0, isBehind = upTo == count;
    const std::size_t before = isBefore ? 0 : upTo - 1, after = std::min(upTo, count - 1);
    low_ = isBefore ? (isPadded_ ? -infinity : 0) : gradient_.offset(before);
    high_ = isBehind ? (isPadded_ ? infinity : 1) : gradient_.offset(after);
    const bool isFlat = isBefore || isBehind;
    next_ = isBehind ? infinity : high_;
    color_ = float4(gradient_.color(before));
    start_ = isFlat ? 0 : low_;
    const float gap = high_ - low_;
    slope_ = isFlat || !(gap > 0) ? Float4{} : (float4(gradient_.color(after)) - color_) / gap;
    isPremultiplied_ = slope_[3] == 0;
    widest_ = isPremultiplied_ ? infinity : 0.5f * straightWidth;
    if (isPremultiplied_) {
        slope_ *= color_[3];
        color_ = premultiplied(color_);
    }
}

}  // namespace vtm::asset
