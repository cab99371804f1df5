#include "backend_gl/tiles/block_grid.hpp"

#include <algorithm>

namespace vtm::gl {

int blockSideFor(const glm::dmat2& pixelsToTiles, int largest) {
    const glm::dvec2 pixel = glm::abs(pixelsToTiles[0]) + glm::abs(pixelsToTiles[1]);
    // Between the outermost centres, and a little more, as in block_shape.hpp.
    const double most = 1 / std::max(pixel.x, pixel.y) + 1 - 0.02;
    int side = largest;
    while (side > minBlockSide && side > most)
        side -= blockSideStep;
    return side;
}

}  // namespace vtm::gl
