/// \file
/// Pictures of how a picture is stored and drawn (docs/debug_views.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>
#include "tools/input/source.hpp"

namespace vtm::tools {

enum class DebugView { None, Cells, Depth, Pieces, Cost, Regions, Fallback, Tiles };

/// Throws UsageError for an unknown name; "" is None.
DebugView parseDebugView(const std::string& name);

/// Puts an asset that shows the view into the place of the source's, for any engine to draw. Throws
/// UsageError where there is none: of a paper or compat asset, or for Fallback of a file that was compiled
/// before.
void prepare(Source& source, DebugView view);

/// An asset that shows the view: Depth, Pieces, Cost, Regions. Nothing for the others.
std::optional<asset::Asset> debugAsset(const asset::Asset& asset, DebugView view);

/// A rectangle in the picture's units.
struct DebugOutline {
    glm::dvec2 corner, size;
    glm::vec3 color;
};
/// What Cells and Fallback draw.
std::vector<DebugOutline> debugOutlines(const asset::Asset& asset,
                                        const std::vector<compiler::UnprovenSquare>& unproven,
                                        DebugView view);

/// A colour and what it stands for.
struct DebugMark {
    glm::vec3 color;
    std::string text;
};
std::vector<DebugMark> debugLegend(DebugView view);

/// Lays over a drawn picture what is made of lines: Cells, Fallback, Tiles.
/// The view scales and moves only.
void layLines(image::Bitmap& picture, DebugView view, const Source& source, const asset::View& to);

}  // namespace vtm::tools
