/// \file
/// Gradients of paint programs; twin of backend_gl/shaders/shared/gradient.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "asset/records.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// (m0 m1), (m2 m3), (m4 m5) as columns, applied to a picture point.
inline glm::vec2 applyMatrix(const std::array<float, 6>& m, glm::vec2 p) {
    return {m[0] * p.x + m[2] * p.y + m[4], m[1] * p.x + m[3] * p.y + m[5]};
}

/// Colours of so many places are made together, at most.
inline constexpr std::size_t longestRow = 64;

/// Circles that lie within each other fill the plane: everywhere there is a root, the larger one, and u
/// changes by no more than 1 / (1 - fr - |f|) with the point. This is the least 1 - fr - |f| where
/// single precision has them, without care for what cancels.
inline constexpr float minGap = 0.1f;

/// Eight pixels from the tip of a radial gradient, whose square this is, the mean of u over a pixel is that
/// in the middle but for less than a 380th of what a pixel does.
inline constexpr float farFromTip = 64;

/// u along a row, t steps from where it begins: b + t change + sqrt(s0 + t (s1 + t s2)).
struct CircleSteps {
    float b, change, s0, s1, s2;

    template <class Number>  // or four of them
    Number at(Number t) const {
        return b + t * change + squareRoot(largerOf(s0 + t * (s1 + t * s2), Number{}));
    }
};

/// Circles that lie within each other; points are counted from the focus.
struct NestedCircles {
    glm::vec2 f{0};
    float fr = 0, a = 1, inverse = 1;

    NestedCircles() = default;
    NestedCircles(glm::vec2 focus, float focalRadius);

    /// u = b + root, of one point or of four.
    template <class Number>
    Number b(Number x, Number y) const {
        return (x * f.x + y * f.y - fr * (1 - fr)) * inverse;
    }
    template <class Number>
    Number root(Number b, Number squared) const {
        return squareRoot(largerOf(b * b + (squared - fr * fr) * inverse, Number{}));
    }
    /// Along first, first + change and so on: b and what is under the root are polynomials of the step.
    CircleSteps stepsFrom(glm::vec2 first, glm::vec2 change) const;
    /// u there.
    void rowOffsets(glm::vec2 first, glm::vec2 change, std::span<float> offsets) const;
};

inline CircleSteps NestedCircles::stepsFrom(glm::vec2 first, glm::vec2 change) const {
    const float b0 = b(first.x, first.y), b1 = glm::dot(change, f) * inverse;
    const float c0 = (glm::dot(first, first) - fr * fr) * inverse, c1 = glm::dot(first, change) * inverse,
                c2 = glm::dot(change, change) * inverse;
    return {b0, b1, b0 * b0 + c0, 2 * (b0 * b1 + c1), b1 * b1 + c2};
}

struct PixelRange {
    std::size_t first, end;
};
/// Which of `count` points, first, first + change and so on, may be no further from 0 than that, squared.
inline PixelRange nearOrigin(glm::vec2 first, glm::vec2 change, float squared, std::size_t count) {
    const float steps = glm::dot(change, change), middle = steps > 0 ? -glm::dot(first, change) / steps : 0;
    const glm::vec2 d = first + middle * change;
    const float rest = squared - glm::dot(d, d);
    if (!(rest >= 0))
        return {0, 0};
    const float half = steps > 0 ? std::sqrt(rest / steps) : 0, maximum = float(count);
    return {std::size_t(std::clamp(std::floor(middle - half), 0.0f, maximum)),
            std::size_t(std::clamp(std::ceil(middle + half) + 1, 0.0f, maximum))};
}

/// Premultiplied mean colours over up to longestRow pixels, one after the other: the middle of the first one
/// is a picture point, a step leads to the next one's, and their sides are `pixel`; 0: the colours at the
/// points. Exact for linear gradients and pixels along their axis (docs/coverage.md).
/// Returns the colour instead where it is seen to be the same everywhere.
std::optional<Float4> linearColors(const GradientView& gradient, glm::vec2 point, glm::vec2 step,
                                   const glm::mat2& pixel, std::span<Float4> colors);
std::optional<Float4> radialColors(const GradientView& gradient, glm::vec2 point, glm::vec2 step,
                                   const glm::mat2& pixel, std::span<Float4> colors);
/// The same over pixels whose middles are anywhere.
std::optional<Float4> linearColors(const GradientView& gradient, std::span<const glm::vec2> points,
                                   const glm::mat2& pixel, std::span<Float4> colors);
std::optional<Float4> radialColors(const GradientView& gradient, std::span<const glm::vec2> points,
                                   const glm::mat2& pixel, std::span<Float4> colors);

}  // namespace vtm::asset
