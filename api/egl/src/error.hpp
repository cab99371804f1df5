/// \file
/// Errors inside of a call; what the caller sees is eglGetError().
#pragma once

#include <EGL/egl.h>

namespace vtm::egl {

struct Error {
    EGLint code;
};

/// Throws unless what a call asks for is right.
inline void require(bool isRight, EGLint code) {
    if (!isRight)
        throw Error{code};
}

}  // namespace vtm::egl
