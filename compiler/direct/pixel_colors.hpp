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
    struct Listed {
        std::uint32_t layer;
        bool inParts;
        std::uint32_t known = noIndex;  ///< of the pixel's colours
    };
    /// A layer, or those of a group that is more than its layers; or a run of such that are inside all over a
    /// pixel and laid over each other, and do not divide it.
    struct Part {
        std::uint32_t first, end;  ///< of the pixel's layers
        bool hasGroups;
        bool isWhole;          ///< it divides nothing
        bool isAlone;          ///< a layer that does
        bool isBlended;        ///< with what lies below it
        bool isKnown = false;  ///< its colours: the same in all regions
        Quarters colors{};
    };
    /// Regions that were asked for last, by their keys.
    struct Known {
        static constexpr std::size_t most = 16;
        std::array<std::uint64_t, most> keys{};  ///< 0 is that of no layers
        std::array<Quarters, most> quarters;
        std::size_t next = 0;  ///< to be forgotten
    };
    struct Pixel {
        std::vector<Listed> layers;  ///< from the top
        std::vector<Part> parts;     ///< from the top; none until it is asked
        std::vector<Quarters> colors;
        LightBelow below;
        bool isSteep = false;    ///< one of the layers
        bool isBlended = false;  ///< one of the parts
        Known known;
    };
    /// Of the picture's sources and groups.
    struct Sources {
        asset::Asset asset;
        std::vector<std::uint32_t> paints;  ///< by texel of the picture's data
        std::vector<std::uint8_t> isSteep;  ///< so too
        std::optional<asset::PixelPaints> pixels;
        std::vector<std::uint32_t> outer;  ///< by group: the outermost that is more than its layers
    };
    template <std::size_t quarters>
    class Groups;

    void make();
    void findOuter();
    const LoweredItem& itemOf(std::uint32_t layer) const {
        return picture_.items[picture_.itemOfLayer[layer]];
    }
    std::uint32_t outerOf(std::uint32_t layer) const { return sources_->outer[itemOf(layer).group]; }
    bool isBlended(std::uint32_t outer) const {
        return outer != noIndex && picture_.groups[outer].blend != scene::BlendMode::Normal;
    }
    const Quarters& regionOf(const RegionState& state, Pixel& pixel, int x) const;
    void divide(Pixel& pixel) const;
    template <std::size_t quarters>
    Quarters composite(const RegionState& state, Pixel& pixel, int x) const;
    template <std::size_t quarters>
    const Quarters& colorsOf(const RegionState& state, Pixel& pixel, Part& part, int x) const;
    template <std::size_t quarters>
    Quarters inGroups(const RegionState& state, Pixel& pixel, const Part& part, int x,
                      const Quarters& below) const;
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
