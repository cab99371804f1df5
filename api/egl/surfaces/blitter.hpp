/// \file
/// Shows what OpenVG drew on a window or a pixmap of the system's, by a context of OpenGL ES of its own: the
/// state of the program's context stays as it is.
#pragma once

#include <cstdint>
#include <vector>

#include <EGL/egl.h>

#include <vtm/vg.h>

#include "api/egl/state/objects.hpp"

namespace vtm::egl {

class Blitter {
public:
    /// For surfaces of the system's with this config. `isOnGpu`: of drawings there. Throws Error.
    Blitter(const Display& display, EGLConfig config, bool isOnGpu);
    ~Blitter();
    Blitter(const Blitter&) = delete;
    Blitter& operator=(const Blitter&) = delete;

    /// Draws, and waits until the target has it. Throws Error.
    void copy(EGLSurface target, VtmSurface* drawing);
    /// The other way: sets the drawing to what the target has. Throws Error.
    void read(EGLSurface target, VtmSurface* drawing);
    /// Draws, and swaps the target's buffers. Throws Error.
    void swap(EGLSurface target, VtmSurface* drawing, EGLint interval);

    /// The system has freed everything already.
    void forget() { context_ = EGL_NO_CONTEXT; }

private:
    void prepare();
    void draw(VtmSurface* drawing);
    void upload(VtmSurface* drawing);

    const EGLDisplay display_;
    bool sharesTextures_ = false;  ///< of drawings on a GPU
    EGLContext context_ = EGL_NO_CONTEXT;
    bool isPrepared_ = false;
    unsigned texture_ = 0;           ///< of drawings in memory
    EGLint width_ = 0, height_ = 0;  ///< of that
    std::vector<std::uint8_t> pixels_;
};

}  // namespace vtm::egl
