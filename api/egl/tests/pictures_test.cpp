// vtm/vg_gl.h: what OpenVG drew on a GPU, sampled by a context of OpenGL ES that shares with the
// compositor's.

#include <functional>
#include <random>

#include <GLES3/gl3.h>

#include <vtm/vg_gl.h>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

constexpr VGint width = 37, height = 23;

using Bytes = std::vector<std::uint8_t>;

/// OpenGL ES's, by which textures are read.
struct Gl {
    decltype(&::glWaitSync) waitSync = function<decltype(::glWaitSync)>("glWaitSync");
    decltype(&::glDeleteSync) deleteSync = function<decltype(::glDeleteSync)>("glDeleteSync");
    decltype(&::glFenceSync) fenceSync = function<decltype(::glFenceSync)>("glFenceSync");
    decltype(&::glGenFramebuffers) genFramebuffers =
        function<decltype(::glGenFramebuffers)>("glGenFramebuffers");
    decltype(&::glBindFramebuffer) bindFramebuffer =
        function<decltype(::glBindFramebuffer)>("glBindFramebuffer");
    decltype(&::glFramebufferTexture2D) framebufferTexture =
        function<decltype(::glFramebufferTexture2D)>("glFramebufferTexture2D");
    decltype(&::glReadPixels) readPixels = function<decltype(::glReadPixels)>("glReadPixels");
    decltype(&::glGetError) getError = function<decltype(::glGetError)>("glGetError");

    /// Of the current context's share group; rows from the bottom.
    Bytes pixelsOf(const VtmGlPicture& picture, VGint w, VGint h) const {
        const auto ready = static_cast<GLsync>(picture.ready);
        waitSync(ready, 0, GL_TIMEOUT_IGNORED);
        deleteSync(ready);
        GLuint framebuffer = 0;
        genFramebuffers(1, &framebuffer);
        bindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        framebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.texture, 0);
        Bytes pixels(std::size_t(w) * std::size_t(h) * 4);
        readPixels(0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        EXPECT_EQ(getError(), GLenum(GL_NO_ERROR));
        vtmReturnGlPicture(fenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
        return pixels;
    }
};

Bytes bytesOf(VtmSurface* surface) {
    const VGint w = vtmSurfaceWidth(surface), h = vtmSurfaceHeight(surface);
    Bytes pixels(std::size_t(w) * std::size_t(h) * 4);
    for (VGint y = 0; y < h; ++y)
        vtmReadSurfacePart(surface, 0, y, w, 1, &pixels[std::size_t(y * w) * 4], std::size_t(w) * 4);
    return pixels;
}

class GlPictures : public EglTest {
protected:
    void SetUp() override {
        if (isAlone())
            GTEST_SKIP() << "there is no system's libEGL";
        EglTest::SetUp();
        vtmPreferGlDisplay(display);
        VtmGlContext its{};
        if (!vtmGetGlContext(&its))
            GTEST_SKIP() << vtmGetCompositorFault();
        ASSERT_EQ(its.display, display);
        ASSERT_EGL(eglBindAPI(EGL_OPENGL_ES_API));
        const std::vector<EGLConfig> configs =
            choose({EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT});
        ASSERT_FALSE(configs.empty());
        const EGLContext sharing = eglCreateContext(display, configs[0], its.context, its.attributes);
        if (sharing == EGL_NO_CONTEXT && eglGetError() == EGL_BAD_CONTEXT)
            GTEST_SKIP() << "another test of this process has terminated the compositor's display";
        ASSERT_NE(sharing, EGL_NO_CONTEXT) << std::hex << eglGetError();
        ASSERT_EGL(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, sharing));
        gl = Gl();
        vgContext = vtmCreateContext(nullptr);
    }
    void TearDown() override {
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroyContext(vgContext);
        if (!isAlone())
            EglTest::TearDown();
    }

