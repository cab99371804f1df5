#include "raster/src/gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>

#include "raster/src/ramp.hpp"

namespace vtm::asset {

namespace {

using glm::vec2;

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

/// `above`: D², `all`: T, `radial`: R.
struct Cone {
    float higher;    ///< the mean of u over the pixel is so much more than in its middle
    float narrower;  ///< what sides change u by, times that, has the variance

    /// Without a branch, so that rows of them are made four at once.
    Cone(float above, float all, float radial) {
        constexpr float least = std::numeric_limits<float>::min();
        const float isNear = float(int(radial > 0) & int(above <= farFromTip * all));
        const float near = 1 / (1 + 6.6f * above / std::max(all, least)), tip = 0.0315f * all * near * near;
        const float squared = above + std::max(all - radial, 0.0f) / 12 + tip;
        const float rest = 1 - isNear * std::min(12 * tip / std::max(radial, least), 1.0f);
        higher = isNear * (std::sqrt(squared) - std::sqrt(above));
        narrower = std::sqrt(rest);
    }
};

Spot conePixel(const Root& root, vec2 d, const glm::mat2& sides) {
    const vec2 along = root.slope * sides;
    const float steep = glm::dot(root.slope, root.slope);
    const float allSides = glm::dot(sides[0], sides[0]) + glm::dot(sides[1], sides[1]);
    const Cone cone(steep * glm::dot(d, d), steep * allSides, glm::dot(along, along));
    return {root.u + cone.higher, along * cone.narrower};
}

/// Where the middle of a pixel is nearer to the focus than this share of its side, it is put there: at the
/// focus itself there is no slope.
constexpr float besideFocus = 1e-3f;

/// Pixels in a radial gradient's space.
struct RadialPixels {
    glm::mat2 sides;
    vec2 focus;
    float fr;

    RadialPixels(const Gradient& gradient, const glm::mat2& pixel)
        : sides(linearOf(gradient) * pixel), focus(gradient.fx, gradient.fy), fr(gradient.fr) {}

    static glm::mat2 linearOf(const Gradient& gradient) {
        const std::array<float, 6>& m = gradient.matrix;
        return {m[0], m[1], m[2], m[3]};
    }

    /// `d`: of the middle from the focus.
    Float4 color(vec2 d, Spread spread, Ramp& ramp) const {
        const float atFocus = besideFocus * glm::length(sides[0]);
        if (glm::dot(d, d) < atFocus * atFocus)
            d = besideFocus * sides[0];
        const Root root = radialOffset(focus + d, focus, fr);
        if (!root.real)
            return Float4{};
        const Spot spot = conePixel(root, d, sides);
        return ramp.over(spreadOffset(spread, spot.u), spot.sides);
    }

    /// Pixels further from the focus are far from the tip.
    float farSquared() const {
        return farFromTip * (glm::dot(sides[0], sides[0]) + glm::dot(sides[1], sides[1]));
    }
    /// Where circles lie within each other by `gap`, u changes by no more than this from a pixel's middle.
    float reach(float gap) const { return 0.5f * (glm::length(sides[0]) + glm::length(sides[1])) / gap; }
};

/// Those of a row.
struct RadialRow : RadialPixels {
    vec2 first, change;  ///< from the focus

    RadialRow(const Gradient& gradient, vec2 point, vec2 step, const glm::mat2& pixel)
        : RadialPixels(gradient, pixel),
          first(applyMatrix(gradient.matrix, point) - focus),
          change(linearOf(gradient) * step) {}

