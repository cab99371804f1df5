/// \file
/// OpenGL ES 2 behind the system's EGL, for what happens in contexts of ours.
#pragma once

#include <GLES3/gl3.h>

namespace vtm::egl {

/// Its functions, named without their prefix, as far as they are called here. Null where the system has none.
struct Gl {
#define VTM_EGL_GL(f)                                                                                      \
    f(ActiveTexture) f(AttachShader) f(BindAttribLocation) f(BindFramebuffer) f(BindTexture)               \
        f(CompileShader) f(CreateProgram) f(CreateShader) f(Disable) f(DrawArrays)                         \
            f(EnableVertexAttribArray) f(Finish) f(FramebufferTexture2D) f(GenFramebuffers) f(GenTextures) \
                f(GetError) f(GetProgramiv) f(LinkProgram) f(ReadPixels) f(ShaderSource) f(TexImage2D)     \
                    f(TexParameteri) f(TexSubImage2D) f(UseProgram) f(VertexAttribPointer) f(Viewport)
#define VTM_EGL_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
    VTM_EGL_GL(VTM_EGL_GL_MEMBER)
#undef VTM_EGL_GL_MEMBER
};

/// Asked for once, when first called. There must be a system's library.
const Gl& gl();

}  // namespace vtm::egl
