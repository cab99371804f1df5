// Section 3.10, and the waiting of section 3.8. OpenVG draws at once, so there is nothing to flush.

#include "api/egl/surfaces/posting.hpp"

#include <algorithm>
#include <string_view>

#include "api/egl/images/images.hpp"
#include "api/egl/state/thread.hpp"
#include "api/egl/surfaces/blitter.hpp"
#include "api/egl/surfaces/x_pictures.hpp"
#include "api/egl/system/system_surfaces.hpp"

namespace vtm::egl {

namespace {

bool isOnGpu(const VtmSurface* drawing) { return vtmGetCompositor(drawing) == VTM_COMPOSITOR_GL; }

Blitter& blitterOf(Surface& surface) {
    if (!surface.blitter)
        surface.blitter =
            std::make_unique<Blitter>(surface.display, surface.targetConfig, isOnGpu(surface.drawing));
    return *surface.blitter;
}

/// By the name of the driver, where the system tells.
bool isSoftware(const Display& display) {
    const auto driverName = reinterpret_cast<PFNEGLGETDISPLAYDRIVERNAMEPROC>(
        systemEgl()->GetProcAddress("eglGetDisplayDriverName"));
    const char* const name = driverName ? driverName(display.handle) : nullptr;
    return name && std::string_view(name).ends_with("swrast");
}

/// Without OpenGL. False if only the system can do it.
bool putDrawing(Surface& surface) {
    if (surface.native == 0)
        return false;
    if (!surface.xPicture)
        surface.xPicture = std::make_unique<XPicture>(surface.display);
    return surface.xPicture->put(surface.native, surface.drawing);
}

/// Where OpenGL would only be a detour.
bool putOnWindow(Surface& surface) {
    return !isOnGpu(surface.drawing) && isSoftware(surface.display) && putDrawing(surface);
}

/// Of this thread's current context of OpenVG, and none other.
std::shared_ptr<Surface> postedSurface(EGLDisplay dpy, EGLSurface handle) {
    const Display& display = initializedDisplay(dpy);
    if (isAdoptedCurrent(handle))
        return currentSurface();
    const auto surface = getSurface(display, handle);
    require(surface == currentSurface(), EGL_BAD_SURFACE);
    return surface;
}

/// True if the system's context draws into this surface of ours.
bool isGlCurrent(EGLSurface handle) {
    const auto& surface = *thisThread().glDraw;
    return surface && surface->handle == handle;
}

EGLBoolean swap(EGLDisplay dpy, EGLSurface handle) {
    return call(EGLBoolean(EGL_FALSE), [&] {
        if (isGlCurrent(handle)) {
            const auto drawn = getSurface(initializedDisplay(dpy), handle);
            requireSystem(systemEgl()->SwapBuffers(dpy, drawn->target));
            return EGLBoolean(EGL_TRUE);
        }
        const auto surface = postedSurface(dpy, handle);
        if (surface->kind == Surface::Kind::window) {
            fitToTarget(*surface);
            if (!putOnWindow(*surface))
                blitterOf(*surface).swap(surface->target, surface->drawing, surface->swapInterval);
        } else {
            showPixmap(*surface);
        }
        surface->isShown = true;
        return EGLBoolean(EGL_TRUE);
    });
}

void copyTo(const Surface& surface, EGLNativePixmapType pixmap) {
    const Display& display = surface.display;
    const System* const system = systemEgl();
    require(display.systemRuns && surface.config->pixmap, EGL_BAD_NATIVE_PIXMAP);
    const EGLSurface target =
        system->CreatePixmapSurface(display.handle, surface.config->pixmap, pixmap, nullptr);
    requireSystem(target != EGL_NO_SURFACE);
    struct Guard {
        EGLDisplay display;
        EGLSurface target;
        ~Guard() { systemEgl()->DestroySurface(display, target); }
    } const guard{display.handle, target};
    EGLint width = 0, height = 0;
    system->QuerySurface(display.handle, target, EGL_WIDTH, &width);
    system->QuerySurface(display.handle, target, EGL_HEIGHT, &height);
    require(width == surface.width && height == surface.height, EGL_BAD_MATCH);
    if (!XPicture(display).put(std::uintptr_t(pixmap), surface.drawing))
        Blitter(display, surface.config->pixmap, isOnGpu(surface.drawing)).copy(target, surface.drawing);
}

/// To be posted by us.
bool isOurs(EGLSurface handle) {
    return surfaces().has(handle) || (currentApi() == EGL_OPENVG_API && isAdoptedCurrent(handle));
}

/// Calls the system's function of this name, if the surface is none of ours.
EGLBoolean swapWithDamage(const char* name, EGLDisplay dpy, EGLSurface handle, const EGLint* rectangles,
                          EGLint count) {
    if (isOurs(handle))
        return swap(dpy, handle);
    thisThread().error = EGL_SUCCESS;
    const auto function =
        reinterpret_cast<PFNEGLSWAPBUFFERSWITHDAMAGEKHRPROC>(systemEgl()->GetProcAddress(name));
    return function ? function(dpy, handle, rectangles, count) : EGLBoolean(EGL_FALSE);
}

}  // namespace

void fitToTarget(Surface& surface) {
    if (surface.kind != Surface::Kind::window)
        return;
    const System& system = *systemEgl();
    const EGLDisplay display = surface.display.handle;
    EGLint width = 0, height = 0;
    requireSystem(system.QuerySurface(display, surface.target, EGL_WIDTH, &width));
    requireSystem(system.QuerySurface(display, surface.target, EGL_HEIGHT, &height));
    if (width == surface.width && height == surface.height)
        return;
    require(vtmResizeSurface(surface.drawing, std::max(width, 1), std::max(height, 1)), EGL_BAD_ALLOC);
    surface.width = width;
    surface.height = height;
    surface.isShown = false;
}

void giveToGl(Surface& surface) {
    if (std::exchange(surface.vgDrewLast, false))
        blitterOf(surface).copy(surface.target, surface.drawing);
}

void takeFromGl(Surface& surface) {
    // On surfaces of the system's OpenGL may draw unseen, except while OpenVG alone has them.
    const bool mayGlHaveDrawn =
        surface.isAdopted &&
        (!surface.vgDrewLast || systemEgl()->GetCurrentSurface(EGL_DRAW) == surface.target);
    if (std::exchange(surface.glDrewLast, false) || mayGlHaveDrawn)
        blitterOf(surface).read(surface.target, surface.drawing);
    surface.vgDrewLast = true;
}

void showPixmap(Surface& surface) {
    if (surface.kind == Surface::Kind::pixmap && surface.terminations == surface.display.terminations)
        if (!putDrawing(surface))
            blitterOf(surface).copy(surface.target, surface.drawing);
}

EGLBoolean EGLAPIENTRY swapBuffersWithDamageKhr(EGLDisplay dpy, EGLSurface surface, const EGLint* rectangles,
                                                EGLint count) {
    return swapWithDamage("eglSwapBuffersWithDamageKHR", dpy, surface, rectangles, count);
}

EGLBoolean EGLAPIENTRY swapBuffersWithDamageExt(EGLDisplay dpy, EGLSurface surface, const EGLint* rectangles,
                                                EGLint count) {
    return swapWithDamage("eglSwapBuffersWithDamageEXT", dpy, surface, rectangles, count);
}

EGLBoolean EGLAPIENTRY setDamageRegionKhr(EGLDisplay dpy, EGLSurface handle, EGLint* rectangles,
                                          EGLint count) {
    if (isOurs(handle))
        return call(EGLBoolean(EGL_FALSE), [&] {
            const auto surface = postedSurface(dpy, handle);
            require(surface->isBackBuffered() && surface->swapBehavior == EGL_BUFFER_DESTROYED,
                    EGL_BAD_MATCH);
            return EGLBoolean(EGL_TRUE);
        });
    thisThread().error = EGL_SUCCESS;
    const auto function =
        reinterpret_cast<PFNEGLSETDAMAGEREGIONKHRPROC>(systemEgl()->GetProcAddress("eglSetDamageRegionKHR"));
    return function ? function(dpy, handle, rectangles, count) : EGLBoolean(EGL_FALSE);
}

}  // namespace vtm::egl

