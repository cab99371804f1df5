/// \file
/// Contexts of OpenGL ES 3.0 without a window: on a GPU where EGL's list of devices has one, else what the
/// platform offers. EGL_PLATFORM, which EGL itself reads, decides alone where it is set;
/// LIBGL_ALWAYS_SOFTWARE is respected.
#pragma once

#include "gles_context/egl.hpp"

namespace vtm::gles_context {

/// What drivers there may be, by EGL's list of devices, which is read within 2 ms.
enum class Drivers {
    none,
    software,
    perhapsGpu  ///< only a context can tell
};
Drivers likelyDrivers(const Egl& egl);

struct Context {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext handle = EGL_NO_CONTEXT;
    const EGLint* attributes = nullptr;  ///< that it was made with; a constant
};

struct Wish {
    /// Tried before all others, initialised or not; EGL_NO_DISPLAY: none.
    EGLDisplay display = EGL_NO_DISPLAY;
    /// No other display is tried.
    bool thatDisplayOnly = false;
    /// To share objects with; EGL_NO_CONTEXT: nothing.
    EGLContext share = EGL_NO_CONTEXT;
    /// Notice of resets, if it can be had.
    bool isRobust = true;
};

/// Current in this thread. Its display stays initialised for ever: EGL shares it with all others in the
/// process. Throws std::runtime_error, which says what was tried.
Context openContext(const Egl& egl, const Wish& wish);

}  // namespace vtm::gles_context
