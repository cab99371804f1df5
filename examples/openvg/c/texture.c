/* A texture that OpenGL ES draws, as an image of OpenVG: turned, and as the pattern of a disc, in a PPM file.
   cc texture.c $(pkg-config --cflags --libs openvg glesv2) -o texture; ./texture texture.ppm */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <VG/openvg.h>
#define VG_VGEXT_PROTOTYPES
#include <VG/vgext.h>
#include <VG/vgu.h>

#include "offscreen.h"

enum { width = 320, height = 160, side = 64 };

/* A context of OpenGL ES without a surface of its own use: it draws into the texture only. */
static EGLContext open_gles(EGLDisplay display, EGLSurface* surface) {
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    require(eglBindAPI(EGL_OPENGL_ES_API), "there is no OpenGL ES");
    require(eglChooseConfig(display, wanted, &config, 1, &count) && count == 1, "no config for OpenGL ES");
    *surface = eglCreatePbufferSurface(display, config, size);
    return eglCreateContext(display, config, EGL_NO_CONTEXT, version);
}

static GLuint make_texture(void) {
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    return texture;
}

static void paint_part(int x, int y, float r, float g, float b) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(x, y, side / 2, side / 2);
    glClearColor(r, g, b, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

/* Red, green, blue and white, from the lower left to the upper right. */
static void draw_texture(void) {
    paint_part(0, 0, 1, 0, 0);
    paint_part(side / 2, 0, 0, 1, 0);
    paint_part(0, side / 2, 0, 0, 1);
    paint_part(side / 2, side / 2, 1, 1, 1);
}

/* On its corner, around (80, 80). */
static void draw_turned(VGImage image) {
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgLoadIdentity();
    vgTranslate(80, 80);
    vgRotate(45);
    vgTranslate(-side / 2, -side / 2);
    vgDrawImage(image);
}

static void draw_disc(VGImage image) {
    VGPath disc = vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
    VGPaint pattern = vgCreatePaint();
    vguEllipse(disc, 240, 80, 120, 120);
    vgSetParameteri(pattern, VG_PAINT_TYPE, VG_PAINT_TYPE_PATTERN);
    vgSetParameteri(pattern, VG_PAINT_PATTERN_TILING_MODE, VG_TILE_REPEAT);
    vgPaintPattern(pattern, image);
    vgSetPaint(pattern, VG_FILL_PATH);
    vgDrawPath(disc, VG_FILL_PATH);
}

int main(int argc, char** argv) {
    require(argc == 2, "usage: texture FILE.ppm");
    open_pbuffer(width, height);
    EGLDisplay display = eglGetCurrentDisplay();
    EGLSurface vg_surface = eglGetCurrentSurface(EGL_DRAW), gl_surface;
    EGLContext vg = eglGetCurrentContext(), gl = open_gles(display, &gl_surface);

    require(eglMakeCurrent(display, gl_surface, gl_surface, gl), "no context of OpenGL ES");
    GLuint texture = make_texture();
    EGLImage shared =
        eglCreateImage(display, gl, EGL_GL_TEXTURE_2D, (EGLClientBuffer)(size_t)texture, NULL);
    require(shared != EGL_NO_IMAGE, "no EGLImage of the texture");
    VGImage image = vgCreateEGLImageTargetKHR(shared);
    require(image != VG_INVALID_HANDLE, "no image of the EGLImage");
    eglDestroyImage(display, shared); /* texture and image keep the pixels */
    draw_texture();

    /* Going from one API to the other makes each see what the other has drawn. */
    require(eglMakeCurrent(display, vg_surface, vg_surface, vg), "no context of OpenVG");
    draw_turned(image);
    require(eglMakeCurrent(display, gl_surface, gl_surface, gl), "no context of OpenGL ES");
    paint_part(0, 0, 1, 1, 0);
    require(eglMakeCurrent(display, vg_surface, vg_surface, vg), "no context of OpenVG");
    draw_disc(image);

    write_ppm(argv[1], width, height);
    close_pbuffer();
    return 0;
}
