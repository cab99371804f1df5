// A window of X11 with a context of OpenVG, by EGL. Link with -lEGL -lOpenVG -lX11, EGL being ours.

#include <chrono>
#include <stdexcept>

#include <EGL/egl.h>
#include <VG/openvg.h>
#include <X11/Xlib.h>
#include <X11/keysym.h>

#include "examples/openvg/stage.hpp"

namespace stage {

namespace {

void require(bool condition, const char* what) {
    if (!condition)
        throw std::runtime_error(what);
}

class XWindow : public Stage {
public:
    XWindow(int width, int height, const std::string& title) : x_(XOpenDisplay(nullptr)) {
        require(x_ != nullptr, "no X display: is DISPLAY set?");
        const ::Window root = DefaultRootWindow(x_);
        window_ = XCreateSimpleWindow(x_, root, 0, 0, unsigned(width), unsigned(height), 0, 0, 0);
        closed_ = XInternAtom(x_, "WM_DELETE_WINDOW", False);
        XSetWMProtocols(x_, window_, &closed_, 1);
        XStoreName(x_, window_, title.c_str());
        XSelectInput(x_, window_, KeyPressMask);
        XMapWindow(x_, window_);
        XSync(x_, False);
        createSurface();
    }

    ~XWindow() override {
        eglMakeCurrent(egl_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglTerminate(egl_);
        XCloseDisplay(x_);
    }

    void show(double seconds, const std::function<void(double)>& frame) override {
        const auto start = std::chrono::steady_clock::now();
        while (!isClosed()) {
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
            frame(seconds + passed.count());
            checkErrors();
            require(eglSwapBuffers(egl_, surface_), "eglSwapBuffers failed");
        }
    }

private:
    void createSurface() {
        const EGLint wanted[] = {EGL_RED_SIZE,
                                 8,
                                 EGL_GREEN_SIZE,
                                 8,
                                 EGL_BLUE_SIZE,
                                 8,
                                 EGL_ALPHA_MASK_SIZE,
                                 8,
                                 EGL_RENDERABLE_TYPE,
                                 EGL_OPENVG_BIT,
                                 EGL_SURFACE_TYPE,
                                 EGL_WINDOW_BIT,
                                 EGL_NONE};
        egl_ = eglGetDisplay(x_);
        require(eglInitialize(egl_, nullptr, nullptr), "eglInitialize failed");
        require(eglBindAPI(EGL_OPENVG_API), "this EGL knows no OpenVG");
        EGLConfig config;
        EGLint count = 0;
        require(eglChooseConfig(egl_, wanted, &config, 1, &count) && count == 1,
                "no config for OpenVG in a window");
        surface_ = eglCreateWindowSurface(egl_, config, window_, nullptr);
        const EGLContext context = eglCreateContext(egl_, config, EGL_NO_CONTEXT, nullptr);
        require(eglMakeCurrent(egl_, surface_, surface_, context), "no OpenVG context for the window");
    }

    /// Escape, q, or the window's own button.
    bool isClosed() {
        bool closed = false;
        while (XPending(x_) > 0) {
            XEvent event;
            XNextEvent(x_, &event);
            const KeySym key = event.type == KeyPress ? XLookupKeysym(&event.xkey, 0) : NoSymbol;
            closed |= key == XK_Escape || key == XK_q;
            closed |= event.type == ClientMessage && Atom(event.xclient.data.l[0]) == closed_;
        }
        return closed;
    }

    ::Display* x_;
    ::Window window_;
    Atom closed_;
    EGLDisplay egl_ = EGL_NO_DISPLAY;
    EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace

std::unique_ptr<Stage> openWindow(int width, int height, const std::string& title) {
    return std::make_unique<XWindow>(width, height, title);
}

}  // namespace stage
