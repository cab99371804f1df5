#include <memory>
#include <mutex>

#include <EGL/egl.h>

#include <vtm/asset/asset.hpp>
#include <vtm/gl/context.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/vtm.hpp>
#include "api/gl_entry.hpp"

namespace vtm::gl {

namespace {

/// Brings back the context that the calling thread had.
class CallersContext {
public:
    CallersContext() = default;
    ~CallersContext() {
        if (context_ != EGL_NO_CONTEXT)
            eglMakeCurrent(display_, draw_, read_, context_);
        else if (const EGLDisplay ours = eglGetCurrentDisplay(); ours != EGL_NO_DISPLAY)
            eglMakeCurrent(ours, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    CallersContext(const CallersContext&) = delete;
    CallersContext& operator=(const CallersContext&) = delete;

private:
    const EGLContext context_ = eglGetCurrentContext();
    const EGLDisplay display_ = eglGetCurrentDisplay();
    const EGLSurface draw_ = eglGetCurrentSurface(EGL_DRAW), read_ = eglGetCurrentSurface(EGL_READ);
};

/// A context and its programs, for all threads in turn. Only ever made with the mutex held.
struct Worker {
    Context context;
    Renderer renderer;
};

struct SharedWorker {
    std::mutex mutex;
    std::unique_ptr<Worker> worker;
};

/// Never destroyed: at the process's end drivers may be gone.
SharedWorker& sharedWorker() {
    static SharedWorker& one = *new SharedWorker;
    return one;
}

/// Also pictures with filters, which are computed on the CPU everywhere.
bool scannerDraws(const asset::Asset* asset) {
    return !asset || (asset->mode == asset::Mode::Exact && asset->materials.empty());
}

/// From EGL's devices alone, without a context.
bool mayBeFaster(const asset::Asset* asset) {
    static const Driver driver = likelyDriver();
    return driver == Driver::PerhapsGpu || (driver == Driver::Software && !scannerDraws(asset));
}

bool draw(GlRequest& request) {
    const std::lock_guard lock(sharedWorker().mutex);
    const CallersContext callers;
    auto& worker = sharedWorker().worker;
    if (worker)
        worker->context.makeCurrent();
    else
        worker = std::make_unique<Worker>();
    if (!request.required && worker->context.isSoftware() && scannerDraws(request.asset))
        return false;
    if (!request.asset)
        return true;
    const Texture texture = worker->renderer.upload(*request.asset);
    request.drawn = worker->renderer.render(texture, request.view);
    return true;
}

}  // namespace

}  // namespace vtm::gl

extern "C" __attribute__((visibility("default"))) bool vtm_gl_draw(vtm::GlRequest& request) {
    using namespace vtm::gl;
    if (!request.required && !mayBeFaster(request.asset))
        return false;
    try {
        return draw(request);
    } catch (const ContextLost&) {
        const std::lock_guard lock(sharedWorker().mutex);
        sharedWorker().worker.reset();
        if (request.required)
            throw;
    } catch (const GlError&) {
        if (request.required)
            throw;
    }
    return false;
}

namespace vtm {

gl::Texture Picture::texture() const { return gl::Texture(asset()); }

}  // namespace vtm
