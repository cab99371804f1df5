// EGL specification sections 3.5, 3.6 and 3.10: pbuffers.

#include <climits>
#include <cstdint>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

using Surfaces = EglTest;

TEST_F(Surfaces, APbufferHasWhatItWasAskedFor) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface s = pbuffer(c, 40, 30,
                                 {EGL_VG_COLORSPACE, EGL_VG_COLORSPACE_LINEAR, EGL_VG_ALPHA_FORMAT,
                                  EGL_VG_ALPHA_FORMAT_PRE, EGL_LARGEST_PBUFFER, EGL_TRUE});
    ASSERT_NE(s, EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_SUCCESS);
    EXPECT_EQ(query(s, EGL_WIDTH), 40);
    EXPECT_EQ(query(s, EGL_HEIGHT), 30);
    EXPECT_EQ(query(s, EGL_VG_COLORSPACE), EGL_VG_COLORSPACE_LINEAR);
    EXPECT_EQ(query(s, EGL_VG_ALPHA_FORMAT), EGL_VG_ALPHA_FORMAT_PRE);
    EXPECT_EQ(query(s, EGL_LARGEST_PBUFFER), EGL_TRUE);
    EXPECT_EQ(query(s, EGL_CONFIG_ID), value(c, EGL_CONFIG_ID));
    EXPECT_EQ(query(s, EGL_RENDER_BUFFER), EGL_BACK_BUFFER);
    EXPECT_EQ(query(s, EGL_MULTISAMPLE_RESOLVE), EGL_MULTISAMPLE_RESOLVE_DEFAULT);
    EXPECT_EQ(query(s, EGL_TEXTURE_FORMAT), EGL_NO_TEXTURE);
    EXPECT_EQ(query(s, EGL_TEXTURE_TARGET), EGL_NO_TEXTURE);
    EXPECT_EQ(query(s, EGL_HORIZONTAL_RESOLUTION), EGL_UNKNOWN);
    EXPECT_EQ(query(s, EGL_PIXEL_ASPECT_RATIO), EGL_UNKNOWN);
}

TEST_F(Surfaces, SamplesChangeNoPixel) {
    const auto drawn = [&](EGLint samples) {
        const std::vector<EGLConfig> found =
            choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RED_SIZE, 8,
                    EGL_ALPHA_SIZE, 8, EGL_SAMPLES, samples});
        EXPECT_EQ(value(found.at(0), EGL_SAMPLES), samples);
        const EGLSurface s = pbuffer(found.at(0), 16, 16);
        const EGLContext ctx = context(found.at(0));
        EXPECT_TRUE(eglMakeCurrent(display, s, s, ctx));
        const VGPath path =
            vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
        const VGubyte commands[]{VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH};
        const VGfloat numbers[]{1.3f, 2.1f, 14.7f, 5.2f, 6.4f, 13.9f};
        vgAppendPathData(path, 4, commands, numbers);
        vgDrawPath(path, VG_FILL_PATH);
        std::vector<VGuint> pixels(16 * 16);
        vgReadPixels(pixels.data(), 64, VG_sRGBA_8888, 0, 0, 16, 16);
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        return pixels;
    };
    const std::vector<VGuint> exact = drawn(0);
    EXPECT_NE(exact, std::vector<VGuint>(16 * 16));
    EXPECT_EQ(drawn(4), exact);
}

TEST_F(Surfaces, ThereAreDefaults) {
    const EGLSurface s = eglCreatePbufferSurface(display, config(8, 8, 8, 8), nullptr);
    ASSERT_NE(s, EGL_NO_SURFACE);
    EXPECT_EQ(query(s, EGL_WIDTH), 0);
    EXPECT_EQ(query(s, EGL_VG_COLORSPACE), EGL_VG_COLORSPACE_sRGB);
    EXPECT_EQ(query(s, EGL_VG_ALPHA_FORMAT), EGL_VG_ALPHA_FORMAT_NONPRE);
    EXPECT_EQ(query(s, EGL_LARGEST_PBUFFER), EGL_FALSE);
}

