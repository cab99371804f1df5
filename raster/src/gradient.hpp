/// \file
/// Gradients of paint programs; twin of backend_gl/shaders/shared/gradient.glsl.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

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

/// Circles that lie within each other; points are counted from the focus.
struct NestedCircles {
    glm::vec2 f{0};
    float fr = 0, a = 1, inverse = 1;

    NestedCircles() = default;
    NestedCircles(glm::vec2 focus, float focalRadius);

    /// u = b + root.
    float b(float x, float y) const { return (x * f.x + y * f.y - fr * (1 - fr)) * inverse; }
    float root(float b, float squared) const {
        return std::sqrt(std::max(b * b + (squared - fr * fr) * inverse, 0.0f));
    }
    /// u at first, first + change and so on: b and what is under the root are polynomials of the step.
    void rowOffsets(glm::vec2 first, glm::vec2 change, std::span<float> offsets) const;
};

struct PixelRange {
    std::size_t first, end;
};
/// Which of `count` points, first, first + change and so on, may be no further from 0 than that, squared.
PixelRange nearOrigin(glm::vec2 first, glm::vec2 change, float squared, std::size_t count);

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
