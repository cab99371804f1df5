/// \file
/// What EGL keeps per thread, and how every function of ours runs (EGL specification sections 3.1, 3.7
/// and 3.12).
#pragma once

#include <exception>
#include <memory>
#include <utility>

#include <EGL/egl.h>

#include "api/egl/state/objects.hpp"
#include "api/egl/state/registry.hpp"
#include "api/system_egl/system.hpp"

namespace vtm::egl {

struct Thread {
    EGLenum api = 0;             ///< 0: nobody has asked for one yet
    EGLint error = EGL_SUCCESS;  ///< of the last call, if that was ours; the system knows of its own
    std::shared_ptr<Context> context;
    SurfaceUse<&Surface::vgUses> surface;
    SurfaceUse<&Surface::glUses> glDraw, glRead;  ///< surfaces of ours that the system's context draws into
};

Thread& thisThread();

/// EGL_OPENGL_ES_API to begin with, EGL_NONE where there is none.
EGLenum currentApi();

/// The current OpenVG context and its surface; null if there is none.
std::shared_ptr<Context> currentContext();
std::shared_ptr<Surface> currentSurface();

/// Lets go of both.
void releaseCurrent();

/// The last call was ours and ended so. Forgets what the system has said before.
void setError(EGLint code);

/// Throws the system's error unless a call to it succeeded.
inline void requireSystem(bool succeeded) {
    if (!succeeded)
        throw Error{systemEgl()->GetError()};
}

/// Runs a function that OpenVG has to do with: gives its result, or `otherwise` if it throws.
template <class Result, class Body>
Result call(Result otherwise, Body&& body) noexcept {
    EGLint code = EGL_SUCCESS;
    try {
        Result result = std::forward<Body>(body)();
        setError(code);
        return result;
    } catch (const Error& error) {
        code = error.code;
    } catch (const std::exception&) {
        code = EGL_BAD_ALLOC;
    }
    setError(code);
    return otherwise;
}

/// True if the system shall judge what it is given with this display.
inline bool isForSystem(EGLDisplay handle) {
    if (!systemEgl())
        return false;
    const Display* const display = findDisplay(handle);
    return !display || (display->isSystems && (display->systemRuns || !display->isInitialized));
}

/// Calls the system's function. Where the system has no such display: EGL_BAD_DISPLAY, EGL_NOT_INITIALIZED,
/// or `error`, since what is none of ours is nothing then.
template <class Result, class... Parameters, class... Arguments>
Result forward(Result (*System::*function)(EGLDisplay, Parameters...), Result otherwise, EGLint error,
               EGLDisplay display, Arguments... arguments) noexcept {
    if (isForSystem(display) && systemEgl()->*function) {
        thisThread().error = EGL_SUCCESS;
        return (systemEgl()->*function)(display, arguments...);
    }
    return call(otherwise, [&]() -> Result {
        initializedDisplay(display);
        throw Error{error};
    });
}

}  // namespace vtm::egl
