// EGLImages of textures and renderbuffers as images of OpenVG: VG_KHR_EGL_image.

#include <array>
#include <cstdint>
#include <thread>

#include <GLES3/gl31.h>

#include <VG/vgext.h>
#include <vtm/egl.h>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

/// Of OpenGL ES.
#define GL(name) function<decltype(::gl##name)>("gl" #name)

constexpr VGuint red = 0xff0000ff, green = 0x00ff00ff, blue = 0x0000ffff;

/// By both compositors.
class EglTextures : public WithGl<ContextTest>, public ::testing::WithParamInterface<EGLint> {
protected:
    void SetUp() override {
        WithGl::SetUp();
        if (IsSkipped())
            return;
        const auto drawn = choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                   EGL_ALPHA_SIZE, 8, EGL_RED_SIZE, 8, EGL_COMPOSITOR_VTM, GetParam()});
        ASSERT_FALSE(drawn.empty());
        eglBindAPI(EGL_OPENVG_API);
        surface = pbuffer(drawn.front());
        // Both are current, as is legal.
        useVg();
        useGl();
    }

    /// Bound, of texels that count from 1 on: of `width` x `height` in the given format.
    GLuint texture(GLenum format, GLsizei width, GLsizei height) const {
        GLuint name = 0;
        GL(GenTextures)(1, &name);
        GL(BindTexture)(GL_TEXTURE_2D, name);
        std::vector<GLubyte> bytes(std::size_t(width) * std::size_t(height) * 4);
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = GLubyte(i + 1);
        GL(PixelStorei)(GL_UNPACK_ALIGNMENT, 1);
        GL(TexImage2D)
        (GL_TEXTURE_2D, 0, GLint(format), width, height, 0, format, GL_UNSIGNED_BYTE, bytes.data());
        return name;
    }
    EGLImage imageOf(GLuint name, EGLenum target = EGL_GL_TEXTURE_2D,
                     const EGLAttrib* attributes = nullptr) const {
        const EGLImage made =
            eglCreateImage(display, gl, target, EGLClientBuffer(std::uintptr_t(name)), attributes);
        EXPECT_NE(made, EGL_NO_IMAGE) << std::hex << eglGetError();
        return made;
    }
    /// The bound texture is what OpenGL draws into.
    void drawInto(GLuint name) const {
        GLuint framebuffer = 0;
        GL(GenFramebuffers)(1, &framebuffer);
        GL(BindFramebuffer)(GL_FRAMEBUFFER, framebuffer);
        GL(FramebufferTexture2D)(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, name, 0);
        ASSERT_EQ(GL(CheckFramebufferStatus)(GL_FRAMEBUFFER), GLenum(GL_FRAMEBUFFER_COMPLETE));
    }
    static void glFill(VGuint color) {
        GL(ClearColor)
        (float(color >> 24) / 255, float(color >> 16 & 255) / 255, float(color >> 8 & 255) / 255,
         float(color & 255) / 255);
        GL(Clear)(GL_COLOR_BUFFER_BIT);
    }

    VGuint texel(VGImage of, VGint x, VGint y) const {
        VGuint pixel = 0;
        vg.getImageSubData(of, &pixel, 4, VG_sRGBA_8888, x, y, 1, 1);
        return pixel;
    }
    /// As drawing shows it, opaque.
    VGuint drawn(VGImage of) const {
        const VGfloat black[] = {0, 0, 0, 1};
        vg.fill(16, 8, black);
        drawImage(of);
        return vg.pixel(0, 0);
    }
    void set(VGImage of, VGint x, VGint y, VGuint pixel) const {
        imageSubData(of, &pixel, 4, VG_sRGBA_8888, x, y, 1, 1);
    }
    void expectNoError() const {
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        EXPECT_EQ(GL(GetError)(), GLenum(GL_NO_ERROR));
    }
    void expectIllegal(EGLImage made, VGErrorCode error) const {
        EXPECT_EQ(createTarget(made), VG_INVALID_HANDLE);
        EXPECT_EQ(vgGetError(), error);
    }

    const Vg vg;
    decltype(&::vgCreateEGLImageTargetKHR) createTarget =
        function<decltype(::vgCreateEGLImageTargetKHR)>("vgCreateEGLImageTargetKHR");
    decltype(&::vgImageSubData) imageSubData = function<decltype(::vgImageSubData)>("vgImageSubData");
    decltype(&::vgDrawImage) drawImage = function<decltype(::vgDrawImage)>("vgDrawImage");
    decltype(&::vgGetParameteri) parameter = function<decltype(::vgGetParameteri)>("vgGetParameteri");
    decltype(&::vgFinish) finish = function<decltype(::vgFinish)>("vgFinish");
    decltype(&::vgGetPixels) getPixels = function<decltype(::vgGetPixels)>("vgGetPixels");
};