TEST_F(Surfaces, EveryFormatInEverySpaceIsDrawnInto) {
    for (const EGLConfig c : choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                     EGL_COLOR_BUFFER_TYPE, EGL_DONT_CARE})) {
        const EGLContext ctx = context(c);
        for (const EGLint space : {EGL_VG_COLORSPACE_sRGB, EGL_VG_COLORSPACE_LINEAR})
            for (const EGLint alpha : {EGL_VG_ALPHA_FORMAT_NONPRE, EGL_VG_ALPHA_FORMAT_PRE}) {
                const EGLSurface s = pbuffer(c, 4, 4, {EGL_VG_COLORSPACE, space, EGL_VG_ALPHA_FORMAT, alpha});
                ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
                VtmSurfaceFormat format;
                vtmGetSurfaceFormat(vtmGetCurrentSurface(), &format);
                EXPECT_EQ(format.linear, VGboolean(space == EGL_VG_COLORSPACE_LINEAR));
                EXPECT_EQ(format.premultiplied, VGboolean(alpha == EGL_VG_ALPHA_FORMAT_PRE));
                EXPECT_EQ(format.redBits, value(c, EGL_RED_SIZE));
                EXPECT_EQ(format.alphaBits, value(c, EGL_ALPHA_SIZE));
                EXPECT_EQ(format.luminanceBits, value(c, EGL_LUMINANCE_SIZE));
                EXPECT_EQ(format.maskBits, 8);
            }
    }
}

TEST_F(Surfaces, TooLargeOnesAreRefusedOrMadeSmaller) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLint maximum = value(c, EGL_MAX_PBUFFER_WIDTH);
    EXPECT_EQ(pbuffer(c, maximum + 1, 1), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ALLOC);
    EXPECT_EQ(pbuffer(c, INT_MAX, INT_MAX), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ALLOC);
    const EGLSurface s = pbuffer(c, maximum + 1, 2, {EGL_LARGEST_PBUFFER, EGL_TRUE});
    ASSERT_NE(s, EGL_NO_SURFACE);
    EXPECT_EQ(query(s, EGL_WIDTH), maximum);
    EXPECT_EQ(query(s, EGL_HEIGHT), 2);
}

TEST_F(Surfaces, BadAttributesAreErrors) {
    const EGLConfig c = config(8, 8, 8, 8);
    EXPECT_EQ(pbuffer(c, -1, 4), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    for (const Attributes& bad : {Attributes{EGL_VG_COLORSPACE, 0}, Attributes{EGL_VG_ALPHA_FORMAT, EGL_TRUE},
                                  Attributes{EGL_LARGEST_PBUFFER, 2}, Attributes{EGL_RED_SIZE, 8},
                                  Attributes{EGL_RENDER_BUFFER, EGL_BACK_BUFFER}, Attributes{77, 0}}) {
        EXPECT_EQ(pbuffer(c, 4, 4, bad), EGL_NO_SURFACE) << std::hex << bad[0];
        EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
    }
}

TEST_F(Surfaces, AttributesAreSet) {
    const EGLSurface s = pbuffer(config(8, 8, 8, 8));
    EXPECT_TRUE(eglSurfaceAttrib(display, s, EGL_SWAP_BEHAVIOR, EGL_BUFFER_DESTROYED));
    EXPECT_EQ(query(s, EGL_SWAP_BEHAVIOR), EGL_BUFFER_DESTROYED);
    EXPECT_TRUE(eglSurfaceAttrib(display, s, EGL_SWAP_BEHAVIOR, EGL_BUFFER_PRESERVED));
    EXPECT_EQ(query(s, EGL_SWAP_BEHAVIOR), EGL_BUFFER_PRESERVED);
    EXPECT_TRUE(eglSurfaceAttrib(display, s, EGL_MULTISAMPLE_RESOLVE, EGL_MULTISAMPLE_RESOLVE_DEFAULT));
    EXPECT_FALSE(eglSurfaceAttrib(display, s, EGL_MULTISAMPLE_RESOLVE, EGL_MULTISAMPLE_RESOLVE_BOX));
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_FALSE(eglSurfaceAttrib(display, s, EGL_SWAP_BEHAVIOR, 1));
    EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
    EXPECT_FALSE(eglSurfaceAttrib(display, s, EGL_WIDTH, 1));
    EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
    EGLint unchanged = 5;
    EXPECT_FALSE(eglQuerySurface(display, s, EGL_RED_SIZE, &unchanged));
    EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
    EXPECT_EQ(unchanged, 5);
}

TEST_F(Surfaces, ADestroyedSurfaceStaysWhileItIsCurrent) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface s = pbuffer(c);
    const EGLContext ctx = context(c);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    EXPECT_TRUE(eglDestroySurface(display, s));
    EXPECT_TRUE(eglDestroyContext(display, ctx));
    EXPECT_FALSE(eglDestroySurface(display, s));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), s);
    EXPECT_EQ(eglGetCurrentContext(), ctx);
    ASSERT_NE(vtmGetCurrentSurface(), nullptr);
    EXPECT_EQ(vtmSurfaceWidth(vtmGetCurrentSurface()), 16);
}

