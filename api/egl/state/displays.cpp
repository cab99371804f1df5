// Sections 3.2 and 3.3: displays, their initialisation, and what they say of themselves.

#include <set>
#include <string>

#include "api/egl/images/images.hpp"
#include "api/egl/state/configs.hpp"
#include "api/egl/state/displays.hpp"
#include "api/egl/state/thread.hpp"
#include "api/egl/system/system_surfaces.hpp"

namespace vtm::egl {

namespace {

void initialize(Display& display) {
    const std::lock_guard lock(display.initializing);
    if (display.isInitialized)
        return;
    if (display.isSystems) {
        EGLint major = 0, minor = 0;
        if (systemEgl()->Initialize(display.handle, &major, &minor)) {
            display.major = major;
            display.minor = minor;
            display.systemRuns = true;
        } else if (!display.mayBeAlone) {
            throw Error{systemEgl()->GetError()};
        }
    }
    makeConfigs(display);
    display.isInitialized = true;
}

void terminate(Display& display) {
    const std::lock_guard lock(display.initializing);
    if (!display.isInitialized)
        return;
    display.isInitialized = false;
    // What is current in some thread stays until that thread lets go of it.
    forgetAllAdopted(display);
    surfaces().removeAll(display);
    forgetImages(display);
    contexts().removeAll(display);
    configs().removeAll(display);
    display.configs.clear();
    ++display.terminations;
    if (display.systemRuns.exchange(false))
        systemEgl()->Terminate(display.handle);
}

/// The text, for ever.
const char* kept(std::string text) {
    static auto& mutex = *new std::mutex;
    static auto& texts = *new std::set<std::string>;
    const std::lock_guard lock(mutex);
    return texts.insert(std::move(text)).first->c_str();
}

std::string systemString(const Display& display, EGLint name) {
    const char* const text = display.systemRuns ? systemEgl()->QueryString(display.handle, name) : nullptr;
    return text ? text : "";
}

bool hasWord(const std::string& text, const std::string& word) {
    return (' ' + text + ' ').find(' ' + word + ' ') != std::string::npos;
}

std::string withWord(std::string text, const std::string& word) {
    if (hasWord(text, word))
        return text;
    if (!text.empty() && text.back() != ' ')
        text += ' ';
    return text + word;
}

std::string displayString(const Display& display, EGLint name) {
    const std::string systems = systemString(display, name);
    switch (name) {
        case EGL_CLIENT_APIS:
            return withWord(systems, "OpenVG");
        case EGL_VENDOR:
            return systems.empty() ? "VTM" : "VTM, " + systems;
        case EGL_VERSION:
            // A space follows the number, which some drivers leave out.
            return systems.find(' ') != std::string::npos
                       ? systems
                       : std::to_string(display.major) + '.' + std::to_string(display.minor) + " VTM";
        case EGL_EXTENSIONS:
            return withWord(
                withWord(display.systemRuns ? systems : "EGL_KHR_no_config_context", "EGL_KHR_image_base"),
                "EGL_KHR_vg_parent_image");
        default:
            throw Error{EGL_BAD_PARAMETER};
    }
}

/// Without a system.
std::string clientString(EGLint name) {
    switch (name) {
        case EGL_EXTENSIONS:
            return "EGL_EXT_client_extensions EGL_KHR_client_get_all_proc_addresses";
        case EGL_VERSION:
            return "1.5 VTM";
        default:
            throw Error{EGL_BAD_DISPLAY};
    }
}

template <class Get>
EGLDisplay adopted(bool mayBeAlone, std::optional<void*> native, Get&& get) {
    thisThread().error = EGL_SUCCESS;
    const EGLDisplay display = get();
    if (display != EGL_NO_DISPLAY)
        addDisplay(display, true, mayBeAlone, native);
    return display;
}

/// What a display of this platform is named by, if that may be an X11 Display.
std::optional<void*> x11Display(EGLenum platform, void* native) {
    return platform == EGL_PLATFORM_X11_EXT ? std::optional(native) : std::nullopt;
}

}  // namespace

static EGLDisplay ownPlatformDisplay(EGLenum platform, void* native) {
    return call(EGLDisplay(EGL_NO_DISPLAY), [&]() -> EGLDisplay {
        require(platform == EGL_PLATFORM_SURFACELESS_MESA && native == nullptr, EGL_BAD_PARAMETER);
        return ownDisplay().handle;
    });
}

EGLDisplay EGLAPIENTRY getPlatformDisplayExt(EGLenum platform, void* native, const EGLint* attributes) {
    return adopted(false, x11Display(platform, native), [&]() -> EGLDisplay {
        const auto get = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
            systemEgl()->GetProcAddress("eglGetPlatformDisplayEXT"));
        return get ? get(platform, native, attributes) : EGL_NO_DISPLAY;
    });
}

}  // namespace vtm::egl

using namespace vtm::egl;

EGLDisplay EGLAPIENTRY eglGetDisplay(EGLNativeDisplayType native) {
    const bool isDefault = native == EGL_DEFAULT_DISPLAY;
    if (systemEgl()) {
        const EGLDisplay display =
            adopted(isDefault, static_cast<void*>(native), [&] { return systemEgl()->GetDisplay(native); });
        if (display != EGL_NO_DISPLAY || !isDefault)
            return display;
    }
    return call(EGLDisplay(EGL_NO_DISPLAY),
                [&]() -> EGLDisplay { return isDefault ? ownDisplay().handle : EGL_NO_DISPLAY; });
}

EGLDisplay EGLAPIENTRY eglGetPlatformDisplay(EGLenum platform, void* native, const EGLAttrib* attributes) {
    if (systemEgl() && systemEgl()->GetPlatformDisplay)
        return adopted(false, x11Display(platform, native),
                       [&] { return systemEgl()->GetPlatformDisplay(platform, native, attributes); });
    return ownPlatformDisplay(platform, native);
}

EGLBoolean EGLAPIENTRY eglInitialize(EGLDisplay dpy, EGLint* major, EGLint* minor) {
    return call(EGLBoolean(EGL_FALSE), [&] {
        Display* display = findDisplay(dpy);
        // The program may have it from a function of the system's that we do not know.
        if (!display && systemEgl() && dpy != EGL_NO_DISPLAY) {
            requireSystem(systemEgl()->Initialize(dpy, nullptr, nullptr));
            display = &addDisplay(dpy, true, false);
        }
        require(display != nullptr, EGL_BAD_DISPLAY);
        initialize(*display);
        if (major)
            *major = display->major;
        if (minor)
            *minor = display->minor;
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglTerminate(EGLDisplay dpy) {
    Display* const display = findDisplay(dpy);
    if (!display)
        return forward(&System::Terminate, EGLBoolean(EGL_FALSE), EGL_BAD_DISPLAY, dpy);
    return call(EGLBoolean(EGL_FALSE), [&] {
        terminate(*display);
        return EGLBoolean(EGL_TRUE);
    });
}

const char* EGLAPIENTRY eglQueryString(EGLDisplay dpy, EGLint name) {
    if (dpy == EGL_NO_DISPLAY) {
        if (systemEgl()) {
            thisThread().error = EGL_SUCCESS;
            return systemEgl()->QueryString(dpy, name);
        }
        return call(static_cast<const char*>(nullptr), [&] { return kept(clientString(name)); });
    }
    if (!findDisplay(dpy))
        return forward(&System::QueryString, static_cast<const char*>(nullptr), EGL_BAD_DISPLAY, dpy, name);
    return call(static_cast<const char*>(nullptr),
                [&] { return kept(displayString(initializedDisplay(dpy), name)); });
}
