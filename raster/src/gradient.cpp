#include "raster/src/gradient.hpp"

#include <algorithm>
#include <cmath>

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

struct PixelRange {
    std::size_t first, end;
};

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

    /// Which of `count` pixels are not far from the tip.
    PixelRange nearTip(std::size_t count) const {
        const float steps = glm::dot(change, change),
                    middle = steps > 0 ? -glm::dot(first, change) / steps : 0;
        const vec2 d = first + middle * change;
        const float rest = farSquared() - glm::dot(d, d);
        if (!(rest >= 0))
            return {0, 0};
        const float half = steps > 0 ? std::sqrt(rest / steps) : 0, maximum = float(count);
        return {std::size_t(std::clamp(std::floor(middle - half), 0.0f, maximum)),
                std::size_t(std::clamp(std::ceil(middle + half) + 1, 0.0f, maximum))};
    }
};

/// Circles that lie within each other fill the plane: everywhere there is a root, the larger one, and u
/// changes by no more than 1 / (1 - fr - |f|) with the point. This is the least 1 - fr - |f| where
/// single precision has them, without care for what cancels.
constexpr float minGap = 0.1f;

/// u in such circles: u = b + sqrt(b² + c), each of radialOffset()'s divided by a. Along the row b and the
/// discriminant are polynomials of the step.
void nestedOffsets(const RadialRow& row, std::span<float> offsets) {
    const vec2 f = row.focus, d = row.first, change = row.change;
    const float fr = row.fr, grow = 1 - fr, a = grow * grow - glm::dot(f, f), inverse = 1 / a;
    const float b0 = (glm::dot(d, f) - fr * grow) * inverse, b1 = glm::dot(change, f) * inverse;
    const float c0 = (glm::dot(d, d) - fr * fr) * inverse, c1 = glm::dot(d, change) * inverse,
                c2 = glm::dot(change, change) * inverse;
    const float s0 = b0 * b0 + c0, s1 = 2 * (b0 * b1 + c1), s2 = b1 * b1 + c2;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const float t = float(int(i));
        offsets[i] = b0 + t * b1 + std::sqrt(std::max(s0 + t * (s1 + t * s2), 0.0f));
    }
}

void spreadOffsets(Spread spread, std::span<float> offsets) {
    if (spread != Spread::Pad)
        for (float& u : offsets)
            u = spreadOffset(spread, u);
}

/// Anywhere; whether all are far from the tip.
bool nestedOffsets(const RadialPixels& pixels, const std::array<float, 6>& m, std::span<const vec2> points,
                   std::span<float> offsets) {
    const vec2 f = pixels.focus, origin = vec2(m[4], m[5]) - f;
    const float fr = pixels.fr, grow = 1 - fr, inverse = 1 / (grow * grow - glm::dot(f, f));
    const float far = pixels.farSquared();
    int near = 0;  // counted without a branch
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const float x = m[0] * points[i].x + m[2] * points[i].y + origin.x;
        const float y = m[1] * points[i].x + m[3] * points[i].y + origin.y;
        const float squared = x * x + y * y, b = (x * f.x + y * f.y - fr * grow) * inverse;
        offsets[i] = b + std::sqrt(std::max(b * b + (squared - fr * fr) * inverse, 0.0f));
        near += int(squared <= far);
    }
    return near == 0;
}

/// `places`: before they are spread.
void fillLinear(const GradientView& view, std::span<float> places, vec2 sides, std::span<Float4> colors) {
    spreadOffsets(view.gradient().spread, places);
    Ramp ramp(view);
    const float reach = 0.5f * (std::abs(sides.x) + std::abs(sides.y));
    ramp.over(places, reach, colors, [&](std::size_t i) { return ramp.over(places[i], sides); });
}

}  // namespace

void linearColors(const GradientView& view, vec2 point, vec2 step, const glm::mat2& pixel,
                  std::span<Float4> colors) {
    const std::array<float, 6>& m = view.gradient().matrix;
    const vec2 row(m[0], m[2]);
    const float first = applyMatrix(m, point).x, change = glm::dot(row, step);
    std::array<float, longestRow> offsets;
    const std::span<float> places = std::span(offsets).first(colors.size());
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = first + float(int(i)) * change;
    fillLinear(view, places, row * pixel, colors);
}

void linearColors(const GradientView& view, std::span<const vec2> points, const glm::mat2& pixel,
                  std::span<Float4> colors) {
    const std::array<float, 6>& m = view.gradient().matrix;
    std::array<float, longestRow> offsets;
    const std::span<float> places = std::span(offsets).first(colors.size());
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = applyMatrix(m, points[i]).x;
    fillLinear(view, places, vec2(m[0], m[2]) * pixel, colors);
}

void radialColors(const GradientView& view, vec2 point, vec2 step, const glm::mat2& pixel,
                  std::span<Float4> colors) {
    const Gradient& gradient = view.gradient();
    const RadialRow row(gradient, point, step, pixel);
    Ramp ramp(view);
    const std::size_t count = colors.size();
    const float gap = 1 - gradient.fr - glm::length(row.focus);
    const PixelRange near = gap < minGap ? PixelRange{0, count} : row.nearTip(count);
    for (std::size_t i = near.first; i < near.end; ++i)
        colors[i] = row.color(row.fromFocus(i), gradient.spread, ramp);
    if (near.first == 0 && near.end == count)
        return;
    std::array<float, longestRow> offsets;
    const std::span<float> places = std::span(offsets).first(count);
    nestedOffsets(row, places);
    spreadOffsets(gradient.spread, places);
    const float reach = row.reach(gap);
    const auto fill = [&](std::size_t first, std::size_t end) {
        ramp.over(places.subspan(first, end - first), reach, colors.subspan(first, end - first),
                  [&](std::size_t i) { return row.color(row.fromFocus(first + i), gradient.spread, ramp); });
    };
    fill(0, near.first);
    fill(near.end, count);
}

void radialColors(const GradientView& view, std::span<const vec2> points, const glm::mat2& pixel,
                  std::span<Float4> colors) {
    const Gradient& gradient = view.gradient();
    const RadialPixels pixels(gradient, pixel);
    Ramp ramp(view);
    const auto colorAt = [&](std::size_t i) {
        return pixels.color(applyMatrix(gradient.matrix, points[i]) - pixels.focus, gradient.spread, ramp);
    };
    std::array<float, longestRow> offsets;
    const std::span<float> places = std::span(offsets).first(colors.size());
    const float gap = 1 - gradient.fr - glm::length(pixels.focus);
    if (gap < minGap || !nestedOffsets(pixels, gradient.matrix, points, places)) {
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = colorAt(i);
        return;
    }
    spreadOffsets(gradient.spread, places);
    ramp.over(places, pixels.reach(gap), colors, colorAt);
}

}  // namespace vtm::asset
