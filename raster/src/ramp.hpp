/// \file
/// A gradient's ramp of colours: means over pixels, exact but for what docs/coverage.md says.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include <glm/vec2.hpp>

#include "asset/records.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Where the ramp is to be asked: within it, but for padded ones, which go on at both ends.
inline float spreadOffset(Spread spread, float u) {
    switch (spread) {
        case Spread::Reflect:
            return 1 - std::abs(1 - (u - 2 * std::floor(u / 2)));
        case Spread::Repeat:
            return u - std::floor(u);
        default:
            return u;
    }
}

/// Premultiplied, what straight colours change by from `color` on; and by the square of the distance.
inline Float4 changeOf(Float4 color, Float4 slope) {
    return color * Float4{slope[3], slope[3], slope[3], 0} + slope * Float4{color[3], color[3], color[3], 1};
}
inline Float4 bendOf(Float4 slope) { return slope * Float4{slope[3], slope[3], slope[3], 0}; }

/// A ramp that is asked for neighbours: it keeps the stretch between two stops that it was asked for last.
/// Places are what spreadOffset() gives.
class Ramp {
public:
    explicit Ramp(const GradientView& gradient)
        : gradient_(gradient), isPadded_(gradient.gradient().spread == Spread::Pad) {}

    /// The mean over a pixel whose sides change u by `sides`, exactly. Where the pixel has nothing but a
    /// little of one stretch, it is the colour in the middle.
    Float4 over(float place, glm::vec2 sides);

    /// Over pixels none of which reaches further to either side; otherwise(i) where that is too far. Returns
    /// the colour instead if all lie where the ramp has one.
    template <class Otherwise>
    std::optional<Float4> over(std::span<const float> places, float reach, std::span<Float4> colors,
                               Otherwise&& otherwise) {
        for (std::size_t i = 0; i < places.size();) {
            if (!finds(places[i], reach)) {
                colors[i] = otherwise(i);
                ++i;
                continue;
            }
            const std::size_t count =
                countWithin(places.subspan(i), low_ + reach, std::min(next_, high_ - reach));
            if (count == places.size() && largest(slope_) == 0)
                return color_;
            fill(places.subspan(i, count), &colors[i]);
            i += count;
        }
        return {};
    }

    /// The same of a padded ramp, over pixels whose places are `change` apart, of which `first` is the first.
    template <class Otherwise>
    std::optional<Float4> overRow(float first, float change, float reach, std::span<Float4> colors,
                                  Otherwise&& otherwise) {
        for (std::size_t i = 0; i < colors.size();) {
            const float place = first + float(int(i)) * change;
            if (!finds(place, reach)) {
                colors[i++] = otherwise(place);
                continue;
            }
            // One step less than fit: rounding does not matter.
            const float end = change > 0 ? std::min(next_, high_ - reach) : low_ + reach;
            const auto most = int(colors.size() - i);
            const float steps = change == 0 ? float(most) : (end - place) / change;
            const auto count = std::size_t(steps < float(most) ? std::max(int(steps), 1) : most);
            if (count == colors.size() && largest(slope_) == 0)
                return color_;
            fillRow(place, change, colors.subspan(i, count));
            i += count;
        }
        return {};
    }

private:
    /// How many places, the first of them in any case, are from `low` to below `high`, one after the other.
    static std::size_t countWithin(std::span<const float> places, float low, float high) {
        int within = 0;  // mostly all of them, which is counted without a branch
        for (const float place : places)
            within += int(place >= low) & int(place < high);
        if (std::size_t(within) == places.size())
            return places.size();
        std::size_t count = 1;
        while (count < places.size() && places[count] >= low && places[count] < high)
            ++count;
        return count;
    }

    /// What the ramp differs by from the stretch, if that went on: jump + x change + x² bend at a distance x
    /// from its end, as far as `length`.
    struct Beyond {
        float length;
        Float4 jump, change, bend;
    };
    /// What comes next beyond an end of the stretch: its length, and there its straight colour and what that
    /// changes by with u.
    struct Neighbour {
        float length;
        Float4 color, slope;
    };
    /// The two numbers whose sum u is, less that of the middle, are even over intervals of these lengths.
    struct Sides {
        float longer, shorter;

        float reach() const { return 0.5f * (longer + shorter); }
    };

    bool holds(float place, float reach) const {
        return place - reach >= low_ && place + reach <= high_ && place < next_ && reach <= widest_;
    }
    bool finds(float place, float reach) {
        if (holds(place, reach))
            return true;
        if (place >= low_ && place < next_)
            return false;
        find(place);
        return holds(place, reach);
    }
    Float4 lineAt(float place) const { return color_ + (place - start_) * slope_; }
    Float4 at(float place) const { return isPremultiplied_ ? lineAt(place) : premultiplied(lineAt(place)); }
    void fill(std::span<const float> places, Float4* colors) const {
        if (isPremultiplied_)
            for (const float place : places)
                *colors++ = lineAt(place);
        else
            for (const float place : places)
                *colors++ = premultiplied(lineAt(place));
    }

    void fillRow(float place, float change, std::span<Float4> colors) const {
        if (isPremultiplied_)
            fillSteps(lineAt(place), change * slope_, colors, [](Float4 color) { return color; });
        else
            fillSteps(lineAt(place), change * slope_, colors, premultiplied);
    }
    /// Four at a time, since each sum waits for the one before it.
    template <class ColorOf>
    static void fillSteps(Float4 first, Float4 step, std::span<Float4> colors, ColorOf&& colorOf) {
        std::array<Float4, 4> next{first, first + step, first + 2 * step, first + 3 * step};
        std::size_t i = 0;
        for (; i + 4 <= colors.size(); i += 4)
            for (std::size_t k = 0; k < 4; ++k) {
                colors[i + k] = colorOf(next[k]);
                next[k] += 4 * step;
            }
        for (std::size_t k = 0; i < colors.size(); ++i, ++k)
            colors[i] = colorOf(next[k]);
    }

    void find(float place);
    /// The mean over a pixel in whose reach are this stretch and its neighbours alone.
    std::optional<Float4> meanNear(float place, const Sides& sides);
    const Beyond& beyond(bool isAbove);
    Neighbour neighbour(bool isAbove) const;

    const GradientView& gradient_;
    bool isPadded_;
    // The stretch, of which its upper end is not a part: colours at `start_` and what they change by, which
    // are premultiplied where alpha does not change; up to which reach it is straight. None at first.
    float low_ = 1, high_ = 0, next_ = 0, widest_ = 0, start_ = 0;
    Float4 color_{}, slope_{};
    bool isPremultiplied_ = true;
    std::size_t number_ = 0;             ///< of the stop at which it ends
    std::array<Beyond, 2> beyond_;       ///< below it and above
    std::array<bool, 2> knowsBeyond_{};  ///< once they have been asked for
};

}  // namespace vtm::asset
