/// \file
/// An image of OpenVG's as a texture of OpenGL ES. The EGLImage that programs get is that texture's, one of
/// the system's: every driver's glEGLImageTargetTexture2DOES takes it. Texture and image each have their own
/// memory; what one side changed is copied to the other when a program goes from one API to the other, as it
/// must to be sure of what it sees (EGL_KHR_image_base, issue 7).
#pragma once

#include <cstdint>
#include <vector>

#include "api/egl/state/objects.hpp"

namespace vtm::egl {

class GlImage {
public:
    /// Throws Error where the system has no textures to make EGLImages of.
    GlImage(const Display& display, VtmSharedImage* pixels);
    ~GlImage();
    GlImage(const GlImage&) = delete;
    GlImage& operator=(const GlImage&) = delete;

    EGLImage handle() const { return image_; }

    /// What OpenVG has changed goes into the texture; if it has changed nothing, and OpenGL might have, what
    /// the texture has into the image. False if there is no image any more.
    bool synchronize(bool mayGlHaveDrawn);
    /// The program has the EGLImage no longer; its textures stay.
    void destroyHandle();
    /// The system has freed everything already.
    void forget() { context_ = EGL_NO_CONTEXT; }

private:
    void create(const Display& display);
    void free();

    const EGLDisplay display_;
    VtmSharedImage* const pixels_;
    std::vector<std::uint8_t> bytes_;
    EGLSurface surface_ = EGL_NO_SURFACE;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLImage image_ = EGL_NO_IMAGE;
};

}  // namespace vtm::egl
