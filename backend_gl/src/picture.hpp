/// \file
/// Drawing an exact asset as a picture: every pixel once, by the patch that its centre lies in.
#pragma once

#include "asset/view.hpp"
#include "backend_gl/src/programs.hpp"
#include "backend_gl/src/upload.hpp"

namespace vtm::gl {

/// Reused from picture to picture.
struct PictureBuffers {
    PictureBuffers();

    VertexArrayHandle flatArray, patchArray;
    BufferHandle flat, patch;
};

/// Draws into the bound framebuffer, `view` fitting it, on what stands there if blending is on. The view is
/// invertible.
void drawPicture(Programs& programs, PictureBuffers& buffers, UploadedAsset& asset, const asset::View& view);

}  // namespace vtm::gl
