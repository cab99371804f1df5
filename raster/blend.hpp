/// \file
/// Compositing of premultiplied colours; twin of backend_gl/shaders/shared/blend.glsl.
/// Source: W3C Compositing and Blending Level 1.
#pragma once

#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

inline glm::vec4 over(glm::vec4 source, glm::vec4 backdrop) { return source + (1 - source.a) * backdrop; }

/// Section 9.1 and 10: source-over with the mode's mixing where both cover.
glm::vec4 blend(Blend mode, glm::vec4 source, glm::vec4 backdrop);

/// The same colour in linear light, premultiplied too.
glm::vec4 light(glm::vec4 color);

/// What a mask leaves of the picture at one place: `op` is one of the PopMask operations.
float maskFactor(Op op, glm::vec4 mask);

}  // namespace vtm::asset
