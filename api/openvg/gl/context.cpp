#include "api/openvg/gl/context.hpp"

#include <atomic>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <EGL/eglext.h>
#include <fmt/format.h>

#include "api/system_egl/system.hpp"

namespace vtm::openvg::gl {

namespace {

bool isListed(const char* extensions, std::string_view name) {
    return fmt::format(" {} ", extensions ? extensions : "").find(fmt::format(" {} ", name)) !=
           std::string::npos;
}

template <class Function>
Function extension(const char* name) {
    return reinterpret_cast<Function>(egl::systemEgl()->GetProcAddress(name));
}

EGLDisplay platformDisplay(EGLenum platform, void* native) {
    const auto get = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    return get ? get(platform, native, nullptr) : EGL_NO_DISPLAY;
}

bool isSoftwareWanted() {
    const char* const value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    return value && *value && std::string_view(value) != "0" && std::string_view(value) != "false";
}

/// Nothing where EGL cannot list them.
std::optional<std::vector<EGLDeviceEXT>> listedDevices() {
    const auto query = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    std::vector<EGLDeviceEXT> devices(32);
    EGLint count = 0;
    if (!query || !query(EGLint(devices.size()), devices.data(), &count))
        return std::nullopt;
    devices.resize(std::size_t(count));
    return devices;
}

bool isSoftware(EGLDeviceEXT device) {
    const auto text = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    return text && isListed(text(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

std::atomic<EGLDisplay> preferred = EGL_NO_DISPLAY;

/// Best first.
std::vector<EGLDisplay> candidateDisplays() {
    const egl::System& system = *egl::systemEgl();
    std::vector<EGLDisplay> displays;
    if (const EGLDisplay first = preferred; first != EGL_NO_DISPLAY)
        displays.push_back(first);
    if (!std::getenv("EGL_PLATFORM")) {
        if (!isSoftwareWanted())
            for (const EGLDeviceEXT device : listedDevices().value_or(std::vector<EGLDeviceEXT>()))
                if (!isSoftware(device))
                    displays.push_back(platformDisplay(EGL_PLATFORM_DEVICE_EXT, device));
        if (isListed(system.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
            displays.push_back(platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY));
    }
    displays.push_back(system.GetDisplay(EGL_DEFAULT_DISPLAY));
    return displays;
}

std::string refusal(const char* function) {
    return fmt::format("{} failed (0x{:04x})", function, egl::systemEgl()->GetError());
}

constexpr EGLint plainAttributes[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
constexpr EGLint attributesWithNotice[] = {EGL_CONTEXT_CLIENT_VERSION, 3,
                                           EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                                           EGL_LOSE_CONTEXT_ON_RESET_EXT, EGL_NONE};

/// With notice of resets where that can be had.
ContextHandle createContext(EGLDisplay display, EGLConfig config) {
    const egl::System& system = *egl::systemEgl();
    const bool canNotify =
        isListed(system.QueryString(display, EGL_EXTENSIONS), "EGL_EXT_create_context_robustness");
    for (const EGLint* const attributes : {attributesWithNotice, plainAttributes}) {
        if (attributes == attributesWithNotice && !canNotify)
            continue;
        const EGLContext context = system.CreateContext(display, config, EGL_NO_CONTEXT, attributes);
        if (context != EGL_NO_CONTEXT)
            return {display, context, attributes};
    }
    return {};
}

}  // namespace

void preferDisplay(EGLDisplay display) { preferred = display; }

Drivers likelyDrivers() {
    if (!egl::systemEgl())
        return Drivers::none;
    const auto devices = listedDevices();
    if (!devices)
        return Drivers::perhapsGpu;
    if (devices->empty())
        return Drivers::none;
    for (const EGLDeviceEXT device : *devices)
        if (!isSoftware(device) && !isSoftwareWanted())
            return Drivers::perhapsGpu;
    return Drivers::software;
}

Context::Context() {
    if (!egl::systemEgl())
        throw std::runtime_error("there is no libEGL");
    std::string reasons;
    for (const EGLDisplay display : candidateDisplays()) {
        const std::string reason = open(display);
        if (reason.empty())
            return;
        reasons += (reasons.empty() ? "" : "; ") + reason;
    }
    throw std::runtime_error("no EGL display gives a context of OpenGL ES 3: " + reasons);
}

/// Why not; empty if it is open.
std::string Context::open(EGLDisplay display) {
    const egl::System& system = *egl::systemEgl();
    if (display == EGL_NO_DISPLAY)
        return "no display";
    if (!system.Initialize(display, nullptr, nullptr))
        return refusal("eglInitialize");
    if (!isListed(system.QueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
        return "no EGL_KHR_surfaceless_context";
    system.BindAPI(EGL_OPENGL_ES_API);  // of this thread
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!system.ChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        return refusal("eglChooseConfig");
    const ContextHandle handle = createContext(display, config);
    if (handle.context == EGL_NO_CONTEXT)
        return refusal("eglCreateContext");
    if (!system.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, handle.context)) {
        const std::string reason = refusal("eglMakeCurrent");
        system.DestroyContext(display, handle.context);
        return reason;
    }
    handle_ = handle;
    return {};
}

Context::~Context() {
    if (handle_.context == EGL_NO_CONTEXT)
        return;
    const egl::System& system = *egl::systemEgl();
    // The display stays initialised: EGL shares it with all other users of the process.
    system.MakeCurrent(handle_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    system.DestroyContext(handle_.display, handle_.context);
}

}  // namespace vtm::openvg::gl
