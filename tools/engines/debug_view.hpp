/// \file
/// Pictures of how a picture is stored and drawn (docs/debug_views.md).
#pragma once

#include <string>
#include <vector>

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

/// Lays over a drawn picture what is made of lines: Cells, Fallback, Tiles.
/// The view scales and moves only.
void layLines(image::Bitmap& picture, DebugView view, const Source& source, const asset::View& to);

}  // namespace vtm::tools
