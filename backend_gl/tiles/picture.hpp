/// \file
/// Drawing an exact asset as a picture: every pixel once, by the tile that its centre lies in.
#pragma once

#include <cstddef>

#include <vtm/raster/view.hpp>
#include "backend_gl/core/programs.hpp"
#include "backend_gl/tiles/block_grid.hpp"
#include "backend_gl/upload/upload.hpp"

namespace vtm::gl {

/// What suits the driver. Where shaders run on the CPU, blocks and draws cost little beside pixels, and small
/// blocks are more often drawn by simple programs. On a GPU what counts is the CPU's time for each block and
/// draw.
struct DrawingCosts {
    int largestBlock;    ///< pixels a side
    std::size_t fewest;  ///< blocks, that are worth a draw of their own
};
inline constexpr DrawingCosts onCpu{minBlockSide, 8}, onGpu{maxBlockSide, 64};

/// Reused from picture to picture.
struct PictureBuffers {
    PictureBuffers();

    VertexArrayHandle flatArray, blockArray;
    BufferHandle flat, block;
    DrawingCosts costs;
};

/// Draws into the bound framebuffer, `view` fitting the viewport, on what stands there if blending is on: all
/// pixels of `box` that are not transparent, and others, too, unless the scissor keeps them. The view is
/// invertible; GL is in the state of StateGuard.
/// `markOverruns`: of RendererOptions.
void drawPicture(Programs& programs, PictureBuffers& buffers, UploadedAsset& asset, const asset::View& view,
                 const PixelBox& box, Finish finish, bool markOverruns);
/// The same of one map. Returns a box that holds all it changed.
PixelBox drawMap(Programs& programs, PictureBuffers& buffers, const UploadedAsset& asset, Atlas& atlas,
                 const asset::View& view, const PixelBox& box, Finish finish, bool markOverruns);

}  // namespace vtm::gl
