#include "api/egl/system/gl_functions.hpp"

#include <vtm/vg_gl.h>

#include "api/egl/state/configs.hpp"
#include "api/system_egl/system.hpp"

namespace vtm::egl {

const Gl& gl() {
    static const Gl functions = [] {
        Gl found;
#define VTM_EGL_GL_FIND(name) \
    found.name = reinterpret_cast<decltype(found.name)>(systemEgl()->GetProcAddress("gl" #name));
        VTM_EGL_GL(VTM_EGL_GL_FIND)
#undef VTM_EGL_GL_FIND
        found.EGLImageTargetTexture2DOES = reinterpret_cast<PFNGLEGLIMAGETARGETTEXTURE2DOESPROC>(
            systemEgl()->GetProcAddress("glEGLImageTargetTexture2DOES"));
        return found;
    }();
    return functions;
}

EGLContext newGlContext(const Display& display, EGLConfig config) {
    const EGLint attributes[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    return newGlContext(display, config, EGL_NO_CONTEXT, attributes);
}

EGLContext newGlContext(const Display& display, EGLConfig config, EGLContext share,
                        const EGLint* attributes) {
    const System& system = *systemEgl();
    const EGLenum api = system.QueryAPI();
    requireSystem(system.BindAPI(EGL_OPENGL_ES_API));
    const EGLContext context = system.CreateContext(display.handle, config, share, attributes);
    const EGLint error = system.GetError();
    system.BindAPI(api);
    require(context != EGL_NO_CONTEXT, error);
    return context;
}

EGLContext newSharingContext(const Display& display, EGLConfig config) {
    VtmGlContext its{};
    if (!vtmGetGlContext(&its) || its.display != display.handle)
        return EGL_NO_CONTEXT;
    try {
        return newGlContext(display, config, its.context, its.attributes);
    } catch (const Error&) {
        return EGL_NO_CONTEXT;
    }
}

EGLConfig pbufferConfig(const Display& display) {
    for (const EGLConfig config : systemConfigs(display))
        if (systemConfigAttribute(display, config, EGL_RENDERABLE_TYPE) & EGL_OPENGL_ES2_BIT &&
            systemConfigAttribute(display, config, EGL_SURFACE_TYPE) & EGL_PBUFFER_BIT)
            return config;
    throw Error{EGL_BAD_MATCH};
}

}  // namespace vtm::egl
