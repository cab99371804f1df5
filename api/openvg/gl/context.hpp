/// \file
/// A context of OpenGL ES 3.0 without a window, of the compositor's own.
#pragma once

#include <string>

#include <EGL/egl.h>

namespace vtm::openvg::gl {

/// What drivers there may be, by EGL's list of devices, which is read within 2 ms; `none` where there is no
/// EGL. Respects LIBGL_ALWAYS_SOFTWARE.
enum class Drivers { none, software, perhapsGpu };
Drivers likelyDrivers();

/// The display that contexts are opened on from now on, if that works; EGL_NO_DISPLAY: none.
void preferDisplay(EGLDisplay display);

/// `attributes`: a list for eglCreateContext.
struct ContextHandle {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    const EGLint* attributes = nullptr;
};

/// On the preferred display if there is one; on a GPU where EGL's list of devices has one, else what the
/// platform offers; EGL_PLATFORM decides alone.
/// Current in the thread that makes it; nothing but this thread may use it.
class Context {
public:
    /// Throws std::runtime_error, which says what was tried.
    Context();
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const ContextHandle& handle() const { return handle_; }

private:
    std::string open(EGLDisplay display);

    ContextHandle handle_;
};

}  // namespace vtm::openvg::gl
