/// \file
/// The CPU evaluator: the counterpart of the fragment shaders, in the same single precision. It helps to
/// locate faults in the backend and draws where there is no GPU.
#pragma once

#include <functional>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/view.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

/// Returns the premultiplied colour of Asset::materials[material] at point p of the material's space, as its
/// GLSL does.
using MaterialFunction = std::function<glm::vec4(std::uint32_t material, glm::vec2 p)>;

/// Draws the asset on transparent black. Materials get their fallback colours unless `materials` is set.
/// Throws std::length_error if the view exceeds the limits in vtm/raster/view.hpp.
image::Raster evaluate(const AssetView& asset, const View& view, const MaterialFunction& materials = {});

/// The same with the shaders' resolution of a quarter of a pixel (docs/coverage.md, rough pixels).
image::Raster evaluateAsShaders(const AssetView& asset, const View& view,
                                const MaterialFunction& materials = {});

}  // namespace vtm::asset

#pragma GCC visibility pop
