#include "api/openvg/gl/functions.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "api/system_egl/system.hpp"

namespace vtm::openvg::gl {

namespace {

template <class Function>
Function found(const char* name) {
    return reinterpret_cast<Function>(egl::systemEgl()->GetProcAddress(name));
}

template <class Function>
Function required(const char* name) {
    const auto function = found<Function>(name);
    if (!function)
        throw std::runtime_error(fmt::format("the driver has no {}", name));
    return function;
}

}  // namespace

Functions currentFunctions() {
    Functions functions;
#define VTM_OPENVG_GL_FIND(name) functions.name = required<decltype(functions.name)>("gl" #name);
    VTM_OPENVG_GL(VTM_OPENVG_GL_FIND)
#undef VTM_OPENVG_GL_FIND
    for (const char* name : {"glGetGraphicsResetStatusKHR", "glGetGraphicsResetStatusEXT"})
        if (!functions.GetGraphicsResetStatus)
            functions.GetGraphicsResetStatus = found<GLenum (*)()>(name);
    return functions;
}

}  // namespace vtm::openvg::gl
