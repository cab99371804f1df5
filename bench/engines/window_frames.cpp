// bench_windows WIDTH HEIGHT FRAMES: frames on a window of every format, by OpenVG and our EGL on the X
// server that DISPLAY names. A line each: format, kind of frame, median CPU milliseconds of this process.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <EGL/egl.h>
#include <VG/openvg.h>
#include <X11/Xlib.h>

#include "bench/measure/measure.hpp"

namespace {

using vtm::bench::median;
using vtm::bench::spentTime;

struct VgWindow {
    EGLDisplay display;
    EGLConfig config;
    EGLSurface surface;
    int width, height;

    EGLint attribute(EGLint name) const {
        EGLint value = 0;
        eglGetConfigAttrib(display, config, name, &value);
        return value;
    }
    EGLint ofSurface(EGLint name) const {
        EGLint value = 0;
        eglQuerySurface(display, surface, name, &value);
        return value;
    }
    std::string name() const {
        const EGLint luminance = attribute(EGL_LUMINANCE_SIZE), red = attribute(EGL_RED_SIZE);
        std::string text = luminance ? "L " + std::to_string(luminance) : red ? "RGBA " : "A ";
        if (red)
            for (const EGLint size : {EGL_RED_SIZE, EGL_GREEN_SIZE, EGL_BLUE_SIZE})
                text += std::to_string(attribute(size));
        if (!luminance)
            text += std::to_string(attribute(EGL_ALPHA_SIZE));
        if (ofSurface(EGL_VG_COLORSPACE) == EGL_VG_COLORSPACE_LINEAR)
            text += ", linear";
        if (ofSurface(EGL_VG_ALPHA_FORMAT) == EGL_VG_ALPHA_FORMAT_PRE)
            text += ", premultiplied";
        return text;
    }
    void swap() const { eglSwapBuffers(display, surface); }
};

/// Something that changes with every frame, in a corner.
void drawMark(int frame) {
    const VGfloat color[] = {VGfloat(frame % 7) / 7, 0.5f, 0.8f, 1};
    vgSetfv(VG_CLEAR_COLOR, 4, color);
    vgClear(3 * frame, 2 * frame, 60, 60);
}

template <class Frame>
void measure(const VgWindow& window, const char* kind, int frames, Frame&& frame) {
    std::vector<double> times;
    for (int i = 0; i < frames + 2; ++i) {
        const double time = spentTime([&] { frame(i); });
        if (i >= 2)
            times.push_back(time);
    }
    std::printf("%s\t%s\t%.4f\n", window.name().c_str(), kind, median(times));
}

/// Opaque pixels of a decoder's, drawn over all.
void measureVideo(const VgWindow& window, VGImageFormat format, const char* kind, int frames) {
    const VGImage image = vgCreateImage(format, window.width, window.height, VG_IMAGE_QUALITY_NONANTIALIASED);
    std::vector<VGuint> pixels(std::size_t(window.width) * std::size_t(window.height), 0x4080c0ff);
    measure(window, kind, frames, [&](int i) {
        pixels[std::size_t(i)] ^= 0xffff00;
        vgImageSubData(image, pixels.data(), 4 * window.width, format, 0, 0, window.width, window.height);
        vgDrawImage(image);
        window.swap();
    });
    vgDestroyImage(image);
}

void measureWindow(::Display* x, const VgWindow& like, EGLint space, EGLint alphaFormat, int frames) {
    VgWindow window = like;
    const ::Window native = XCreateSimpleWindow(x, DefaultRootWindow(x), 0, 0, unsigned(window.width),
                                                unsigned(window.height), 0, 0, 0);
    XMapWindow(x, native);
    XSync(x, False);
    const EGLint kind[] = {EGL_VG_COLORSPACE, space, EGL_VG_ALPHA_FORMAT, alphaFormat, EGL_NONE};
    window.surface = eglCreateWindowSurface(window.display, window.config, native, kind);
    const EGLContext context = eglCreateContext(window.display, window.config, EGL_NO_CONTEXT, nullptr);
    if (!eglMakeCurrent(window.display, window.surface, window.surface, context))
        std::exit(1);
    eglSwapInterval(window.display, 0);
    measure(window, "swap", frames, [&](int i) {
        drawMark(i);
        window.swap();
    });
    if (window.attribute(EGL_RED_SIZE) == 8) {
        measureVideo(window, VG_sXBGR_8888, "video", frames);
        measureVideo(window, VG_sRGBA_8888, "video with alpha", frames);
    }
    eglMakeCurrent(window.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroySurface(window.display, window.surface);
    eglDestroyContext(window.display, context);
    XDestroyWindow(x, native);
}

}  // namespace

int main(int argc, char** argv) {
    ::Display* const x = XOpenDisplay(nullptr);
    if (!x || argc != 4)
        return 1;
    const EGLDisplay display = eglGetDisplay(reinterpret_cast<EGLNativeDisplayType>(x));
    if (!eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENVG_API))
        return 1;
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             EGL_WINDOW_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENVG_BIT,
                             EGL_COLOR_BUFFER_TYPE,
                             EGL_DONT_CARE,
                             EGL_SAMPLES,
                             0,
                             EGL_NONE};
    EGLConfig configs[64];
    EGLint count = 0;
    eglChooseConfig(display, wanted, configs, 64, &count);
    for (EGLint i = 0; i < count; ++i) {
        const VgWindow window{display, configs[i], EGL_NO_SURFACE, std::atoi(argv[1]), std::atoi(argv[2])};
        if (window.attribute(EGL_SAMPLES) != 0)
            continue;
        for (const EGLint space : {EGL_VG_COLORSPACE_sRGB, EGL_VG_COLORSPACE_LINEAR})
            for (const EGLint alpha : {EGL_VG_ALPHA_FORMAT_NONPRE, EGL_VG_ALPHA_FORMAT_PRE})
                measureWindow(x, window, space, alpha, std::atoi(argv[3]));
    }
    return 0;
}
