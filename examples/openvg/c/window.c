/* A window of X11 with a turning wheel, as large as the window, whatever its size becomes.
   cc window.c $(pkg-config --cflags --libs openvg x11) -o window; ./window [SECONDS] */
#define _POSIX_C_SOURCE 199309L
#include <EGL/egl.h>
#include <VG/openvg.h>
#include <VG/vgu.h>
#include <X11/Xlib.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static void require(int holds, const char* what) {
    if (!holds) {
        fprintf(stderr, "%s\n", what);
        exit(1);
    }
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static Window open_window(Display* x, unsigned width, unsigned height) {
    Window window = XCreateSimpleWindow(x, DefaultRootWindow(x), 0, 0, width, height, 0, 0, 0);
    Atom closed = XInternAtom(x, "WM_DELETE_WINDOW", False);
    XSetWMProtocols(x, window, &closed, 1);
    XStoreName(x, window, "OpenVG");
    XSelectInput(x, window, KeyPressMask);
    XMapWindow(x, window);
    XSync(x, False);
    return window;
}

/* Any key, or the window's own button. */
static int is_closed(Display* x) {
    int closed = 0;
    while (XPending(x) > 0) {
        XEvent event;
        XNextEvent(x, &event);
        closed |= event.type == KeyPress || event.type == ClientMessage;
    }
    return closed;
}

static EGLSurface open_surface(EGLDisplay display, Window window) {
    const EGLint wanted[] = {EGL_RED_SIZE,
                             8,
                             EGL_GREEN_SIZE,
                             8,
                             EGL_BLUE_SIZE,
                             8,
                             EGL_SURFACE_TYPE,
                             EGL_WINDOW_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENVG_BIT,
                             EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    require(eglInitialize(display, NULL, NULL), "EGL does not start");
    require(eglBindAPI(EGL_OPENVG_API), "this EGL has no OpenVG");
    require(eglChooseConfig(display, wanted, &config, 1, &count) && count == 1,
            "no config for OpenVG in a window");
    EGLSurface surface = eglCreateWindowSurface(display, config, window, NULL);
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
    require(eglMakeCurrent(display, surface, surface, context), "no OpenVG context for the window");
    return surface;
}

/* A wheel of twelve sectors, 1.9 wide, about the origin. */
static VGPath wheel(void) {
    VGPath path =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
    for (int i = 0; i < 12; ++i)
        vguArc(path, 0, 0, 1.9f, 1.9f, (VGfloat)(30 * i), 15, VGU_ARC_PIE);
    return path;
}

static void draw(VGPath path, EGLint width, EGLint height, double seconds) {
    const VGfloat radius = (VGfloat)(width < height ? width : height) / 2;
    vgClear(0, 0, width, height);
    vgLoadIdentity();
    vgTranslate((VGfloat)width / 2, (VGfloat)height / 2);
    vgScale(radius, radius);
    vgRotate((VGfloat)(40 * seconds));
    vgDrawPath(path, VG_FILL_PATH | VG_STROKE_PATH);
}

int main(int argc, char** argv) {
    static const VGfloat paper[] = {0.95f, 0.93f, 0.87f, 1};
    Display* x = XOpenDisplay(NULL);
    require(x != NULL, "no X display");
    Window window = open_window(x, 320, 240);
    EGLDisplay display = eglGetDisplay(x);
    EGLSurface surface = open_surface(display, window);

    VGPath path = wheel();
    VGPaint fill = vgCreatePaint(), stroke = vgCreatePaint();
    vgSetColor(fill, 0xd04050ff);
    vgSetColor(stroke, 0x303040ff);
    vgSetPaint(fill, VG_FILL_PATH);
    vgSetPaint(stroke, VG_STROKE_PATH);
    vgSetf(VG_STROKE_LINE_WIDTH, 0.02f);
    vgSetfv(VG_CLEAR_COLOR, 4, paper);

    const double start = now(), end = argc > 1 ? start + atof(argv[1]) : 1e30;
    while (now() < end && !is_closed(x)) {
        /* The surface follows the window: its size may change with every frame. */
        EGLint width = 0, height = 0;
        eglQuerySurface(display, surface, EGL_WIDTH, &width);
        eglQuerySurface(display, surface, EGL_HEIGHT, &height);
        draw(path, width, height, now() - start);
        require(vgGetError() == VG_NO_ERROR, "OpenVG reports an error");
        require(eglSwapBuffers(display, surface), "eglSwapBuffers fails");
    }

    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglTerminate(display);
    XCloseDisplay(x);
    return 0;
}
