/// \file
/// The functions of EGL that contexts without windows take.
#pragma once

#include <EGL/egl.h>

/// Calls `f` with their names, less the prefix.
#define VTM_GLES_CONTEXT_EGL(f)                                                             \
    f(BindAPI) f(ChooseConfig) f(CreateContext) f(DestroyContext) f(GetDisplay) f(GetError) \
        f(GetProcAddress) f(Initialize) f(MakeCurrent) f(QueryString)

namespace vtm::gles_context {

/// As somebody linked or loaded them.
struct Egl {
#define VTM_GLES_CONTEXT_MEMBER(name) decltype(&::egl##name) name = nullptr;
    VTM_GLES_CONTEXT_EGL(VTM_GLES_CONTEXT_MEMBER)
#undef VTM_GLES_CONTEXT_MEMBER
};

}  // namespace vtm::gles_context
