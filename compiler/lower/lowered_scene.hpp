/// \file
/// The lowered scene: the scene with its geometry as closed outlines on the lattice (*layers*) and
/// its paints as the asset's records; groups, clips and masks as tables of indices.
///
/// Everything stands in painter's order. A layer is one outline with a fill rule; it belongs to an
/// item or to a clip. Layers of a group (its clip's first, then its items', then its mask's) are
/// consecutive, so "below" is "a smaller layer index".
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/scene/scene.hpp>
#include "compiler/lower/outline.hpp"

namespace vtm::compiler {

inline constexpr std::uint32_t noIndex = 0xFFFFFFFFu;

struct Layer {
    scene::FillRule rule = scene::FillRule::NonZero;
    std::uint32_t firstRun = 0, runCount = 0;  ///< of LoweredScene::outlines
    limits::Place place{};                     ///< of the item or the clip's shape, for messages
};

/// What an item is painted with.
struct Source {
    asset::Op op = asset::Op::Solid;  ///< Solid, Linear, Radial, Image or Material
    std::array<float, 4> color{};     ///< Solid: premultiplied
    std::uint32_t data = 0;           ///< otherwise: the record in LoweredScene::data
    bool opaque = false;              ///< alpha 1 everywhere
};

struct LoweredItem {
    std::uint32_t layer = 0;
    std::uint32_t source = 0;
    float opacity = 1;
    std::uint32_t group = 0;
};

/// Inside one of the terms, and inside `outer` if there is one.
struct ClipExpression {
    struct Term {
        std::uint32_t layer = 0;
        std::uint32_t clip = noIndex;
        bool inverted = false;  ///< outside the layer instead of inside
    };
    std::vector<Term> terms;
    std::uint32_t outer = noIndex;
};

enum class GroupRole : std::uint8_t { Plain, LuminanceMask, LinearMask, AlphaMask };

struct LoweredGroup {
    std::uint32_t parent = noIndex;
    GroupRole role = GroupRole::Plain;
    float opacity = 1;
    scene::BlendMode blend = scene::BlendMode::Normal;
    std::uint32_t clip = noIndex;
    std::uint32_t mask = noIndex;  ///< the mask's group, a child of this one that comes after the items
    unsigned depth = 0;
    /// The outside of a selection. Where regions are disjoint it is a group like any other; where coverage is
    /// a factor (compat mode) it is added to the inside, so that their shares add up to one.
    bool adds = false;
};

struct LoweredScene {
    Outlines outlines;
    std::vector<Layer> layers;
    std::vector<LoweredItem> items;  ///< painter's order; layers ascend
    std::vector<LoweredGroup>
        groups;  ///< parents before children; 0 is the ground, the scene's root lies in it
    std::vector<ClipExpression> clips;
    std::vector<Source> sources;
    std::vector<asset::Texel> data;  ///< gradients, image and material fills
    std::vector<std::shared_ptr<const image::Bitmap>> images;
    std::vector<asset::Material> materials;
    std::vector<std::uint32_t> itemOfLayer;  ///< noIndex: a clip's layer
    std::size_t sampledStrokes = 0;          ///< Result::sampledStrokes
    std::vector<std::string> warnings;       ///< what a limit removed
    bool lacksImages = false;  ///< patterns of too many tiles are left out, which PatternImages would draw
};

/// Copies, for the asset.
inline std::vector<image::Bitmap> bitmapsOf(const LoweredScene& picture) {
    std::vector<image::Bitmap> bitmaps;
    for (const auto& image : picture.images)
        bitmaps.push_back(*image);
    return bitmaps;
}

}  // namespace vtm::compiler
