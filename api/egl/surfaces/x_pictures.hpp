/// \file
/// Drawings on windows and pixmaps of an X server, without OpenGL: where that is a software renderer it would
/// be a detour, and Mesa's draws beside the pixmaps that its surfaces are for.
#pragma once

#include <cstdint>
#include <memory>

#include <vtm/vg.h>

#include "api/egl/state/objects.hpp"
#include "api/egl/system/x_server.hpp"

namespace vtm::egl {

/// The window or pixmap that a function of EGL_EXT_platform_base was given; 0: no X server has it.
std::uintptr_t platformDrawable(const Display& display, const void* native);

/// Puts one drawing after the other, from memory that is kept.
class XPicture {
public:
    /// On the server whose windows and pixmaps the display shows, if that is known.
    explicit XPicture(const Display& display);

    /// True once the window or pixmap has the drawing. False if it is none of the server, has another size,
    /// or not 16, 24 or 32 bits of depth.
    bool put(std::uintptr_t drawable, VtmSurface* drawing);

private:
    const XServer* const server_;
    std::unique_ptr<XServer::SharedMemory> shared_;
};

}  // namespace vtm::egl
