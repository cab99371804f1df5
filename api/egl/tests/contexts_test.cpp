// EGL specification section 3.7, and how contexts of OpenVG and of OpenGL ES live beside each other.

#include <thread>

#include <GLES3/gl3.h>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

class Contexts : public ContextTest {
protected:
    EGLint queryContext(EGLContext handle, EGLint name) const {
        EGLint result = -12345;
        EXPECT_TRUE(eglQueryContext(display, handle, name, &result));
        return result;
    }
};

TEST_F(Contexts, AreCurrentUntilTheyAreNot) {
    EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
    EXPECT_EQ(eglGetCurrentDisplay(), EGL_NO_DISPLAY);
    EXPECT_EQ(queryContext(ctx, EGL_RENDER_BUFFER), EGL_NONE);
    ASSERT_EGL(makeCurrent(surface, ctx));
    EXPECT_EQ(eglGetCurrentContext(), ctx);
    EXPECT_EQ(eglGetCurrentDisplay(), display);
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), surface);
    EXPECT_EQ(eglGetCurrentSurface(EGL_READ), surface);
    EXPECT_EQ(eglGetCurrentSurface(EGL_WIDTH), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_EQ(queryContext(ctx, EGL_RENDER_BUFFER), EGL_BACK_BUFFER);
    EXPECT_EQ(queryContext(ctx, EGL_CONFIG_ID), value(c, EGL_CONFIG_ID));
    EXPECT_EQ(queryContext(ctx, EGL_CONTEXT_CLIENT_TYPE), EGL_OPENVG_API);
    EXPECT_TRUE(makeCurrent(EGL_NO_SURFACE, EGL_NO_CONTEXT));
    EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
    EXPECT_EQ(vtmGetCurrentContext(), nullptr);
}

TEST_F(Contexts, NeedMatchingSurfaces) {
    const EGLSurface other = pbuffer(c);
    EXPECT_FALSE(eglMakeCurrent(display, surface, other, ctx));
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_FALSE(eglMakeCurrent(display, surface, EGL_NO_SURFACE, ctx));
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_FALSE(makeCurrent(EGL_NO_SURFACE, ctx));
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_FALSE(makeCurrent(surface, EGL_NO_CONTEXT));
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_FALSE(makeCurrent(pbuffer(config(5, 6, 5, 0)), ctx));
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_FALSE(makeCurrent(this, ctx));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    EXPECT_FALSE(makeCurrent(surface, this));
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
    // A failure changes nothing.
    ASSERT_EGL(makeCurrent(surface, ctx));
    EXPECT_FALSE(makeCurrent(this, ctx));
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), surface);
}

TEST_F(Contexts, WithoutAConfigFitEverySurface) {
    const EGLContext any = context(EGL_NO_CONFIG_KHR);
    ASSERT_NE(any, EGL_NO_CONTEXT);
    EXPECT_TRUE(makeCurrent(surface, any));
    EXPECT_TRUE(makeCurrent(pbuffer(config(5, 6, 5, 0)), any));
}

TEST_F(Contexts, AndSurfacesAreOfOneThreadAtATime) {
    ASSERT_EGL(makeCurrent(surface, ctx));
    std::thread([&] {
        eglBindAPI(EGL_OPENVG_API);
        EXPECT_FALSE(makeCurrent(pbuffer(c), ctx));
        EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
        EXPECT_FALSE(makeCurrent(surface, context(c)));
        EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
        EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
    }).join();
    ASSERT_TRUE(makeCurrent(EGL_NO_SURFACE, EGL_NO_CONTEXT));
    std::thread([&] {
        EXPECT_TRUE(makeCurrent(surface, ctx));
        // And never lets go of them by itself.
    }).join();
    EXPECT_TRUE(makeCurrent(surface, ctx));
}

TEST_F(Contexts, ShareObjects) {
    const Vg vg;
    if (!vg)
        GTEST_SKIP() << "this libOpenVG does not draw";
    ASSERT_EGL(makeCurrent(surface, ctx));
    const VGImage image = vg.createImage(VG_sRGBA_8888, 2, 2, VG_IMAGE_QUALITY_NONANTIALIASED);
    ASSERT_EGL(makeCurrent(surface, context(c, ctx)));
    VGuint pixel = 1;
    vg.getImageSubData(image, &pixel, 4, VG_sRGBA_8888, 0, 0, 1, 1);
    EXPECT_EQ(pixel, 0u);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
    ASSERT_EGL(makeCurrent(surface, context(c)));
    vg.getImageSubData(image, &pixel, 4, VG_sRGBA_8888, 0, 0, 1, 1);
    EXPECT_EQ(vgGetError(), VG_BAD_HANDLE_ERROR);
}

