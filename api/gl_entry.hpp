/// \file
/// How libvtm reaches libvtm_gl, which is not linked with it: a machine without EGL draws on the CPU.
#pragma once

#include <vtm/asset/asset.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>

namespace vtm {

struct GlRequest {
    const asset::Asset* asset = nullptr;  ///< null: whether exact pictures without materials would be drawn
    asset::View view;
    bool required = false;  ///< throw gl::GlError rather than leave it to the CPU
    image::Raster drawn;
};

}  // namespace vtm

/// False: the CPU should draw. Looked up by this name.
extern "C" bool vtm_gl_draw(vtm::GlRequest& request);
