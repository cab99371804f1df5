#include "api/egl/system/gl_functions.hpp"

#include "api/system_egl/system.hpp"

namespace vtm::egl {

const Gl& gl() {
    static const Gl functions = [] {
        Gl found;
#define VTM_EGL_GL_FIND(name) \
    found.name = reinterpret_cast<decltype(found.name)>(systemEgl()->GetProcAddress("gl" #name));
        VTM_EGL_GL(VTM_EGL_GL_FIND)
#undef VTM_EGL_GL_FIND
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

}  // namespace vtm::egl
