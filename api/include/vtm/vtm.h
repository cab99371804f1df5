/*
 * Loads SVG, .vtmtree or .vtm files and renders them to pixels; for C and for languages that bind to C. Plain C99;
 * <vtm/vtm.hpp> is the same in C++.
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
 * Functions that fail return NULL or 0, and vtmGetError() says why. NULL for a picture or an image is such an error, never
 * a crash; destroying NULL does nothing. The caller owns pictures and images and destroys them. A picture may be used in
 * several threads at once; an image does not change. Strings are UTF-8.
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

/* Returns the message of the last failure in this thread; empty if there was none. Valid until the next failure in
 * it. */
const char *vtmGetError(void);

/* Loads an SVG file, gzip-compressed or not, a .vtmtree file (docs/vtmtree.md) or a compiled .vtm file; the bytes
 * decide which. */
VtmPicture *vtmLoadPicture(const char *path);

/* The same from memory, which is not needed afterwards. `name` replaces the file name in messages and may be NULL.
 * Files to which the picture refers by a relative path are not read. */
VtmPicture *vtmLoadPictureFromMemory(const void *bytes, size_t size, const char *name);

/* All zero: the defaults. Strings are copied; NULL means the default. */
typedef struct VtmLoadOptions {
    const char *name;     /* replaces the file name in messages, for pictures from memory */
    const char *folder;   /* to which relative references refer; NULL: the folder of the file, for memory none */
    double dpi;           /* pixels per inch, for lengths in physical units; 0 means 96 */
    const char *language; /* of text, and for systemLanguage; NULL means "en" */
    const char *const *fontDirectories; /* paths, the last followed by NULL; searched before the system's fonts */
    int noSystemFonts;                  /* 1: without the system's fonts */
    /* The families that CSS's generic names stand for, and the one where none is named. */
    const char *serifFamily, *sansSerifFamily, *cursiveFamily, *fantasyFamily, *monospaceFamily, *defaultFamily;
    double defaultFontSize; /* of text without a size, user units; 0 means 12 */
} VtmLoadOptions;

/* The same with options, which may be NULL. */
VtmPicture *vtmLoadPictureWithOptions(const char *path, const VtmLoadOptions *options);
VtmPicture *vtmLoadPictureFromMemoryWithOptions(const void *bytes, size_t size, const VtmLoadOptions *options);

void vtmDestroyPicture(VtmPicture *picture);

/* The picture's size in user units; 0 for NULL. */
double vtmPictureWidth(const VtmPicture *picture);
double vtmPictureHeight(const VtmPicture *picture);

/* Number of warnings so far: what was left out or repaired when the picture was loaded and drawn. */
size_t vtmPictureWarningCount(const VtmPicture *picture);

/* Copies warning `index`, in [0, count), into `text`, truncated to `size` bytes including the terminating zero. Returns
 * the length of the whole warning without the zero; 0 if there is no such warning. */
size_t vtmGetPictureWarning(const VtmPicture *picture, size_t index, char *text, size_t size);

/* Compiles the picture and writes it to a .vtm file. Returns 0 on failure. */
int vtmSavePicture(const VtmPicture *picture, const char *path);

typedef enum VtmFit {
    VTM_FIT_CONTAIN, /* the whole picture is visible; pixels beside it may be empty */
    VTM_FIT_COVER,   /* every pixel is covered; parts of the picture may be outside */
    VTM_FIT_STRETCH  /* the picture fills the pixels; its aspect ratio is not kept */
} VtmFit;

typedef enum VtmEngine {
    VTM_ENGINE_AUTO, /* shaders where there is a GPU, otherwise the CPU */
    VTM_ENGINE_CPU,
    VTM_ENGINE_GL    /* shaders, also on a software driver */
} VtmEngine;

/* All zero: one pixel per user unit, on a transparent background. */
typedef struct VtmRenderOptions {
    int width, height;      /* pixels, 0: not given. With one of them the aspect ratio is kept; with both `fit` applies;
                             * with neither `scale` */
    double scale;           /* pixels per user unit; 0 means 1 */
    int fit;                /* a VtmFit */
    double view[4];         /* x, y, width, height of the visible part, user units; all zero: the whole picture */
    double rotation;        /* degrees, clockwise */
    double matrix[6];       /* unless all zero, replaces scale, fit, view and rotation: SVG's matrix(a b c d e f) from user
                             * units to pixels; needs width and height */
    float background[4];    /* straight sRGB red, green, blue, alpha in [0, 1] */
    int engine;             /* a VtmEngine */
} VtmRenderOptions;

/* Renders the picture. `options` may be NULL: the defaults. */
VtmImage *vtmRenderPicture(const VtmPicture *picture, const VtmRenderOptions *options);

void vtmDestroyImage(VtmImage *image);

/* The image's size in pixels; 0 for NULL. */
int vtmImageWidth(const VtmImage *image);
int vtmImageHeight(const VtmImage *image);

/* Returns the engine that drew the image: VTM_ENGINE_CPU or VTM_ENGINE_GL. */
VtmEngine vtmImageEngine(const VtmImage *image);

/* Returns 8-bit straight (not premultiplied) sRGB red, green, blue, alpha; rows from the top, 4 * width bytes each.
 * Valid as long as the image. */
const uint8_t *vtmImagePixels(const VtmImage *image);

/* Writes the image in the format of the path's suffix: .png, .webp (lossless), .jpg or .ppm (both without alpha).
 * Returns 0 on failure. */
int vtmSaveImage(const VtmImage *image, const char *path);

#pragma GCC visibility pop

#ifdef __cplusplus
}
#endif

#endif
