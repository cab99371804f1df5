#include "raster/src/ramp.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

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

/// Stretches are as good as straight in a pixel if interpolating straight colours moves the mean over it by
/// no more: their bend times the variance, which is a third of the reach's square at most.
constexpr float maxBending = 1.0f / 3000;

/// A stretch that is shorter, compared with a pixel's reach, is not followed beyond its ends: what it would
/// be there is far from any colour.
constexpr float minStretch = 0.25f;

/// A stretch's length, its straight colours at both ends, and what they change by.
struct Ends {
    float length;
    Float4 first, last, slope;
};

/// `number`: of the stop at which it ends.
Ends endsOf(const GradientView& gradient, std::size_t number) {
    const std::size_t count = gradient.size();
    if (number == 0 || number == count) {
        const bool isPadded = gradient.gradient().spread == Spread::Pad;
        const Float4 color = float4(gradient.color(number == 0 ? 0 : count - 1));
        return {isPadded      ? std::numeric_limits<float>::infinity()
                : number == 0 ? gradient.offset(0)
                              : 1 - gradient.offset(count - 1),
                color, color, Float4{}};
    }
    const float length = gradient.offset(number) - gradient.offset(number - 1);
    const Float4 first = float4(gradient.color(number - 1)), last = float4(gradient.color(number));
    return {length, first, last, length > 0 ? (last - first) / length : Float4{}};
}

}  // namespace

Float4 Ramp::over(float place, vec2 sides) {
    sides = glm::min(glm::abs(sides), vec2(widestPadded));
    const float longer = std::max(sides.x, sides.y), shorter = std::min(sides.x, sides.y);
    if (finds(place, 0.5f * (longer + shorter)) || !(longer > 0))
        return at(place);
    if (const auto mean = meanNear(place, {longer, std::max(shorter, thinnest * longer)}))
        return *mean;
    return meanOver(gradient_, place, longer, shorter, at(place));
}

/// Colours are quadratic in u, so the mean over the stretch alone is that in the middle and bend times the
/// variance. Beyond a stop, at a distance d from the middle, the density is (r - x) / (longer shorter) with r
/// the reach, less (f - x) / (longer shorter) as far as f, half of the sides' difference; to be integrated
/// are 1, x - d and its square.
std::optional<Float4> Ramp::meanNear(float place, const Sides& sides) {
    const float reach = sides.reach(), flat = 0.5f * (sides.longer - sides.shorter);
    if (!(high_ - low_ >= minStretch * reach))
        return {};
    Float4 mean = at(place);
    if (!isPremultiplied_) {
        const float variance = (sides.longer * sides.longer + sides.shorter * sides.shorter) / 12;
        mean += variance * bendOf(slope_);
    }
    const float density = 1 / (sides.longer * sides.shorter);
    for (const bool isAbove : {false, true}) {
        const float distance = isAbove ? high_ - place : place - low_, x = reach - distance;
        if (!(x > 0))
            continue;
        const Beyond& other = beyond(isAbove);
        if (!(x <= other.length))
            return {};
        const float y = std::max(flat - distance, 0.0f), height = (y > 0 ? sides.shorter : x) * density;
        mean += height * (0.5f * (x + y)) * other.jump;
        mean += height * ((1.0f / 6) * (x * x + x * y + y * y)) * other.change;
        mean += height * ((1.0f / 12) * (x + y) * (x * x + y * y)) * other.bend;
    }
    return mean;
}

const Ramp::Beyond& Ramp::beyond(bool isAbove) {
    Beyond& known = beyond_[std::size_t(isAbove)];
    if (std::exchange(knowsBeyond_[std::size_t(isAbove)], true))
        return known;
    const Ends here = endsOf(gradient_, number_);
    const Float4 color = isAbove ? here.last : here.first;
    const Neighbour next = neighbour(isAbove);
    const Float4 change = changeOf(next.color, next.slope) - changeOf(color, here.slope);
    return known = Beyond{next.length, premultiplied(next.color) - premultiplied(color),
                          isAbove ? change : -change, bendOf(next.slope) - bendOf(here.slope)};
}

/// Stretches of no length are passed over. Periodic ramps go on at the other end, reflected ones turn back.
Ramp::Neighbour Ramp::neighbour(bool isAbove) const {
    const std::size_t count = gradient_.size() + 1;  // of stretches
    const bool turns = gradient_.gradient().spread == Spread::Reflect;
    std::size_t number = number_;
    do {
        const bool isLast = number == (isAbove ? count - 1 : 0);
        if (isLast && turns) {
            const Ends here = endsOf(gradient_, number_);
            return {here.length, isAbove ? here.last : here.first, -here.slope};
        }
        number = isAbove ? (isLast ? 0 : number + 1) : (isLast ? count - 1 : number - 1);
        const Ends next = endsOf(gradient_, number);
        if (next.length > 0)
            return {next.length, isAbove ? next.first : next.last, next.slope};
    } while (number != number_);
    return {0, Float4{}, Float4{}};
}

void Ramp::find(float place) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::size_t upTo = stopsUpTo(gradient_, place), count = gradient_.size();
    const bool isBefore = upTo == 0, isBehind = upTo == count;
    number_ = upTo;
    knowsBeyond_ = {};
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
    widest_ = isPremultiplied_ ? infinity : std::sqrt(3 * maxBending / largest(bendOf(slope_)));
    if (isPremultiplied_) {
        slope_ *= color_[3];
        color_ = premultiplied(color_);
    }
}

}  // namespace vtm::asset
