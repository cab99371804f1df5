/// \file
/// Paints and paint programs; twin of backend_gl/shaders/paint.glsl.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "asset/evaluate.hpp"

namespace vtm::asset {

/// Premultiplied colour of a paint at a picture point.
glm::vec4 paintColor(const AssetView& asset, std::uint32_t paint, glm::vec2 point,
                     const MaterialFunction& materials = {});

}  // namespace vtm::asset
