#include <vtm/gl/context.hpp>

#include <stdexcept>
#include <string>

#include <EGL/egl.h>
#include <GLES3/gl3.h>
#include <fmt/format.h>

#include "gles_context/context.hpp"
#include "gles_context/renderer_name.hpp"

namespace vtm::gl {

namespace {

constexpr gles_context::Egl linkedEgl{
#define VTM_GL_LINKED(name) .name = &::egl##name,
    VTM_GLES_CONTEXT_EGL(VTM_GL_LINKED)
#undef VTM_GL_LINKED
};

std::string glString(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

}  // namespace

Driver likelyDriver() {
    switch (gles_context::likelyDrivers(linkedEgl)) {
        case gles_context::Drivers::none:
            return Driver::None;
        case gles_context::Drivers::software:
            return Driver::Software;
        default:
            return Driver::PerhapsGpu;
    }
}

struct Context::Impl {
    gles_context::Context made;
    std::string renderer, version;

    ~Impl() {
        if (made.handle == EGL_NO_CONTEXT)
            return;
        if (eglGetCurrentContext() == made.handle)
            eglMakeCurrent(made.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(made.display, made.handle);
    }
};

Context::Context(const ContextOptions& options) : impl_(std::make_unique<Impl>()) {
    gles_context::Wish wish{.isRobust = options.robust};
    if (options.share != nullptr) {
        wish.display = options.share->impl_->made.display;
        wish.thatDisplayOnly = true;
        wish.share = options.share->impl_->made.handle;
    }
    try {
        impl_->made = gles_context::openContext(linkedEgl, wish);
    } catch (const std::runtime_error& error) {
        throw GlError(error.what());
    }
    impl_->renderer = glString(GL_RENDERER);
    impl_->version = glString(GL_VERSION);
}

Context::~Context() = default;

void Context::makeCurrent() const {
    if (!eglMakeCurrent(impl_->made.display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->made.handle))
        throw GlError(fmt::format("eglMakeCurrent failed (0x{:04x})", eglGetError()));
}

const std::string& Context::renderer() const { return impl_->renderer; }
const std::string& Context::version() const { return impl_->version; }
bool Context::isSoftware() const { return gles_context::isSoftwareName(impl_->renderer).value_or(false); }

}  // namespace vtm::gl
