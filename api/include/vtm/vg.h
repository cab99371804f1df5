/*
 * OpenVG without EGL: contexts and drawing surfaces in memory. Plain C89. Our libEGL is built on these.
 *
 *     VtmSurfaceFormat format = {8, 8, 8, 8, 0, 8, VG_FALSE, VG_TRUE};
 *     VtmSurface *surface = vtmCreateSurface(640, 480, &format);
 *     VtmContext *context = vtmCreateContext(NULL);
 *     vtmMakeCurrent(context, surface);
 *     vgClear(0, 0, 640, 480);  ...
 *     vtmReadSurface(surface, bytes, 640 * 4);
 *
 * A context may be current in one thread at a time, a surface with one context at a time. Contexts that share objects
 * may be used in several threads at once; their calls are serialised. The caller owns what it creates and destroys it;
 * destroying NULL does nothing. Other functions take NULL only where their comment says so.
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

/* Bits of each channel of a pixel, and the encoding of its values (specification 3.4). The channels are either colours
 * (8 8 8 8, 8 8 8 0, 5 6 5 0, 5 5 5 1, 4 4 4 4), alpha only (0 0 0 8), or luminance only (luminanceBits 8 or 1). */
typedef struct VtmSurfaceFormat {
    VGint redBits, greenBits, blueBits, alphaBits;
    VGint luminanceBits;
    VGint maskBits;          /* of the drawing surface mask: 8, or 0 for none */
    VGboolean linear;        /* colours are linear light, not sRGB-encoded */
    VGboolean premultiplied; /* colours are stored multiplied by alpha */
} VtmSurfaceFormat;

/* What draws on a surface: the CPU, or the GPU through OpenGL ES (docs/openvg.md). Pixels are the same within 1/255 of a
 * channel. */
typedef enum {
    VTM_COMPOSITOR_AUTOMATIC, /* what the environment variable VTM_OPENVG_COMPOSITOR says, "cpu" or "gl"; if it says
                               * nothing, the GPU where there is one, else the CPU */
    VTM_COMPOSITOR_CPU,
    VTM_COMPOSITOR_GL /* OpenGL ES 3, on any driver; the CPU where there is none */
} VtmCompositor;

/* Creates a surface whose pixels are 0 and whose mask is 1. Sides are in pixels. Returns NULL if the format is not one
 * of those above, a side is not in [1, 16384], or there is no memory. */
VG_API_CALL VtmSurface *VG_API_ENTRY vtmCreateSurface(VGint width, VGint height,
                                                      const VtmSurfaceFormat *format) VG_API_EXIT;

/* Creates a surface that draws into an image of `context` (specification 4, Images as rendering targets); `maskBits` as
 * above. On failure returns NULL and sets *error: VG_BAD_HANDLE_ERROR if `image` is not an image of the context,
 * VG_IMAGE_IN_USE_ERROR if it is already a target, is related to other images, or is a paint's pattern or a font's
 * glyph, VG_ILLEGAL_ARGUMENT_ERROR if drawing into its format is not supported. `error` may be NULL. */
VG_API_CALL VtmSurface *VG_API_ENTRY vtmCreateImageSurface(VtmContext *context, VGImage image, VGint maskBits,
                                                           VGErrorCode *error) VG_API_EXIT;

/* Chooses what draws on a surface from now on, and keeps its pixels. New surfaces have VTM_COMPOSITOR_AUTOMATIC. Returns
 * what draws now: VTM_COMPOSITOR_CPU or VTM_COMPOSITOR_GL. */
VG_API_CALL VtmCompositor VG_API_ENTRY vtmChooseCompositor(VtmSurface *surface, VtmCompositor compositor) VG_API_EXIT;

/* Returns what draws on a surface: VTM_COMPOSITOR_CPU or VTM_COMPOSITOR_GL. It changes to the CPU where the GPU fails. */
VG_API_CALL VtmCompositor VG_API_ENTRY vtmGetCompositor(const VtmSurface *surface) VG_API_EXIT;

