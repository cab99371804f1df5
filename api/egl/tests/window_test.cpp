// EGL specification sections 3.5.1, 3.5.4 and 3.10 on an X server: what OpenVG draws is seen.

#include <dlfcn.h>

#include <GLES3/gl3.h>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

/// The few functions of libX11 that a window takes; nothing where there is no libX11 or no server.
struct X11 {
    template <class F>
    F* find(const char* name) const {
        return library ? reinterpret_cast<F*>(dlsym(library, name)) : nullptr;
    }

    void* const library = dlopen("libX11.so.6", RTLD_NOW);
    void* const display = library ? find<void*(const char*)>("XOpenDisplay")(nullptr) : nullptr;

    unsigned long root() const { return find<unsigned long(void*)>("XDefaultRootWindow")(display); }
    void sync() const { find<int(void*, int)>("XSync")(display, 0); }

    unsigned long window(unsigned width, unsigned height) const {
        using Create = unsigned long(void*, unsigned long, int, int, unsigned, unsigned, unsigned,
                                     unsigned long, unsigned long);
        const unsigned long result =
            find<Create>("XCreateSimpleWindow")(display, root(), 0, 0, width, height, 0, 0, 0x123456);
        find<int(void*, unsigned long)>("XMapWindow")(display, result);
        sync();
        return result;
    }
    unsigned long pixmap(unsigned width, unsigned height) const {
        using Create = unsigned long(void*, unsigned long, unsigned, unsigned, unsigned);
        return find<Create>("XCreatePixmap")(display, root(), width, height, 24);
    }
    void resize(unsigned long window, unsigned width, unsigned height) const {
        find<int(void*, unsigned long, unsigned, unsigned)>("XResizeWindow")(display, window, width, height);
        sync();
    }
    void destroy(unsigned long window) const {
        find<int(void*, unsigned long)>("XDestroyWindow")(display, window);
        sync();
    }
    /// Red, green, blue from the highest to the lowest byte; y from the top.
    unsigned long pixel(unsigned long drawable, int x, int y) const {
        sync();
        using Get = void*(void*, unsigned long, int, int, unsigned, unsigned, unsigned long, int);
        void* const image = find<Get>("XGetImage")(display, drawable, x, y, 1, 1, ~0ul, 2);
        return image ? find<unsigned long(void*, int, int)>("XGetPixel")(image, 0, 0) & 0xffffff : 1;
    }
};

constexpr unsigned long red = 0xff0000, green = 0x00ff00, blue = 0x0000ff;

class Windows : public ::testing::Test {
protected:
    void SetUp() override {
        if (!x.display)
            GTEST_SKIP() << "there is no X server";
        display = eglGetDisplay(static_cast<EGLNativeDisplayType>(x.display));
        ASSERT_EGL(eglInitialize(display, nullptr, nullptr));
        ASSERT_EGL(eglBindAPI(EGL_OPENVG_API));
        if (!vg)
            GTEST_SKIP() << "this libOpenVG does not draw";
        c = choose(8, 8, EGL_WINDOW_BIT | EGL_PIXMAP_BIT | EGL_PBUFFER_BIT);
        ctx = eglCreateContext(display, c, EGL_NO_CONTEXT, nullptr);
        ASSERT_NE(ctx, EGL_NO_CONTEXT);
    }
    void TearDown() override {
        if (!x.display)
            return;
        eglReleaseThread();
        eglTerminate(display);
    }

