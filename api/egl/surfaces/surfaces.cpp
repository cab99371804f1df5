// Sections 3.5.5, 3.5.6 and 3.6: what all surfaces of OpenVG have in common.

#include "api/egl/surfaces/surfaces.hpp"

#include <algorithm>

#include <vtm/vg_gl.h>

#include "api/egl/state/thread.hpp"
#include "api/egl/surfaces/blitter.hpp"
#include "api/egl/surfaces/posting.hpp"
#include "api/egl/surfaces/x_pictures.hpp"
#include "api/egl/system/system_surfaces.hpp"

namespace vtm::egl {

Surface::Surface(Display& d, std::shared_ptr<const Config> c, Kind k)
    : display(d), config(std::move(c)), kind(k), terminations(d.terminations) {}

Surface::~Surface() {
    vtmDestroySurface(drawing);
    // A display that was terminated took the system's surfaces with it, and may have given their handles to
    // others.
    if (display.terminations != terminations) {
        if (blitter)
            blitter->forget();
    } else if (target != EGL_NO_SURFACE) {
        blitter = nullptr;
        if (!isAdopted)
            systemEgl()->DestroySurface(display.handle, target);
    }
}

bool setDrawingAttribute(Surface& surface, EGLint attribute, EGLint value) {
    const auto choose = [&](EGLint no, EGLint yes) {
        require(value == no || value == yes, EGL_BAD_ATTRIBUTE);
        return value == yes;
    };
    switch (attribute) {
        case EGL_GL_COLORSPACE:
            choose(EGL_GL_COLORSPACE_LINEAR, EGL_GL_COLORSPACE_SRGB);
            surface.glColorspace = value;
            return true;
        case EGL_VG_COLORSPACE:
            surface.isLinear = choose(EGL_VG_COLORSPACE_sRGB, EGL_VG_COLORSPACE_LINEAR);
            return true;
        case EGL_VG_ALPHA_FORMAT:
            surface.isPremultiplied = choose(EGL_VG_ALPHA_FORMAT_NONPRE, EGL_VG_ALPHA_FORMAT_PRE);
            return true;
        default:
            return false;
    }
}

void createDrawing(Surface& surface, EGLint width, EGLint height) {
    VtmSurfaceFormat format = surface.config->format;
    format.linear = VGboolean(surface.isLinear);
    format.premultiplied = VGboolean(surface.isPremultiplied);
    // A surface without a pixel is legal here, and nothing can be drawn on it; OpenVG wants one.
    // Windows of this display can then show what a GPU has drawn, and OpenVG has its textures.
    if (surface.display.systemRuns)
        vtmPreferGlDisplay(surface.display.handle);
    surface.drawing = vtmCreateSurface(std::max(width, 1), std::max(height, 1), &format);
    require(surface.drawing != nullptr, EGL_BAD_ALLOC);
    vtmChooseCompositor(surface.drawing, surface.config->compositor);
    surface.width = width;
    surface.height = height;
}

namespace {

/// A window may have changed its size since OpenVG drew.
EGLint side(const Surface& surface, EGLint name, EGLint drawn) {
    EGLint value = drawn;
    if (surface.kind == Surface::Kind::window && surface.glUses > 0)
        systemEgl()->QuerySurface(surface.display.handle, surface.target, name, &value);
    return value;
}

/// A program that asks for the size draws for it: the window in which this thread's OpenVG draws has its new
/// size from here on. Section 3.10.1.1 only asks for that in eglSwapBuffers, when a frame for the old size is
/// drawn already.
void followWindow(EGLSurface handle, EGLint attribute) {
    const auto surface = currentSurface();
    if ((attribute == EGL_WIDTH || attribute == EGL_HEIGHT) && surface && surface->handle == handle &&
        surface->terminations == surface->display.terminations)
        fitToTarget(*surface);
}

/// Of table 3.5; nothing for those that a surface of this kind leaves unmodified.
std::optional<EGLint> surfaceAttribute(const Surface& surface, EGLint attribute) {
    const bool isPbuffer = surface.kind == Surface::Kind::pbuffer;
    const auto ofPbuffer = [&](EGLint value) { return isPbuffer ? std::optional(value) : std::nullopt; };
    switch (attribute) {
        case EGL_GL_COLORSPACE:
            return surface.glColorspace;
        case EGL_VG_ALPHA_FORMAT:
            return surface.isPremultiplied ? EGL_VG_ALPHA_FORMAT_PRE : EGL_VG_ALPHA_FORMAT_NONPRE;
        case EGL_VG_COLORSPACE:
            return surface.isLinear ? EGL_VG_COLORSPACE_LINEAR : EGL_VG_COLORSPACE_sRGB;
        case EGL_CONFIG_ID:
            return surface.config->id;
        case EGL_WIDTH:
            return side(surface, attribute, surface.width);
        case EGL_HEIGHT:
            return side(surface, attribute, surface.height);
        case EGL_LARGEST_PBUFFER:
            return ofPbuffer(surface.largestPbuffer);
        case EGL_HORIZONTAL_RESOLUTION:
        case EGL_VERTICAL_RESOLUTION:
        case EGL_PIXEL_ASPECT_RATIO:
            return EGL_UNKNOWN;
        case EGL_MIPMAP_TEXTURE:
            return ofPbuffer(EGL_FALSE);
        case EGL_MIPMAP_LEVEL:
            return ofPbuffer(0);
        case EGL_TEXTURE_FORMAT:
        case EGL_TEXTURE_TARGET:
            return ofPbuffer(EGL_NO_TEXTURE);
        case EGL_MULTISAMPLE_RESOLVE:
            return EGL_MULTISAMPLE_RESOLVE_DEFAULT;
        case EGL_RENDER_BUFFER:
            return surface.renderBuffer;
        case EGL_SWAP_BEHAVIOR:
            return surface.swapBehavior;
        case EGL_BUFFER_AGE_EXT:
            return surface.isBackBuffered() && surface.isShown ? 1 : 0;
        default:
            throw Error{EGL_BAD_ATTRIBUTE};
    }
}

void setAttribute(Surface& surface, EGLint attribute, EGLint value) {
    switch (attribute) {
        case EGL_MIPMAP_LEVEL:
            // Has no effect on what is no texture.
            require(surface.config->gl != nullptr, EGL_BAD_PARAMETER);
            break;
        case EGL_MULTISAMPLE_RESOLVE:
            require(value != EGL_MULTISAMPLE_RESOLVE_BOX, EGL_BAD_MATCH);
            require(value == EGL_MULTISAMPLE_RESOLVE_DEFAULT, EGL_BAD_ATTRIBUTE);
            break;
        case EGL_SWAP_BEHAVIOR:
            require(value == EGL_BUFFER_PRESERVED || value == EGL_BUFFER_DESTROYED, EGL_BAD_ATTRIBUTE);
            surface.swapBehavior = value;
            break;
        default:
            throw Error{EGL_BAD_ATTRIBUTE};
    }
}

/// Section 3.6: OpenGL ES cannot bind surfaces of OpenVG as textures.
EGLBoolean refuseTexture(EGLDisplay dpy, EGLSurface handle) {
    return call(EGLBoolean(EGL_FALSE), [&]() -> EGLBoolean {
        getSurface(initializedDisplay(dpy), handle);
        throw Error{EGL_BAD_SURFACE};
    });
}

}  // namespace

}  // namespace vtm::egl

