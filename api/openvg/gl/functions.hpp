/// \file
/// OpenGL ES 3.0 behind the system's EGL: nothing of it is linked.
#pragma once

#include <GLES3/gl3.h>

namespace vtm::openvg::gl {

/// Its functions, named without their prefix, as far as they are called here.
struct Functions {
#define VTM_OPENVG_GL(f)                                                                                     \
    f(ActiveTexture) f(AttachShader) f(BindAttribLocation) f(BindBuffer) f(BindBufferRange)                  \
        f(BindFramebuffer) f(BindTexture) f(BindVertexArray) f(BufferData) f(BufferSubData)                  \
            f(CheckFramebufferStatus) f(CompileShader) f(CopyTexSubImage2D) f(CreateProgram) f(CreateShader) \
                f(DeleteProgram) f(DeleteShader) f(DeleteSync) f(DeleteTextures) f(Disable)                  \
                    f(DrawArraysInstanced) f(EnableVertexAttribArray) f(FenceSync) f(Finish) f(Flush)        \
                        f(FramebufferTexture2D) f(GenBuffers) f(GenFramebuffers) f(GenTextures)              \
                            f(GenVertexArrays) f(GetError) f(GetIntegerv) f(GetProgramInfoLog)               \
                                f(GetProgramiv) f(GetShaderInfoLog) f(GetShaderiv) f(GetString)              \
                                    f(GetStringi) f(GetUniformBlockIndex) f(GetUniformLocation)              \
                                        f(LinkProgram) f(PixelStorei) f(ReadPixels) f(ShaderSource)          \
                                            f(TexParameteri) f(TexStorage2D) f(TexSubImage2D) f(Uniform1i)   \
                                                f(UniformBlockBinding) f(UseProgram) f(VertexAttribDivisor)  \
                                                    f(VertexAttribIPointer) f(VertexAttribPointer)           \
                                                        f(Viewport) f(WaitSync)
#define VTM_OPENVG_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
    VTM_OPENVG_GL(VTM_OPENVG_GL_MEMBER)
#undef VTM_OPENVG_GL_MEMBER
    /// Of GL_EXT_robustness and GL_KHR_robustness; null where there is neither.
    GLenum (*GetGraphicsResetStatus)() = nullptr;
};

/// Those of the thread's current context. Throws std::runtime_error if one is missing.
Functions currentFunctions();

}  // namespace vtm::openvg::gl