TEST_P(EglTextures, AreImages) {
    const EGLImage made = imageOf(texture(GL_RGBA, 3, 2));
    const VGImage image = createTarget(made);
    ASSERT_NE(image, VG_INVALID_HANDLE) << std::hex << vgGetError();
    EXPECT_EQ(parameter(image, VG_IMAGE_WIDTH), 3);
    EXPECT_EQ(parameter(image, VG_IMAGE_HEIGHT), 2);
    EXPECT_EQ(parameter(image, VG_IMAGE_FORMAT), VG_sABGR_8888);
    EXPECT_EQ(texel(image, 0, 0), 0x01020304u);
    EXPECT_EQ(texel(image, 2, 0), 0x090a0b0cu);
    EXPECT_EQ(texel(image, 0, 1), 0x0d0e0f10u);
    // The same again is a sibling.
    const VGImage other = createTarget(made);
    EXPECT_NE(other, image);
    set(other, 1, 1, 0x55667788);
    EXPECT_EQ(texel(image, 1, 1), 0x55667788u);
    EXPECT_TRUE(eglDestroyImage(display, made));
    expectIllegal(made, VG_ILLEGAL_ARGUMENT_ERROR);
    vg.destroyImage(image);
    EXPECT_EQ(texel(other, 1, 1), 0x55667788u);
    expectNoError();
}

