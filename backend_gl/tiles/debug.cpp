#include "backend_gl/debug.hpp"

#include <cmath>

#include "backend_gl/tiles/atlas.hpp"

namespace vtm::gl {

TileGrid tileGrid(const asset::Map& map, const asset::View& view) {
    return {std::ldexp(map.side, -tileLevelFor(map, view)), 1u << tileCellsLog2};
}

}  // namespace vtm::gl
