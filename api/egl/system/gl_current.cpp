#include "api/egl/system/gl_current.hpp"

namespace vtm::egl {

EGLContext newGlContext(const Display& display, EGLConfig config) {
    const System& system = *systemEgl();
    const EGLint attributes[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    const EGLenum api = system.QueryAPI();
    requireSystem(system.BindAPI(EGL_OPENGL_ES_API));
    const EGLContext context = system.CreateContext(display.handle, config, EGL_NO_CONTEXT, attributes);
    const EGLint error = system.GetError();
    system.BindAPI(api);
    require(context != EGL_NO_CONTEXT, error);
    return context;
}

}  // namespace vtm::egl
