/// \file
/// OpenGL ES behind the system's EGL, for what happens in contexts of ours.
#pragma once

#include <EGL/egl.h>
#include <GLES3/gl31.h>
// After its header.
#include <GLES2/gl2ext.h>

#include "api/egl/state/thread.hpp"

namespace vtm::egl {

/// Its functions, named without their prefix, as far as they are called here. Null where the system has none;
/// those of fences are OpenGL ES 3's, GetTexLevelParameteriv is OpenGL ES 3.1's.
struct Gl {
#define VTM_EGL_GL(f)                                                                                        \
    f(ActiveTexture) f(AttachShader) f(BindAttribLocation) f(BindFramebuffer) f(BindTexture)                 \
        f(CheckFramebufferStatus) f(CompileShader) f(CreateProgram) f(CreateShader) f(DeleteSync)            \
            f(DeleteTextures) f(Disable) f(DrawArrays) f(EnableVertexAttribArray) f(FenceSync) f(Finish)     \
                f(FramebufferTexture2D) f(GenFramebuffers) f(GenTextures) f(GetError) f(GetProgramiv)        \
                    f(GetTexLevelParameteriv) f(LinkProgram) f(PixelStorei) f(ReadPixels) f(ShaderSource)    \
                        f(TexImage2D) f(TexParameteri) f(TexSubImage2D) f(UseProgram) f(VertexAttribPointer) \
                            f(Viewport) f(WaitSync)
#define VTM_EGL_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
    VTM_EGL_GL(VTM_EGL_GL_MEMBER)
#undef VTM_EGL_GL_MEMBER
    PFNGLEGLIMAGETARGETTEXTURE2DOESPROC EGLImageTargetTexture2DOES = nullptr;
};

/// Asked for once, when first called. There must be a system's library.
const Gl& gl();

/// Of OpenGL ES 2, sharing nothing; or with other attributes, sharing with a context. Throws Error.
EGLContext newGlContext(const Display& display, EGLConfig config);
EGLContext newGlContext(const Display& display, EGLConfig config, EGLContext share, const EGLint* attributes);

/// Shares with the compositor of GPUs; EGL_NO_CONTEXT where none can.
EGLContext newSharingContext(const Display& display, EGLConfig config);

/// By which OpenGL ES 2 draws into pbuffers. Throws Error.
EGLConfig pbufferConfig(const Display& display);

/// Makes a context current in the system for as long as this lives, and then again what was.
class GlCurrent {
public:
    GlCurrent(EGLDisplay display, EGLSurface surface, EGLContext context)
        : system_(*systemEgl()),
          display_(system_.GetCurrentDisplay()),
          draw_(system_.GetCurrentSurface(EGL_DRAW)),
          read_(system_.GetCurrentSurface(EGL_READ)),
          context_(system_.GetCurrentContext()),
          madeFor_(display) {
        requireSystem(system_.MakeCurrent(display, surface, surface, context));
    }
    ~GlCurrent() {
        if (context_ != EGL_NO_CONTEXT)
            system_.MakeCurrent(display_, draw_, read_, context_);
        else
            system_.MakeCurrent(madeFor_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    GlCurrent(const GlCurrent&) = delete;
    GlCurrent& operator=(const GlCurrent&) = delete;

private:
    const System& system_;
    const EGLDisplay display_;
    const EGLSurface draw_, read_;
    const EGLContext context_;
    const EGLDisplay madeFor_;
};

}  // namespace vtm::egl