/* Returns why the GPU cannot be had; empty if it can, or if nothing has asked for it yet. */
VG_API_CALL const char *VG_API_ENTRY vtmGetCompositorFault(void) VG_API_EXIT;

/* Destroys a surface; one that is current is destroyed when it stops being current. */
VG_API_CALL void VG_API_ENTRY vtmDestroySurface(VtmSurface *surface) VG_API_EXIT;

/* Changes the size. Pixels inside both sizes are kept; new pixels are 0, new mask values 1. Returns VG_FALSE where
 * vtmCreateSurface would return NULL, and for surfaces that draw into images. */
VG_API_CALL VGboolean VG_API_ENTRY vtmResizeSurface(VtmSurface *surface, VGint width, VGint height) VG_API_EXIT;

/* The size in pixels. */
VG_API_CALL VGint VG_API_ENTRY vtmSurfaceWidth(const VtmSurface *surface) VG_API_EXIT;
VG_API_CALL VGint VG_API_ENTRY vtmSurfaceHeight(const VtmSurface *surface) VG_API_EXIT;

/* Returns the format of a surface, including one that draws into an image. */
VG_API_CALL void VG_API_ENTRY vtmGetSurfaceFormat(const VtmSurface *surface, VtmSurfaceFormat *format) VG_API_EXIT;

/* Copies all pixels as sRGB-encoded, premultiplied bytes red, green, blue, alpha, rows from the TOP (y = height - 1
 * first), `rowBytes` from one row to the next. */
VG_API_CALL void VG_API_ENTRY vtmReadSurface(VtmSurface *surface, void *pixels, size_t rowBytes) VG_API_EXIT;

/* The same for a rectangle, which must be within the surface; (x, y) is its lower left pixel. */
VG_API_CALL void VG_API_ENTRY vtmReadSurfacePart(VtmSurface *surface, VGint x, VGint y, VGint width, VGint height,
                                                 void *pixels, size_t rowBytes) VG_API_EXIT;

/* The same in any format of images of eight bits or more a pixel. Words are native: VG_sARGB_8888_PRE gives bytes blue,
 * green, red, alpha on little-endian machines, as X servers and other window systems take them. VG_FALSE: there is no
 * such format. */
VG_API_CALL VGboolean VG_API_ENTRY vtmReadSurfaceAs(VtmSurface *surface, VGImageFormat format, VGint x, VGint y,
                                                    VGint width, VGint height, void *pixels,
                                                    size_t rowBytes) VG_API_EXIT;

/* The inverse of vtmReadSurface: sets all pixels. */
VG_API_CALL void VG_API_ENTRY vtmWriteSurface(VtmSurface *surface, const void *pixels, size_t rowBytes) VG_API_EXIT;

/* Creates a context that shares the objects of `share`, unless that is NULL. Returns NULL if there is no memory. */
VG_API_CALL VtmContext *VG_API_ENTRY vtmCreateContext(VtmContext *share) VG_API_EXIT;

/* Destroys a context; one that is current in a thread is destroyed when it stops being current. */
VG_API_CALL void VG_API_ENTRY vtmDestroyContext(VtmContext *context) VG_API_EXIT;

/* Makes both current in this thread, replacing what was; NULL, NULL makes nothing current. When a context gets another
 * surface, its mask is reset (specification 7.2). Returns VG_FALSE and changes nothing if only one is NULL, the context
 * is current in another thread, the surface is current with another context, or its image has become a paint's pattern
 * or a font's glyph. */
VG_API_CALL VGboolean VG_API_ENTRY vtmMakeCurrent(VtmContext *context, VtmSurface *surface) VG_API_EXIT;

/* What is current in this thread; NULL if nothing is. */
VG_API_CALL VtmContext *VG_API_ENTRY vtmGetCurrentContext(void) VG_API_EXIT;
VG_API_CALL VtmSurface *VG_API_ENTRY vtmGetCurrentSurface(void) VG_API_EXIT;

