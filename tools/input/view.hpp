/// \file
/// Pictures that are as fine as the view wants.
#pragma once

#include <vtm/raster/view.hpp>
#include <vtm/scene/fit.hpp>
#include "tools/input/source.hpp"

namespace vtm::tools {

/// What a source becomes before it is drawn.
enum class Preparation {
    None,
    Drawing,  ///< of this view alone (compiler/draw_view.hpp), where there can be one; else an asset
    Asset
};

/// The view of a source that is parsed. An asset of an SVG is compiled so that boundaries are within a
/// 64th of a pixel: the part that is seen if need be, and then the view is one of that part. A tolerance
/// that the user gave is taken as it is. Warns where the asset, from a file or made, is not as fine as that.
asset::View prepareView(Source& source, const SourceOptions& options, const scene::Framing& framing,
                        Preparation preparation);

}  // namespace vtm::tools
