#include "api/openvg/gl/context.hpp"

#include <atomic>
#include <stdexcept>

#include "api/system_egl/system.hpp"

namespace vtm::openvg::gl {

namespace {

std::atomic<EGLDisplay> preferred = EGL_NO_DISPLAY;

/// There must be a system's library.
gles_context::Egl loadedEgl() {
    gles_context::Egl egl;
#define VTM_OPENVG_LOADED(name) egl.name = egl::systemEgl()->name;
    VTM_GLES_CONTEXT_EGL(VTM_OPENVG_LOADED)
#undef VTM_OPENVG_LOADED
    return egl;
}

gles_context::Context opened() {
    if (!egl::systemEgl())
        throw std::runtime_error("there is no libEGL");
    return gles_context::openContext(loadedEgl(), {.display = preferred});
}

}  // namespace

gles_context::Drivers likelyDrivers() {
    return egl::systemEgl() ? gles_context::likelyDrivers(loadedEgl()) : gles_context::Drivers::none;
}

void preferDisplay(EGLDisplay display) { preferred = display; }

Context::Context() : made_(opened()) {}

Context::~Context() {
    const egl::System& system = *egl::systemEgl();
    system.MakeCurrent(made_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    system.DestroyContext(made_.display, made_.handle);
}

}  // namespace vtm::openvg::gl