/*
 * Recordings: a sequence of calls compiled to one picture, a Vector Texture Map. Layers become disjoint regions, so
 * abutting shapes leave no seam, and the recording is exact under any matrix (docs/openvg_recordings.md).
 *
 *     vtmBeginRecording(400, 300);
 *     ...                                                 the usual calls: nothing is drawn meanwhile
 *     VtmRecording *recording = vtmEndRecording();
 *     vtmDrawRecording(recording);                        under the path matrix, any number of times
 */
typedef struct VtmRecording VtmRecording;

/* The error of a call that cannot be recorded. */
#define VTM_NOT_RECORDABLE_ERROR ((VGErrorCode)0x1F00)

/* Starts a recording. From now on vgClear, vgSetPixels, vgWritePixels and the functions that draw paths, glyphs and
 * images on the current context are recorded instead of drawn: what would appear in [0, width] x [0, height] of the
 * surface, whatever the surface's size, on a transparent background. The recording has a mask of its own, which starts
 * at 1; the surface's pixels and mask do not change. Sets VG_ILLEGAL_ARGUMENT_ERROR if the context is already
 * recording, or a side is not in (0, 1000000].
 *
 * * A call that cannot be recorded does nothing and sets VTM_NOT_RECORDABLE_ERROR; docs/openvg_recordings.md lists
 * them. */
VG_API_CALL void VG_API_ENTRY vtmBeginRecording(VGfloat width, VGfloat height) VG_API_EXIT;

/* Ends the recording, also on failure. On failure returns NULL and sets VG_ILLEGAL_ARGUMENT_ERROR if the context is not
 * recording, VTM_NOT_RECORDABLE_ERROR if a call could not be recorded, VG_OUT_OF_MEMORY_ERROR if there is no memory or
 * the picture exceeds a limit of the compiler. */
VG_API_CALL VtmRecording *VG_API_ENTRY vtmEndRecording(void) VG_API_EXIT;

/* Returns why the current context's last recording failed: the call and the reason. Empty if it did not fail. Valid
 * until the next recording begins. */
VG_API_CALL const char *VG_API_ENTRY vtmGetRecordingFault(void) VG_API_EXIT;

/* Makes a recording from the bytes of a .vtm file, from any source. Returns NULL if the bytes are not a valid file
 * (untrusted bytes are safe) or contain a picture in compat mode, which has no regions. Materials, which are GLSL, have
 * their fallback colours. */
VG_API_CALL VtmRecording *VG_API_ENTRY vtmLoadRecording(const void *bytes, size_t size) VG_API_EXIT;

/* Destroys a recording. Recordings do not change and belong to no context: any thread may use them at any time. */
VG_API_CALL void VG_API_ENTRY vtmDestroyRecording(VtmRecording *recording) VG_API_EXIT;

/* Returns the bytes of the recording's .vtm file and sets *size to their number. Valid as long as the recording. */
VG_API_CALL const void *VG_API_ENTRY vtmGetRecordingBytes(const VtmRecording *recording, size_t *size) VG_API_EXIT;

/* The size in user units, as given to vtmBeginRecording. */
VG_API_CALL VGfloat VG_API_ENTRY vtmRecordingWidth(const VtmRecording *recording) VG_API_EXIT;
VG_API_CALL VGfloat VG_API_ENTRY vtmRecordingHeight(const VtmRecording *recording) VG_API_EXIT;

/* Draws a recording on the current surface under VG_MATRIX_PATH_USER_TO_SURFACE, as one shape whose paint is the
 * picture, with the current scissoring, masking, blend mode and colour transform. NULL sets VG_ILLEGAL_ARGUMENT_ERROR.
 * While the context is recording, the call fails with VTM_NOT_RECORDABLE_ERROR. */
VG_API_CALL void VG_API_ENTRY vtmDrawRecording(const VtmRecording *recording) VG_API_EXIT;

/* Returns the address of an exported vg, vgu or vtm function, or NULL if there is none of that name. */
typedef void (*VtmFunction)(void);
VG_API_CALL VtmFunction VG_API_ENTRY vtmGetProcAddress(const char *name) VG_API_EXIT;

#ifdef __cplusplus
}
#endif

#endif
