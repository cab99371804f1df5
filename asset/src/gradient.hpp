/// \file
/// Gradients of paint programs; twin of backend_gl/shaders/gradient.glsl.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "asset/src/records.hpp"

namespace vtm::asset {

/// (m0 m1), (m2 m3), (m4 m5) as columns, applied to a picture point.
inline glm::vec2 applyMatrix(const std::array<float, 6>& m, glm::vec2 p) {
    return {m[0] * p.x + m[2] * p.y + m[4], m[1] * p.x + m[3] * p.y + m[5]};
}

/// Premultiplied mean colour over a pixel whose middle is a picture point and whose sides there are `pixel`;
/// 0: the colour at the point. Exact for linear gradients and pixels along their axis (docs/coverage.md).
glm::vec4 linearColor(const GradientView& gradient, glm::vec2 point, const glm::mat2& pixel);
glm::vec4 radialColor(const GradientView& gradient, glm::vec2 point, const glm::mat2& pixel);

}  // namespace vtm::asset
