/*
 * Images shared by contexts of different share groups (VG_KHR_EGL_image). Plain C89. Our libEGL builds its EGLImages on
 * these; programs without EGL may use them directly.
 *
 *     VtmSharedImage *shared = vtmShareImage(context, image, NULL);
 *     vtmNameSharedImage(shared, &shared);
 *     sibling = vgCreateEGLImageTargetKHR(&shared);                 (in another context: the same pixels)
 *
 * All images that share pixels are siblings: the image that was shared, those made by vgCreateEGLImageTargetKHR, and the
 * children of all these. Pixels exist until the last sibling is destroyed. Siblings may be used like other images, but
 * they cannot be shared again or drawn into as surfaces. A program that writes in one context while it reads in another
 * must synchronise the two itself (EGL_KHR_image_base, issue 7).
 */
#ifndef VTM_VG_IMAGE_H
#define VTM_VG_IMAGE_H

#include <VG/vgext.h>
#include <vtm/vg.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct VtmSharedImage VtmSharedImage;

/* Shares an image, whose pixels are kept. On failure returns NULL and sets *error: VG_BAD_HANDLE_ERROR if `image` is
 * not an image of the context, VG_IMAGE_IN_USE_ERROR if it is a child, already a sibling, or a surface, or
 * VG_OUT_OF_MEMORY_ERROR. `error` may be NULL. */
VG_API_CALL VtmSharedImage *VG_API_ENTRY vtmShareImage(VtmContext *context, VGImage image,
                                                       VGErrorCode *error) VG_API_EXIT;

/* Destroys the shared image and frees its name. Siblings stay. */
VG_API_CALL void VG_API_ENTRY vtmDestroySharedImage(VtmSharedImage *image) VG_API_EXIT;

/* Sets the name under which vgCreateEGLImageTargetKHR finds the shared image; any address will do. It replaces the
 * previous name. Returns VG_FALSE and changes nothing if the name is taken or there is no memory. NULL removes the name
 * for good: the shared image then no longer keeps pixels and makes no siblings, and only the functions below may be
 * used with it. */
VG_API_CALL VGboolean VG_API_ENTRY vtmNameSharedImage(VtmSharedImage *image, VGeglImageKHR name) VG_API_EXIT;

/* The size in pixels. */
VG_API_CALL VGint VG_API_ENTRY vtmSharedImageWidth(const VtmSharedImage *image) VG_API_EXIT;
VG_API_CALL VGint VG_API_ENTRY vtmSharedImageHeight(const VtmSharedImage *image) VG_API_EXIT;

/* vtmTakeSharedPixels copies the pixels for other APIs, as bytes red, green, blue, alpha, rows from the bottom without
 * padding. The values are those that the image stores, in its colour space. A luminance is copied to red, green and
 * blue; without an alpha channel alpha is 255. Must not be called in two threads at once for the same shared image. */
typedef enum {
    VTM_PIXELS_SAME,    /* no pixel has changed since the last take or put; nothing is copied */
    VTM_PIXELS_CHANGED, /* some pixels have changed; all are copied */
    VTM_PIXELS_GONE     /* the last image with these pixels is destroyed; nothing is copied */
} VtmPixels;
VG_API_CALL VtmPixels VG_API_ENTRY vtmTakeSharedPixels(VtmSharedImage *image, void *pixels) VG_API_EXIT;

/* Sets the pixels whose bytes differ from those last taken or put; the others keep all their bits. Does nothing before
 * pixels were taken for the first time. */
VG_API_CALL void VG_API_ENTRY vtmPutSharedPixels(VtmSharedImage *image, const void *pixels) VG_API_EXIT;

/* A function that vgFinish calls, in the thread that called it, so that what was drawn can be given to other APIs. It must
 * not call OpenVG. NULL: none. */
VG_API_CALL void VG_API_ENTRY vtmSetFinishFunction(void (*function)(void)) VG_API_EXIT;

/*
 * Pixels that another API keeps, as images of OpenVG: our libEGL makes the system's EGLImages known by these.
 *
 * vgCreateEGLImageTargetKHR opens them by their name, and makes images of format VG_sABGR_8888, or VG_sXBGR_8888 where
 * there is no alpha: bytes red, green, blue, alpha, rows from the bottom without padding. Pixels are fetched when OpenVG
 * first needs them after the other API may have changed them. All functions may be called in any thread.
 */
typedef struct {
    void *pixels; /* given to the functions below */
    VGint width, height;
    VGboolean hasAlpha;
    /* A texture with the pixels, in a context that shares with the compositor's (vtm/vg_gl.h). It is drawn from and into
     * without a copy, and deleted with the last image. 0: there is none. */
    unsigned texture;
} VtmForeignPixels;

typedef struct {
    /* Fills `opened`. `texture` shall be set if possible where `onGpu` is VG_TRUE, and only there. VG_FALSE: images
     * cannot have such pixels. */
    VGboolean (*open)(void *owner, VGeglImageKHR name, VGboolean onGpu, VtmForeignPixels *opened);
    /* All pixels; leave things as they are where that fails. Not called where there is a texture. */
    void (*read)(void *pixels, void *bytes);
    void (*write)(void *pixels, const void *bytes);
    /* The last image is destroyed, or the pixels were detached. */
    void (*close)(void *pixels);
} VtmForeignFunctions;

/* Names pixels, whatever had the name before. VG_FALSE: there is no memory. Forgetting a name leaves its images,
 * and names of other owners. */
VG_API_CALL VGboolean VG_API_ENTRY vtmNameForeignPixels(VGeglImageKHR name, const VtmForeignFunctions *functions,
                                                        void *owner) VG_API_EXIT;
VG_API_CALL void VG_API_ENTRY vtmForgetForeignPixels(VGeglImageKHR name, void *owner) VG_API_EXIT;

/* Gives what OpenVG has changed to those who keep the pixels, as vgFinish does. `mayChange`: from here on they may have
 * changed what OpenVG did not. */
VG_API_CALL void VG_API_ENTRY vtmFinishForeignPixels(VGboolean mayChange) VG_API_EXIT;

/* Forgets the names of an owner; what its images show is OpenVG's alone from now on. */
VG_API_CALL void VG_API_ENTRY vtmDetachForeignPixels(void *owner) VG_API_EXIT;

#ifdef __cplusplus
}
#endif

#endif
