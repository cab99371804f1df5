/// \file
/// The CPU evaluator: the fragment shaders' twin, in the same single precision, for finding which
/// side of the backend is wrong and for drawing where there is no GPU.
#pragma once

#include <functional>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/view.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// The premultiplied colour of Asset::materials[material] at point p of its own space: the twin of its GLSL.
using MaterialFunction = std::function<glm::vec4(std::uint32_t material, glm::vec2 p)>;

/// Draws the asset on transparent black; materials in their fallback colours unless there is a function for
/// them. Throws std::length_error if the view is beyond its limits.
image::Raster evaluate(const AssetView& asset, const View& view, const MaterialFunction& materials = {});

/// The same as shaders draw it, which have nothing finer than quarters of pixels (docs/coverage.md, rough
/// pixels).
image::Raster evaluateAsShaders(const AssetView& asset, const View& view,
                                const MaterialFunction& materials = {});

}  // namespace vtm::asset

#pragma GCC visibility pop