using namespace vtm::egl;

EGLBoolean EGLAPIENTRY eglDestroySurface(EGLDisplay dpy, EGLSurface handle) {
    if (!surfaces().has(handle)) {
        const EGLBoolean isDestroyed =
            forward(&System::DestroySurface, EGLBoolean(EGL_FALSE), EGL_BAD_SURFACE, dpy, handle);
        if (isDestroyed)
            forgetAdopted(handle);
        return isDestroyed;
    }
    return call(EGLBoolean(EGL_FALSE), [&] {
        getSurface(initializedDisplay(dpy), handle);
        surfaces().remove(handle);
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglQuerySurface(EGLDisplay dpy, EGLSurface handle, EGLint attribute, EGLint* value) {
    const bool isAdopted = isAdoptedCurrent(handle);
    if (!surfaces().has(handle) && !isAdopted)
        return forward(&System::QuerySurface, EGLBoolean(EGL_FALSE), EGL_BAD_SURFACE, dpy, handle, attribute,
                       value);
    return call(EGLBoolean(EGL_FALSE), [&] {
        const auto surface = isAdopted ? currentSurface() : getSurface(initializedDisplay(dpy), handle);
        followWindow(handle, attribute);
        if (isAdopted) {
            requireSystem(systemEgl()->QuerySurface(dpy, handle, attribute, value));
            return EGLBoolean(EGL_TRUE);
        }
        const std::optional<EGLint> found = surfaceAttribute(*surface, attribute);
        require(value != nullptr, EGL_BAD_PARAMETER);
        if (found)
            *value = *found;
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglSurfaceAttrib(EGLDisplay dpy, EGLSurface handle, EGLint attribute, EGLint value) {
    if (!surfaces().has(handle))
        return forward(&System::SurfaceAttrib, EGLBoolean(EGL_FALSE), EGL_BAD_SURFACE, dpy, handle, attribute,
                       value);
    return call(EGLBoolean(EGL_FALSE), [&] {
        setAttribute(*getSurface(initializedDisplay(dpy), handle), attribute, value);
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglBindTexImage(EGLDisplay dpy, EGLSurface handle, EGLint buffer) {
    return surfaces().has(handle)
               ? refuseTexture(dpy, handle)
               : forward(&System::BindTexImage, EGLBoolean(EGL_FALSE), EGL_BAD_SURFACE, dpy, handle, buffer);
}

EGLBoolean EGLAPIENTRY eglReleaseTexImage(EGLDisplay dpy, EGLSurface handle, EGLint buffer) {
    return surfaces().has(handle) ? refuseTexture(dpy, handle)
                                  : forward(&System::ReleaseTexImage, EGLBoolean(EGL_FALSE), EGL_BAD_SURFACE,
                                            dpy, handle, buffer);
}
