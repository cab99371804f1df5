#include "raster/src/ramp.hpp"

#include <array>
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

// ---- Means over pixels ------------------------------------------------------------------------------

/// A stretch of a ramp as it is passed. Between stops straight colours are interpolated, then premultiplied
/// (SVG 2 section 14.2.4), so with t from 0 to 1 along it the colour is from + t (to - from) - t (1 - t)
/// bend.
struct Passed {
    float length;
    Float4 from, to, bend;

    Float4 at(float t) const { return from + t * (to - from - (1 - t) * bend); }
    /// What is left from t on.
    Passed rest(float t) const {
        const float left = 1 - t;
        return {left * length, at(t), to, left * left * bend};
    }
    /// The integral from the stretch's start over x, and the integral of that.
    Float4 once(float x) const {
        const float t = x / length;
        return x * (from + t * (0.5f * (to - from - bend) + t * (1.0f / 3) * bend));
    }
    Float4 twice(float x) const {
        const float t = x / length;
        return x * x * (0.5f * from + t * ((1.0f / 6) * (to - from - bend) + t * (1.0f / 12) * bend));
    }
};

/// Goes along a ramp from a place on, in the direction of growing u: stretch after stretch.
class RampWalk {
public:
    /// `base` is taken from all colours.
    RampWalk(const GradientView& gradient, float place, Float4 base) : gradient_(gradient), base_(base) {
        if (spread() == Spread::Pad) {
            enter(place);
            return;
        }
        const float period = std::floor(place);
        isBackwards_ = spread() == Spread::Reflect && std::fmod(period, 2.0f) != 0;
        enter(isBackwards_ ? period + 1 - place : place - period);
    }

    /// The stretch, or what is left of the first one.
    const Passed& here() const { return here_; }
    void goOn() {
        if (isBackwards_ ? number_ > 0 : number_ < gradient_.size())
            number_ += isBackwards_ ? -1 : 1;
        else if (spread() == Spread::Reflect)
            isBackwards_ = !isBackwards_;
        else
            number_ = 0;
        here_ = passed();
    }

private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    Spread spread() const { return gradient_.gradient().spread; }
    /// Of a stretch; the first one and the last lie beyond the stops.
    float start() const {
        return number_ == 0 ? (spread() == Spread::Pad ? -infinity : 0) : gradient_.offset(number_ - 1);
    }
    float end() const {
        return number_ == gradient_.size() ? (spread() == Spread::Pad ? infinity : 1)
                                           : gradient_.offset(number_);
    }

    void enter(float place) {
        number_ = stopsUpTo(gradient_, place);
        here_ = passed();
        const float passedBy = isBackwards_ ? end() - place : place - start();
        if (!std::isfinite(here_.length))
            here_.length = number_ == 0 ? end() - place : infinity;
        else if (here_.length > 0)
            here_ = here_.rest(std::min(passedBy / here_.length, 1.0f));
    }

    Passed passed() const {
        const float length = end() - start();
        if (number_ == 0 || number_ == gradient_.size()) {
            const Float4 color =
                premultiplied(float4(gradient_.color(number_ == 0 ? 0 : number_ - 1))) - base_;
            return {length, color, color, Float4{}};
        }
        const Float4 from = float4(gradient_.color(number_ - 1)), to = float4(gradient_.color(number_));
        const Float4 change = to - from, bend = change * Float4{change[3], change[3], change[3], 0};
        const Float4 start = premultiplied(from) - base_, end = premultiplied(to) - base_;
        return isBackwards_ ? Passed{length, end, start, bend} : Passed{length, start, end, bend};
    }

    const GradientView& gradient_;
    Float4 base_;
    std::size_t number_ = 0;  ///< of the stop at which the stretch ends
    bool isBackwards_ = false;
    Passed here_{};
};

/// A reflected ramp repeats after two, so no mean is over more; a padded one is all but two colours beyond.
constexpr float widestPeriodic = 2, widestPadded = 1024;

/// The shorter side is taken for no shorter than that share of the longer one: a jump at a pixel's side is
/// off by an eighth of it, 1/16000, and single precision has so much of a difference of integrals.
constexpr float thinnest = 1.0f / 2048;

/// The mean over a pixel whose sides change u by `longer` > 0 and `shorter`, and in whose middle `color` is.
/// u is the sum of two numbers that are even over the sides' intervals, so the mean is a second difference
/// of the ramp's second integral I, over longer times shorter: with r and f half of the sum and of the
/// difference of the sides, I(u + r) - I(u + f) - I(u - f) + I(u - r). I is 0 at u - r, where the walk
/// begins. Differences from one colour are added, so that colours that are all alike stay what they are:
/// blend modes may jump there.
Float4 meanOver(const GradientView& gradient, float u, float longer, float shorter, Float4 color) {
    const float widest = gradient.gradient().spread == Spread::Pad ? widestPadded : widestPeriodic;
    longer = std::min(longer, widest);
    shorter = std::clamp(shorter, thinnest * longer, longer);
    const float reach = 0.5f * (longer + shorter);
    const std::array<float, 3> corners{shorter, longer, 2 * reach};  // from u - r
    const std::array<float, 3> signs{-1, -1, 1};
    Float4 once{}, twice{}, sum{};
    float done = 0;
    RampWalk walk(gradient, u - reach, color);
    for (std::size_t next = 0; next < corners.size();) {
        const Passed& here = walk.here();
        if (here.length > 0) {
            for (; next < corners.size() && !(corners[next] - done > here.length); ++next) {
                const float x = corners[next] - done;
                sum += signs[next] * (twice + x * once + here.twice(x));
            }
            twice += here.length * once + here.twice(here.length);
            once += here.once(here.length);
            done += here.length;
        }
        walk.goOn();
    }
    return color + sum / (longer * shorter);
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
    if (finds(place, 0.5f * (longer + shorter)) || !(longer > 0))
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
