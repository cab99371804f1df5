/// \file
/// EGLImages (EGL specification section 3.9).
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace vtm::egl {

struct Display;

/// Copies what has changed in any image between OpenVG and OpenGL: before contexts change, at the end of a
/// frame, and where a program waits for an API.
void synchronizeImages();

/// When the display terminates.
void forgetImages(Display& display);

/// Functions of EGL_KHR_image_base.
EGLImageKHR EGLAPIENTRY createImageKhr(EGLDisplay, EGLContext, EGLenum target, EGLClientBuffer,
                                       const EGLint* list);
EGLBoolean EGLAPIENTRY destroyImageKhr(EGLDisplay, EGLImageKHR);

}  // namespace vtm::egl
