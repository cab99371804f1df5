// Section 3.7: contexts, and which are current. A thread has one context of OpenVG and one of OpenGL (ES)
// current at once; ours is kept here and in libOpenVG, the other in the system.

#include "api/egl/images/images.hpp"
#include "api/egl/state/attributes.hpp"
#include "api/egl/state/gl_contexts.hpp"
#include "api/egl/state/thread.hpp"
#include "api/egl/surfaces/posting.hpp"
#include "api/egl/system/system_surfaces.hpp"

namespace vtm::egl {

Context::Context(Display& d, std::shared_ptr<const Config> c, VtmContext* v)
    : display(d), config(std::move(c)), drawing(v) {}

Context::~Context() { vtmDestroyContext(drawing); }

namespace {

bool isVgCurrentApi() { return currentApi() == EGL_OPENVG_API; }

EGLContext createContext(Display& display, EGLConfig handle, EGLContext share, const EGLint* list) {
    // EGL_NO_CONFIG_KHR: EGL_KHR_no_config_context.
    const auto config = handle == EGL_NO_CONFIG_KHR ? nullptr : configForVg(display, handle);
    const auto sharing = share == EGL_NO_CONTEXT ? nullptr : getContext(display, share);
    // None are for OpenVG.
    require(attributeList(list).empty(), EGL_BAD_ATTRIBUTE);
    VtmContext* const drawing = vtmCreateContext(sharing ? sharing->drawing : nullptr);
    require(drawing != nullptr, EGL_BAD_ALLOC);
    const auto context = std::make_shared<Context>(display, config, drawing);
    contexts().add(context);
    return context->handle;
}

/// Section 2.2: the same type of colours, in the same numbers of bits.
bool areCompatible(const Context& context, const Surface& surface) {
    if (!context.config)
        return true;
    const VtmSurfaceFormat &a = context.config->format, &b = surface.config->format;
    return a.redBits == b.redBits && a.greenBits == b.greenBits && a.blueBits == b.blueBits &&
           a.alphaBits == b.alphaBits && a.luminanceBits == b.luminanceBits && a.maskBits == b.maskBits;
}

/// What it shows may be gone by now: then nobody misses the pixels.
void leave(Surface& surface) {
    try {
        showPixmap(surface);
        if (surface.isAdopted)
            giveToGl(surface);
    } catch (const Error&) {
    }
}

std::shared_ptr<Surface> surfaceForVg(Display& display, EGLSurface handle) {
    require(handle != EGL_NO_SURFACE, EGL_BAD_MATCH);
    return surfaces().has(handle) ? getSurface(display, handle) : adoptedSurface(display, handle);
}

bool isSystemContext(const Display& display, EGLContext handle) {
    EGLint id = 0;
    return !contexts().has(handle) && display.systemRuns &&
           systemEgl()->QueryContext(display.handle, handle, EGL_CONFIG_ID, &id);
}

void makeCurrent(Display& display, EGLSurface draw, EGLSurface read, EGLContext handle) {
    const auto context = getContext(display, handle);
    const auto surface = surfaceForVg(display, draw);
    require(surfaceForVg(display, read) == surface && areCompatible(*context, *surface), EGL_BAD_MATCH);
    if (const auto old = currentSurface(); old && old != surface)
        leave(*old);
    require(surface->glUses == 0, EGL_BAD_ACCESS);
    fitToTarget(*surface);
    require(vtmMakeCurrent(context->drawing, surface->drawing), EGL_BAD_ACCESS);
    thisThread().context = context;
    thisThread().surface = SurfaceUse<&Surface::vgUses>(surface);
    takeFromGl(*surface);
}

}  // namespace

void releaseCurrent() {
    if (const auto surface = currentSurface()) {
        leave(*surface);
        vtmMakeCurrent(nullptr, nullptr);
    }
    thisThread().context = nullptr;
    thisThread().surface = {};
}

}  // namespace vtm::egl

using namespace vtm::egl;

EGLContext EGLAPIENTRY eglCreateContext(EGLDisplay dpy, EGLConfig config, EGLContext share,
                                        const EGLint* list) {
    if (isVgCurrentApi())
        return call(EGLContext(EGL_NO_CONTEXT),
                    [&] { return createContext(initializedDisplay(dpy), config, share, list); });
    if (!configs().has(config) && !contexts().has(share))
        return forward(&System::CreateContext, EGLContext(EGL_NO_CONTEXT), EGL_BAD_CONFIG, dpy, config, share,
                       list);
    return call(EGLContext(EGL_NO_CONTEXT),
                [&] { return createGlContext(initializedDisplay(dpy), config, share, list); });
}

