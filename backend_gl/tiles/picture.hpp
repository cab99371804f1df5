/// \file
/// Drawing an exact asset as a picture: every pixel once, by the tile that its centre lies in.
#pragma once

#include <vtm/raster/view.hpp>
#include "backend_gl/core/programs.hpp"
#include "backend_gl/upload/upload.hpp"

namespace vtm::gl {

/// Reused from picture to picture.
struct PictureBuffers {
    PictureBuffers();

    VertexArrayHandle flatArray, blockArray;
    BufferHandle flat, block;
    /// The smallest where shaders run on the CPU: blocks cost little beside their pixels there, and small
    /// ones are more often drawn by simple programs. On a GPU what counts is the CPU's time for each block.
    int largestBlock;
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