TEST_P(EglTextures, ShowWhatOpenGlDraws) {
    const GLuint name = texture(GL_RGBA, 2, 2);
    drawInto(name);
    const VGImage image = createTarget(imageOf(name));
    glFill(red);
    EXPECT_TRUE(eglWaitClient());
    EXPECT_EQ(drawn(image), red);
    EXPECT_EQ(texel(image, 1, 1), red);
    glFill(green);
    useVg();
    EXPECT_EQ(drawn(image), green);
    useGl();
    glFill(blue);
    EXPECT_TRUE(eglWaitGL());
    EXPECT_EQ(texel(image, 0, 0), blue);
    EXPECT_EQ(drawn(image), blue);
    // With no context of OpenGL current any more.
    glFill(red);
    ASSERT_EGL(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    useVg();
    EXPECT_EQ(drawn(image), red);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_P(EglTextures, GetWhatOpenVgChanges) {
    const GLuint name = texture(GL_RGBA, 2, 2);
    drawInto(name);
    const VGImage image = createTarget(imageOf(name));
    set(image, 1, 0, 0x55667788);
    finish();
    EXPECT_EQ(glTexel(1, 0), 0x55667788u);
    EXPECT_EQ(glTexel(0, 0), 0x01020304u);
    set(image, 0, 1, red);
    useGl();
    EXPECT_EQ(glTexel(0, 1), red);
    EXPECT_EQ(glTexel(1, 0), 0x55667788u);
    // Drawn by OpenVG, and into the texture on a GPU.
    const VGfloat opaqueGreen[] = {0, 1, 0, 1};
    vg.fill(16, 8, opaqueGreen);
    getPixels(image, 1, 0, 0, 0, 1, 2);
    EXPECT_TRUE(eglWaitClient());
    EXPECT_EQ(glTexel(1, 0), green);
    EXPECT_EQ(glTexel(1, 1), green);
    EXPECT_EQ(glTexel(0, 1), red);
    expectNoError();
}

TEST_P(EglTextures, TakeTurnsFrameByFrame) {
    const GLuint name = texture(GL_RGBA, 2, 2);
    drawInto(name);
    const VGImage image = createTarget(imageOf(name));
    for (VGuint i = 1; i < 20; ++i) {
        const VGuint fromGl = i << 24 | 0xff, fromVg = i << 16 | 0xff;
        useGl();
        glFill(fromGl);
        useVg();
        EXPECT_EQ(drawn(image), fromGl);
        set(image, 0, 0, fromVg);
        EXPECT_EQ(drawn(image), fromVg);
        useGl();
        EXPECT_EQ(glTexel(0, 0), fromVg);
        EXPECT_EQ(glTexel(1, 1), fromGl);
    }
    expectNoError();
}

TEST_P(EglTextures, OutliveTextureAndEglImage) {
    const GLuint name = texture(GL_RGBA, 2, 2);
    const EGLImage made = imageOf(name);
    const VGImage image = createTarget(made);
    EXPECT_TRUE(eglDestroyImage(display, made));
    GL(DeleteTextures)(1, &name);
    useVg();
    EXPECT_EQ(texel(image, 1, 1), 0x0d0e0f10u);
    set(image, 0, 0, red);
    finish();
    EXPECT_EQ(drawn(image), red);
    expectNoError();
}

TEST_P(EglTextures, WithoutAlphaAreOpaque) {
    const GLuint name = texture(GL_RGB, 3, 1);
    drawInto(name);
    const VGImage image = createTarget(imageOf(name));
    ASSERT_NE(image, VG_INVALID_HANDLE) << std::hex << vgGetError();
    EXPECT_EQ(parameter(image, VG_IMAGE_FORMAT), VG_sXBGR_8888);
    EXPECT_EQ(drawn(image), 0x010203ffu);
    EXPECT_EQ(texel(image, 2, 0), 0x070809ffu);
    set(image, 1, 0, 0x55667788);
    finish();
    EXPECT_EQ(glTexel(1, 0), 0x556677ffu);
    EXPECT_EQ(glTexel(2, 0), 0x070809ffu);
    glFill(green);
    useVg();
    EXPECT_EQ(drawn(image), green);
    expectNoError();
}

TEST_P(EglTextures, RenderbuffersAreImages) {
    GLuint name = 0, framebuffer = 0;
    GL(GenRenderbuffers)(1, &name);
    GL(BindRenderbuffer)(GL_RENDERBUFFER, name);
    GL(RenderbufferStorage)(GL_RENDERBUFFER, GL_RGBA8, 5, 4);
    GL(GenFramebuffers)(1, &framebuffer);
    GL(BindFramebuffer)(GL_FRAMEBUFFER, framebuffer);
    GL(FramebufferRenderbuffer)(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, name);
    glFill(blue);
    const VGImage image = createTarget(imageOf(name, EGL_GL_RENDERBUFFER));
    ASSERT_NE(image, VG_INVALID_HANDLE) << std::hex << vgGetError();
    EXPECT_EQ(parameter(image, VG_IMAGE_WIDTH), 5);
    useVg();
    EXPECT_EQ(texel(image, 4, 3), blue);
    glFill(green);
    eglWaitClient();
    EXPECT_EQ(drawn(image), green);
}

TEST_P(EglTextures, OfALevelHaveItsSize) {
    const GLuint name = texture(GL_RGBA, 4, 2);
    const std::array<GLubyte, 8> next{9, 8, 7, 6, 5, 4, 3, 2};
    const std::array<GLubyte, 4> last{1, 2, 3, 4};
    GL(TexImage2D)(GL_TEXTURE_2D, 1, GL_RGBA, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, next.data());
    GL(TexImage2D)(GL_TEXTURE_2D, 2, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, last.data());
    const EGLAttrib level[] = {EGL_GL_TEXTURE_LEVEL, 1, EGL_NONE};
    const VGImage image = createTarget(imageOf(name, EGL_GL_TEXTURE_2D, level));
    ASSERT_NE(image, VG_INVALID_HANDLE) << std::hex << vgGetError();
    EXPECT_EQ(parameter(image, VG_IMAGE_WIDTH), 2);
    EXPECT_EQ(parameter(image, VG_IMAGE_HEIGHT), 1);
    EXPECT_EQ(texel(image, 1, 0), 0x05040302u);
}

TEST_P(EglTextures, NeedColoursOfEightBitsOrLess) {
    struct Format {
        GLint internal;
        GLenum format, type;
    };
    for (const Format& f : {Format{GL_R32F, GL_RED, GL_FLOAT},
                            {GL_RGBA16F, GL_RGBA, GL_FLOAT},
                            {GL_R8, GL_RED, GL_UNSIGNED_BYTE},
                            {GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE},
                            {GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV},
                            {GL_ALPHA, GL_ALPHA, GL_UNSIGNED_BYTE}}) {
        SCOPED_TRACE(f.internal);
        GLuint name = 0;
        GL(GenTextures)(1, &name);
        GL(BindTexture)(GL_TEXTURE_2D, name);
        GL(TexImage2D)(GL_TEXTURE_2D, 0, f.internal, 2, 2, 0, f.format, f.type, nullptr);
        ASSERT_EQ(GL(GetError)(), GLenum(GL_NO_ERROR));
        const EGLImage made =
            eglCreateImage(display, gl, EGL_GL_TEXTURE_2D, EGLClientBuffer(std::uintptr_t(name)), nullptr);
        if (made != EGL_NO_IMAGE)
            expectIllegal(made, VG_UNSUPPORTED_IMAGE_FORMAT_ERROR);
        // What goes wrong in our contexts is not the program's.
        EXPECT_EQ(GL(GetError)(), GLenum(GL_NO_ERROR));
    }
    const GLuint name = texture(GL_RGBA, 2, 2);
    EXPECT_NE(createTarget(imageOf(name)), VG_INVALID_HANDLE);
}

TEST_P(EglTextures, TakeWhatTheirFormatCanHold) {
    GLuint name = 0;
    GL(GenTextures)(1, &name);
    GL(BindTexture)(GL_TEXTURE_2D, name);
    GL(TexImage2D)(GL_TEXTURE_2D, 0, GL_RGB565, 2, 1, 0, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, nullptr);
    drawInto(name);
    const VGImage image = createTarget(imageOf(name));
    ASSERT_NE(image, VG_INVALID_HANDLE) << std::hex << vgGetError();
    set(image, 0, 0, 0xff8001ff);
    finish();
    EXPECT_EQ(glTexel(0, 0), 0xff8200ffu);
    eglWaitClient();
    EXPECT_EQ(texel(image, 0, 0), 0xff8200ffu);
    expectNoError();
}

TEST_P(EglTextures, KeepValuesOfSrgbTextures) {
    GLuint name = 0;
    GL(GenTextures)(1, &name);
    GL(BindTexture)(GL_TEXTURE_2D, name);
    const std::array<GLubyte, 4> pixel{100, 150, 200, 255};
    GL(TexImage2D)
    (GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    const EGLImage made =
        eglCreateImage(display, gl, EGL_GL_TEXTURE_2D, EGLClientBuffer(std::uintptr_t(name)), nullptr);
    ASSERT_NE(made, EGL_NO_IMAGE);
    const VGImage image = createTarget(made);
    ASSERT_NE(image, VG_INVALID_HANDLE);
    EXPECT_EQ(texel(image, 0, 0), 0x6496c8ffu);
    EXPECT_EQ(drawn(image), 0x6496c8ffu);
}

TEST_P(EglTextures, KeepPixelsWithoutTheirDisplay) {
    const GLuint name = texture(GL_RGBA, 2, 2);
    drawInto(name);
    const EGLImage made = imageOf(name);
    const VGImage image = createTarget(made);
    glFill(blue);
    useVg();
    ASSERT_TRUE(eglTerminate(display));
    // The context is current still.
    EXPECT_EQ(texel(image, 1, 1), blue);
    set(image, 1, 1, red);
    finish();
    EXPECT_EQ(texel(image, 1, 1), red);
    expectIllegal(made, VG_ILLEGAL_ARGUMENT_ERROR);
    ASSERT_EGL(eglInitialize(display, nullptr, nullptr));
}

TEST_P(EglTextures, MayBeCurrentInAnotherThread) {
    const GLuint name = texture(GL_RGBA, 64, 64);
    drawInto(name);
    const VGImage image = createTarget(imageOf(name));
    useGl();
    ASSERT_EGL(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    for (VGuint i = 1; i < 10; ++i) {
        const VGuint color = i * 25 << 24 | 0xff;
        std::thread([&] {
            useGl();
            glFill(color);
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglReleaseThread();
        }).join();
        EXPECT_EQ(texel(image, 63, 63), color);
        EXPECT_EQ(drawn(image), color);
    }
}

INSTANTIATE_TEST_SUITE_P(DrawnBy, EglTextures,
                         ::testing::Values(EGL_COMPOSITOR_CPU_VTM, EGL_COMPOSITOR_GL_VTM),
                         [](const auto& tested) {
                             return tested.param == EGL_COMPOSITOR_GL_VTM ? "Gl" : "Cpu";
                         });

#undef GL

}  // namespace
}  // namespace vtm::egl::testing
