#include "api/egl/state/gl_contexts.hpp"

#include <algorithm>

#include "api/egl/state/thread.hpp"
#include "api/egl/surfaces/posting.hpp"

namespace vtm::egl {

namespace {

/// Windows have the system's surface from the beginning, pbuffers when OpenGL first wants it.
void provideTarget(Surface& surface) {
    require(surface.config->gl && surface.image == VG_INVALID_HANDLE, EGL_BAD_MATCH);
    if (surface.target != EGL_NO_SURFACE) {
        require(surface.targetConfig == surface.config->gl, EGL_BAD_MATCH);
        return;
    }
    const EGLint size[] = {EGL_WIDTH, std::max<EGLint>(surface.width, 1), EGL_HEIGHT,
                           std::max<EGLint>(surface.height, 1), EGL_NONE};
    surface.target = systemEgl()->CreatePbufferSurface(surface.display.handle, surface.config->gl, size);
    requireSystem(surface.target != EGL_NO_SURFACE);
    surface.targetConfig = surface.config->gl;
}

/// The surface of ours, ready for OpenGL; null if the handle is one of the system's.
std::shared_ptr<Surface> surfaceForGl(const Display& display, EGLSurface handle) {
    if (!surfaces().has(handle))
        return nullptr;
    const auto surface = getSurface(display, handle);
    require(surface->vgUses == 0, EGL_BAD_ACCESS);
    provideTarget(*surface);
    return surface;
}

}  // namespace

EGLContext createGlContext(const Display& display, EGLConfig handle, EGLContext share, const EGLint* list) {
    require(!contexts().has(share), EGL_BAD_CONTEXT);
    const auto config = getConfig(display, handle);
    require(config->gl != nullptr, EGL_BAD_MATCH);
    const EGLContext context = systemEgl()->CreateContext(display.handle, config->gl, share, list);
    requireSystem(context != EGL_NO_CONTEXT);
    return context;
}

void makeGlCurrent(const Display& display, EGLSurface draw, EGLSurface read, EGLContext context) {
    const auto ourDraw = surfaceForGl(display, draw), ourRead = surfaceForGl(display, read);
    for (const auto& surface : {ourDraw, ourRead})
        if (surface)
            giveToGl(*surface);
    requireSystem(systemEgl()->MakeCurrent(display.handle, ourDraw ? ourDraw->target : draw,
                                           ourRead ? ourRead->target : read, context));
    thisThread().glDraw = SurfaceUse<&Surface::glUses>(ourDraw);
    thisThread().glRead = SurfaceUse<&Surface::glUses>(ourRead);
    if (ourDraw)
        ourDraw->glDrewLast = true;
}

void forgetGlSurfaces() {
    thisThread().glDraw = {};
    thisThread().glRead = {};
}

EGLSurface currentGlSurface(EGLint readdraw, EGLSurface systems) {
    const auto& ours = *(readdraw == EGL_READ ? thisThread().glRead : thisThread().glDraw);
    return ours && ours->target == systems ? ours->handle : systems;
}

}  // namespace vtm::egl