    vec2 fromFocus(std::size_t i) const { return first + float(i) * change; }
};

using Numbers = std::array<float, longestRow>;

/// Middles of pixels, from the focus. Each number has an array of its own, so that the compiler takes four
/// pixels at once.
struct Middles {
    Numbers x, y;
    std::size_t count;
};

/// As RadialPixels::color() sees pixels: u, and what the sides change it by.
struct Spots {
    Numbers u, first, second;
};

/// Of pixels first to end - 1, far from the tip, or anywhere.
template <bool isFar>
void someSpots(const NestedCircles& circles, const RadialPixels& pixels, const Middles& middles,
               std::size_t first, std::size_t end, Spots& spots) {
    const vec2 f = circles.f, one = pixels.sides[0], other = pixels.sides[1];
    const float allSides = glm::dot(one, one) + glm::dot(other, other);
    const vec2 beside = besideFocus * one;
    const float atFocus = glm::dot(beside, beside);
    for (std::size_t i = first; i < end; ++i) {
        float x = middles.x[i], y = middles.y[i];
        if constexpr (!isFar) {
            const bool isAtFocus = x * x + y * y < atFocus;
            x = isAtFocus ? beside.x : x;
            y = isAtFocus ? beside.y : y;
        }
        const float squared = x * x + y * y, b = circles.b(x, y), root = circles.root(b, squared);
        const float u = b + root, steepness = 1 / std::max(circles.a * root, 1e-6f);
        const float slopeX = (u * f.x + x) * steepness, slopeY = (u * f.y + y) * steepness;
        const float along = slopeX * one.x + slopeY * one.y, across = slopeX * other.x + slopeY * other.y;
        if constexpr (isFar) {
            spots.u[i] = u;
            spots.first[i] = along;
            spots.second[i] = across;
        } else {
            const float steep = slopeX * slopeX + slopeY * slopeY;
            const Cone cone(steep * squared, steep * allSides, along * along + across * across);
            spots.u[i] = u + cone.higher;
            spots.first[i] = along * cone.narrower;
            spots.second[i] = across * cone.narrower;
        }
    }
}

void nestedSpots(const NestedCircles& circles, const RadialPixels& pixels, const Middles& middles,
                 Spots& spots) {
    constexpr std::size_t together = 16;
    const float farSquared = pixels.farSquared();
    for (std::size_t i = 0; i < middles.count; i += together) {
        const std::size_t end = std::min(i + together, middles.count);
        int near = 0;
        for (std::size_t k = i; k < end; ++k)
            near += int(middles.x[k] * middles.x[k] + middles.y[k] * middles.y[k] <= farSquared);
        if (near == 0)
            someSpots<true>(circles, pixels, middles, i, end, spots);
        else
            someSpots<false>(circles, pixels, middles, i, end, spots);
    }
}

void spreadOffsets(Spread spread, std::span<float> offsets) {
    if (spread == Spread::Reflect)
        for (float& u : offsets)
            u = spreadOffset(Spread::Reflect, u);
    else if (spread == Spread::Repeat)
        for (float& u : offsets)
            u = spreadOffset(Spread::Repeat, u);
}

/// From a pixel's middle, of what its sides change u by.
float reachOf(vec2 sides) { return 0.5f * (std::abs(sides.x) + std::abs(sides.y)); }

/// `places`: before they are spread.
std::optional<Float4> fillLinear(const GradientView& view, std::span<float> places, vec2 sides,
                                 std::span<Float4> colors) {
    spreadOffsets(view.gradient().spread, places);
    Ramp ramp(view);
    return ramp.over(places, reachOf(sides), colors,
                     [&](std::size_t i) { return ramp.over(places[i], sides); });
}

}  // namespace

/// radialOffset(), each of its numbers divided by a: u = b + sqrt(b² + c).
NestedCircles::NestedCircles(vec2 focus, float focalRadius)
    : f(focus), fr(focalRadius), a((1 - fr) * (1 - fr) - glm::dot(f, f)), inverse(1 / a) {}

void NestedCircles::rowOffsets(vec2 first, vec2 change, std::span<float> offsets) const {
    const CircleSteps steps = stepsFrom(first, change);
    for (std::size_t i = 0; i < offsets.size(); ++i)
        offsets[i] = steps.at(float(int(i)));
}

std::optional<Float4> linearColors(const GradientView& view, vec2 point, vec2 step, const glm::mat2& pixel,
                                   std::span<Float4> colors) {
    const std::array<float, 6>& m = view.gradient().matrix;
    const vec2 row(m[0], m[2]), sides = row * pixel;
    const float first = applyMatrix(m, point).x, change = glm::dot(row, step);
    if (view.gradient().spread == Spread::Pad) {
        Ramp ramp(view);
        return ramp.overRow(first, change, reachOf(sides), colors,
                            [&](float place) { return ramp.over(place, sides); });
    }
    std::array<float, longestRow> offsets;
    const std::span<float> places = std::span(offsets).first(colors.size());
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = first + float(int(i)) * change;
    return fillLinear(view, places, sides, colors);
}

std::optional<Float4> linearColors(const GradientView& view, std::span<const vec2> points,
                                   const glm::mat2& pixel, std::span<Float4> colors) {
    const std::array<float, 6>& m = view.gradient().matrix;
    std::array<float, longestRow> offsets;
    const std::span<float> places = std::span(offsets).first(colors.size());
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = applyMatrix(m, points[i]).x;
    return fillLinear(view, places, vec2(m[0], m[2]) * pixel, colors);
}

namespace {

/// Pixels of a radial gradient, with what they share.
class RadialFill {
public:
    RadialFill(const GradientView& view, const RadialPixels& pixels)
        : pixels_(pixels),
          spread_(view.gradient().spread),
          gap_(1 - pixels.fr - glm::length(pixels.focus)),
          circles_(pixels.focus, pixels.fr),
          ramp_(view) {}

