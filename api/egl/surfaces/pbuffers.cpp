// Sections 3.5.2 and 3.5.3: surfaces in memory, and images of OpenVG as surfaces.

#include <algorithm>
#include <set>

#include "api/egl/state/attributes.hpp"
#include "api/egl/state/configs.hpp"
#include "api/egl/state/thread.hpp"
#include "api/egl/surfaces/surfaces.hpp"

namespace vtm::egl {

namespace {

/// A side is halved until there is memory; with the sides that were asked for at first.
void createLargest(Surface& surface, EGLint width, EGLint height) {
    width = std::min(width, maxSide);
    height = std::min(height, maxSide);
    for (;;) {
        try {
            createDrawing(surface, width, height);
            return;
        } catch (const Error&) {
            if (width <= 1 && height <= 1)
                throw;
            (width >= height ? width : height) /= 2;
        }
    }
}

EGLSurface createPbuffer(Display& display, EGLConfig handle, const EGLint* list) {
    const auto config = getConfig(display, handle);
    const auto surface = std::make_shared<Surface>(display, config, Surface::Kind::pbuffer);
    EGLint width = 0, height = 0;
    for (const auto& [attribute, value] : attributeList(list)) {
        switch (attribute) {
            case EGL_WIDTH:
                width = value;
                break;
            case EGL_HEIGHT:
                height = value;
                break;
            case EGL_LARGEST_PBUFFER:
                require(value == EGL_TRUE || value == EGL_FALSE, EGL_BAD_ATTRIBUTE);
                surface->largestPbuffer = value;
                break;
            case EGL_TEXTURE_FORMAT:
            case EGL_TEXTURE_TARGET:
                require(config->gl != nullptr, EGL_BAD_ATTRIBUTE);
                // No config of ours is for textures.
                require(value == EGL_NO_TEXTURE, EGL_BAD_MATCH);
                break;
            case EGL_MIPMAP_TEXTURE:
                require(config->gl && (value == EGL_TRUE || value == EGL_FALSE), EGL_BAD_ATTRIBUTE);
                break;
            default:
                require(setDrawingAttribute(*surface, attribute, value), EGL_BAD_ATTRIBUTE);
        }
    }
    require(width >= 0 && height >= 0, EGL_BAD_PARAMETER);
    if (surface->largestPbuffer)
        createLargest(*surface, width, height);
    else
        createDrawing(*surface, width, height);
    surfaces().add(surface);
    return surface->handle;
}

bool hasFormatOf(const Config& config, const VtmSurfaceFormat& image) {
    const VtmSurfaceFormat& f = config.format;
    return f.redBits == image.redBits && f.greenBits == image.greenBits && f.blueBits == image.blueBits &&
           f.alphaBits == image.alphaBits && f.luminanceBits == image.luminanceBits;
}

EGLSurface createFromImage(Display& display, EGLClientBuffer buffer, EGLConfig handle, const EGLint* list) {
    const auto context = currentContext();
    require(context != nullptr, EGL_BAD_ACCESS);
    const auto config = getConfig(display, handle);
    require(attributeList(list).empty(), EGL_BAD_ATTRIBUTE);
    const auto number = reinterpret_cast<std::uintptr_t>(buffer);
    require(number != 0 && number <= UINT32_MAX, EGL_BAD_PARAMETER);
    const auto surface = std::make_shared<Surface>(display, config, Surface::Kind::pbuffer);
    VGErrorCode error = VG_NO_ERROR;
    surface->drawing = vtmCreateImageSurface(context->drawing, VGImage(number), maskBits, &error);
    require(surface->drawing != nullptr, errorOf(error));
    vtmChooseCompositor(surface->drawing, config->compositor);
    VtmSurfaceFormat format;
    vtmGetSurfaceFormat(surface->drawing, &format);
    require(hasFormatOf(*config, format), EGL_BAD_MATCH);
    surface->image = VGImage(number);
    surface->isLinear = format.linear;
    surface->isPremultiplied = format.premultiplied;
    surface->width = vtmSurfaceWidth(surface->drawing);
    surface->height = vtmSurfaceHeight(surface->drawing);
    surfaces().add(surface);
    return surface->handle;
}

}  // namespace

}  // namespace vtm::egl

using namespace vtm::egl;

EGLSurface EGLAPIENTRY eglCreatePbufferSurface(EGLDisplay dpy, EGLConfig config, const EGLint* list) {
    if (!configs().has(config))
        return forward(&System::CreatePbufferSurface, EGLSurface(EGL_NO_SURFACE), EGL_BAD_CONFIG, dpy, config,
                       list);
    return call(EGLSurface(EGL_NO_SURFACE),
                [&] { return createPbuffer(initializedDisplay(dpy), config, list); });
}

EGLSurface EGLAPIENTRY eglCreatePbufferFromClientBuffer(EGLDisplay dpy, EGLenum type, EGLClientBuffer buffer,
                                                        EGLConfig config, const EGLint* list) {
    if (type != EGL_OPENVG_IMAGE && !configs().has(config))
        return forward(&System::CreatePbufferFromClientBuffer, EGLSurface(EGL_NO_SURFACE), EGL_BAD_PARAMETER,
                       dpy, type, buffer, config, list);
    return call(EGLSurface(EGL_NO_SURFACE), [&] {
        Display& display = initializedDisplay(dpy);
        require(type == EGL_OPENVG_IMAGE, EGL_BAD_PARAMETER);
        return createFromImage(display, buffer, config, list);
    });
}
