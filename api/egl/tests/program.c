/* A program of EGL and OpenVG as others write them: linked with -lEGL -lOpenVG, and C89. */

#include <stdio.h>

#include <EGL/egl.h>
#include <VG/openvg.h>
#include <vtm/vg.h>

#define CHECK(condition)                                                            \
    if (!(condition)) {                                                             \
        fprintf(stderr, "%s, error %x\n", #condition, (unsigned)eglGetError());     \
        return 1;                                                                   \
    }

int main(void) {
    static const EGLint attributes[] = {EGL_RED_SIZE,        8,              EGL_GREEN_SIZE,   8,
                                        EGL_BLUE_SIZE,       8,              EGL_ALPHA_SIZE,   8,
                                        EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                        EGL_NONE};
    static const EGLint size[] = {EGL_WIDTH, 20, EGL_HEIGHT, 10, EGL_NONE};
    static unsigned char pixels[20 * 10 * 4];
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    EGLConfig config;
    EGLSurface surface;
    EGLContext context;
    EGLint count = 0;
    VGfloat matrix[9];

    CHECK(eglInitialize(display, NULL, NULL))
    CHECK(eglBindAPI(EGL_OPENVG_API))
    CHECK(eglChooseConfig(display, attributes, &config, 1, &count) && count == 1)
    surface = eglCreatePbufferSurface(display, config, size);
    CHECK(surface != EGL_NO_SURFACE)
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
    CHECK(context != EGL_NO_CONTEXT)
    CHECK(eglMakeCurrent(display, surface, surface, context))

    vgTranslate(3, 4);
    vgGetMatrix(matrix);
    CHECK(matrix[6] == 3 && matrix[7] == 4)
    CHECK(vgGetError() == VG_NO_ERROR)
    vtmReadSurface(vtmGetCurrentSurface(), pixels, 20 * 4);
    CHECK(pixels[0] == 0)
    CHECK(eglSwapBuffers(display, surface))

    CHECK(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT))
    CHECK(vgGetError() == VG_NO_CONTEXT_ERROR)
    CHECK(eglTerminate(display))
    printf("%s\n", "drawn");
    return 0;
}
