// Sections 3.5.1 and 3.5.4: windows and pixmaps. OpenVG draws in memory; the system has a surface on the
// window or the pixmap, which shows that memory when the program posts it.

#include "api/egl/state/attributes.hpp"
#include "api/egl/state/configs.hpp"
#include "api/egl/state/thread.hpp"
#include "api/egl/surfaces/surfaces.hpp"
#include "api/egl/surfaces/x_pictures.hpp"
#include "api/egl/system/system_surfaces.hpp"

namespace vtm::egl {

namespace {

using Kind = Surface::Kind;

/// Makes the system's surface with the config that shows ours, or, if that does not fit the window or pixmap,
/// with any that does.
template <class Make>
void createTarget(Surface& surface, EGLConfig best, EGLint surfaceBit, Make&& make) {
    const Display& display = surface.display;
    std::vector<EGLConfig> candidates{best};
    for (const EGLConfig config : systemConfigs(display))
        if (config != best && (systemConfigAttribute(display, config, EGL_SURFACE_TYPE) & surfaceBit) &&
            (systemConfigAttribute(display, config, EGL_RENDERABLE_TYPE) & EGL_OPENGL_ES2_BIT) &&
            systemConfigAttribute(display, config, EGL_SAMPLES) == 0)
            candidates.push_back(config);
    EGLint error = EGL_BAD_MATCH;
    for (std::size_t i = 0; i < candidates.size() && error == EGL_BAD_MATCH; ++i) {
        surface.targetConfig = candidates[i];
        surface.target = make(candidates[i]);
        error = surface.target != EGL_NO_SURFACE ? EGL_SUCCESS : systemEgl()->GetError();
    }
    require(surface.target != EGL_NO_SURFACE, error);
}

EGLint targetAttribute(const Surface& surface, EGLint name) {
    EGLint value = 0;
    requireSystem(systemEgl()->QuerySurface(surface.display.handle, surface.target, name, &value));
    return value;
}

/// `make` creates the system's surface with a config of the system's.
template <class Number, class Make>
EGLSurface createNative(Display& display, Kind kind, EGLConfig handle, const Number* list, Make&& make,
                        std::uintptr_t native) {
    const auto config = getConfig(display, handle);
    const bool isWindow = kind == Kind::window;
    const EGLConfig best = isWindow ? config->window : config->pixmap;
    require(best != nullptr && display.systemRuns, EGL_BAD_MATCH);
    const auto surface = std::make_shared<Surface>(display, config, kind);
    surface->native = native;
    surface->renderBuffer = isWindow ? EGL_BACK_BUFFER : EGL_SINGLE_BUFFER;
    for (const auto& [attribute, value] : attributeList(list)) {
        if (isWindow && attribute == EGL_RENDER_BUFFER) {
            require(value == EGL_BACK_BUFFER || value == EGL_SINGLE_BUFFER, EGL_BAD_ATTRIBUTE);
            surface->renderBuffer = value;
        } else {
            require(setDrawingAttribute(*surface, attribute, value), EGL_BAD_ATTRIBUTE);
        }
    }
    createTarget(*surface, best, isWindow ? EGL_WINDOW_BIT : EGL_PIXMAP_BIT, make);
    createDrawing(*surface, targetAttribute(*surface, EGL_WIDTH), targetAttribute(*surface, EGL_HEIGHT));
    surfaces().add(surface);
    return surface->handle;
}

template <class Number, class Make>
EGLSurface createdNative(EGLDisplay dpy, Kind kind, EGLConfig config, const Number* list, Make&& make,
                         std::uintptr_t native) {
    return call(EGLSurface(EGL_NO_SURFACE),
                [&] { return createNative(initializedDisplay(dpy), kind, config, list, make, native); });
}

/// Calls the system's function of EGL_EXT_platform_base.
EGLSurface callExt(const char* name, EGLDisplay dpy, EGLConfig config, void* native, const EGLint* list) {
    const auto create =
        reinterpret_cast<PFNEGLCREATEPLATFORMWINDOWSURFACEEXTPROC>(systemEgl()->GetProcAddress(name));
    return create ? create(dpy, config, native, list) : EGL_NO_SURFACE;
}

std::uintptr_t platformNative(EGLDisplay dpy, const void* native) {
    const Display* const display = findDisplay(dpy);
    return display && display->systemRuns ? platformDrawable(*display, native) : 0;
}

EGLSurface createExt(const char* name, Kind kind, EGLDisplay dpy, EGLConfig config, void* native,
                     const EGLint* list) {
    if (configs().has(config))
        return createdNative(
            dpy, kind, config, list,
            [&](EGLConfig systems) { return callExt(name, dpy, systems, native, nullptr); },
            platformNative(dpy, native));
    thisThread().error = EGL_SUCCESS;
    const EGLSurface made = callExt(name, dpy, config, native, list);
    if (kind == Kind::window)
        noteWindow(dpy, made, platformNative(dpy, native));
    return made;
}

}  // namespace

EGLSurface EGLAPIENTRY createPlatformWindowSurfaceExt(EGLDisplay dpy, EGLConfig config, void* window,
                                                      const EGLint* list) {
    return createExt("eglCreatePlatformWindowSurfaceEXT", Kind::window, dpy, config, window, list);
}

EGLSurface EGLAPIENTRY createPlatformPixmapSurfaceExt(EGLDisplay dpy, EGLConfig config, void* pixmap,
                                                      const EGLint* list) {
    return createExt("eglCreatePlatformPixmapSurfaceEXT", Kind::pixmap, dpy, config, pixmap, list);
}

}  // namespace vtm::egl

