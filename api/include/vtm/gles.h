/*
 * OpenVG in a program that has an OpenGL ES 3.0 context (or later) of its own: libOpenVG_GLES. Plain C89. What contexts and
 * surfaces of <vtm/vg.h> drew in memory is shown in a framebuffer; recordings are drawn by shaders.
 *
 *     VtmGl *gl = vtmCreateGl();                          with the GLES context current, in any state
 *     VtmGlTarget target = {0};                           the window, from its lower left corner on
 *     vg...
 *     vtmPresentGl(gl, surface, &target);
 *
 * Everything here needs the context in which the VtmGl was made to be current, and nothing of OpenVG. GL's state is left
 * as it was found (docs/backend.md). Functions that fail say so, and vtmGetGlFault() says why.
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

/* Where pixels go, and in which numbers. All zero: into the window, premultiplied, encoded, in place of what is there. */
typedef struct VtmGlTarget {
    VGuint framebuffer;    /* a framebuffer object of any normalised or float format, or 0, the window's */
    VGint x, y;            /* its pixel for the lower left one of what is drawn */
    VGboolean upsideDown;  /* the upper row first, as textures want it that begin with their top */
    VGboolean linear;      /* linear light, not sRGB-encoded; sRGB formats store encoded whatever this says */
    VGboolean straight;    /* colours not multiplied by alpha; not with `over` */
    VGboolean over;        /* blended over what is there */
    const VGint *damage;   /* x, y, width, height of rectangles, y upwards: only these pixels change; NULL: all do */
    VGint damageCount;     /* of rectangles */
} VtmGlTarget;

/* Returns NULL if no suitable context is current. */
VG_API_CALL VtmGl *VG_API_ENTRY vtmCreateGl(void) VG_API_EXIT;

/* Destroy its pictures first. If its context has ended or another one is current, no GL objects are deleted. */
VG_API_CALL void VG_API_ENTRY vtmDestroyGl(VtmGl *gl) VG_API_EXIT;

/* Shows a surface: all of it, or what is damaged, of which alone memory is read and sent. No other thread may draw on it
 * meanwhile. False, with no pixel changed, for contradictions in the target and framebuffers that cannot be drawn into. */
VG_API_CALL VGboolean VG_API_ENTRY vtmPresentGl(VtmGl *gl, VtmSurface *surface, const VtmGlTarget *target) VG_API_EXIT;

/* NULL if there is no memory. The recording is not needed afterwards. */
VG_API_CALL VtmGlPicture *VG_API_ENTRY vtmUploadRecordingGl(VtmGl *gl, const VtmRecording *recording) VG_API_EXIT;
VG_API_CALL void VG_API_ENTRY vtmDestroyPictureGl(VtmGlPicture *picture) VG_API_EXIT;

/* Draws a recording with shaders, into [0, width] x [0, height] pixels. `matrix` is as vgLoadMatrix() takes it, affine, and
 * leads to these pixels, y upwards: what VG_MATRIX_PATH_USER_TO_SURFACE is to vtmDrawRecording(). Regions are added up in
 * linear light, as OpenVG mixes its edges; with `over` the picture's border is blended in the framebuffer's numbers. */
VG_API_CALL VGboolean VG_API_ENTRY vtmDrawPictureGl(VtmGl *gl, const VtmGlPicture *picture, VGint width, VGint height,
                                                    const VGfloat matrix[9], const VtmGlTarget *target) VG_API_EXIT;

/* Returns the message of the last failure in this thread. */
VG_API_CALL const char *VG_API_ENTRY vtmGetGlFault(void) VG_API_EXIT;

#ifdef __cplusplus
}
#endif

#endif
