/// \file
/// A gradient's ramp of colours: means over pixels, exact but for what docs/coverage.md says.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include <glm/vec2.hpp>

#include "asset/records.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Where the ramp is to be asked: within it, but for padded ones, which go on at both ends.
float spreadOffset(Spread spread, float u);

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

    bool holds(float place, float reach) const {
        return place - reach >= low_ && place + reach <= high_ && place < next_ && reach <= widest_;
    }
    bool finds(float place, float reach) {
        if (holds(place, reach))
            return true;
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

    void find(float place);

    const GradientView& gradient_;
    bool isPadded_;
    // The stretch, of which its upper end is not a part: colours at `start_` and what they change by, which
    // are premultiplied where alpha does not change; up to which reach it is straight. None at first.
    float low_ = 1, high_ = 0, next_ = 0, widest_ = 0, start_ = 0;
    Float4 color_{}, slope_{};
    bool isPremultiplied_ = true;
};

}  // namespace vtm::asset
