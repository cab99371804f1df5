/// \file
/// OpenVG on configs and surfaces of the system's. Programs of devices where every config has OpenVG ask for
/// colours alone, and get the system's configs by the order of the specification: these do what they expect.
#pragma once

#include <memory>

#include <EGL/egl.h>

#include "api/egl/state/objects.hpp"

namespace vtm::egl {

/// The config itself if it is ours, the one with the same colours if it is the system's. Throws Error.
std::shared_ptr<const Config> configForVg(Display& display, EGLConfig handle);

/// A drawing beside a surface of the system's, the same one until that is destroyed. Throws Error.
std::shared_ptr<Surface> adoptedSurface(Display& display, EGLSurface handle);

/// The system has made a surface on this window; nothing to note for EGL_NO_SURFACE.
void noteWindow(EGLDisplay display, EGLSurface handle, std::uintptr_t window);

/// The system's surface is destroyed, or all of the display's are.
void forgetAdopted(EGLSurface handle);
void forgetAllAdopted(const Display& display);

/// True if OpenVG draws for this surface of the system's in this thread.
bool isAdoptedCurrent(EGLSurface handle);

}  // namespace vtm::egl