    EGLConfig choose(EGLint redBits, EGLint alphaBits, EGLint surfaces, EGLint luminanceBits = 0) const {
        const EGLint attributes[] = {EGL_RED_SIZE,
                                     redBits,
                                     EGL_ALPHA_SIZE,
                                     alphaBits,
                                     EGL_LUMINANCE_SIZE,
                                     luminanceBits,
                                     EGL_COLOR_BUFFER_TYPE,
                                     luminanceBits ? EGL_LUMINANCE_BUFFER : EGL_RGB_BUFFER,
                                     EGL_SURFACE_TYPE,
                                     surfaces,
                                     EGL_RENDERABLE_TYPE,
                                     EGL_OPENVG_BIT,
                                     EGL_NONE};
        EGLConfig list[8] = {};
        EGLint count = 0;
        EXPECT_TRUE(eglChooseConfig(display, attributes, list, 8, &count));
        for (int i = 0; i < count; ++i) {
            EGLint r = 0, a = 0, l = 0;
            eglGetConfigAttrib(display, list[i], EGL_RED_SIZE, &r);
            eglGetConfigAttrib(display, list[i], EGL_ALPHA_SIZE, &a);
            eglGetConfigAttrib(display, list[i], EGL_LUMINANCE_SIZE, &l);
            if (r == redBits && a == alphaBits && l == luminanceBits)
                return list[i];
        }
        return nullptr;
    }

    EGLint query(EGLSurface surface, EGLint name) const {
        EGLint value = -1;
        EXPECT_TRUE(eglQuerySurface(display, surface, name, &value));
        return value;
    }

    EGLSurface onWindow(unsigned long window) const {
        return eglCreateWindowSurface(display, c, window, nullptr);
    }

    const X11 x;
    const Vg vg;
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLConfig c = nullptr;
    EGLContext ctx = EGL_NO_CONTEXT;
};

TEST_F(Windows, ShowWhatWasDrawnWhenSwapped) {
    const unsigned long window = x.window(60, 40);
    const EGLSurface s = onWindow(window);
    ASSERT_NE(s, EGL_NO_SURFACE) << std::hex << eglGetError();
    EXPECT_EQ(query(s, EGL_WIDTH), 60);
    EXPECT_EQ(query(s, EGL_HEIGHT), 40);
    EXPECT_EQ(query(s, EGL_RENDER_BUFFER), EGL_BACK_BUFFER);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(60, 40, {1, 0, 0, 1});
    vg.fill(20, 10, {0, 1, 0, 1});
    EXPECT_NE(x.pixel(window, 30, 5), red);
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(x.pixel(window, 0, 39), green);
    EXPECT_EQ(x.pixel(window, 19, 30), green);
    EXPECT_EQ(x.pixel(window, 20, 30), red);
    EXPECT_EQ(x.pixel(window, 19, 29), red);
    EXPECT_EQ(x.pixel(window, 59, 0), red);
    // The buffer is preserved.
    EXPECT_EQ(query(s, EGL_SWAP_BEHAVIOR), EGL_BUFFER_PRESERVED);
    vg.fill(5, 5, {0, 0, 1, 1});
    ASSERT_TRUE(eglSwapInterval(display, 0));
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(x.pixel(window, 4, 35), blue);
    EXPECT_EQ(x.pixel(window, 19, 30), green);
}

