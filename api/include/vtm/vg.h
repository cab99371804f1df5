/*
 * OpenVG without EGL: contexts and drawing surfaces in memory. Plain C89. Our libEGL makes its own out of these.
 *
 *     VtmSurfaceFormat format = {8, 8, 8, 8, 0, 8, VG_FALSE, VG_TRUE};
 *     VtmSurface *surface = vtmCreateSurface(640, 480, &format);
 *     VtmContext *context = vtmCreateContext(NULL);
 *     vtmMakeCurrent(context, surface);
 *     vgClear(0, 0, 640, 480);  ...
 *     vtmReadSurface(surface, bytes, 640 * 4);
 *
 * A context may be current in one thread at a time, a surface with one context at a time. Contexts that share objects
 * may be used from several threads at once; calls then wait for each other.
 */
#ifndef VTM_VG_H
#define VTM_VG_H

#include <stddef.h>

#include <VG/openvg.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct VtmContext VtmContext;
typedef struct VtmSurface VtmSurface;

/* Bits of each channel of a pixel, and how its numbers are meant (specification 3.4). Either colours
 * (8 8 8 8, 8 8 8 0, 5 6 5 0, 5 5 5 1, 4 4 4 4), alpha alone (0 0 0 8), or luminance alone (luminanceBits 8 or 1). */
typedef struct VtmSurfaceFormat {
    VGint redBits, greenBits, blueBits, alphaBits;
    VGint luminanceBits;
    VGint maskBits;          /* of the drawing surface mask: 8, or 0 for none */
    VGboolean linear;        /* colours are linear light, not sRGB-encoded */
    VGboolean premultiplied; /* colours are stored multiplied by alpha */
} VtmSurfaceFormat;

/* Pixels are 0, the mask is 1. NULL if the format is not one of those above, a side is not in [1, 16384], or
 * there is no memory. */
VG_API_CALL VtmSurface *VG_API_ENTRY vtmCreateSurface(VGint width, VGint height,
                                                      const VtmSurfaceFormat *format) VG_API_EXIT;

/* A surface that draws into an image of `context` (specification 4, Images as rendering targets): `maskBits` as above.
 * NULL with *error set to VG_BAD_HANDLE_ERROR if it is none, to VG_IMAGE_IN_USE_ERROR if it is a target already, is related
 * to other images, or is a paint's pattern or a font's glyph, to VG_ILLEGAL_ARGUMENT_ERROR if drawing
 * into its format is not supported. `error` may be NULL. */
VG_API_CALL VtmSurface *VG_API_ENTRY vtmCreateImageSurface(VtmContext *context, VGImage image, VGint maskBits,
                                                           VGErrorCode *error) VG_API_EXIT;

/* Destroys a surface; one that is current is destroyed when it stops being current. */
VG_API_CALL void VG_API_ENTRY vtmDestroySurface(VtmSurface *surface) VG_API_EXIT;

/* Keeps the pixels that both sizes have; new pixels are 0, new mask values 1. False where vtmCreateSurface would
 * give NULL, and for images. */
VG_API_CALL VGboolean VG_API_ENTRY vtmResizeSurface(VtmSurface *surface, VGint width, VGint height) VG_API_EXIT;

VG_API_CALL VGint VG_API_ENTRY vtmSurfaceWidth(const VtmSurface *surface) VG_API_EXIT;
VG_API_CALL VGint VG_API_ENTRY vtmSurfaceHeight(const VtmSurface *surface) VG_API_EXIT;

/* Returns the format of a surface, including one that draws into an image. */
VG_API_CALL void VG_API_ENTRY vtmGetSurfaceFormat(const VtmSurface *surface, VtmSurfaceFormat *format) VG_API_EXIT;

/* All pixels as sRGB-encoded, premultiplied bytes red, green, blue, alpha, rows from the TOP (y = height - 1 first),
 * `rowBytes` from one row to the next. */
VG_API_CALL void VG_API_ENTRY vtmReadSurface(VtmSurface *surface, void *pixels, size_t rowBytes) VG_API_EXIT;

/* The same of a rectangle, which must be within the surface; (x, y) is its lowest left pixel. */
VG_API_CALL void VG_API_ENTRY vtmReadSurfacePart(VtmSurface *surface, VGint x, VGint y, VGint width, VGint height,
                                                 void *pixels, size_t rowBytes) VG_API_EXIT;

/* The inverse of vtmReadSurface: sets all pixels. */
VG_API_CALL void VG_API_ENTRY vtmWriteSurface(VtmSurface *surface, const void *pixels, size_t rowBytes) VG_API_EXIT;

/* `share`: a context whose objects the new one shares, or NULL. NULL if there is no memory. */
VG_API_CALL VtmContext *VG_API_ENTRY vtmCreateContext(VtmContext *share) VG_API_EXIT;

