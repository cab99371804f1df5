/*
 * Images that contexts of different share groups share (VG_KHR_EGL_image). Plain C89. Our libEGL makes its EGLImages
 * out of these; programs without EGL may use them as they are.
 *
 *     VtmSharedImage *shared = vtmShareImage(context, image, NULL);
 *     vtmNameSharedImage(shared, &shared);
 *     sibling = vgCreateEGLImageTargetKHR(&shared);                 (in another context: the same pixels)
 *
 * All images that share pixels are siblings: the one that was shared, with its children, and those made by
 * vgCreateEGLImageTargetKHR, with theirs. Pixels stay until the last sibling is gone. Siblings may be used as images of
 * any kind, but neither be shared again nor be drawn into as surfaces. Who writes in one context while another reads
 * has to order the two himself (EGL_KHR_image_base, issue 7).
 */
#ifndef VTM_VG_IMAGE_H
#define VTM_VG_IMAGE_H

#include <VG/vgext.h>
#include <vtm/vg.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct VtmSharedImage VtmSharedImage;

/* Keeps its pixels. NULL with *error set to VG_BAD_HANDLE_ERROR if `image` is none of the context's, to
 * VG_IMAGE_IN_USE_ERROR if it is a child, a sibling already or a surface's, to VG_OUT_OF_MEMORY_ERROR. `error` may be
 * NULL. */
VG_API_CALL VtmSharedImage *VG_API_ENTRY vtmShareImage(VtmContext *context, VGImage image,
                                                       VGErrorCode *error) VG_API_EXIT;

/* Destroys the shared image and frees its name. Siblings stay. */
VG_API_CALL void VG_API_ENTRY vtmDestroySharedImage(VtmSharedImage *image) VG_API_EXIT;

/* What vgCreateEGLImageTargetKHR knows it by, in place of the name it had: any address. False, and nothing changed, if
 * the name is taken, or there is no memory. With NULL it has no name any more, nor ever again; what is left of it neither
 * keeps pixels nor makes siblings, and only the functions below tell more of it. */
VG_API_CALL VGboolean VG_API_ENTRY vtmNameSharedImage(VtmSharedImage *image, VGeglImageKHR name) VG_API_EXIT;

VG_API_CALL VGint VG_API_ENTRY vtmSharedImageWidth(const VtmSharedImage *image) VG_API_EXIT;
VG_API_CALL VGint VG_API_ENTRY vtmSharedImageHeight(const VtmSharedImage *image) VG_API_EXIT;

/* Its pixels, for other APIs: as bytes red, green, blue, alpha, the numbers as the image stores them, whatever color space
 * they are in; a luminance in all of the first three, 255 for an alpha that there is not; rows from the bottom, one right
 * after the other. Not for two threads at once. */
typedef enum {
    VTM_PIXELS_SAME,    /* none has changed since they were last taken or put; nothing is stored */
    VTM_PIXELS_CHANGED, /* some have; all are stored */
    VTM_PIXELS_GONE     /* they are gone with the last image that had them; nothing is stored */
} VtmPixels;
VG_API_CALL VtmPixels VG_API_ENTRY vtmTakeSharedPixels(VtmSharedImage *image, void *pixels) VG_API_EXIT;

/* Sets the pixels whose bytes differ from those last taken or put; the others keep all bits that they have. Of no effect
 * before they are first taken. */
VG_API_CALL void VG_API_ENTRY vtmPutSharedPixels(VtmSharedImage *image, const void *pixels) VG_API_EXIT;

#ifdef __cplusplus
}
#endif

#endif
