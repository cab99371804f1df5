/// \file
/// The lowered picture: the scene with its geometry as closed outlines on the lattice (*layers*) and
/// its paints as the asset's records; groups, clips and masks as tables of indices.
///
/// Everything stands in painter's order. A layer is one outline with a fill rule; it belongs to an
/// item or to a clip. Layers of a group (its clip's first, then its items', then its mask's) are
/// consecutive, so "below" is "a smaller layer index".
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/scene/scene.hpp>
#include "compiler/lower/error_budget.hpp"
#include "compiler/lower/outline.hpp"

namespace vtm::compiler {

class OutlineCache;

/// What becomes the picture: what `fromScene` maps from the scene into [0, width] × [0, height].
struct Excerpt {
    scene::Affine fromScene = scene::identity;
    double width = 0, height = 0;
    /// A small part of the scene: strokes are cut down to what is near, and gradients to the colours in it.
    bool isPart = false;
};
inline Excerpt wholeOf(const scene::Scene& scene) {
    return {scene::identity, scene.width, scene.height, false};
}

inline constexpr std::uint32_t none = 0xFFFFFFFFu;

struct Layer {
    scene::FillRule rule = scene::FillRule::NonZero;
    std::uint32_t firstRun = 0, runCount = 0;  ///< of Picture::outlines
    limits::Place place{};                     ///< of the item or the clip's shape, for messages
};

/// What an item is painted with.
struct Source {
    asset::Op op = asset::Op::Solid;  ///< Solid, Linear, Radial, Image or Material
    std::array<float, 4> color{};     ///< Solid: premultiplied
    std::uint32_t data = 0;           ///< otherwise: the record in Picture::data
    bool opaque = false;              ///< alpha 1 everywhere
};

struct PictureItem {
    std::uint32_t layer = 0;
    std::uint32_t source = 0;
    float opacity = 1;
    std::uint32_t group = 0;
};

/// Inside one of the terms, and inside `outer` if there is one.
struct ClipExpression {
    struct Term {
        std::uint32_t layer = 0;
        std::uint32_t clip = none;
        bool inverted = false;  ///< outside the layer instead of inside
    };
    std::vector<Term> terms;
    std::uint32_t outer = none;
};

enum class GroupRole : std::uint8_t { Plain, LuminanceMask, LinearMask, AlphaMask };

struct PictureGroup {
    std::uint32_t parent = none;
    GroupRole role = GroupRole::Plain;
    float opacity = 1;
    scene::BlendMode blend = scene::BlendMode::Normal;
    std::uint32_t clip = none;
    std::uint32_t mask = none;  ///< the mask's group, a child of this one that comes after the items
    unsigned depth = 0;
    /// The outside of a selection. Where regions are disjoint it is a group like any other; where coverage is
    /// a factor (compat mode) it is added to the inside, so that their shares add up to one.
    bool adds = false;
};

struct Picture {
    Outlines outlines;
    std::vector<Layer> layers;
    std::vector<PictureItem> items;  ///< painter's order; layers ascend
    std::vector<PictureGroup>
        groups;  ///< parents before children; 0 is the ground, the scene's root lies in it
    std::vector<ClipExpression> clips;
    std::vector<Source> sources;
    std::vector<asset::Texel> data;  ///< gradients, image and material fills
    std::vector<std::shared_ptr<const image::Bitmap>> images;
    std::vector<asset::Material> materials;
    std::vector<std::uint32_t> itemOfLayer;  ///< none: a clip's layer
    std::size_t sampledStrokes = 0;          ///< Result::sampledStrokes
};

/// Copies, for the asset.
inline std::vector<image::Bitmap> bitmapsOf(const Picture& picture) {
    std::vector<image::Bitmap> bitmaps;
    for (const auto& image : picture.images)
        bitmaps.push_back(*image);
    return bitmaps;
}

/// Limits of lowering; beyond them a LimitError.
inline constexpr std::size_t maxChords = 50'000'000;
inline constexpr std::size_t maxLayers = 4'000'000;
inline constexpr std::size_t maxTiles = 20'000;  ///< of one pattern fill

/// Outlines: a fill right below an opaque stroke of its own path may take an outline of the stroke's for its
/// own, where that hides the difference (docs/regions.md).
enum class Sharing : std::uint8_t { None, Outlines };

/// Chords lie as far from their curves as the budget allows. The lattice is that of the excerpt. With a
/// `cache`, outlines that it holds are taken from it and others added to it; its store of outlines becomes
/// the picture's; then nothing is shared.
Picture lower(const scene::Scene& scene, const Excerpt& excerpt, const Lattice& lattice,
              const ErrorBudget& budget, Sharing sharing, OutlineCache* cache = nullptr);

}  // namespace vtm::compiler
