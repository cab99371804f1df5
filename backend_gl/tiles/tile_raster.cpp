#include "backend_gl/tiles/tile_raster.hpp"

#include <cmath>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "raster/steepness.hpp"

namespace vtm::gl {

using glm::dvec2;
using glm::i64vec2;

TileRaster::TileRaster(const asset::Map& map, const asset::View& view, const PixelBox& box, int level,
                       int largestBlock)
    : side_(std::ldexp(map.side, -level)),
      corner_(map.x, map.y),
      view_(&view),
      box_(box),
      inverse_(glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]))),
      minSteepness_(asset::minSteepness(inverse_)),
      grid_(BlockGrid::of({view.width, view.height}, blockSideFor(pixelsToTiles(), largestBlock))) {
    dvec2 minimum(HUGE_VAL), maximum(-HUGE_VAL);
    for (const dvec2 pixel :
         {dvec2(box.min), dvec2(box.max.x, box.min.y), dvec2(box.min.x, box.max.y), dvec2(box.max)}) {
        minimum = glm::min(minimum, toTile(pixel));
        maximum = glm::max(maximum, toTile(pixel));
    }
    // The map's border belongs to pixels with centres up to a margin outside, in a tile beside the map's.
    // Where a block meets that one and the next, pixels of the next must not take it for theirs.
    const double first = -2, end = std::ceil(std::ldexp(1.0, level)) + 2;
    region_ = {level, i64vec2(glm::clamp(glm::floor(minimum), first, end)),
               i64vec2(glm::clamp(glm::floor(maximum) + 1.0, first, end))};
}

}  // namespace vtm::gl
