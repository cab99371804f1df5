/// \file
/// Contexts of OpenGL (ES) with configs and surfaces of ours. The system's surface and the drawing in memory
/// are one color buffer to programs (EGL specification section 2.2): what one API drew is handed over when
/// the other becomes current.
#pragma once

#include <EGL/egl.h>

#include "api/egl/state/objects.hpp"

namespace vtm::egl {

/// With a config of ours. Throws Error.
EGLContext createGlContext(const Display& display, EGLConfig config, EGLContext share, const EGLint* list);

/// A context of the system's with at least one surface of ours. Throws Error.
void makeGlCurrent(const Display& display, EGLSurface draw, EGLSurface read, EGLContext context);

/// The system's context draws into surfaces of ours no more.
void forgetGlSurfaces();

/// The handle that the program knows a current surface of the system's by.
EGLSurface currentGlSurface(EGLint readdraw, EGLSurface systems);

}  // namespace vtm::egl
