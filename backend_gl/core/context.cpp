#include <vtm/gl/context.hpp>

#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <fmt/format.h>

#include "backend_gl/core/software_driver.hpp"

namespace vtm::gl {

namespace {

bool listed(const char* extensions, std::string_view name) {
    const std::string padded = fmt::format(" {} ", extensions == nullptr ? "" : extensions);
    return padded.find(fmt::format(" {} ", name)) != std::string::npos;
}

bool listedByClient(std::string_view name) {
    return listed(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), name);
}

template <class Function>
Function extensionFunction(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

EGLDisplay platformDisplay(EGLenum platform, void* native) {
    static const auto get = extensionFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    return get == nullptr ? EGL_NO_DISPLAY : get(platform, native, nullptr);
}

bool softwareWanted() {
    const char* value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    return value != nullptr && *value != '\0' && std::string_view(value) != "0" &&
           std::string_view(value) != "false";
}

/// Nothing where EGL cannot list them.
std::optional<std::vector<EGLDeviceEXT>> devices() {
    const auto query = extensionFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    constexpr EGLint maximum = 32;
    std::vector<EGLDeviceEXT> list(maximum);
    EGLint count = 0;
    if (query == nullptr || !query(maximum, list.data(), &count))
        return std::nullopt;
    list.resize(std::size_t(count));
    return list;
}

bool isSoftwareDevice(EGLDeviceEXT device) {
    const auto text = extensionFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    return text != nullptr && listed(text(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

std::vector<EGLDeviceEXT> hardwareDevices() {
    std::vector<EGLDeviceEXT> list = devices().value_or(std::vector<EGLDeviceEXT>());
    std::erase_if(list, isSoftwareDevice);
    return list;
}

/// Best first. EGL_PLATFORM, read by EGL itself, decides alone where it is set.
std::vector<EGLDisplay> candidateDisplays() {
    std::vector<EGLDisplay> displays;
    if (std::getenv("EGL_PLATFORM") == nullptr) {
        if (!softwareWanted() && listedByClient("EGL_EXT_platform_device"))
            for (EGLDeviceEXT device : hardwareDevices())
                displays.push_back(platformDisplay(EGL_PLATFORM_DEVICE_EXT, device));
        if (listedByClient("EGL_MESA_platform_surfaceless"))
            displays.push_back(platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY));
    }
    displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return displays;
}

}  // namespace

Driver likelyDriver() {
    const auto all = devices();
    if (!all)
        return Driver::PerhapsGpu;
    if (all->empty())
        return Driver::None;
    return softwareWanted() || hardwareDevices().empty() ? Driver::Software : Driver::PerhapsGpu;
}

struct Context::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::string renderer, version;

    ~Impl() {
        if (display == EGL_NO_DISPLAY)
            return;
        // The display stays initialised: EGL shares it with every other context of the process.
        if (eglGetCurrentContext() == context)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT)
            eglDestroyContext(display, context);
    }
};

namespace {

std::string refusal(const char* what) { return fmt::format("{} failed (0x{:04x})", what, eglGetError()); }

/// With notice of resets if it is wanted and can be had.
EGLContext createContext(EGLDisplay display, EGLConfig config, EGLContext share, bool robust) {
    std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0};
    if (robust && listed(eglQueryString(display, EGL_EXTENSIONS), "EGL_EXT_create_context_robustness")) {
        std::vector<EGLint> withNotice = attributes;
        withNotice.insert(withNotice.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                                             EGL_LOSE_CONTEXT_ON_RESET_EXT, EGL_NONE});
        const EGLContext context = eglCreateContext(display, config, share, withNotice.data());
        if (context != EGL_NO_CONTEXT)
            return context;
    }
    attributes.push_back(EGL_NONE);
    return eglCreateContext(display, config, share, attributes.data());
}

/// Makes a current context on a display, or says why not.
std::optional<std::string> openOn(EGLDisplay display, EGLContext share, bool robust, EGLContext& context) {
    if (display == EGL_NO_DISPLAY)
        return "no display";
    if (!eglInitialize(display, nullptr, nullptr))
        return refusal("eglInitialize");
    if (!listed(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
        return "no EGL_KHR_surfaceless_context";
    if (!eglBindAPI(EGL_OPENGL_ES_API))
        return refusal("eglBindAPI");
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        return refusal("eglChooseConfig for OpenGL ES 3");
    context = createContext(display, config, share, robust);
    if (context == EGL_NO_CONTEXT)
        return refusal("eglCreateContext");
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return std::nullopt;
    const std::string reason = refusal("eglMakeCurrent");
    eglDestroyContext(display, context);
    context = EGL_NO_CONTEXT;
    return reason;
}

std::string glString(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

}  // namespace

Context::Context(const ContextOptions& options) : impl_(std::make_unique<Impl>()) {
    const Impl* shared = options.share == nullptr ? nullptr : options.share->impl_.get();
    std::string reasons;
    for (const EGLDisplay display :
         shared == nullptr ? candidateDisplays() : std::vector<EGLDisplay>{shared->display}) {
        const std::optional<std::string> reason = openOn(
            display, shared == nullptr ? EGL_NO_CONTEXT : shared->context, options.robust, impl_->context);
        if (!reason) {
            impl_->display = display;
            impl_->renderer = glString(GL_RENDERER);
            impl_->version = glString(GL_VERSION);
            return;
        }
        reasons += "; " + *reason;
    }
    throw GlError("no EGL display gives an OpenGL ES 3 context" + reasons);
}

Context::~Context() = default;

void Context::makeCurrent() const {
    if (!eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->context))
        throw GlError(refusal("eglMakeCurrent"));
}

const std::string& Context::renderer() const { return impl_->renderer; }
const std::string& Context::version() const { return impl_->version; }
bool Context::isSoftware() const { return runsOnCpu(impl_->renderer).value_or(false); }

}  // namespace vtm::gl
