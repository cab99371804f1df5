/// \file
/// Which item of a scene covers a point: the scene again, with numbers for paints.
///
/// The compiler merges regions of equal paint, so the asset that is drawn does not know its items. A pick map
/// is the same geometry through the same compiler, each item filled with a paint of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm::compiler {

/// Items that one pick map can tell apart.
inline constexpr std::size_t maxPickItems = 65535;

struct PickMap {
    /// Exact, every region one solid paint. Its paints mean items; drawn, it is a picture in false colours.
    asset::Asset asset;
    /// In painter's order, groups' and both sides' of selections; strokes and fills are items of their own.
    /// They point into the scene that was compiled.
    std::vector<const scene::Item*> items;
    /// By paint of the asset: an index of `items`, or nothing.
    std::vector<std::optional<std::uint32_t>> itemOfPaint;
};

/// As SVG's pointer events see it: an item counts wherever its geometry is, however transparent its paint,
/// its group or a pattern is; the topmost one covers those below. Clips cut. So do masks, where they let
/// nothing through: an item of a mask hides if it is black, and shows if it has any light (luminance), or any
/// paint (alpha). Throws as compile() does, and LimitError beyond maxPickItems; options.mode must be exact.
PickMap compilePickMap(const scene::Scene& scene, const Options& options = {});

/// The topmost item at a point of the picture, user units (asset::paintAt says how exactly); an index of
/// `items`. Where the compiler filled a leaf with a mean of samples (Asset::fallbackLeaves), nothing.
std::optional<std::uint32_t> itemAt(const PickMap& map, glm::dvec2 point);

}  // namespace vtm::compiler

#pragma GCC visibility pop