EGLBoolean EGLAPIENTRY eglDestroyContext(EGLDisplay dpy, EGLContext handle) {
    if (!contexts().has(handle))
        return forward(&System::DestroyContext, EGLBoolean(EGL_FALSE), EGL_BAD_CONTEXT, dpy, handle);
    return call(EGLBoolean(EGL_FALSE), [&] {
        getContext(initializedDisplay(dpy), handle);
        contexts().remove(handle);
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglMakeCurrent(EGLDisplay dpy, EGLSurface draw, EGLSurface read, EGLContext handle) {
    synchronizeImages();
    const bool isOurs =
        handle == EGL_NO_CONTEXT ? isVgCurrentApi() || currentApi() == EGL_NONE : contexts().has(handle);
    if (!isOurs && !surfaces().has(draw) && !surfaces().has(read)) {
        if (isAdoptedCurrent(draw))
            leave(*currentSurface());
        const EGLBoolean succeeded =
            forward(&System::MakeCurrent, EGLBoolean(EGL_FALSE),
                    handle == EGL_NO_CONTEXT ? EGL_BAD_MATCH : EGL_BAD_CONTEXT, dpy, draw, read, handle);
        if (succeeded)
            forgetGlSurfaces();
        return succeeded;
    }
    return call(EGLBoolean(EGL_FALSE), [&] {
        if (handle == EGL_NO_CONTEXT && draw == EGL_NO_SURFACE && read == EGL_NO_SURFACE) {
            // Allowed of a display that is no longer initialised.
            require(findDisplay(dpy) != nullptr, EGL_BAD_DISPLAY);
            releaseCurrent();
            return EGLBoolean(EGL_TRUE);
        }
        Display& display = initializedDisplay(dpy);
        require(handle != EGL_NO_CONTEXT, EGL_BAD_MATCH);
        if (isSystemContext(display, handle))
            makeGlCurrent(display, draw, read, handle);
        else
            makeCurrent(display, draw, read, handle);
        return EGLBoolean(EGL_TRUE);
    });
}

EGLContext EGLAPIENTRY eglGetCurrentContext(void) {
    if (!isVgCurrentApi() && systemEgl()) {
        thisThread().error = EGL_SUCCESS;
        return systemEgl()->GetCurrentContext();
    }
    return call(EGLContext(EGL_NO_CONTEXT), [] {
        const auto context = isVgCurrentApi() ? currentContext() : nullptr;
        return context ? context->handle : EGL_NO_CONTEXT;
    });
}

EGLSurface EGLAPIENTRY eglGetCurrentSurface(EGLint readdraw) {
    if (!isVgCurrentApi() && systemEgl()) {
        thisThread().error = EGL_SUCCESS;
        const EGLSurface surface = systemEgl()->GetCurrentSurface(readdraw);
        return currentGlSurface(readdraw, surface);
    }
    return call(EGLSurface(EGL_NO_SURFACE), [&] {
        require(readdraw == EGL_READ || readdraw == EGL_DRAW, EGL_BAD_PARAMETER);
        const auto surface = isVgCurrentApi() ? currentSurface() : nullptr;
        return surface ? surface->handle : EGL_NO_SURFACE;
    });
}

EGLDisplay EGLAPIENTRY eglGetCurrentDisplay(void) {
    if (!isVgCurrentApi() && systemEgl()) {
        thisThread().error = EGL_SUCCESS;
        return systemEgl()->GetCurrentDisplay();
    }
    return call(EGLDisplay(EGL_NO_DISPLAY), [] {
        const auto context = isVgCurrentApi() ? currentContext() : nullptr;
        return context ? context->display.handle : EGL_NO_DISPLAY;
    });
}

EGLBoolean EGLAPIENTRY eglQueryContext(EGLDisplay dpy, EGLContext handle, EGLint attribute, EGLint* value) {
    if (!contexts().has(handle))
        return forward(&System::QueryContext, EGLBoolean(EGL_FALSE), EGL_BAD_CONTEXT, dpy, handle, attribute,
                       value);
    return call(EGLBoolean(EGL_FALSE), [&] {
        const auto context = getContext(initializedDisplay(dpy), handle);
        require(value != nullptr, EGL_BAD_PARAMETER);
        switch (attribute) {
            case EGL_CONFIG_ID:
                *value = context->config ? context->config->id : 0;
                break;
            case EGL_CONTEXT_CLIENT_TYPE:
                *value = EGL_OPENVG_API;
                break;
            case EGL_CONTEXT_CLIENT_VERSION:
                *value = 1;
                break;
            case EGL_RENDER_BUFFER: {
                const auto surface = context == currentContext() ? currentSurface() : nullptr;
                *value = !surface                    ? EGL_NONE
                         : surface->isBackBuffered() ? EGL_BACK_BUFFER
                                                     : EGL_SINGLE_BUFFER;
                break;
            }
            default:
                throw Error{EGL_BAD_ATTRIBUTE};
        }
        return EGLBoolean(EGL_TRUE);
    });
}
