/// \file
/// Scene in, picture out: strokes become outlines, patterns become groups of tiles, curves become chords.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <vtm/scene/scene.hpp>
#include "compiler/lower/error_budget.hpp"
#include "compiler/lower/lowered_scene.hpp"

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

/// Limits of lowering; beyond them a LimitError.
inline constexpr std::size_t maxChords = 50'000'000;
inline constexpr std::size_t maxLayers = 4'000'000;
inline constexpr std::size_t maxTiles = 20'000;  ///< of one pattern fill

/// Outlines: a fill right below an opaque stroke of its own path may take an outline of the stroke's for its
/// own, where that hides the difference (docs/regions.md).
enum class Sharing : std::uint8_t { None, Outlines };

/// What the outline of a layer was made of.
struct LayerOrigin {
    std::shared_ptr<const scene::Path> path;
    scene::Affine transform;                     ///< path space to picture
    const scene::StrokeStyle* stroke = nullptr;  ///< of the scene; null: filled
    scene::FillRule rule = scene::FillRule::NonZero;
    bool isClip = false;
};

/// Chords lie as far from their curves as the budget allows. The lattice is that of the excerpt. With a
/// `cache`, outlines that it holds are taken from it and others added to it; its store of outlines becomes
/// the picture's; then nothing is shared. `origins`: gets those of the layers.
LoweredScene lower(const scene::Scene& scene, const Excerpt& excerpt, const Lattice& lattice,
                   const ErrorBudget& budget, Sharing sharing, OutlineCache* cache = nullptr,
                   std::vector<LayerOrigin>* origins = nullptr);

}  // namespace vtm::compiler
