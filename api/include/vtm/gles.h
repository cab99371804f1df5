/*
 * OpenVG in a program that has an OpenGL ES 3.0 context (or later) of its own: libOpenVG_GLES. Plain C89. It copies
 * surfaces of <vtm/vg.h>, which are drawn in memory, to a framebuffer, and draws recordings with shaders.
 *
 *     VtmGl *gl = vtmCreateGl();                          with the GLES context current, in any state
 *     VtmGlTarget target = {0};                           the window, at its lower left corner
 *     vg...
 *     vtmPresentGl(gl, surface, &target);
 *
 * All functions need the GL context to be current in which the VtmGl was created; no OpenVG context needs to be current.
 * GL's state is restored (docs/backend.md). Functions that fail return NULL or VG_FALSE, and vtmGetGlFault() says why.
 */
#ifndef VTM_GLES_H
#define VTM_GLES_H

#include <vtm/vg.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Programs and buffers in one GLES context. */
typedef struct VtmGl VtmGl;

/* A recording on the GPU. Belongs to its VtmGl. */
typedef struct VtmGlPicture VtmGlPicture;

/* The destination of pixels and their encoding. All zero: premultiplied, sRGB-encoded pixels replace those of the
 * window. */
typedef struct VtmGlTarget {
    VGuint framebuffer;    /* a framebuffer object of any normalised or float format, or 0, the window's */
    VGint x, y;            /* the framebuffer's pixel for the lower left pixel of the picture */
    VGboolean upsideDown;  /* the top row first, for textures whose first row is the top */
    VGboolean linear;      /* linear light, not sRGB-encoded; sRGB formats are always stored encoded */
    VGboolean straight;    /* colours not multiplied by alpha; cannot be combined with `over` */
    VGboolean over;        /* blended over the framebuffer's pixels */
    const VGint *damage;   /* x, y, width, height of rectangles in pixels of the picture, y up: only these change; NULL:
                            * all */
    VGint damageCount;     /* number of rectangles */
} VtmGlTarget;

/* Compiles the programs in the current GL context. Returns NULL if no suitable context is current. */
VG_API_CALL VtmGl *VG_API_ENTRY vtmCreateGl(void) VG_API_EXIT;

/* Destroys a VtmGl, whose pictures must be destroyed first. If its GL context no longer exists or is not current, no GL
 * objects are deleted. */
VG_API_CALL void VG_API_ENTRY vtmDestroyGl(VtmGl *gl) VG_API_EXIT;

/* Copies a surface to the target: all of it, or only the damaged rectangles. No other thread may draw on the surface
 * meanwhile. Returns VG_FALSE and changes no pixel if the target is contradictory or its framebuffer cannot be drawn
 * into. */
VG_API_CALL VGboolean VG_API_ENTRY vtmPresentGl(VtmGl *gl, VtmSurface *surface, const VtmGlTarget *target) VG_API_EXIT;

/* Uploads a recording, which is not needed afterwards. Returns NULL if there is no memory. */
VG_API_CALL VtmGlPicture *VG_API_ENTRY vtmUploadRecordingGl(VtmGl *gl, const VtmRecording *recording) VG_API_EXIT;
VG_API_CALL void VG_API_ENTRY vtmDestroyPictureGl(VtmGlPicture *picture) VG_API_EXIT;

/* Draws a recording with shaders into [0, width] x [0, height] pixels. `matrix` has the layout of vgLoadMatrix(), must
 * be affine and maps the recording's user units to these pixels, y up, as VG_MATRIX_PATH_USER_TO_SURFACE does for
 * vtmDrawRecording(). Coverage is accumulated in linear light, as OpenVG blends its edges; with `over` the picture's
 * border is blended in the framebuffer's encoding. Returns VG_FALSE as vtmPresentGl does. */
VG_API_CALL VGboolean VG_API_ENTRY vtmDrawPictureGl(VtmGl *gl, const VtmGlPicture *picture, VGint width, VGint height,
                                                    const VGfloat matrix[9], const VtmGlTarget *target) VG_API_EXIT;

/* Returns the message of the last failure in this thread. Valid until the next failure in it. */
VG_API_CALL const char *VG_API_ENTRY vtmGetGlFault(void) VG_API_EXIT;

#ifdef __cplusplus
}
#endif

#endif
