/// \file
/// The colours of an asset's paints in single pixels of a view.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/view.hpp>
#include "raster/chord_scanner.hpp"

namespace vtm::asset {

class PixelPaints {
public:
    /// The asset must outlive it.
    PixelPaints(const AssetView& asset, std::shared_ptr<const Images> images, const View& view);
    ~PixelPaints();

    /// Whether parts of a pixel may differ enough to matter.
    bool isSteep(std::uint32_t paint) const;
    /// The mean over a pixel, premultiplied.
    glm::vec4 color(std::uint32_t paint, int x, int row) const;
    /// Over its quarters, by rows.
    std::array<glm::vec4, 4> quarters(std::uint32_t paint, int x, int row) const;

private:
    struct Impl;
    std::unique_ptr<const Impl> impl_;
};

}  // namespace vtm::asset
