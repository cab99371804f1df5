#include "api/egl/images/gl_image.hpp"

#include "api/egl/system/gl_functions.hpp"

namespace vtm::egl {

GlImage::GlImage(const Display& display, VtmSharedImage* pixels)
    : display_(display.handle),
      pixels_(pixels),
      bytes_(std::size_t(vtmSharedImageWidth(pixels)) * std::size_t(vtmSharedImageHeight(pixels)) * 4) {
    require(systemEgl()->CreateImage && systemEgl()->DestroyImage, EGL_BAD_MATCH);
    try {
        create(display);
    } catch (const Error&) {
        free();
        throw;
    }
}

GlImage::~GlImage() { free(); }

void GlImage::create(const Display& display) {
    const System& system = *systemEgl();
    const EGLConfig config = pbufferConfig(display);
    context_ = newGlContext(display, config);
    const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    surface_ = system.CreatePbufferSurface(display_, config, size);
    requireSystem(surface_ != EGL_NO_SURFACE);
    const GlCurrent current(display_, surface_, context_);
    GLuint texture = 0, framebuffer = 0;
    gl().GenTextures(1, &texture);
    gl().BindTexture(GL_TEXTURE_2D, texture);
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    vtmTakeSharedPixels(pixels_, bytes_.data());
    gl().TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, vtmSharedImageWidth(pixels_), vtmSharedImageHeight(pixels_), 0,
                    GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
    gl().GenFramebuffers(1, &framebuffer);
    gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    require(gl().GetError() == GL_NO_ERROR, EGL_BAD_ALLOC);
    image_ = system.CreateImage(display_, context_, EGL_GL_TEXTURE_2D,
                                reinterpret_cast<EGLClientBuffer>(std::uintptr_t(texture)), nullptr);
    requireSystem(image_ != EGL_NO_IMAGE);
    gl().Finish();
}

void GlImage::free() {
    if (context_ == EGL_NO_CONTEXT)
        return;
    destroyHandle();
    if (surface_ != EGL_NO_SURFACE)
        systemEgl()->DestroySurface(display_, surface_);
    systemEgl()->DestroyContext(display_, context_);
}

void GlImage::destroyHandle() {
    if (image_ != EGL_NO_IMAGE)
        systemEgl()->DestroyImage(display_, image_);
    image_ = EGL_NO_IMAGE;
}

bool GlImage::synchronize(bool mayGlHaveDrawn) {
    const VtmPixels pixels = vtmTakeSharedPixels(pixels_, bytes_.data());
    if (pixels == VTM_PIXELS_GONE)
        return false;
    if (pixels == VTM_PIXELS_SAME && !mayGlHaveDrawn)
        return true;
    const GlCurrent current(display_, surface_, context_);
    const GLsizei width = vtmSharedImageWidth(pixels_), height = vtmSharedImageHeight(pixels_);
    if (pixels == VTM_PIXELS_CHANGED) {
        gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
        gl().Finish();
    } else {
        gl().ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
        vtmPutSharedPixels(pixels_, bytes_.data());
    }
    return true;
}

}  // namespace vtm::egl
