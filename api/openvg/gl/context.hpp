/// \file
/// The compositor's own context, behind the system's EGL.
#pragma once

#include "gles_context/context.hpp"

namespace vtm::openvg::gl {

/// None where there is no EGL.
gles_context::Drivers likelyDrivers();

/// The display that contexts are opened on from now on, if that works; EGL_NO_DISPLAY: none.
void preferDisplay(EGLDisplay display);

/// Current in the thread that makes it; nothing but this thread may use it.
class Context {
public:
    /// Throws std::runtime_error, which says what was tried.
    Context();
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const gles_context::Context& made() const { return made_; }

private:
    gles_context::Context made_;
};

}  // namespace vtm::openvg::gl
