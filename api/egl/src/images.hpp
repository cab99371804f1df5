/// \file
/// EGLImages (EGL specification section 3.9).
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace vtm::egl {

/// Functions of EGL_KHR_image_base.
EGLImageKHR EGLAPIENTRY createImageKhr(EGLDisplay, EGLContext, EGLenum target, EGLClientBuffer,
                                       const EGLint* list);
EGLBoolean EGLAPIENTRY destroyImageKhr(EGLDisplay, EGLImageKHR);

}  // namespace vtm::egl
