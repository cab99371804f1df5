/// \file
/// Making surfaces (EGL specification section 3.5).
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "api/egl/state/objects.hpp"

namespace vtm::egl {

/// Sets what EGL_GL_COLORSPACE, EGL_VG_COLORSPACE and EGL_VG_ALPHA_FORMAT say. False for other attributes.
/// Throws Error.
bool setDrawingAttribute(Surface& surface, EGLint attribute, EGLint value);

/// In memory, with pixels as the surface's config and attributes want them. Throws Error.
void createDrawing(Surface& surface, EGLint width, EGLint height);

/// Functions of EGL_EXT_platform_base, where the system has them.
EGLSurface EGLAPIENTRY createPlatformWindowSurfaceExt(EGLDisplay, EGLConfig, void*, const EGLint*);
EGLSurface EGLAPIENTRY createPlatformPixmapSurfaceExt(EGLDisplay, EGLConfig, void*, const EGLint*);

}  // namespace vtm::egl
