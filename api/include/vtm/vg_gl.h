/*
 * Surfaces that are drawn on a GPU, as textures of OpenGL ES. Plain C89. Our libEGL shows windows by these; programs that
 * have contexts of their own may use them too.
 *
 *     vtmPreferGlDisplay(display);                        (before the first surface is made)
 *     if (vtmGetGlContext(&its) && its.display == display)
 *         context = eglCreateContext(display, config, its.context, its.attributes);
 *     ...
 *     if (vtmTakeGlPicture(surface, &picture)) {
 *         glWaitSync(picture.ready, 0, GL_TIMEOUT_IGNORED); glDeleteSync(picture.ready);
 *         ... sample picture.texture ...
 *         vtmReturnGlPicture(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));  glFlush();
 *     }
 *
 * Handles are those of the system's libEGL and of OpenGL ES: EGLDisplay, EGLContext, GLsync.
 */
#ifndef VTM_VG_GL_H
#define VTM_VG_GL_H

#include <vtm/vg.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Names the display, initialised, on which the compositor of GPUs shall open its context, so that contexts there can share
 * its textures. NULL: its own choice, which is what it is at first. Without effect once the context is open. */
VG_API_CALL void VG_API_ENTRY vtmPreferGlDisplay(void *display) VG_API_EXIT;

/* The compositor's context, for others to share with. It must never be made current. `attributes`: those that contexts
 * which share with it need too; a list for eglCreateContext, which ends with EGL_NONE and lives for ever. */
typedef struct {
    void *display, *context;
    const int *attributes;
} VtmGlContext;

/* Gives the compositor's context, and opens it if nothing has. VG_FALSE: there is none, and vtmGetCompositorFault says
 * why. Once its display was terminated, nothing can share with it any more. */
VG_API_CALL VGboolean VG_API_ENTRY vtmGetGlContext(VtmGlContext *context) VG_API_EXIT;

/* `texture`: GL_TEXTURE_2D with the surface's size in the format GL_RGBA8: the bytes that vtmReadSurface gives, but rows
 * from the bottom. `ready`: who samples the texture must wait for it, and then delete it. */
typedef struct {
    unsigned texture;
    void *ready;
} VtmGlPicture;

/* Gives what is drawn on a surface; nothing is copied to memory. The texture is for contexts that share with the
 * compositor's. It is filled anew by the next call for this surface, and deleted with the surface. VG_FALSE: the CPU
 * draws on it, or the GPU has failed or has no room; vtmReadSurface then gives the pixels. */
VG_API_CALL VGboolean VG_API_ENTRY vtmTakeGlPicture(VtmSurface *surface, VtmGlPicture *picture) VG_API_EXIT;

/* Tells when a picture has been sampled: what fills it next waits for this fence, and deletes it. */
VG_API_CALL void VG_API_ENTRY vtmReturnGlPicture(void *fence) VG_API_EXIT;

#ifdef __cplusplus
}
#endif

#endif
