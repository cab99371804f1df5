/// \file
/// Contexts of OpenGL ES that are ours: made by the system, current for a moment, and unseen by the program.
#pragma once

#include <EGL/egl.h>

#include "api/egl/state/thread.hpp"

namespace vtm::egl {

/// Of OpenGL ES 2, sharing nothing. Throws Error.
EGLContext newGlContext(const Display& display, EGLConfig config);

/// Makes a context current in the system for as long as this lives, and then again what was.
class GlCurrent {
public:
    GlCurrent(EGLDisplay display, EGLSurface surface, EGLContext context)
        : system_(*systemEgl()),
          display_(system_.GetCurrentDisplay()),
          draw_(system_.GetCurrentSurface(EGL_DRAW)),
          read_(system_.GetCurrentSurface(EGL_READ)),
          context_(system_.GetCurrentContext()),
          madeFor_(display) {
        requireSystem(system_.MakeCurrent(display, surface, surface, context));
    }
    ~GlCurrent() {
        if (context_ != EGL_NO_CONTEXT)
            system_.MakeCurrent(display_, draw_, read_, context_);
        else
            system_.MakeCurrent(madeFor_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    GlCurrent(const GlCurrent&) = delete;
    GlCurrent& operator=(const GlCurrent&) = delete;

private:
    const System& system_;
    const EGLDisplay display_;
    const EGLSurface draw_, read_;
    const EGLContext context_;
    const EGLDisplay madeFor_;
};

}  // namespace vtm::egl
