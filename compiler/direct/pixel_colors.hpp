/// \file
/// Paints of regions that are smaller than pixels: composited where they are asked for, and forgotten.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>
#include "compiler/lower/lowered_scene.hpp"
#include "compiler/paint/palette.hpp"
#include "raster/pixel_paints.hpp"

namespace vtm::compiler {

/// Where a region is asked for its paint.
struct PixelPlace {
    int x, row;
    glm::vec2 middle;  ///< of what it has of the pixel, whose upper left corner is (0, 0)
};

/// For one thread. All that it is given must outlive it.
class PixelColors {
public:
    PixelColors(const LoweredScene& picture, std::span<const image::Bitmap> bitmaps,
                const std::shared_ptr<const asset::Images>& images, const asset::View& view)
        : picture_(picture), bitmaps_(bitmaps), images_(images), view_(view) {}

    /// What a program makes of the means of its layers over a pixel; where these are steep, over its
    /// quarters, and between their middles what is between. `key` stands for the program.
    glm::vec4 color(std::uint64_t key, std::span<const PaintStep> program, const PixelPlace& place);

private:
    using Float4 = float __attribute__((vector_size(16)));
    /// Of a pixel's quarters, by rows; or the first for all.
    using Quarters = std::array<Float4, 4>;
    /// What was asked for in a pixel.
    struct Known {
        std::uint64_t key = 0;
        int x = -1, row = -1;
        bool isSteep = false;
        Quarters quarters;
    };
    /// Of the picture's sources.
    struct Sources {
        asset::Asset asset;
        std::vector<std::uint32_t> paints;  ///< by texel of the picture's data
        std::vector<std::uint8_t> isSteep;  ///< so too
        std::optional<asset::PixelPaints> pixels;
    };

    void make();
    bool isSteep(std::span<const PaintStep> program) const;
    template <std::size_t parts>
    Quarters composite(std::span<const PaintStep> program, int x, int row);
    const Known& ofLayer(std::uint32_t data, int x, int row);
    template <class Make>
    static const Known& remembered(std::vector<Known>& known, std::uint64_t key, int x, int row,
                                   const Make& make);

    const LoweredScene& picture_;
    const std::span<const image::Bitmap> bitmaps_;
    const std::shared_ptr<const asset::Images>& images_;
    const asset::View& view_;
    std::unique_ptr<Sources> sources_;      ///< null until a layer is asked for
    std::vector<Known> programs_, layers_;  ///< that were asked for near each other
    std::vector<Quarters> groups_;          ///< that are open
};

}  // namespace vtm::compiler