TEST_F(Contexts, AreNotMadeOfWhatDoesNotFit) {
    EXPECT_EQ(context(this), EGL_NO_CONTEXT);
    EXPECT_EGL_ERROR(EGL_BAD_CONFIG);
    EXPECT_EQ(context(c, this), EGL_NO_CONTEXT);
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
    const EGLint attributes[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    EXPECT_EQ(eglCreateContext(display, c, EGL_NO_CONTEXT, attributes), EGL_NO_CONTEXT);
    EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
    EXPECT_FALSE(eglQueryContext(display, ctx, EGL_CONFIG_ID, nullptr));
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EGLint unchanged = 3;
    EXPECT_FALSE(eglQueryContext(display, ctx, EGL_WIDTH, &unchanged));
    EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
    EXPECT_EQ(unchanged, 3);
}

TEST_F(Contexts, HaveNoFences) {
    ASSERT_EGL(makeCurrent(surface, ctx));
    EXPECT_EQ(eglCreateSync(display, EGL_SYNC_FENCE, nullptr), EGL_NO_SYNC);
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
}

class Both : public Contexts {
protected:
    void SetUp() override {
        Contexts::SetUp();
        if (isAlone())
            GTEST_SKIP() << "there is no OpenGL ES";
        const auto configs = choose({EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_SURFACE_TYPE,
                                     EGL_PBUFFER_BIT, EGL_RED_SIZE, 8, EGL_ALPHA_SIZE, 8});
        ASSERT_FALSE(configs.empty());
        glConfig = configs[0];
        ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
        glSurface = pbuffer(glConfig);
        glContext = createGl(glConfig);
        ASSERT_NE(glContext, EGL_NO_CONTEXT);
    }

    EGLContext createGl(EGLConfig of, EGLContext share = EGL_NO_CONTEXT) const {
        const EGLint attributes[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
        return eglCreateContext(display, of, share, attributes);
    }

    EGLConfig glConfig = nullptr;
    EGLSurface glSurface = EGL_NO_SURFACE;
    EGLContext glContext = EGL_NO_CONTEXT;
};

TEST_F(Both, AreCurrentAtOnce) {
    ASSERT_EGL(makeCurrent(glSurface, glContext));
    EXPECT_EQ(eglGetCurrentContext(), glContext);
    ASSERT_EGL(makeCurrent(surface, ctx));
    // The API decides, not what was made current last.
    EXPECT_EQ(eglGetCurrentContext(), glContext);
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), glSurface);
    ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
    EXPECT_EQ(eglGetCurrentContext(), ctx);
    EXPECT_EQ(eglGetCurrentSurface(EGL_READ), surface);

    function<decltype(::glClearColor)>("glClearColor")(0, 1, 0, 1);
    function<decltype(::glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    GLuint pixel = 0;
    function<decltype(::glReadPixels)>("glReadPixels")(3, 3, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &pixel);
    EXPECT_EQ(pixel, 0xff00ff00u);
    if (const Vg vg; vg) {
        vg.fill(16, 8, {1, 0, 0, 1});
        EXPECT_EQ(vg.pixel(3, 3), 0xff0000ffu);
    }

    EXPECT_TRUE(makeCurrent(EGL_NO_SURFACE, EGL_NO_CONTEXT));
    EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
    ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
    EXPECT_EQ(eglGetCurrentContext(), glContext);
    EXPECT_TRUE(eglWaitGL());
    ASSERT_TRUE(eglReleaseThread());
    EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
}

TEST_F(Both, AreNotMixedUp) {
    EXPECT_EQ(createGl(glConfig, ctx), EGL_NO_CONTEXT);
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
    EXPECT_FALSE(makeCurrent(pbuffer(config(0, 0, 0, 8)), glContext));
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_EQ(createGl(config(0, 0, 0, 0, 8)), EGL_NO_CONTEXT);
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
    EXPECT_EQ(context(c, glContext), EGL_NO_CONTEXT);
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
}

/// A config for both, as programs ask for it that draw with one of the two, or with one after the other.
class OneSurface : public Both {
protected:
    void SetUp() override {
        Both::SetUp();
        if (IsSkipped())
            return;
        const auto configs = choose({EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT | EGL_OPENVG_BIT,
                                     EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8,
                                     EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8, EGL_DEPTH_SIZE, 16});
        ASSERT_EQ(configs.size(), 1u);
        one = pbuffer(configs[0]);
        gl = createGl(configs[0]);
        ASSERT_NE(gl, EGL_NO_CONTEXT) << std::hex << eglGetError();
        eglBindAPI(EGL_OPENVG_API);
        ours = context(configs[0]);
        ASSERT_NE(ours, EGL_NO_CONTEXT);
        eglBindAPI(EGL_OPENGL_ES_API);
    }

    /// Lets go of what is current for one API, and takes it for the other.
    void change(EGLenum from, EGLenum to) const {
        eglBindAPI(from);
        ASSERT_EGL(makeCurrent(EGL_NO_SURFACE, EGL_NO_CONTEXT));
        eglBindAPI(to);
        ASSERT_EGL(makeCurrent(one, to == EGL_OPENVG_API ? ours : gl));
    }

    static void fillGl(float r, float g, float b, float a) {
        function<decltype(::glClearColor)>("glClearColor")(r, g, b, a);
        function<decltype(::glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    }
    static GLuint glPixel(GLint x, GLint y) {
        GLuint pixel = 0;
        function<decltype(::glReadPixels)>("glReadPixels")(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &pixel);
        return pixel;
    }

    EGLSurface one = EGL_NO_SURFACE;
    EGLContext gl = EGL_NO_CONTEXT, ours = EGL_NO_CONTEXT;
};

TEST_F(OneSurface, IsDrawnIntoByOpenGl) {
    ASSERT_EGL(makeCurrent(one, gl));
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), one);
    EXPECT_EQ(eglGetCurrentSurface(EGL_READ), one);
    fillGl(1, 0, 0, 1);
    EXPECT_EQ(glPixel(2, 2), 0xff0000ffu);
    EXPECT_EGL_ERROR(EGL_SUCCESS);
    EXPECT_TRUE(eglSwapBuffers(display, one));
    EXPECT_EQ(query(one, EGL_WIDTH), 16);
    ASSERT_TRUE(eglDestroySurface(display, one));
    EXPECT_EQ(glPixel(2, 2), 0xff0000ffu);
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), one);
    EXPECT_TRUE(makeCurrent(EGL_NO_SURFACE, EGL_NO_CONTEXT));
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), EGL_NO_SURFACE);
}

