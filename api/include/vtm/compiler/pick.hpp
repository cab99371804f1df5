/// \file
/// Picking: which item of a scene covers a point.
///
/// The compiler merges regions of equal paint, so an asset for drawing does not know its items. A pick map is
/// made from the same geometry by the same compiler, with a paint of its own for each item.
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

/// Max number of items in a pick map.
inline constexpr std::size_t maxPickItems = 65535;

struct PickMap {
    /// An asset of exact mode in which every region has one solid paint that stands for an item. Drawn, it is
    /// a picture in false colours.
    asset::Asset asset;
    /// All items in painter's order, including those in groups and on both sides of selections. A stroke and
    /// a fill are separate items. The pointers refer to the compiled scene, which must outlive them.
    std::vector<const scene::Item*> items;
    /// For each paint of the asset an index into `items`, or empty.
    std::vector<std::optional<std::uint32_t>> itemOfPaint;
};

/// Follows SVG's pointer events: an item counts wherever its geometry is, whatever the opacity of its paint,
/// group or pattern, and the topmost item covers those below. Clips cut items. Masks cut them where they let
/// nothing through: an item of a mask hides if it is black, and shows if it has any light (luminance) or any
/// paint (alpha). Throws as compile() does, LimitError for more than maxPickItems items, and
/// std::invalid_argument unless options.mode is Exact.
PickMap compilePickMap(const scene::Scene& scene, const Options& options = {});

/// Returns the index into `items` of the topmost item at a point in user units, with the accuracy of
/// asset::paintAt. Empty if no item is there, or where the compiler filled a leaf with a mean of samples
/// (Asset::fallbackLeaves).
std::optional<std::uint32_t> itemAt(const PickMap& map, glm::dvec2 point);

}  // namespace vtm::compiler

#pragma GCC visibility pop