TEST_F(Windows, AreFollowedWhenResized) {
    const unsigned long window = x.window(60, 40);
    const EGLSurface s = onWindow(window);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(60, 40, {1, 0, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    x.resize(window, 90, 70);
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(query(s, EGL_WIDTH), 90);
    EXPECT_EQ(query(s, EGL_HEIGHT), 70);
    vg.fill(90, 70, {0, 1, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(x.pixel(window, 89, 0), green);
    x.resize(window, 30, 20);
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(query(s, EGL_WIDTH), 30);
    EXPECT_EQ(x.pixel(window, 29, 19), green);
}

TEST_F(Windows, AreFollowedWhenAskedForTheirSize) {
    const unsigned long window = x.window(60, 40);
    const EGLSurface s = onWindow(window);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(60, 40, {1, 0, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    x.resize(window, 90, 70);
    EXPECT_EQ(query(s, EGL_WIDTH), 90);
    EXPECT_EQ(query(s, EGL_HEIGHT), 70);
    // What is drawn now is seen with the next swap, also where there was no window before.
    vg.fill(90, 70, {0, 1, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(x.pixel(window, 89, 0), green);
    // A surface that is not current keeps its pixels and its size.
    ASSERT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    x.resize(window, 30, 20);
    EXPECT_EQ(query(s, EGL_WIDTH), 90);
}

TEST_F(Windows, OfEveryFormatAreShown) {
    struct Case {
        EGLint red, alpha, luminance;
        unsigned long shown;
    };
    // Of red: all of it, or as luminance 0.2126 in linear light, which sRGB encodes as 0.4977.
    for (const Case& k : {Case{8, 0, 0, red}, Case{5, 0, 0, red}, Case{5, 1, 0, red}, Case{4, 4, 0, red},
                          Case{0, 0, 8, 0x7f7f7f}, Case{0, 0, 1, 0x000000}}) {
        const EGLConfig format = choose(k.red, k.alpha, EGL_WINDOW_BIT, k.luminance);
        ASSERT_NE(format, nullptr) << k.red << ' ' << k.alpha << ' ' << k.luminance;
        const unsigned long window = x.window(8, 8);
        const EGLSurface s = eglCreateWindowSurface(display, format, window, nullptr);
        ASSERT_NE(s, EGL_NO_SURFACE) << std::hex << eglGetError();
        ASSERT_EGL(eglMakeCurrent(display, s, s, eglCreateContext(display, format, EGL_NO_CONTEXT, nullptr)));
        vg.fill(8, 8, {1, 0, 0, 1});
        ASSERT_EGL(eglSwapBuffers(display, s));
        EXPECT_EQ(x.pixel(window, 4, 4), k.shown) << k.red << ' ' << k.alpha << ' ' << k.luminance;
    }
}

/// Windows that are named by their number, and by an address, are shown in different ways.
TEST_F(Windows, ShowEveryPixel) {
    constexpr EGLint width = 61, height = 43;
    for (const bool isByNumber : {true, false}) {
        unsigned long window = x.window(width, height);
        const EGLSurface s =
            isByNumber ? onWindow(window) : eglCreatePlatformWindowSurface(display, c, &window, nullptr);
        ASSERT_NE(s, EGL_NO_SURFACE) << std::hex << eglGetError();
        ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
        for (int frame = 0; frame < 3; ++frame) {
            vg.fill(width, height, {0, 0, 0.25f, 1});
            for (int i = 0; i < 20; ++i)
                vg.fill(width - 3 * i, height - 2 * i,
                        {float(i) / 20, float(i * frame % 7) / 7, float(i % 5) / 5, i % 2 ? 0.4f : 1});
            ASSERT_EGL(eglSwapBuffers(display, s));
            int wrong = 0;
            for (EGLint y = 0; y < height; ++y)
                for (EGLint column = 0; column < width; ++column) {
                    VGuint drawn = 0;
                    vg.readPixels(&drawn, 4, VG_sRGBA_8888_PRE, column, y, 1, 1);
                    wrong += x.pixel(window, column, height - 1 - y) != drawn >> 8;
                }
            EXPECT_EQ(wrong, 0) << "frame " << frame << ", by number: " << isByNumber;
        }
    }
}

TEST_F(Windows, KnowTheAgeOfTheirBuffer) {
    const unsigned long window = x.window(20, 10);
    const EGLSurface s = onWindow(window);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    EXPECT_EQ(query(s, EGL_BUFFER_AGE_EXT), 0);
    vg.fill(20, 10, {0, 1, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(query(s, EGL_BUFFER_AGE_EXT), 1);
    x.resize(window, 30, 10);
    EXPECT_EQ(query(s, EGL_WIDTH), 30);
    EXPECT_EQ(query(s, EGL_BUFFER_AGE_EXT), 0);
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(query(s, EGL_BUFFER_AGE_EXT), 1);
}

/// A window that was destroyed is an error, and nothing worse.
TEST_F(Windows, MayBeGone) {
    const unsigned long window = x.window(20, 10), other = x.window(20, 10);
    const EGLSurface s = onWindow(window);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(20, 10, {0, 1, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    x.destroy(window);
    eglSwapBuffers(display, s);
    const EGLSurface t = onWindow(other);
    ASSERT_EGL(eglMakeCurrent(display, t, t, ctx));
    vg.fill(20, 10, {0, 0, 1, 1});
    ASSERT_EGL(eglSwapBuffers(display, t));
    EXPECT_EQ(x.pixel(other, 5, 5), blue);
}

TEST_F(Windows, LeaveTheProgramsOpenGlAlone) {
    const EGLint glAttributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                   EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, 4, EGL_HEIGHT, 4, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    EGLConfig glConfig = nullptr;
    EGLint count = 0;
    ASSERT_EGL(eglChooseConfig(display, glAttributes, &glConfig, 1, &count));
    ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
    const EGLSurface glSurface = eglCreatePbufferSurface(display, glConfig, size);
    const EGLContext glContext = eglCreateContext(display, glConfig, EGL_NO_CONTEXT, version);
    ASSERT_EGL(eglMakeCurrent(display, glSurface, glSurface, glContext));
    function<decltype(::glClearColor)>("glClearColor")(0, 0, 1, 1);
    function<decltype(::glViewport)>("glViewport")(1, 2, 3, 4);

    ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
    const unsigned long window = x.window(10, 10);
    const EGLSurface s = onWindow(window);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(10, 10, {0, 1, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(x.pixel(window, 5, 5), green);

    ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
    EXPECT_EQ(eglGetCurrentContext(), glContext);
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), glSurface);
    GLint viewport[4] = {};
    function<decltype(::glGetIntegerv)>("glGetIntegerv")(GL_VIEWPORT, viewport);
    EXPECT_EQ(viewport[0] * 1000 + viewport[1] * 100 + viewport[2] * 10 + viewport[3], 1234);
    function<decltype(::glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    GLuint pixel = 0;
    function<decltype(::glReadPixels)>("glReadPixels")(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &pixel);
    EXPECT_EQ(pixel, 0xffff0000u);
    EXPECT_EQ(function<decltype(::glGetError)>("glGetError")(), GLenum(GL_NO_ERROR));
}

TEST_F(Windows, AreDrawnIntoByBothApisInTurn) {
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    const unsigned long window = x.window(20, 10);
    const EGLSurface s = onWindow(window);
    ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
    const EGLContext gl = eglCreateContext(display, c, EGL_NO_CONTEXT, version);
    ASSERT_NE(gl, EGL_NO_CONTEXT) << std::hex << eglGetError();
    ASSERT_EGL(eglMakeCurrent(display, s, s, gl));
    function<decltype(::glClearColor)>("glClearColor")(0, 0, 1, 1);
    function<decltype(::glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    ASSERT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(10, 10, {1, 0, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(x.pixel(window, 5, 5), red);
    EXPECT_EQ(x.pixel(window, 15, 5), blue);
    ASSERT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
    ASSERT_EGL(eglMakeCurrent(display, s, s, gl));
    x.resize(window, 30, 12);
    function<decltype(::glClearColor)>("glClearColor")(0, 1, 0, 1);
    function<decltype(::glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(query(s, EGL_WIDTH), 30);
    EXPECT_EQ(x.pixel(window, 5, 5), green);
}

/// Of a config of the system's.
class SystemsWindows : public Windows {
protected:
    void SetUp() override {
        Windows::SetUp();
        if (IsSkipped())
            return;
        const EGLint colours[] = {EGL_RED_SIZE,   8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8,
                                  EGL_ALPHA_SIZE, 8, EGL_NONE};
        EGLint count = 0;
        ASSERT_EGL(eglChooseConfig(display, colours, &config, 1, &count));
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
        ASSERT_NE(context, EGL_NO_CONTEXT) << std::hex << eglGetError();
        window = x.window(10, 10);
    }
    void useVg(EGLSurface s) const {
        ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
        ASSERT_EGL(eglMakeCurrent(display, s, s, context));
    }

    EGLConfig config = nullptr;
    EGLContext context = EGL_NO_CONTEXT;
    unsigned long window = 0;
};

TEST_F(SystemsWindows, AreDrawnInto) {
    for (const bool isPlatforms : {false, true}) {
        SCOPED_TRACE(isPlatforms);
        const EGLSurface s = isPlatforms ? eglCreatePlatformWindowSurface(display, config, &window, nullptr)
                                         : eglCreateWindowSurface(display, config, window, nullptr);
        ASSERT_NE(s, EGL_NO_SURFACE);
        useVg(s);
        vg.fill(10, 10, {0, 1, 0, 1});
        ASSERT_EGL(eglSwapBuffers(display, s));
        EXPECT_EQ(x.pixel(window, 5, 5), green);
        x.resize(window, 20, 15);
        EXPECT_EQ(query(s, EGL_WIDTH), 20);
        vg.fill(20, 15, {0, 0, 1, 1});
        ASSERT_EGL(eglSwapBuffers(display, s));
        EXPECT_EQ(x.pixel(window, 19, 0), blue);
        x.resize(window, 10, 10);
        ASSERT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
        EXPECT_TRUE(eglDestroySurface(display, s));
    }
}

TEST_F(SystemsWindows, KeepWhatIsDrawnWhenMadeCurrentAgain) {
    const EGLSurface s = eglCreateWindowSurface(display, config, window, nullptr);
    useVg(s);
    vg.fill(10, 10, {1, 0, 0, 1});
    useVg(s);
    vg.fill(5, 5, {0, 1, 0, 1});
    useVg(s);
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(x.pixel(window, 7, 2), red);
    EXPECT_EQ(x.pixel(window, 2, 7), green);
}

TEST_F(SystemsWindows, AreOneBufferForBothApis) {
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    const EGLSurface s = eglCreateWindowSurface(display, config, window, nullptr);
    ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
    const EGLContext gl = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    const auto clear = [](float r, float g, float b) {
        function<decltype(::glClearColor)>("glClearColor")(r, g, b, 1);
        function<decltype(::glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    };
    const auto useGl = [&] {
        ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
        ASSERT_EGL(eglMakeCurrent(display, s, s, gl));
    };
    // Neither is released before the other is made current.
    for (int turn = 0; turn < 3; ++turn) {
        useGl();
        clear(0, 0, 1);
        useVg(s);
        vg.fill(5, 10, {1, 0, 0, 1});
        ASSERT_EGL(eglSwapBuffers(display, s));
        EXPECT_EQ(x.pixel(window, 2, 5), red) << turn;
        EXPECT_EQ(x.pixel(window, 7, 5), blue) << turn;
        useVg(s);
        vg.fill(10, 10, {0, 1, 0, 1});
        useGl();
        function<decltype(::glEnable)>("glEnable")(GL_SCISSOR_TEST);
        function<decltype(::glScissor)>("glScissor")(0, 0, 5, 5);
        clear(0, 0, 1);
        function<decltype(::glDisable)>("glDisable")(GL_SCISSOR_TEST);
        ASSERT_EGL(eglSwapBuffers(display, s));
        EXPECT_EQ(x.pixel(window, 2, 7), blue) << turn;
        EXPECT_EQ(x.pixel(window, 7, 2), green) << turn;
    }
}

TEST_F(Windows, ArePlatformWindowsToo) {
    unsigned long window = x.window(10, 10);
    const EGLAttrib attributes[] = {EGL_RENDER_BUFFER, EGL_SINGLE_BUFFER, EGL_VG_COLORSPACE,
                                    EGL_VG_COLORSPACE_LINEAR, EGL_NONE};
    const EGLSurface s = eglCreatePlatformWindowSurface(display, c, &window, attributes);
    ASSERT_NE(s, EGL_NO_SURFACE) << std::hex << eglGetError();
    EXPECT_EQ(query(s, EGL_RENDER_BUFFER), EGL_SINGLE_BUFFER);
    EXPECT_EQ(query(s, EGL_VG_COLORSPACE), EGL_VG_COLORSPACE_LINEAR);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(10, 10, {0, 1, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    EXPECT_EQ(x.pixel(window, 5, 5), green);
}

TEST_F(Windows, HaveOneSurfaceAtATime) {
    const unsigned long window = x.window(10, 10);
    const EGLSurface s = onWindow(window);
    ASSERT_NE(s, EGL_NO_SURFACE);
    EXPECT_EQ(onWindow(window), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ALLOC);
    ASSERT_TRUE(eglDestroySurface(display, s));
    EXPECT_NE(onWindow(window), EGL_NO_SURFACE);
}

TEST_F(Windows, BadAttributesAreErrors) {
    const unsigned long window = x.window(10, 10);
    for (const EGLint name : {EGL_WIDTH, EGL_LARGEST_PBUFFER, EGL_TEXTURE_FORMAT}) {
        const EGLint bad[] = {name, 1, EGL_NONE};
        EXPECT_EQ(eglCreateWindowSurface(display, c, window, bad), EGL_NO_SURFACE);
        EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
    }
    EXPECT_EQ(onWindow(0), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_NATIVE_WINDOW);
}

TEST_F(Windows, MayBeCurrentWhenTheDisplayIsTerminated) {
    const unsigned long window = x.window(10, 10);
    const EGLSurface s = onWindow(window);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(10, 10, {0, 1, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, s));
    ASSERT_TRUE(eglTerminate(display));
    ASSERT_EGL(eglInitialize(display, nullptr, nullptr));
    c = choose(8, 8, EGL_WINDOW_BIT);
    const EGLSurface again = onWindow(window);
    ASSERT_NE(again, EGL_NO_SURFACE) << std::hex << eglGetError();
    const EGLContext newContext = eglCreateContext(display, c, EGL_NO_CONTEXT, nullptr);
    ASSERT_EGL(eglMakeCurrent(display, again, again, newContext));
    vg.fill(10, 10, {1, 0, 0, 1});
    ASSERT_EGL(eglSwapBuffers(display, again));
    EXPECT_EQ(x.pixel(window, 5, 5), red);
}

TEST_F(Windows, PixmapsHaveWhatWasDrawnAfterWaiting) {
    const unsigned long pixmap = x.pixmap(10, 6);
    const EGLSurface s = eglCreatePixmapSurface(display, c, pixmap, nullptr);
    ASSERT_NE(s, EGL_NO_SURFACE) << std::hex << eglGetError();
    EXPECT_EQ(query(s, EGL_RENDER_BUFFER), EGL_SINGLE_BUFFER);
    EXPECT_EQ(query(s, EGL_HEIGHT), 6);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(10, 6, {1, 0, 0, 1});
    vg.fill(10, 1, {0, 0, 1, 1});
    ASSERT_EGL(eglWaitClient());
    EXPECT_EQ(x.pixel(pixmap, 3, 0), red);
    EXPECT_EQ(x.pixel(pixmap, 3, 5), blue);
    vg.fill(10, 6, {0, 1, 0, 1});
    ASSERT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    EXPECT_EQ(x.pixel(pixmap, 3, 0), green);
}

TEST_F(Windows, BuffersAreCopiedToPixmaps) {
    const EGLint size[] = {EGL_WIDTH, 10, EGL_HEIGHT, 6, EGL_NONE};
    const EGLSurface s = eglCreatePbufferSurface(display, c, size);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(10, 6, {1, 0, 0, 1});
    vg.fill(10, 1, {0, 0, 1, 1});
    const unsigned long pixmap = x.pixmap(10, 6);
    ASSERT_EGL(eglCopyBuffers(display, s, pixmap));
    EXPECT_EQ(x.pixel(pixmap, 3, 0), red);
    EXPECT_EQ(x.pixel(pixmap, 3, 5), blue);
    EXPECT_FALSE(eglCopyBuffers(display, s, x.pixmap(3, 3)));
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
}

}  // namespace
}  // namespace vtm::egl::testing