TEST_F(OneSurface, IsOfOneContextAtATime) {
    ASSERT_EGL(makeCurrent(one, gl));
    eglBindAPI(EGL_OPENVG_API);
    EXPECT_FALSE(makeCurrent(one, ours));
    EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
    change(EGL_OPENGL_ES_API, EGL_OPENVG_API);
    EXPECT_FALSE(makeCurrent(one, gl));
    EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
    EXPECT_EQ(eglGetCurrentContext(), ours);
}

TEST_F(OneSurface, KeepsWhatTheOtherDrew) {
    const Vg vg;
    if (!vg)
        GTEST_SKIP() << "this libOpenVG does not draw";
    ASSERT_EGL(makeCurrent(one, gl));
    fillGl(1, 0, 0, 1);
    change(EGL_OPENGL_ES_API, EGL_OPENVG_API);
    EXPECT_EQ(vg.pixel(15, 7), 0xff0000ffu);
    vg.fill(4, 2, {0, 1, 0, 1});
    change(EGL_OPENVG_API, EGL_OPENGL_ES_API);
    EXPECT_EQ(glPixel(3, 1), 0xff00ff00u);
    EXPECT_EQ(glPixel(4, 1), 0xff0000ffu);
    EXPECT_EQ(glPixel(3, 2), 0xff0000ffu);
}

// Programs that ask for colours alone get the system's configs, and may draw with OpenVG all the same.
TEST_F(Both, OpenVgDrawsOnSurfacesOfTheSystem) {
    const Vg vg;
    if (!vg)
        GTEST_SKIP() << "this libOpenVG does not draw";
    ASSERT_EGL(makeCurrent(glSurface, glContext));
    function<decltype(::glClearColor)>("glClearColor")(0, 1, 0, 1);
    function<decltype(::glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    ASSERT_TRUE(makeCurrent(EGL_NO_SURFACE, EGL_NO_CONTEXT));
    ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
    const EGLContext ours = context(glConfig);
    ASSERT_NE(ours, EGL_NO_CONTEXT) << std::hex << eglGetError();
    ASSERT_EGL(makeCurrent(glSurface, ours));
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), glSurface);
    EXPECT_EQ(vg.pixel(3, 3), 0x00ff00ffu);
    vg.fill(4, 4, {1, 0, 0, 1});
    EXPECT_EQ(vg.pixel(3, 3), 0xff0000ffu);
    EXPECT_TRUE(eglSwapBuffers(display, glSurface));
    ASSERT_TRUE(makeCurrent(EGL_NO_SURFACE, EGL_NO_CONTEXT));
    ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
    ASSERT_EGL(makeCurrent(glSurface, glContext));
    GLuint pixels[2] = {};
    function<decltype(::glReadPixels)>("glReadPixels")(3, 3, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    EXPECT_EQ(pixels[0], 0xff0000ffu);
    EXPECT_EQ(pixels[1], 0xff00ff00u);
    EXPECT_TRUE(eglDestroySurface(display, glSurface));
    ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
    EXPECT_FALSE(makeCurrent(this, ours));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
}

TEST_F(Both, ErrorsAreMergedInOrder) {
    // The system's error, then a success of ours, and the other way round.
    EXPECT_FALSE(eglDestroyContext(display, EGL_NO_CONTEXT));
    EXPECT_EQ(query(surface, EGL_WIDTH), 16);
    EXPECT_EGL_ERROR(EGL_SUCCESS);
    EXPECT_FALSE(eglSwapBuffers(display, surface));
    EXPECT_EQ(query(glSurface, EGL_WIDTH), 16);
    EXPECT_EGL_ERROR(EGL_SUCCESS);
    EXPECT_FALSE(eglSwapBuffers(display, surface));
    EXPECT_FALSE(eglDestroyContext(display, EGL_NO_CONTEXT));
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
}

}  // namespace
}  // namespace vtm::egl::testing
