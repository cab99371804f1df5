#include "raster/src/ramp.hpp"

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

/// How much of a pixel has u at a distance d from that in its middle, u being the sum of two that are even
/// over their boxes: it rises, is flat and falls again.
struct PixelWeight {
    float reach, flat;  ///< |d| is at most `reach`; up to `flat` all are alike

    PixelWeight(float longer, float shorter)
        : reach(0.5f * (longer + shorter)), flat(0.5f * (longer - shorter)) {}

    float at(float d) const {
        const float rest = reach - std::abs(d), slope = reach - flat;
        return rest < slope ? rest / slope : 1;
    }
    /// Where it bends next.
    float bendAfter(float d) const {
        return d < -flat ? -flat : d < flat ? flat : std::numeric_limits<float>::infinity();
    }
};

/// A mean that grows. Differences from one colour are added, so that colours that are all alike stay what
/// they are: blend modes may jump there.
class WeighedMean {
public:
    explicit WeighedMean(Float4 base) : base_(base) {}

    void add(float weight, Float4 color) {
        sum_ += weight * (color - base_);
        weights_ += weight;
    }
    Float4 mean() const { return weights_ > 0 ? base_ + sum_ / weights_ : base_; }

private:
    Float4 base_, sum_{};
    float weights_ = 0;
};

/// Adds the padded ramp at middle + d for d from `from` to `last`. Between stops and bends it is a quadratic
/// times a straight line, which Simpson's rule integrates exactly; at the same time that serves what lies
/// before the first stop and behind the last.
void add(const GradientView& gradient, float middle, float from, float last, const PixelWeight& weight,
         WeighedMean& mean) {
    std::size_t next = stopsUpTo(gradient, middle + from);
    while (from < last) {
        const std::size_t before = next == 0 ? 0 : next - 1, after = std::min(next, gradient.size() - 1);
        const float end = next == gradient.size() ? last : std::min(last, gradient.offset(after) - middle);
        const float to = std::min(end, weight.bendAfter(from)), sixth = (to - from) / 6;
        const auto addAt = [&](float d, float times) {
            mean.add(times * sixth * weight.at(d), colorBetween(gradient, before, after, middle + d));
        };
        if (from < to) {
            addAt(from, 1);
            addAt(0.5f * (from + to), 4);
            addAt(to, 1);
            from = to;
        }
        next += to == end;
    }
}

/// A reflected ramp repeats after two, so no mean is over more; a padded one is all but two colours beyond.
constexpr float widestPeriodic = 2, widestPadded = 1024;

/// The mean over a pixel whose sides change u by `longer` > 0 and `shorter`, and in whose middle `color` is.
Float4 meanOver(const GradientView& gradient, float u, float longer, float shorter, Float4 color) {
    const Spread spread = gradient.gradient().spread;
    const float widest = spread == Spread::Pad ? widestPadded : widestPeriodic;
    const PixelWeight weight(std::min(longer, widest), std::min(shorter, widest));
    WeighedMean mean(color);
    if (spread == Spread::Pad) {
        add(gradient, u, -weight.reach, weight.reach, weight, mean);
    } else {
        u -= 2 * std::floor(0.5f * u);
        for (float n = std::floor(u - weight.reach); n < u + weight.reach; ++n) {
            const float a = std::max(-weight.reach, n - u), b = std::min(weight.reach, n + 1 - u);
            const bool isMirrored = spread == Spread::Reflect && std::fmod(n, 2.0f) != 0;
            if (isMirrored)
                add(gradient, n + 1 - u, -b, -a, weight, mean);
            else
                add(gradient, u - n, a, b, weight, mean);
        }
    }
    return mean.mean();
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
    return meanOver(gradient_, place, longer, shorter, at(place));
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
