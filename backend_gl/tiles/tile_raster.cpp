#include "backend_gl/tiles/tile_raster.hpp"

#include <cmath>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "raster/steepness.hpp"

namespace vtm::gl {

using glm::dvec2;
using glm::i64vec2;

TileRaster::TileRaster(const asset::Map& map, const asset::View& view, const PixelBox& box, int level)
    : side_(std::ldexp(map.side, -level)),
      corner_(map.x, map.y),
      view_(&view),
      box_(box),
      inverse_(glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]))),
      minSteepness_(asset::minSteepness(inverse_)),
      grid_(BlockGrid::of({view.width, view.height}, blockSideFor(pixelsToTiles()))) {
    dvec2 minimum(HUGE_VAL), maximum(-HUGE_VAL);
    for (const dvec2 pixel :
         {dvec2(box.min), dvec2(box.max.x, box.min.y), dvec2(box.min.x, box.max.y), dvec2(box.max)}) {
        minimum = glm::min(minimum, toTile(pixel));
        maximum = glm::max(maximum, toTile(pixel));
    }
    // The map's border belongs to pixels with centres up to a margin outside.
    const double end = std::ceil(std::ldexp(1.0, level)) + 1;
    region_ = {level, i64vec2(glm::clamp(glm::floor(minimum), -1.0, end)),
               i64vec2(glm::clamp(glm::floor(maximum) + 1.0, -1.0, end))};
}

}  // namespace vtm::gl
