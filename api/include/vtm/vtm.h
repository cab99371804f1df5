/*
 * Pictures in C, and for languages that bind to C: SVG or .vtm files in, pixels out. Plain C99; <vtm/vtm.hpp> has the same
 * in C++.
 *
 *     VtmPicture *picture = vtmLoadPicture("tiger.svg");
 *     VtmRenderOptions options = {0};
 *     options.width = 800;
 *     VtmImage *image = vtmRenderPicture(picture, &options);
 *     if (!image || !vtmSaveImage(image, "tiger.png"))
 *         fprintf(stderr, "%s\n", vtmGetError());
 *     vtmDestroyImage(image);
 *     vtmDestroyPicture(picture);
 *
 * What cannot be made is NULL, what failed returns 0, and vtmGetError() says why. Passing NULL for a picture or an image is
 * such an error, never a crash; destroying NULL does nothing. A picture may be used from several threads at once, an image
 * is never changed. Strings are UTF-8.
 */
#ifndef VTM_VTM_H
#define VTM_VTM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#pragma GCC visibility push(default)

typedef struct VtmPicture VtmPicture;
typedef struct VtmImage VtmImage;

/* Returns the version, for example "0.2.0". */
const char *vtmVersion(void);

/* Returns the message of the last failure in this thread; empty if there was none. Valid until the next failure. */
const char *vtmGetError(void);

/* An SVG file, gzip-compressed or not, or a compiled .vtm file. */
VtmPicture *vtmLoadPicture(const char *path);

/* The same from memory, which is not needed afterwards. `name` stands for it in messages and may be NULL; nothing that the
 * picture refers to by a relative path is read. */
VtmPicture *vtmLoadPictureFromMemory(const void *bytes, size_t size, const char *name);

void vtmDestroyPicture(VtmPicture *picture);

/* User units; 0 for NULL. */
double vtmPictureWidth(const VtmPicture *picture);
double vtmPictureHeight(const VtmPicture *picture);

/* What was left out or repaired so far: when it was loaded, and in what was drawn. */
size_t vtmPictureWarningCount(const VtmPicture *picture);

/* Copies a warning, cut to `size` bytes with the terminating zero; returns its whole length, 0 if there is none of that
 * index. */
size_t vtmGetPictureWarning(const VtmPicture *picture, size_t index, char *text, size_t size);

/* Compiles the picture and writes it to a .vtm file. Returns 0 on failure. */
int vtmSavePicture(const VtmPicture *picture, const char *path);

typedef enum VtmFit {
    VTM_FIT_CONTAIN, /* all of it is seen, some of the pixels may be empty */
    VTM_FIT_COVER,   /* no pixel is left empty, some of it may lie outside */
    VTM_FIT_STRETCH  /* the aspect is not kept */
} VtmFit;

typedef enum VtmEngine {
    VTM_ENGINE_AUTO, /* shaders where there is a GPU, else the CPU */
    VTM_ENGINE_CPU,
    VTM_ENGINE_GL
} VtmEngine;

/* All zero: one pixel a user unit, on transparent ground. */
typedef struct VtmRenderOptions {
    int width, height;      /* pixels; one of them alone keeps the aspect; both: `fit` decides; neither: `scale` */
    double scale;           /* pixels a user unit; 0 is 1 */
    int fit;                /* a VtmFit */
    double view[4];         /* x, y, width, height of the part that is shown, user units; all zero: the whole picture */
    double rotation;        /* degrees, clockwise */
    double matrix[6];       /* unless all zero, in place of scale, fit, view and rotation: SVG's matrix(a b c d e f) from
                             * user units to pixels; needs width and height */
    float background[4];    /* straight sRGB red, green, blue, alpha in [0, 1] */
    int engine;             /* a VtmEngine */
} VtmRenderOptions;

/* `options` may be NULL. */
VtmImage *vtmRenderPicture(const VtmPicture *picture, const VtmRenderOptions *options);

void vtmDestroyImage(VtmImage *image);

int vtmImageWidth(const VtmImage *image);
int vtmImageHeight(const VtmImage *image);

/* Returns the engine that drew the image: VTM_ENGINE_CPU or VTM_ENGINE_GL. */
VtmEngine vtmImageEngine(const VtmImage *image);

/* 8-bit straight sRGB red, green, blue, alpha; rows from the top, 4 * width bytes each. Valid as long as the image. */
const uint8_t *vtmImagePixels(const VtmImage *image);

/* In the format of the path's suffix: .png, .jpg, .webp or .ppm; the latter two without loss, .jpg and .ppm without alpha. */
int vtmSaveImage(const VtmImage *image, const char *path);

#pragma GCC visibility pop

#ifdef __cplusplus
}
#endif

#endif
