#include "api/egl/system/gl_functions.hpp"

#include "api/egl/system/system.hpp"

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

}  // namespace vtm::egl