TEST_F(Surfaces, SwappingAPbufferChangesNothing) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface s = pbuffer(c), other = pbuffer(c);
    EXPECT_FALSE(eglSwapBuffers(display, s));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    ASSERT_EGL(eglMakeCurrent(display, s, s, context(c)));
    EXPECT_TRUE(eglSwapBuffers(display, s));
    EXPECT_FALSE(eglSwapBuffers(display, other));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    EXPECT_TRUE(eglSwapInterval(display, 1));
    EXPECT_TRUE(eglWaitClient());
    EXPECT_TRUE(eglWaitNative(EGL_CORE_NATIVE_ENGINE));
    EXPECT_FALSE(eglWaitNative(1));
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
}

TEST_F(Surfaces, SwappingIsOfWhatIsCurrent) {
    EXPECT_FALSE(eglSwapInterval(display, 1));
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
    EXPECT_TRUE(eglWaitClient());
}

TEST_F(Surfaces, NoTexturesAreMadeOfThem) {
    const EGLSurface s = pbuffer(config(8, 8, 8, 8));
    EXPECT_FALSE(eglBindTexImage(display, s, EGL_BACK_BUFFER));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    EXPECT_FALSE(eglReleaseTexImage(display, s, EGL_BACK_BUFFER));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
}

TEST_F(Surfaces, WindowsNeedADisplayThatHasThem) {
    const EGLConfig c = config(8, 8, 8, 8);
    if (value(c, EGL_SURFACE_TYPE) & EGL_WINDOW_BIT)
        GTEST_SKIP() << "this display has windows";
    EXPECT_EQ(eglCreateWindowSurface(display, c, 0, nullptr), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_EQ(eglCreatePlatformWindowSurface(display, c, nullptr, nullptr), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_EQ(eglCreatePixmapSurface(display, c, 0, nullptr), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
}

class Images : public ContextTest {
protected:
    void SetUp() override {
        ContextTest::SetUp();
        if (!vg)
            GTEST_SKIP() << "this libOpenVG does not draw";
        ASSERT_EGL(makeCurrent(surface, ctx));
    }

    EGLSurface bound(VGImage image, EGLConfig of, Attributes attributes = {}) const {
        attributes.push_back(EGL_NONE);
        return eglCreatePbufferFromClientBuffer(display, EGL_OPENVG_IMAGE,
                                                reinterpret_cast<EGLClientBuffer>(std::uintptr_t(image)), of,
                                                attributes.data());
    }

    const Vg vg;
};

TEST_F(Images, AreDrawnInto) {
    const VGImage image = vg.createImage(VG_lRGBA_8888_PRE, 6, 5, VG_IMAGE_QUALITY_NONANTIALIASED);
    const EGLSurface s = bound(image, c);
    ASSERT_NE(s, EGL_NO_SURFACE) << std::hex << eglGetError();
    EXPECT_EQ(query(s, EGL_WIDTH), 6);
    EXPECT_EQ(query(s, EGL_HEIGHT), 5);
    EXPECT_EQ(query(s, EGL_VG_COLORSPACE), EGL_VG_COLORSPACE_LINEAR);
    EXPECT_EQ(query(s, EGL_VG_ALPHA_FORMAT), EGL_VG_ALPHA_FORMAT_PRE);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(6, 5, {1, 0, 0, 1});
    ASSERT_EGL(eglMakeCurrent(display, surface, surface, ctx));
    VGuint pixel = 0;
    vg.getImageSubData(image, &pixel, 4, VG_sRGBA_8888, 5, 4, 1, 1);
    EXPECT_EQ(pixel, 0xff0000ffu);
}

TEST_F(Images, AreBoundOnce) {
    const VGImage image = vg.createImage(VG_sRGBA_8888, 6, 5, VG_IMAGE_QUALITY_NONANTIALIASED);
    const EGLSurface s = bound(image, c);
    ASSERT_NE(s, EGL_NO_SURFACE);
    EXPECT_EQ(bound(image, c), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
    ASSERT_TRUE(eglDestroySurface(display, s));
    EXPECT_NE(bound(image, c), EGL_NO_SURFACE);
    const VGImage parent = vg.createImage(VG_sRGBA_8888, 6, 5, VG_IMAGE_QUALITY_NONANTIALIASED);
    const VGImage child = vg.childImage(parent, 0, 0, 2, 2);
    EXPECT_EQ(bound(parent, c), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
    EXPECT_EQ(bound(child, c), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
}

TEST_F(Images, AreNotDrawnIntoWhileTheyArePatterns) {
    const VGImage image = vg.createImage(VG_sRGBA_8888, 6, 5, VG_IMAGE_QUALITY_NONANTIALIASED);
    const EGLSurface s = bound(image, c);
    const VGPaint paint = vg.createPaint();
    vg.paintPattern(paint, image);
    EXPECT_FALSE(eglMakeCurrent(display, s, s, ctx));
    EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), surface);
    vg.paintPattern(paint, VG_INVALID_HANDLE);
    EXPECT_TRUE(eglMakeCurrent(display, s, s, ctx));
}

TEST_F(Images, LiveAsLongAsTheirSurface) {
    const VGImage image = vg.createImage(VG_sRGBA_8888, 6, 5, VG_IMAGE_QUALITY_NONANTIALIASED);
    const EGLSurface s = bound(image, c);
    vg.destroyImage(image);
    ASSERT_EGL(eglMakeCurrent(display, s, s, ctx));
    vg.fill(6, 5, {0, 0, 1, 1});
    EXPECT_EQ(vg.pixel(2, 2), 0x0000ffffu);
    EXPECT_EQ(bound(image, c), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
}

TEST_F(Images, MustFit) {
    const VGImage image = vg.createImage(VG_sRGB_565, 6, 5, VG_IMAGE_QUALITY_NONANTIALIASED);
    EXPECT_EQ(bound(image, c), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_MATCH);
    EXPECT_EQ(bound(image, nullptr), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_CONFIG);
    EXPECT_EQ(bound(12345678, c), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_EQ(bound(VG_INVALID_HANDLE, c), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_EQ(bound(image, config(5, 6, 5, 0), {EGL_WIDTH, 5}), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ATTRIBUTE);
    EXPECT_EQ(eglCreatePbufferFromClientBuffer(display, EGL_WIDTH, nullptr, c, nullptr), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_NE(bound(image, config(5, 6, 5, 0)), EGL_NO_SURFACE);
    ASSERT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    EXPECT_EQ(bound(image, config(5, 6, 5, 0)), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
}

}  // namespace
}  // namespace vtm::egl::testing
