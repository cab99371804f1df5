/// \file
/// What the backend's index of a picture looks like, for debug views.
#pragma once

#include <vtm/asset/asset.hpp>
#include <vtm/raster/view.hpp>

namespace vtm::gl {

/// Squares of `side` picture units, one with its corner at the map's, each of `cells` × `cells` cells; of
/// more where there are many pieces.
struct TileGrid {
    double side = 0;
    unsigned cells = 0;
};

/// What an exact picture is drawn by under an invertible view.
TileGrid tileGrid(const asset::Map& map, const asset::View& view);

}  // namespace vtm::gl
