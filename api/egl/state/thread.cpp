// Sections 3.1 and 3.12, and the current rendering API of section 3.7.

#include "api/egl/state/thread.hpp"

namespace vtm::egl {

Thread& thisThread() {
    // When the thread ends, libOpenVG lets go of the context by itself, before or after this.
    thread_local Thread thread;
    return thread;
}

EGLenum currentApi() {
    EGLenum& api = thisThread().api;
    if (api == 0)
        api = systemEgl() ? EGL_OPENGL_ES_API : EGL_NONE;
    return api;
}

std::shared_ptr<Context> currentContext() {
    const Thread& thread = thisThread();
    // A program may have called vtmMakeCurrent meanwhile.
    const bool isCurrent = thread.context && vtmGetCurrentContext() == thread.context->drawing;
    return isCurrent ? thread.context : nullptr;
}

std::shared_ptr<Surface> currentSurface() { return currentContext() ? *thisThread().surface : nullptr; }

void setError(EGLint code) {
    if (systemEgl())
        systemEgl()->GetError();
    thisThread().error = code;
}

}  // namespace vtm::egl

using namespace vtm::egl;

EGLint EGLAPIENTRY eglGetError(void) {
    const EGLint error = std::exchange(thisThread().error, EGL_SUCCESS);
    return error == EGL_SUCCESS && systemEgl() ? systemEgl()->GetError() : error;
}

EGLBoolean EGLAPIENTRY eglBindAPI(EGLenum api) {
    if (api != EGL_OPENVG_API && systemEgl()) {
        thisThread().error = EGL_SUCCESS;
        const EGLBoolean isBound = systemEgl()->BindAPI(api);
        if (isBound)
            thisThread().api = api;
        return isBound;
    }
    return call(EGLBoolean(EGL_FALSE), [&] {
        require(api == EGL_OPENVG_API, EGL_BAD_PARAMETER);
        thisThread().api = api;
        return EGLBoolean(EGL_TRUE);
    });
}

EGLenum EGLAPIENTRY eglQueryAPI(void) {
    return call(EGLenum(EGL_NONE), [] { return currentApi(); });
}

EGLBoolean EGLAPIENTRY eglReleaseThread(void) {
    return call(EGLBoolean(EGL_FALSE), [] {
        releaseCurrent();
        thisThread() = Thread();
        return systemEgl() ? systemEgl()->ReleaseThread() : EGLBoolean(EGL_TRUE);
    });
}
