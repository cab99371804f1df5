/// \file
/// The system's own libEGL, which everything that is not OpenVG is forwarded to.
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

/// Calls `f` with the name, less its prefix, of every function of EGL 1.5.
#define VTM_EGL_FUNCTIONS(f)                                                                              \
    f(BindAPI) f(BindTexImage) f(ChooseConfig) f(ClientWaitSync) f(CopyBuffers) f(CreateContext)          \
        f(CreateImage) f(CreatePbufferFromClientBuffer) f(CreatePbufferSurface) f(CreatePixmapSurface)    \
            f(CreatePlatformPixmapSurface) f(CreatePlatformWindowSurface) f(CreateSync)                   \
                f(CreateWindowSurface) f(DestroyContext) f(DestroyImage) f(DestroySurface) f(DestroySync) \
                    f(GetConfigAttrib) f(GetConfigs) f(GetCurrentContext) f(GetCurrentDisplay)            \
                        f(GetCurrentSurface) f(GetDisplay) f(GetError) f(GetPlatformDisplay)              \
                            f(GetProcAddress) f(GetSyncAttrib) f(Initialize) f(MakeCurrent) f(QueryAPI)   \
                                f(QueryContext) f(QueryString) f(QuerySurface) f(ReleaseTexImage)         \
                                    f(ReleaseThread) f(SurfaceAttrib) f(SwapBuffers) f(SwapInterval)      \
                                        f(Terminate) f(WaitClient) f(WaitGL) f(WaitNative) f(WaitSync)

namespace vtm::egl {

/// Functions that an older library lacks are null; those of EGL 1.0 to 1.4 never are.
struct System {
#define VTM_EGL_MEMBER(name) decltype(&::egl##name) name = nullptr;
    VTM_EGL_FUNCTIONS(VTM_EGL_MEMBER)
#undef VTM_EGL_MEMBER
};

/// Loaded with the first call; null if there is none. The variable VTM_SYSTEM_EGL names the file to load, or
/// is "none".
const System* systemEgl();

}  // namespace vtm::egl
