/// \file
/// Pictures that are as fine as the view wants.
#pragma once

#include <vtm/raster/view.hpp>
#include <vtm/scene/fit.hpp>
#include "tools/input/source.hpp"

namespace vtm::tools {

/// The view of a source that is parsed. If `compile`, an SVG is compiled so that boundaries are within a
/// sixteenth of a pixel: the part that is seen if need be, and then the view is one of that part. A tolerance
/// that the user gave is taken as it is. Warns where the asset, from a file or made, is not as fine as that.
asset::View prepareView(Source& source, const SourceOptions& options, const scene::Framing& framing,
                        bool compile);

}  // namespace vtm::tools
