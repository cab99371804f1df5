/// \file
/// Scene in, picture out: strokes become outlines, patterns become groups of tiles, curves become chords.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/gtc/type_precision.hpp>

#include <vtm/scene/scene.hpp>
#include "compiler/lower/error_budget.hpp"
#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

class OutlineCache;
class PatternImages;

/// What becomes the picture: what `fromScene` maps from the scene into [0, width] × [0, height].
struct Excerpt {
    scene::Affine fromScene = scene::identity;
    double width = 0, height = 0;
    /// A small part of the scene: strokes are cut down to what is near, and gradients to the colours in it.
    bool isPart = false;

    bool operator==(const Excerpt&) const = default;
};
/// The scene's box from min to max as a picture of so many pixels, whose units they are.
inline Excerpt inPixels(scene::Point min, scene::Point max, scene::Point pixels) {
    const scene::Point scale = pixels / (max - min);
    return {{scale.x, 0, 0, scale.y, -scale.x * min.x, -scale.y * min.y}, pixels.x, pixels.y, false};
}
inline Excerpt wholeOf(const scene::Scene& scene) {
    return {scene::identity, scene.width, scene.height, false};
}

/// Limits of lowering; beyond them a LimitError.
inline constexpr std::size_t maxChords = 50'000'000;
inline constexpr std::size_t maxLayers = 4'000'000;

/// Of patterns. What needs more tiles is drawn as an image.
inline constexpr std::size_t maxTiles = 20'000;        ///< of one fill, that are lowered one by one
inline constexpr std::size_t maxTilesInTile = 16'000;  ///< of a fill in a tile that is placed
/// Of all fills whose tiles are placed as maps: a million rectangles. They are drawn one by one, which takes
/// a GL driver a GB.
inline constexpr std::size_t maxPlacedSegments = std::size_t(1) << 22;
inline constexpr std::size_t maxCutTiles = 4 * maxTiles;  ///< of these, that are lowered one by one
inline constexpr std::size_t maxPlacedFills = 256;
/// Of a fill whose tiles become one outline for each shape in them, for pictures that are drawn once and for
/// assets; and the points of all such outlines after which no more fills are lowered so.
inline constexpr std::size_t maxTiledSegments = std::size_t(1) << 22, maxTiledPoints = std::size_t(1) << 23,
                             maxTiledSegmentsOfAssets = std::size_t(1) << 14;
/// After so many fills whose tiles are placed, assets have the others as outlines, too.
inline constexpr std::size_t fewPlacedFills = 8;

/// Outlines: a fill right below an opaque stroke of its own path may take an outline of the stroke's for its
/// own, where that hides the difference (docs/regions.md). All: also, equal shapes of clips may be one layer,
/// the first, and then not all layers of a group follow each other; and fills of one path in many places are
/// cut into chords once (repeated_paths.hpp).
enum class Sharing : std::uint8_t { None, Outlines, All };

/// What the outline of a layer was made of.
struct LayerOrigin {
    std::shared_ptr<const scene::Path> path;     ///< null of a shape in tiles that is one outline
    scene::Affine transform;                     ///< path space to picture
    const scene::StrokeStyle* stroke = nullptr;  ///< of the scene; null: filled
    scene::FillRule rule = scene::FillRule::NonZero;
    bool isClip = false;
};

/// A pattern fill of many tiles: tile (x, y) is the pattern's content in [min, max], moved by x and y
/// periods.
struct TilePattern {
    scene::Affine toPicture;   ///< from the pattern's space
    scene::Point min, max;     ///< of tile (0, 0), there
    glm::i64vec2 first, last;  ///< tiles that the shape's box meets
    std::uint32_t shape = 0;   ///< layer of what is filled
    double tilesInTile = 0;    ///< of patterns in it

    scene::Point period() const { return max - min; }
};

/// Some layers that follow each other.
struct LayerRange {
    std::uint32_t first = 0, count = 0;
};

/// How patterns of many tiles are lowered: at first none of their tiles, which gives TilePatterns; then,
/// where `chosen` says so for each of them, some of their tiles in that order, or an image of all.
struct TilePlan {
    struct Chosen {
        std::vector<glm::i64vec2> tiles;
        bool isImage = false;
    };
    std::vector<TilePattern> patterns;
    std::optional<std::vector<Chosen>> chosen;
    std::vector<LayerRange> firstTiles;  ///< layers of the first chosen tile of each pattern
};
/// Patterns of fewer tiles are lowered as they are.
inline constexpr double fewTiles = 400;

/// Chords lie as far from their curves as the budget allows. The lattice is that of the excerpt. With a
/// `cache`, outlines that it holds are taken from it and others added to it; its store of outlines becomes
/// the picture's; then nothing is shared. `origins`: gets those of the layers. Without `tiles` all are
/// lowered. `images`: for patterns of too many tiles, which are left out without.
LoweredScene lower(const scene::Scene& scene, const Excerpt& excerpt, const Lattice& lattice,
                   const ErrorBudget& budget, Sharing sharing, OutlineCache* cache = nullptr,
                   std::vector<LayerOrigin>* origins = nullptr, TilePlan* tiles = nullptr,
                   PatternImages* images = nullptr);

}  // namespace vtm::compiler
