/// \file
/// Paints of regions that are smaller than pixels: composited where they are asked for, and forgotten.
///
/// Most layers that show in a pixel are inside all over it, in all of its regions. Those that lie next to
/// each other are composited once.
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
#include "compiler/direct/layer_cover.hpp"
#include "compiler/direct/region_state.hpp"
#include "compiler/lower/lowered_scene.hpp"
#include "raster/pixel_paints.hpp"

namespace vtm::compiler {

/// Where a region is asked for its paint.
struct PixelPlace {
    int x;
    glm::vec2 middle;  ///< of what it has of the pixel, whose upper left corner is (0, 0)
};

/// For one thread. All that it is given must outlive it.
class PixelColors {
public:
    PixelColors(const LoweredScene& picture, std::span<const image::Bitmap> bitmaps,
                const std::shared_ptr<const asset::Images>& images, const asset::View& view)
        : picture_(picture), bitmaps_(bitmaps), images_(images), view_(view) {}

    /// Then come the layers of the row's pixels, from the top.
    void beginRow(int row);
    /// A layer is inside all over the pixels from `first` to `end` - 1, or in parts of them.
    void add(const RegionState& state, std::uint32_t layer, std::int32_t first, std::int32_t end,
             bool inParts);

    /// What the layers that are inside make of their means over a pixel; where one may be steep, over its
    /// quarters, and between their middles what is between.
    glm::vec4 color(const RegionState& state, const PixelPlace& place);

private:
    using Float4 = float __attribute__((vector_size(16)));
    /// Of a pixel's quarters, by rows; or the first for all.
    using Quarters = std::array<Float4, 4>;
    /// Layers that are inside all over a pixel and laid over each other, or any other one.
    struct Part {
        std::uint32_t first, end;  ///< of the pixel's layers
        bool isKnown = false;
        Quarters colors;
    };
    struct Listed {
        std::uint32_t layer;
        bool inParts;
    };
    /// A region's.
    struct Known {
        std::uint64_t key = 0;  ///< that of no layers
        Quarters quarters{};
    };
    struct Pixel {
        std::vector<Listed> layers;  ///< from the top
        std::vector<Part> parts;     ///< from the top; none until it is asked
        LightBelow below;
        bool isSteep = false;        ///< one of the layers
        bool isLaidOver = true;      ///< each of them, one by one
        std::array<Known, 8> known;  ///< that were asked for last
    };
    /// Of the picture's sources.
    struct Sources {
        asset::Asset asset;
        std::vector<std::uint32_t> paints;  ///< by texel of the picture's data
        std::vector<std::uint8_t> isSteep;  ///< so too
        std::optional<asset::PixelPaints> pixels;
    };
    template <std::size_t quarters>
    class Groups;

    void make();
    const Source& sourceOf(std::uint32_t layer) const {
        return picture_.sources[picture_.items[picture_.itemOfLayer[layer]].source];
    }
    void divide(const RegionState& state, Pixel& pixel) const;
    template <std::size_t quarters>
    Quarters composite(const RegionState& state, Pixel& pixel, int x) const;
    template <std::size_t quarters>
    const Quarters& colorsOf(Pixel& pixel, Part& part, int x) const;
    Quarters colorsOf(std::uint32_t layer, int x, bool inQuarters) const;
    /// Lays what next() gives under each other, until it gives null or no light is left.
    template <std::size_t quarters, class Next>
    static Quarters stacked(Next next);

    const LoweredScene& picture_;
    const std::span<const image::Bitmap> bitmaps_;
    const std::shared_ptr<const asset::Images>& images_;
    const asset::View& view_;
    std::unique_ptr<Sources> sources_;  ///< null until a row begins
    std::vector<Pixel> pixels_;         ///< of the row
    int row_ = 0;
};

}  // namespace vtm::compiler
