/* A context of OpenVG without a window: a pbuffer of EGL, and its pixels in a PPM file. */
#ifndef OFFSCREEN_H
#define OFFSCREEN_H

#include <EGL/egl.h>
#include <VG/openvg.h>
#include <stdio.h>
#include <stdlib.h>

static inline void require(int holds, const char* what) {
    if (!holds) {
        fprintf(stderr, "%s\n", what);
        exit(1);
    }
}

static inline void open_pbuffer(EGLint width, EGLint height) {
    const EGLint wanted[] = {EGL_RED_SIZE,
                             8,
                             EGL_GREEN_SIZE,
                             8,
                             EGL_BLUE_SIZE,
                             8,
                             EGL_ALPHA_SIZE,
                             8,
                             EGL_SURFACE_TYPE,
                             EGL_PBUFFER_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENVG_BIT,
                             EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    EGLConfig config;
    EGLint count = 0;
    require(eglInitialize(display, NULL, NULL), "EGL does not start");
    require(eglBindAPI(EGL_OPENVG_API), "this EGL has no OpenVG");
    require(eglChooseConfig(display, wanted, &config, 1, &count) && count == 1, "no config for OpenVG");
    EGLSurface surface = eglCreatePbufferSurface(display, config, size);
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
    require(eglMakeCurrent(display, surface, surface, context), "no OpenVG context");
}

static inline void close_pbuffer(void) {
    EGLDisplay display = eglGetCurrentDisplay();
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglTerminate(display);
}

/* OpenVG's rows go upwards and a file's go downwards: rows are read from the file's last one on, with a
   negative stride. VG_sABGR_8888 is a word with red in its lowest byte, so bytes are R, G, B, A on
   little-endian machines. */
static inline void write_ppm(const char* name, int width, int height) {
    unsigned char* pixels = malloc((size_t)width * (size_t)height * 4);
    FILE* file = fopen(name, "wb");
    require(pixels && file, "the file cannot be written");
    vgReadPixels(pixels + (size_t)(height - 1) * (size_t)width * 4, -width * 4, VG_sABGR_8888, 0, 0, width,
                 height);
    require(vgGetError() == VG_NO_ERROR, "OpenVG reports an error");
    fprintf(file, "P6\n%d %d\n255\n", width, height);
    for (int i = 0; i < width * height; ++i)
        fwrite(pixels + i * 4, 1, 3, file);
    require(fclose(file) == 0, "the file cannot be written");
    free(pixels);
}

#endif
