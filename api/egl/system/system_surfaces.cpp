#include "api/egl/system/system_surfaces.hpp"

#include <map>
#include <mutex>

#include "api/egl/state/configs.hpp"
#include "api/egl/state/thread.hpp"
#include "api/egl/surfaces/posting.hpp"
#include "api/egl/surfaces/surfaces.hpp"

namespace vtm::egl {

namespace {

struct Adopted {
    std::mutex mutex;
    std::map<EGLSurface, std::shared_ptr<Surface>> all;
    struct Window {
        EGLDisplay display;
        std::uintptr_t native;
    };
    std::map<EGLSurface, Window> windows;  ///< that the system has surfaces on
};

Adopted& adopted() {
    static auto& adopted = *new Adopted;
    return adopted;
}

/// Null if OpenVG has no such colours.
std::shared_ptr<const Config> configLike(Display& display, EGLConfig systems) {
    const auto value = [&](EGLint name) { return systemConfigAttribute(display, systems, name); };
    const std::lock_guard lock(display.initializing);
    for (const auto& config : display.configs) {
        const VtmSurfaceFormat& f = config->format;
        if (f.redBits == value(EGL_RED_SIZE) && f.greenBits == value(EGL_GREEN_SIZE) &&
            f.blueBits == value(EGL_BLUE_SIZE) && f.alphaBits == value(EGL_ALPHA_SIZE) &&
            f.luminanceBits == value(EGL_LUMINANCE_SIZE))
            return config;
    }
    return nullptr;
}

EGLint querySystem(const Display& display, EGLSurface handle, EGLint name) {
    EGLint value = 0;
    requireSystem(display.systemRuns && systemEgl()->QuerySurface(display.handle, handle, name, &value));
    return value;
}

/// 0: it is on none.
std::uintptr_t windowOf(EGLSurface handle) {
    const std::lock_guard lock(adopted().mutex);
    const auto it = adopted().windows.find(handle);
    return it == adopted().windows.end() ? 0 : it->second.native;
}

std::shared_ptr<Surface> adopt(Display& display, EGLSurface handle) {
    const EGLint list[] = {EGL_CONFIG_ID, querySystem(display, handle, EGL_CONFIG_ID), EGL_NONE};
    EGLConfig systems = nullptr;
    EGLint count = 0;
    requireSystem(systemEgl()->ChooseConfig(display.handle, list, &systems, 1, &count));
    require(count == 1, EGL_BAD_SURFACE);
    const auto config = configLike(display, systems);
    require(config && (systemConfigAttribute(display, systems, EGL_RENDERABLE_TYPE) & EGL_OPENGL_ES2_BIT),
            EGL_BAD_MATCH);
    // Of whatever kind it is, the system knows its size, and what swapping it does.
    const auto surface = std::make_shared<Surface>(display, config, Surface::Kind::window);
    surface->isAdopted = true;
    surface->handle = surface->target = handle;
    surface->targetConfig = systems;
    surface->native = windowOf(handle);
    for (const EGLint name : {EGL_VG_COLORSPACE, EGL_VG_ALPHA_FORMAT})
        setDrawingAttribute(*surface, name, querySystem(display, handle, name));
    createDrawing(*surface, querySystem(display, handle, EGL_WIDTH),
                  querySystem(display, handle, EGL_HEIGHT));
    return surface;
}

}  // namespace

std::shared_ptr<const Config> configForVg(Display& display, EGLConfig handle) {
    if (configs().has(handle))
        return getConfig(display, handle);
    EGLint id = 0;
    require(display.systemRuns && systemEgl()->GetConfigAttrib(display.handle, handle, EGL_CONFIG_ID, &id),
            EGL_BAD_CONFIG);
    const auto config = configLike(display, handle);
    require(config != nullptr, EGL_BAD_MATCH);
    return config;
}

std::shared_ptr<Surface> adoptedSurface(Display& display, EGLSurface handle) {
    require(display.systemRuns, EGL_BAD_SURFACE);
    std::shared_ptr<Surface> surface;
    {
        const std::lock_guard lock(adopted().mutex);
        if (const auto it = adopted().all.find(handle); it != adopted().all.end())
            surface = it->second;
    }
    if (!surface) {
        // Not under the lock: the display has one of its own.
        surface = adopt(display, handle);
        const std::lock_guard lock(adopted().mutex);
        surface = adopted().all.try_emplace(handle, surface).first->second;
    }
    require(&surface->display == &display, EGL_BAD_SURFACE);
    return surface;
}

void noteWindow(EGLDisplay display, EGLSurface handle, std::uintptr_t window) {
    if (handle == EGL_NO_SURFACE)
        return;
    const std::lock_guard lock(adopted().mutex);
    adopted().windows.insert_or_assign(handle, Adopted::Window{display, window});
}

void forgetAdopted(EGLSurface handle) {
    const std::lock_guard lock(adopted().mutex);
    adopted().all.erase(handle);
    adopted().windows.erase(handle);
}

void forgetAllAdopted(const Display& display) {
    const std::lock_guard lock(adopted().mutex);
    std::erase_if(adopted().all, [&](const auto& entry) { return &entry.second->display == &display; });
    std::erase_if(adopted().windows,
                  [&](const auto& entry) { return entry.second.display == display.handle; });
}

bool isAdoptedCurrent(EGLSurface handle) {
    const auto surface = currentSurface();
    return surface && surface->isAdopted && surface->handle == handle;
}

}  // namespace vtm::egl
