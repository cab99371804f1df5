#include "gles_context/context.hpp"

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <EGL/eglext.h>
#include <fmt/format.h>

namespace vtm::gles_context {

namespace {

bool isListed(const char* extensions, std::string_view name) {
    return fmt::format(" {} ", extensions ? extensions : "").find(fmt::format(" {} ", name)) !=
           std::string::npos;
}

template <class Function>
Function extension(const Egl& egl, const char* name) {
    return reinterpret_cast<Function>(egl.GetProcAddress(name));
}

bool isSoftwareWanted() {
    const char* const value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    return value && *value && std::string_view(value) != "0" && std::string_view(value) != "false";
}

/// Nothing where EGL cannot list them.
std::optional<std::vector<EGLDeviceEXT>> listedDevices(const Egl& egl) {
    const auto query = extension<PFNEGLQUERYDEVICESEXTPROC>(egl, "eglQueryDevicesEXT");
    std::vector<EGLDeviceEXT> devices(32);
    EGLint count = 0;
    if (!query || !query(EGLint(devices.size()), devices.data(), &count))
        return std::nullopt;
    devices.resize(std::size_t(count));
    return devices;
}

/// Those whose shaders do not run on the CPU.
std::vector<EGLDeviceEXT> hardwareDevices(const Egl& egl) {
    std::vector<EGLDeviceEXT> devices = listedDevices(egl).value_or(std::vector<EGLDeviceEXT>());
    const auto text = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl, "eglQueryDeviceStringEXT");
    std::erase_if(devices, [&](EGLDeviceEXT device) {
        return text && isListed(text(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
    });
    return devices;
}

/// Best first.
std::vector<EGLDisplay> candidateDisplays(const Egl& egl, const Wish& wish) {
    std::vector<EGLDisplay> displays;
    if (wish.display != EGL_NO_DISPLAY)
        displays.push_back(wish.display);
    if (wish.thatDisplayOnly)
        return displays;
    if (!std::getenv("EGL_PLATFORM")) {
        const auto get = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl, "eglGetPlatformDisplayEXT");
        const char* const extensions = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
        if (get && !isSoftwareWanted() && isListed(extensions, "EGL_EXT_platform_device"))
            for (const EGLDeviceEXT device : hardwareDevices(egl))
                displays.push_back(get(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
        if (get && isListed(extensions, "EGL_MESA_platform_surfaceless"))
            displays.push_back(get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    }
    displays.push_back(egl.GetDisplay(EGL_DEFAULT_DISPLAY));
    return displays;
}

std::string refusal(const Egl& egl, const char* function) {
    return fmt::format("{} failed (0x{:04x})", function, egl.GetError());
}

constexpr EGLint plainAttributes[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
constexpr EGLint robustAttributes[] = {EGL_CONTEXT_CLIENT_VERSION, 3,
                                       EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                                       EGL_LOSE_CONTEXT_ON_RESET_EXT, EGL_NONE};

Context createContext(const Egl& egl, EGLDisplay display, EGLConfig config, const Wish& wish) {
    const bool mayBeRobust = wish.isRobust && isListed(egl.QueryString(display, EGL_EXTENSIONS),
                                                       "EGL_EXT_create_context_robustness");
    for (const EGLint* const attributes : {robustAttributes, plainAttributes}) {
        if (attributes == robustAttributes && !mayBeRobust)
            continue;
        const EGLContext handle = egl.CreateContext(display, config, wish.share, attributes);
        if (handle != EGL_NO_CONTEXT)
            return {display, handle, attributes};
    }
    return {};
}

/// Why not; empty if it is open.
std::string openOn(const Egl& egl, EGLDisplay display, const Wish& wish, Context& context) {
    if (display == EGL_NO_DISPLAY)
        return "no display";
    if (!egl.Initialize(display, nullptr, nullptr))
        return refusal(egl, "eglInitialize");
    if (!isListed(egl.QueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
        return "no EGL_KHR_surfaceless_context";
    if (!egl.BindAPI(EGL_OPENGL_ES_API))
        return refusal(egl, "eglBindAPI");
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl.ChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        return refusal(egl, "eglChooseConfig for OpenGL ES 3");
    context = createContext(egl, display, config, wish);
    if (context.handle == EGL_NO_CONTEXT)
        return refusal(egl, "eglCreateContext");
    if (egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context.handle))
        return {};
    const std::string reason = refusal(egl, "eglMakeCurrent");
    egl.DestroyContext(display, context.handle);
    return reason;
}

}  // namespace

Drivers likelyDrivers(const Egl& egl) {
    const auto devices = listedDevices(egl);
    if (!devices)
        return Drivers::perhapsGpu;
    if (devices->empty())
        return Drivers::none;
    return isSoftwareWanted() || hardwareDevices(egl).empty() ? Drivers::software : Drivers::perhapsGpu;
}

Context openContext(const Egl& egl, const Wish& wish) {
    std::string reasons;
    for (const EGLDisplay display : candidateDisplays(egl, wish)) {
        Context context;
        const std::string reason = openOn(egl, display, wish, context);
        if (reason.empty())
            return context;
        reasons += "; " + reason;
    }
    throw std::runtime_error("no EGL display gives an OpenGL ES 3 context" + reasons);
}

}  // namespace vtm::gles_context
