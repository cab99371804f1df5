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

/* A surface that is current stays until it no longer is. */
VG_API_CALL void VG_API_ENTRY vtmDestroySurface(VtmSurface *surface) VG_API_EXIT;

/* Keeps the pixels that both sizes have; new pixels are 0, new mask values 1. False where vtmCreateSurface would
 * give NULL, and for images. */
VG_API_CALL VGboolean VG_API_ENTRY vtmResizeSurface(VtmSurface *surface, VGint width, VGint height) VG_API_EXIT;

VG_API_CALL VGint VG_API_ENTRY vtmSurfaceWidth(const VtmSurface *surface) VG_API_EXIT;
VG_API_CALL VGint VG_API_ENTRY vtmSurfaceHeight(const VtmSurface *surface) VG_API_EXIT;

/* Of an image too. */
VG_API_CALL void VG_API_ENTRY vtmGetSurfaceFormat(const VtmSurface *surface, VtmSurfaceFormat *format) VG_API_EXIT;

/* All pixels as sRGB-encoded, premultiplied bytes red, green, blue, alpha, rows from the TOP (y = height - 1 first),
 * `rowBytes` from one row to the next. */
VG_API_CALL void VG_API_ENTRY vtmReadSurface(VtmSurface *surface, void *pixels, size_t rowBytes) VG_API_EXIT;

/* The inverse: sets all pixels. */
VG_API_CALL void VG_API_ENTRY vtmWriteSurface(VtmSurface *surface, const void *pixels, size_t rowBytes) VG_API_EXIT;

/* `share`: a context whose objects the new one shares, or NULL. NULL if there is no memory. */
VG_API_CALL VtmContext *VG_API_ENTRY vtmCreateContext(VtmContext *share) VG_API_EXIT;

/* A context that is current in some thread stays until it no longer is. */
VG_API_CALL void VG_API_ENTRY vtmDestroyContext(VtmContext *context) VG_API_EXIT;

/* Makes both current in this thread, in place of what was; NULL, NULL makes nothing current. A context that gets another
 * surface has its mask reset (specification 7.2). False, and nothing changed, if only one is NULL, the context is current
 * in another thread, the surface with another context, or its image has become a paint's pattern or a font's glyph. */
VG_API_CALL VGboolean VG_API_ENTRY vtmMakeCurrent(VtmContext *context, VtmSurface *surface) VG_API_EXIT;

VG_API_CALL VtmContext *VG_API_ENTRY vtmGetCurrentContext(void) VG_API_EXIT;
VG_API_CALL VtmSurface *VG_API_ENTRY vtmGetCurrentSurface(void) VG_API_EXIT;

/* The address of an exported vg, vgu or vtm function, or NULL. */
typedef void (*VtmFunction)(void);
VG_API_CALL VtmFunction VG_API_ENTRY vtmGetProcAddress(const char *name) VG_API_EXIT;

#ifdef __cplusplus
}
#endif

#endif