    bool isNested() const { return gap_ >= minGap; }
    const NestedCircles& circles() const { return circles_; }

    /// One by one; `d`: from the focus.
    Float4 color(vec2 d) { return pixels_.color(d, spread_, ramp_); }
    /// Far from the tip, in nested circles. `offsets`: before they are spread; colorAt(i): of one of them.
    template <class ColorAt>
    std::optional<Float4> fillFar(std::span<float> offsets, std::span<Float4> colors, ColorAt&& colorAt) {
        spreadOffsets(spread_, offsets);
        return ramp_.over(offsets, pixels_.reach(gap_), colors, colorAt);
    }
    /// Anywhere, in nested circles.
    std::optional<Float4> fill(const Middles& middles, std::span<Float4> colors) {
        Spots spots;
        nestedSpots(circles_, pixels_, middles, spots);
        return fillFar(std::span(spots.u).first(middles.count), colors, [&](std::size_t i) {
            return ramp_.over(spots.u[i], {spots.first[i], spots.second[i]});
        });
    }

private:
    const RadialPixels& pixels_;
    const Spread spread_;
    const float gap_;
    const NestedCircles circles_;
    Ramp ramp_;
};

}  // namespace

std::optional<Float4> radialColors(const GradientView& view, vec2 point, vec2 step, const glm::mat2& pixel,
                                   std::span<Float4> colors) {
    const RadialRow row(view.gradient(), point, step, pixel);
    RadialFill fill(view, row);
    const std::size_t count = colors.size();
    if (!fill.isNested()) {
        for (std::size_t i = 0; i < count; ++i)
            colors[i] = fill.color(row.fromFocus(i));
        return {};
    }
    const PixelRange near = nearOrigin(row.first, row.change, row.farSquared(), count);
    Numbers offsets;
    const std::span<float> places = std::span(offsets).first(count);
    const auto fillFar = [&](std::size_t first, std::size_t end) {
        return fill.fillFar(places.subspan(first, end - first), colors.subspan(first, end - first),
                            [&](std::size_t i) { return fill.color(row.fromFocus(first + i)); });
    };
    const auto put = [&](std::size_t first, std::size_t end, const std::optional<Float4>& color) {
        if (color)
            std::ranges::fill(colors.subspan(first, end - first), *color);
    };
    if (near.first < near.end) {
        Middles middles;
        middles.count = near.end - near.first;
        for (std::size_t i = 0; i < middles.count; ++i) {
            const vec2 d = row.fromFocus(near.first + i);
            middles.x[i] = d.x;
            middles.y[i] = d.y;
        }
        const auto color = fill.fill(middles, colors.subspan(near.first, middles.count));
        if (middles.count == count)
            return color;
        put(near.first, near.end, color);
    }
    fill.circles().rowOffsets(row.first, row.change, places);
    if (near.first == near.end)
        return fillFar(0, count);
    put(0, near.first, fillFar(0, near.first));
    put(near.end, count, fillFar(near.end, count));
    return {};
}

std::optional<Float4> radialColors(const GradientView& view, std::span<const vec2> points,
                                   const glm::mat2& pixel, std::span<Float4> colors) {
    const std::array<float, 6>& m = view.gradient().matrix;
    const RadialPixels pixels(view.gradient(), pixel);
    const vec2 origin = vec2(m[4], m[5]) - pixels.focus;
    Middles middles;
    middles.count = colors.size();
    for (std::size_t i = 0; i < middles.count; ++i) {
        middles.x[i] = m[0] * points[i].x + m[2] * points[i].y + origin.x;
        middles.y[i] = m[1] * points[i].x + m[3] * points[i].y + origin.y;
    }
    RadialFill fill(view, pixels);
    if (fill.isNested())
        return fill.fill(middles, colors);
    for (std::size_t i = 0; i < colors.size(); ++i)
        colors[i] = fill.color({middles.x[i], middles.y[i]});
    return {};
}

}  // namespace vtm::asset