/* Destroys a context; one that is current in a thread is destroyed when it stops being current. */
VG_API_CALL void VG_API_ENTRY vtmDestroyContext(VtmContext *context) VG_API_EXIT;

/* Makes both current in this thread, in place of what was; NULL, NULL makes nothing current. A context that gets another
 * surface has its mask reset (specification 7.2). False, and nothing changed, if only one is NULL, the context is current
 * in another thread, the surface with another context, or its image has become a paint's pattern or a font's glyph. */
VG_API_CALL VGboolean VG_API_ENTRY vtmMakeCurrent(VtmContext *context, VtmSurface *surface) VG_API_EXIT;

VG_API_CALL VtmContext *VG_API_ENTRY vtmGetCurrentContext(void) VG_API_EXIT;
VG_API_CALL VtmSurface *VG_API_ENTRY vtmGetCurrentSurface(void) VG_API_EXIT;

/*
 * Recordings: a sequence of calls as one picture, compiled to a Vector Texture Map. Layers become disjoint regions, so
 * shapes that abut leave no seam, and what is drawn under a matrix is exact again (docs/openvg.md).
 *
 *     vtmBeginRecording(400, 300);
 *     ...                                                 calls as ever: nothing is drawn meanwhile
 *     VtmRecording *recording = vtmEndRecording();
 *     vtmDrawRecording(recording);                        under the path matrix, any number of times
 */
typedef struct VtmRecording VtmRecording;

/* The error of a call that cannot be recorded. */
#define VTM_NOT_RECORDABLE_ERROR ((VGErrorCode)0x1F00)

/* From here on vgClear and what draws paths, glyphs and images on the current context is kept instead: what would appear
 * in [0, width] x [0, height] of the surface, of whatever size that is, on transparent ground. The recording has a mask of
 * its own, which is 1; the surface's pixels and mask stay as they are. VG_ILLEGAL_ARGUMENT_ERROR if a recording is under
 * way already, or a side is not in (0, 1000000].
 *
 * What a picture cannot hold is refused where it is called, by VTM_NOT_RECORDABLE_ERROR; docs/openvg.md lists it. */
VG_API_CALL void VG_API_ENTRY vtmBeginRecording(VGfloat width, VGfloat height) VG_API_EXIT;

/* Ends it, in every case. NULL with VG_ILLEGAL_ARGUMENT_ERROR if none is under way, with VTM_NOT_RECORDABLE_ERROR if a
 * call was refused, with VG_OUT_OF_MEMORY_ERROR if there is no memory or the picture is beyond a limit of the
 * compiler's. */
VG_API_CALL VtmRecording *VG_API_ENTRY vtmEndRecording(void) VG_API_EXIT;

/* Why the current context's last recording failed: which call, and what about it. Empty if it did not; valid until the
 * next recording begins. */
VG_API_CALL const char *VG_API_ENTRY vtmGetRecordingFault(void) VG_API_EXIT;

/* A recording of the bytes of a .vtm file, wherever it was made. Returns NULL if the bytes are not a valid file (untrusted
 * bytes are safe) or hold a picture in compat mode, which has no regions. Materials, which are GLSL, show their fallback
 * colours. */
VG_API_CALL VtmRecording *VG_API_ENTRY vtmLoadRecording(const void *bytes, size_t size) VG_API_EXIT;

/* A recording never changes, and belongs to no context: any thread may use it at any time. */
VG_API_CALL void VG_API_ENTRY vtmDestroyRecording(VtmRecording *recording) VG_API_EXIT;

/* The .vtm file: its bytes, which live as long as the recording, and in *size how many. */
VG_API_CALL const void *VG_API_ENTRY vtmGetRecordingBytes(const VtmRecording *recording, size_t *size) VG_API_EXIT;

VG_API_CALL VGfloat VG_API_ENTRY vtmRecordingWidth(const VtmRecording *recording) VG_API_EXIT;
VG_API_CALL VGfloat VG_API_ENTRY vtmRecordingHeight(const VtmRecording *recording) VG_API_EXIT;

/* Draws it on the current surface under VG_MATRIX_PATH_USER_TO_SURFACE, with (0, 0) where it was when recorded: as one shape
 * whose paint is the picture, so scissoring, masking, blend mode and colour transform are those of now. While another
 * recording is under way the call is refused. */
VG_API_CALL void VG_API_ENTRY vtmDrawRecording(const VtmRecording *recording) VG_API_EXIT;

/* The address of an exported vg, vgu or vtm function, or NULL. */
typedef void (*VtmFunction)(void);
VG_API_CALL VtmFunction VG_API_ENTRY vtmGetProcAddress(const char *name) VG_API_EXIT;

#ifdef __cplusplus
}
#endif

#endif
