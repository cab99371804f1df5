/// \file
/// Showing what was drawn (EGL specification section 3.10). They may throw Error.
#pragma once

#include "api/egl/state/objects.hpp"

namespace vtm::egl {

/// Gives the drawing of a window the size that the window has now.
void fitToTarget(Surface& surface);

/// Copies to the native pixmap, if the surface is one.
void showPixmap(Surface& surface);

/// Hands the drawing over to the system's surface, or takes over what OpenGL drew there.
void giveToGl(Surface& surface);
void takeFromGl(Surface& surface);

/// The functions of EGL_KHR_swap_buffers_with_damage and of the EXT extension like it: all is swapped.
EGLBoolean EGLAPIENTRY swapBuffersWithDamageKhr(EGLDisplay, EGLSurface, const EGLint* rectangles,
                                                EGLint count);
EGLBoolean EGLAPIENTRY swapBuffersWithDamageExt(EGLDisplay, EGLSurface, const EGLint* rectangles,
                                                EGLint count);

/// Of EGL_KHR_partial_update: a hint that OpenVG does without.
EGLBoolean EGLAPIENTRY setDamageRegionKhr(EGLDisplay, EGLSurface, EGLint* rectangles, EGLint count);

}  // namespace vtm::egl
