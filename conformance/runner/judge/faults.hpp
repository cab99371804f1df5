/// \file
/// Mistakes made on purpose: a suite that does not see them proves nothing. Those of assets patch what the
/// compiler made, those of pictures what an engine drew; the library knows nothing of them.
#pragma once

#include <string_view>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/image/bitmap.hpp>

namespace vtm::conformance {

enum class Fault {
    None,
    // of the asset
    FlippedWinding,  ///< left and right of one piece exchanged
    DroppedPiece,    ///< one piece less in one leaf
    SwappedPaint,    ///< two entries of the palette exchanged
    CellOrigin,      ///< the children of the busiest leaf's node, each one place on
    // of the way in which pixels are made
    Layers,        ///< layers over each other by their coverage, instead of regions
    HalfDistance,  ///< coverage is 0.5 - h, the paper's, instead of exact
    // of the picture
    Blank,
    Shifted,     ///< by a pixel
    Recoloured,  ///< every channel of what is drawn 5/255 less
    Neighbour,   ///< the picture of the view before
    MissingCell  ///< 8 × 8 pixels that show something are clear
};
/// Without None.
const std::vector<Fault>& allFaults();
std::string_view nameOf(Fault fault);
/// Throws std::runtime_error for a name that is none.
Fault faultOf(std::string_view name);

/// The asset with the fault in it, if it is one of assets and there is a place for it. The damage sits where
/// most of the picture's pieces are, so that a view that shows the picture shows it.
asset::Asset damaged(asset::Asset asset, Fault fault);

/// The picture with the fault in it, if it is one of pictures. `before` is what was drawn last.
image::Raster damaged(const image::Raster& picture, Fault fault, const image::Raster& before);

}  // namespace vtm::conformance
