/// \file
/// Displays of platforms by the functions of EGL_EXT_platform_base.
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace vtm::egl {

/// eglGetPlatformDisplayEXT, where the system has it.
EGLDisplay EGLAPIENTRY getPlatformDisplayExt(EGLenum platform, void* native, const EGLint* attributes);

}  // namespace vtm::egl