using namespace vtm::egl;

EGLSurface EGLAPIENTRY eglCreateWindowSurface(EGLDisplay dpy, EGLConfig config, EGLNativeWindowType window,
                                              const EGLint* list) {
    if (!configs().has(config)) {
        const EGLSurface made = forward(&System::CreateWindowSurface, EGLSurface(EGL_NO_SURFACE),
                                        EGL_BAD_CONFIG, dpy, config, window, list);
        noteWindow(dpy, made, std::uintptr_t(window));
        return made;
    }
    const auto make = [&](EGLConfig systems) {
        return systemEgl()->CreateWindowSurface(dpy, systems, window, nullptr);
    };
    return createdNative(dpy, Kind::window, config, list, make, std::uintptr_t(window));
}

EGLSurface EGLAPIENTRY eglCreatePlatformWindowSurface(EGLDisplay dpy, EGLConfig config, void* window,
                                                      const EGLAttrib* list) {
    if (!configs().has(config)) {
        const EGLSurface made = forward(&System::CreatePlatformWindowSurface, EGLSurface(EGL_NO_SURFACE),
                                        EGL_BAD_CONFIG, dpy, config, window, list);
        noteWindow(dpy, made, platformNative(dpy, window));
        return made;
    }
    const auto make = [&](EGLConfig systems) {
        return systemEgl()->CreatePlatformWindowSurface
                   ? systemEgl()->CreatePlatformWindowSurface(dpy, systems, window, nullptr)
                   : EGL_NO_SURFACE;
    };
    return createdNative(dpy, Kind::window, config, list, make, platformNative(dpy, window));
}

EGLSurface EGLAPIENTRY eglCreatePixmapSurface(EGLDisplay dpy, EGLConfig config, EGLNativePixmapType pixmap,
                                              const EGLint* list) {
    if (!configs().has(config))
        return forward(&System::CreatePixmapSurface, EGLSurface(EGL_NO_SURFACE), EGL_BAD_CONFIG, dpy, config,
                       pixmap, list);
    const auto make = [&](EGLConfig systems) {
        return systemEgl()->CreatePixmapSurface(dpy, systems, pixmap, nullptr);
    };
    return createdNative(dpy, Kind::pixmap, config, list, make, std::uintptr_t(pixmap));
}

EGLSurface EGLAPIENTRY eglCreatePlatformPixmapSurface(EGLDisplay dpy, EGLConfig config, void* pixmap,
                                                      const EGLAttrib* list) {
    if (!configs().has(config))
        return forward(&System::CreatePlatformPixmapSurface, EGLSurface(EGL_NO_SURFACE), EGL_BAD_CONFIG, dpy,
                       config, pixmap, list);
    const auto make = [&](EGLConfig systems) {
        return systemEgl()->CreatePlatformPixmapSurface
                   ? systemEgl()->CreatePlatformPixmapSurface(dpy, systems, pixmap, nullptr)
                   : EGL_NO_SURFACE;
    };
    return createdNative(dpy, Kind::pixmap, config, list, make, platformNative(dpy, pixmap));
}
