/// \file
/// What handles of ours stand for (EGL specification section 2.2).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <EGL/egl.h>

#include <vtm/vg_image.h>

namespace vtm::egl {

struct Config;
class Blitter;
class XPicture;
class GlImage;

/// Section 2.1.2. A display stays for ever once a program has asked for it.
struct Display {
    /// The system's own handle where the system has this display: functions that the system alone knows take
    /// it too.
    EGLDisplay handle = EGL_NO_DISPLAY;
    bool isSystems = false;
    /// OpenVG alone is better than nothing, if the system cannot initialise it.
    bool mayBeAlone = false;
    /// What the program named it by, if that is an X11 Display where windows are X11's; null: the default
    /// one.
    std::optional<void*> native;

    std::mutex initializing;
    std::atomic<bool> isInitialized = false;
    std::atomic<bool> systemRuns = false;  ///< the system initialised it too
    std::atomic<unsigned> terminations = 0;
    EGLint major = 1, minor = 5;
    std::vector<std::shared_ptr<const Config>> configs;  ///< guarded by `initializing`
};

/// Section 3.4: a format that OpenVG draws into.
struct Config {
    Display* display = nullptr;
    EGLConfig handle = nullptr;
    EGLint id = 0;
    VtmSurfaceFormat format{};
    VtmCompositor compositor = VTM_COMPOSITOR_AUTOMATIC;  ///< of its surfaces
    /// What the config says of multisampling. Coverage is exact, so pixels are the same.
    EGLint samples = 0;
    /// The system's configs by which windows and pixmaps are shown; null: they cannot be.
    EGLConfig window = nullptr, pixmap = nullptr;
    /// The system's config with the same colours, by which OpenGL draws into surfaces of this one; null: it
    /// cannot.
    EGLConfig gl = nullptr;
    EGLint glApis = 0, depthBits = 0, stencilBits = 0;
    EGLint visualId = 0, visualType = EGL_NONE;
    EGLint minSwapInterval = 0, maxSwapInterval = 0;

    /// Of table 3.1; nothing if there is no such attribute.
    std::optional<EGLint> attribute(EGLint name) const;
};

/// Section 3.5. What is drawn is in memory; a window or a pixmap of the system's shows it.
struct Surface {
    enum class Kind { pbuffer, window, pixmap };

    Surface(Display& display, std::shared_ptr<const Config> config, Kind kind);
    ~Surface();
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    Display& display;
    const std::shared_ptr<const Config> config;
    const Kind kind;
    EGLSurface handle = EGL_NO_SURFACE;
    VtmSurface* drawing = nullptr;
    std::atomic<EGLint> width = 0, height = 0;
    bool isLinear = false, isPremultiplied = false;
    EGLint glColorspace = EGL_GL_COLORSPACE_LINEAR;
    EGLint largestPbuffer = EGL_FALSE;
    EGLint renderBuffer = EGL_BACK_BUFFER;
    std::atomic<EGLint> swapBehavior = EGL_BUFFER_PRESERVED;
    VGImage image = VG_INVALID_HANDLE;   ///< that it draws into
    EGLSurface target = EGL_NO_SURFACE;  ///< the system's
    std::uintptr_t native = 0;           ///< window or pixmap that it is for; 0: only the system knows
    EGLConfig targetConfig = nullptr;    ///< of that
    bool isAdopted = false;              ///< `target` is the program's, and `handle` too
    const unsigned terminations;         ///< of the display, when it was created
    std::unique_ptr<Blitter> blitter;    ///< made when first needed
    std::unique_ptr<XPicture> xPicture;  ///< as well
    EGLint swapInterval = 1;

    std::atomic<bool> isShown = false;  ///< what is drawn was swapped, in this size

    std::atomic<int> vgUses = 0, glUses = 0;  ///< threads where it is current
    bool glDrewLast = false, vgDrewLast = false;

    bool isBackBuffered() const { return kind != Kind::pixmap; }
};

/// Counts itself among the surface's uses as long as it lives.
template <std::atomic<int> Surface::*uses>
class SurfaceUse {
public:
    SurfaceUse() = default;
    explicit SurfaceUse(std::shared_ptr<Surface> surface) : surface_(std::move(surface)) {
        if (surface_)
            ++(*surface_.*uses);
    }
    ~SurfaceUse() {
        if (surface_)
            --(*surface_.*uses);
    }
    SurfaceUse(SurfaceUse&& other) noexcept : surface_(std::exchange(other.surface_, nullptr)) {}
    SurfaceUse& operator=(SurfaceUse&& other) noexcept {
        std::swap(surface_, other.surface_);
        return *this;
    }

    const std::shared_ptr<Surface>& operator*() const { return surface_; }

private:
    std::shared_ptr<Surface> surface_;
};

/// Section 3.7.
struct Context {
    Context(Display& display, std::shared_ptr<const Config> config, VtmContext* drawing);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    Display& display;
    const std::shared_ptr<const Config> config;  ///< null: fits every surface
    VtmContext* const drawing;
    EGLContext handle = EGL_NO_CONTEXT;
};

/// Of an image of OpenVG's (EGL_KHR_vg_parent_image). All others are the system's.
struct Image {
    Image(Display& display, VGImage source, VtmSharedImage* shared);
    ~Image();
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    Display& display;
    const VGImage source;
    VtmSharedImage* const shared;
    EGLImage handle = EGL_NO_IMAGE;  ///< the system's, if OpenGL can use it
    std::unique_ptr<GlImage> gl;     ///< null: it cannot
};

}  // namespace vtm::egl