using namespace vtm::egl;

EGLBoolean EGLAPIENTRY eglSwapBuffers(EGLDisplay dpy, EGLSurface handle) {
    synchronizeImages();
    return isOurs(handle)
               ? swap(dpy, handle)
               : forward(&System::SwapBuffers, EGLBoolean(EGL_FALSE), EGL_BAD_SURFACE, dpy, handle);
}

EGLBoolean EGLAPIENTRY eglCopyBuffers(EGLDisplay dpy, EGLSurface handle, EGLNativePixmapType pixmap) {
    if (!surfaces().has(handle))
        return forward(&System::CopyBuffers, EGLBoolean(EGL_FALSE), EGL_BAD_SURFACE, dpy, handle, pixmap);
    return call(EGLBoolean(EGL_FALSE), [&] {
        if (isGlCurrent(handle)) {
            const auto drawn = getSurface(initializedDisplay(dpy), handle);
            requireSystem(systemEgl()->CopyBuffers(dpy, drawn->target, pixmap));
            return EGLBoolean(EGL_TRUE);
        }
        copyTo(*postedSurface(dpy, handle), pixmap);
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglSwapInterval(EGLDisplay dpy, EGLint interval) {
    if (currentApi() != EGL_OPENVG_API)
        return forward(&System::SwapInterval, EGLBoolean(EGL_FALSE), EGL_BAD_CONTEXT, dpy, interval);
    return call(EGLBoolean(EGL_FALSE), [&] {
        const Display& display = initializedDisplay(dpy);
        const auto surface = currentSurface();
        require(surface && &surface->display == &display, EGL_BAD_CONTEXT);
        const Config& config = *surface->config;
        surface->swapInterval = std::min(std::max(interval, config.minSwapInterval), config.maxSwapInterval);
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglWaitClient(void) {
    synchronizeImages();
    if (currentApi() != EGL_OPENVG_API && systemEgl()) {
        thisThread().error = EGL_SUCCESS;
        return systemEgl()->WaitClient();
    }
    return call(EGLBoolean(EGL_FALSE), [] {
        if (const auto surface = currentApi() == EGL_OPENVG_API ? currentSurface() : nullptr)
            showPixmap(*surface);
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglWaitGL(void) {
    synchronizeImages();
    if (systemEgl()) {
        thisThread().error = EGL_SUCCESS;
        return systemEgl()->WaitGL();
    }
    return call(EGLBoolean(EGL_FALSE), [] { return EGLBoolean(EGL_TRUE); });
}

EGLBoolean EGLAPIENTRY eglWaitNative(EGLint engine) {
    if (currentApi() != EGL_OPENVG_API && systemEgl()) {
        thisThread().error = EGL_SUCCESS;
        return systemEgl()->WaitNative(engine);
    }
    return call(EGLBoolean(EGL_FALSE), [&] {
        require(engine == EGL_CORE_NATIVE_ENGINE, EGL_BAD_PARAMETER);
        return EGLBoolean(EGL_TRUE);
    });
}
