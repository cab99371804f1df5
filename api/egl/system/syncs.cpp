// Section 3.8.1: sync objects, all of which are the system's. libOpenVG has no VG_KHR_EGL_sync.

#include "api/egl/state/thread.hpp"

namespace vtm::egl {

namespace {

constexpr EGLBoolean no = EGL_FALSE;

/// A fence would be one among the calls of OpenVG.
bool isFenceOfVg(EGLenum type) { return currentApi() == EGL_OPENVG_API && type == EGL_SYNC_FENCE; }

}  // namespace

}  // namespace vtm::egl

using namespace vtm::egl;

EGLSync EGLAPIENTRY eglCreateSync(EGLDisplay dpy, EGLenum type, const EGLAttrib* list) {
    if (!isFenceOfVg(type))
        return forward(&System::CreateSync, EGLSync(EGL_NO_SYNC), EGL_BAD_PARAMETER, dpy, type, list);
    return call(EGLSync(EGL_NO_SYNC), [&]() -> EGLSync {
        initializedDisplay(dpy);
        throw Error{EGL_BAD_MATCH};
    });
}

EGLBoolean EGLAPIENTRY eglDestroySync(EGLDisplay dpy, EGLSync sync) {
    return forward(&System::DestroySync, no, EGL_BAD_PARAMETER, dpy, sync);
}

EGLint EGLAPIENTRY eglClientWaitSync(EGLDisplay dpy, EGLSync sync, EGLint flags, EGLTime timeout) {
    return forward(&System::ClientWaitSync, EGLint(EGL_FALSE), EGL_BAD_PARAMETER, dpy, sync, flags, timeout);
}

EGLBoolean EGLAPIENTRY eglGetSyncAttrib(EGLDisplay dpy, EGLSync sync, EGLint attribute, EGLAttrib* value) {
    return forward(&System::GetSyncAttrib, no, EGL_BAD_PARAMETER, dpy, sync, attribute, value);
}

EGLBoolean EGLAPIENTRY eglWaitSync(EGLDisplay dpy, EGLSync sync, EGLint flags) {
    if (currentApi() != EGL_OPENVG_API)
        return forward(&System::WaitSync, no, EGL_BAD_PARAMETER, dpy, sync, flags);
    return call(no, [&]() -> EGLBoolean {
        initializedDisplay(dpy);
        throw Error{EGL_BAD_MATCH};
    });
}
