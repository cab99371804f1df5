/// \file
/// The blocks of a view: upright squares of pixels beside each other.
#pragma once

#include <cstddef>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "backend_gl/core/placement.hpp"

namespace vtm::gl {

/// Pixels a side of the smallest and the largest blocks. Of sides between, steps: drivers shade groups of 2 x
/// 2 pixels and more, which edges of blocks must not cut.
inline constexpr int minBlockSide = 16, maxBlockSide = 32, blockSideStep = 8;

/// The largest blocks whose pixels' centres lie in two tiles along each axis wherever they are, the smallest
/// if there are none. Those always do: from one centre to another it is less than 15 diagonals of a pixel,
/// and a tile is 16 / 2 of 2.83 of them wide at least (tileLevelFor() in atlas.hpp).
int blockSideFor(const glm::dmat2& pixelsToTiles, int largest = maxBlockSide);

struct BlockGrid {
    int side = minBlockSide;
    glm::ivec2 origin{0};  ///< a corner of the first block

    /// Of a view: GL draws points whose middles lie in the viewport, so those of the first and the last
    /// blocks have to, whatever of them lies outside.
    static BlockGrid of(glm::ivec2 view, int blockSide) {
        const auto first = [&](int size) {
            const int rest = size % blockSide;
            return rest != 0 && 2 * rest < blockSide ? -blockSide / 2 : 0;
        };
        return {blockSide, {first(view.x), first(view.y)}};
    }

    /// The first corner of the block that a pixel of the view lies in.
    glm::ivec2 cornerAt(glm::ivec2 pixel) const { return origin + (pixel - origin) / side * side; }
    /// How many blocks a row of a box meets.
    int columnsOf(const PixelBox& box) const {
        return (cornerAt(box.max - 1).x - cornerAt(box.min).x) / side + 1;
    }
    PixelBox pixelsOf(glm::ivec2 corner, const PixelBox& box) const {
        return {glm::max(corner, box.min), glm::min(corner + side, box.max)};
    }
};

/// Where the i-th of a box's blocks stands among scanned ones: they fill rows as long as the box's.
inline glm::ivec2 scannedPlace(std::size_t i, const PixelBox& box, const BlockGrid& grid) {
    const auto columns = std::size_t(grid.columnsOf(box));
    return grid.side * glm::ivec2(i % columns, i / columns);
}

}  // namespace vtm::gl
