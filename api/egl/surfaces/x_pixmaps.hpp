/// \file
/// Pictures into pixmaps of an X server, without OpenGL: Mesa's software renderer draws beside the pixmaps
/// that its surfaces are for.
#pragma once

#include <cstdint>

#include <EGL/egl.h>

namespace vtm::egl {

/// True once the pixmap has the picture: bytes red, green, blue, alpha, rows from the top. False where there
/// is no X server, or it has no pixmap with this number, this size, and 16, 24 or 32 bits of depth.
bool putPicture(EGLNativePixmapType pixmap, int width, int height, const std::uint8_t* pixels);

}  // namespace vtm::egl
