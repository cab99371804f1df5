/// \file
/// Errors inside of a call; what the caller sees is eglGetError().
#pragma once

#include <EGL/egl.h>

#include <VG/openvg.h>

namespace vtm::egl {

struct Error {
    EGLint code;
};

/// Throws unless what a call asks for is right.
inline void require(bool isRight, EGLint code) {
    if (!isRight)
        throw Error{code};
}

/// Of a call that libOpenVG could not do with an image.
inline EGLint errorOf(VGErrorCode code) {
    switch (code) {
        case VG_BAD_HANDLE_ERROR:
            return EGL_BAD_PARAMETER;
        case VG_IMAGE_IN_USE_ERROR:
            return EGL_BAD_ACCESS;
        case VG_OUT_OF_MEMORY_ERROR:
            return EGL_BAD_ALLOC;
        default:
            return EGL_BAD_MATCH;
    }
}

}  // namespace vtm::egl