    /// Rectangles of random colours, some translucent.
    void drawSomething(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<VGfloat> channel(0, 1);
        for (int i = 0; i < 60; ++i) {
            const VGfloat color[4] = {channel(random), channel(random), channel(random),
                                      i % 3 ? channel(random) : 1};
            vgSetfv(VG_CLEAR_COLOR, 4, color);
            vgClear(VGint(random() % width), VGint(random() % height), 1 + VGint(random() % 12),
                    1 + VGint(random() % 9));
        }
        ASSERT_EQ(vgGetError(), VG_NO_ERROR);
    }

    /// One that the GPU draws on, current meanwhile.
    void withSurface(const VtmSurfaceFormat& format, const std::function<void(VtmSurface*)>& test) {
        VtmSurface* const surface = vtmCreateSurface(width, height, &format);
        ASSERT_NE(surface, nullptr);
        ASSERT_EQ(vtmChooseCompositor(surface, VTM_COMPOSITOR_GL), VTM_COMPOSITOR_GL);
        ASSERT_TRUE(vtmMakeCurrent(vgContext, surface));
        test(surface);
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroySurface(surface);
    }

    void expectSame(VtmSurface* surface) {
        VtmGlPicture picture{};
        ASSERT_TRUE(vtmTakeGlPicture(surface, &picture));
        EXPECT_EQ(gl.pixelsOf(picture, vtmSurfaceWidth(surface), vtmSurfaceHeight(surface)),
                  bytesOf(surface));
    }

    Gl gl;
    VtmContext* vgContext = nullptr;
};

TEST_F(GlPictures, HaveTheBytesOfEveryFormat) {
    constexpr VGint sizes[][5] = {{8, 8, 8, 8, 0}, {8, 8, 8, 0, 0}, {5, 6, 5, 0, 0}, {5, 5, 5, 1, 0},
                                  {4, 4, 4, 4, 0}, {0, 0, 0, 8, 0}, {0, 0, 0, 0, 8}, {0, 0, 0, 0, 1}};
    for (const auto& s : sizes)
        for (const VGboolean isLinear : {VG_FALSE, VG_TRUE})
            for (const VGboolean isPremultiplied : {VG_FALSE, VG_TRUE}) {
                SCOPED_TRACE(::testing::Message() << s[0] << s[1] << s[2] << s[3] << s[4] << ' '
                                                  << int(isLinear) << int(isPremultiplied));
                const VtmSurfaceFormat format{s[0], s[1], s[2], s[3], s[4], 0, isLinear, isPremultiplied};
                withSurface(format, [&](VtmSurface* surface) {
                    drawSomething(unsigned(s[1] * 4 + isLinear * 2 + isPremultiplied));
                    expectSame(surface);
                });
            }
}

TEST_F(GlPictures, FollowWhatIsDrawnAndTheSize) {
    withSurface({8, 8, 8, 8, 0, 0, VG_FALSE, VG_FALSE}, [&](VtmSurface* surface) {
        expectSame(surface);
        for (unsigned frame = 0; frame < 5; ++frame) {
            drawSomething(frame);
            expectSame(surface);
            expectSame(surface);
        }
        // What is in memory only is brought to the GPU.
        const Bytes pixels(std::size_t(width) * height * 4, 77);
        vtmWriteSurface(surface, pixels.data(), std::size_t(width) * 4);
        expectSame(surface);
        ASSERT_TRUE(vtmResizeSurface(surface, 2 * width, height / 2));
        expectSame(surface);
        drawSomething(9);
        expectSame(surface);
    });
}

TEST_F(GlPictures, AreNotGivenOfSurfacesThatTheCpuDraws) {
    const VtmSurfaceFormat format{8, 8, 8, 8, 0, 0, VG_FALSE, VG_FALSE};
    VtmSurface* const surface = vtmCreateSurface(width, height, &format);
    vtmChooseCompositor(surface, VTM_COMPOSITOR_CPU);
    VtmGlPicture picture{};
    EXPECT_FALSE(vtmTakeGlPicture(surface, &picture));
    vtmReturnGlPicture(nullptr);
    vtmDestroySurface(surface);
}

}  // namespace
}  // namespace vtm::egl::testing
