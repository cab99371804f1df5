/// \file
/// Pixels of crowded cells: too much for a shader, so the CPU makes them (vtm/raster/scan.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/placement.hpp"
#include "raster/steepness.hpp"

namespace vtm::gl {

/// What stays in main memory of a sum of maps.
struct KeptAsset {
    asset::Asset asset;                       ///< without commands and prefilter
    std::vector<std::uint32_t> programTurns;  ///< by paint (turns.hpp)
    std::vector<asset::PaintChange> changes;  ///< by paint
};
KeptAsset keptOf(const asset::AssetView& asset);

/// Of one map, for one view after the other.
class ScannedPixels {
public:
    /// `asset` must outlive it.
    ScannedPixels(const asset::Asset& asset, const asset::Map& map) : asset_(&asset), map_(map) {}

    /// Puts the pixels of a box, that is not empty, into the texture. Materials have their fallback colours.
    void scan(const asset::View& view, const PixelBox& box, asset::Sums sums);
    /// RGBA32F, the box's first pixel at (0, 0): what tile shaders add up, premultiplied.
    const TextureHandle& texture() const { return texture_; }

private:
    const asset::Scanner& scannerFor(asset::Sums sums);

    const asset::Asset* asset_;
    asset::Map map_;
    std::array<std::optional<asset::Scanner>, 2> scanners_;  ///< by Sums, made when first needed
    glm::ivec2 size_{0};
    TextureHandle texture_;
};

}  // namespace vtm::gl
