// EGLImages of OpenVG's images: EGL_KHR_image_base, EGL_KHR_vg_parent_image.

#include <array>
#include <type_traits>

#include <GLES3/gl3.h>

#include <VG/vgext.h>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

EGLClientBuffer bufferOf(VGImage image) { return reinterpret_cast<EGLClientBuffer>(std::uintptr_t(image)); }

class EglImages : public ContextTest {
protected:
    void SetUp() override {
        ContextTest::SetUp();
        ASSERT_EGL(makeCurrent(surface, ctx));
        image = vg.createImage(VG_sRGBA_8888, 2, 2, VG_IMAGE_QUALITY_NONANTIALIASED);
    }

    EGLImage create(VGImage of, const EGLAttrib* attributes = nullptr) const {
        return eglCreateImage(display, ctx, EGL_VG_PARENT_IMAGE_KHR, bufferOf(of), attributes);
    }
    bool destroy(EGLImage what) const { return eglDestroyImage(display, what); }
    VGuint texel(VGImage of) const {
        VGuint pixel = 0;
        vg.getImageSubData(of, &pixel, 4, VG_sRGBA_8888, 1, 1, 1, 1);
        return pixel;
    }
    void expectNone(EGLImage made, EGLint error) const {
        EXPECT_EGL_ERROR(error);
        EXPECT_EQ(made, EGL_NO_IMAGE);
    }

    const Vg vg;
    decltype(&::vgCreateEGLImageTargetKHR) createTarget =
        function<decltype(::vgCreateEGLImageTargetKHR)>("vgCreateEGLImageTargetKHR");
    decltype(&::vgImageSubData) imageSubData = function<decltype(::vgImageSubData)>("vgImageSubData");
    VGImage image = VG_INVALID_HANDLE;
};

TEST_F(EglImages, AreExtensions) {
    const std::string all = std::string(" ") + eglQueryString(display, EGL_EXTENSIONS) + " ";
    for (const char* name : {" EGL_KHR_image_base ", " EGL_KHR_vg_parent_image "}) {
        ASSERT_NE(all.find(name), std::string::npos) << name;
        EXPECT_EQ(all.find(name), all.rfind(name)) << name;
    }
    EXPECT_NE(eglGetProcAddress("eglCreateImageKHR"), nullptr);
    EXPECT_NE(eglGetProcAddress("eglDestroyImageKHR"), nullptr);
}

TEST_F(EglImages, GiveAnotherContextTheSamePixels) {
    const auto createKhr = function<std::remove_pointer_t<PFNEGLCREATEIMAGEKHRPROC>>("eglCreateImageKHR");
    const auto destroyKhr = function<std::remove_pointer_t<PFNEGLDESTROYIMAGEKHRPROC>>("eglDestroyImageKHR");
    const EGLint preserved[] = {EGL_IMAGE_PRESERVED_KHR, EGL_TRUE, EGL_NONE};
    const VGuint white = 0xffffffff, blue = 0x0000ffff;
    const EGLContext stranger = context(c);
    for (const bool khr : {false, true}) {
        SCOPED_TRACE(khr);
        const VGImage source = vg.createImage(VG_sRGBA_8888, 2, 2, VG_IMAGE_QUALITY_NONANTIALIASED);
        imageSubData(source, &white, 4, VG_sRGBA_8888, 1, 1, 1, 1);
        const EGLImage made =
            khr ? createKhr(display, ctx, EGL_VG_PARENT_IMAGE_KHR, bufferOf(source), preserved)
                : create(source);
        EXPECT_EGL_ERROR(EGL_SUCCESS);
        ASSERT_NE(made, EGL_NO_IMAGE);
        // While it is a sibling it is not shared again.
        expectNone(create(source), EGL_BAD_ACCESS);
        ASSERT_EGL(eglMakeCurrent(display, surface, surface, stranger));
        const VGImage target = createTarget(made);
        EXPECT_EQ(texel(target), white);
        EXPECT_TRUE(khr ? destroyKhr(display, made) : destroy(made));
        imageSubData(target, &blue, 4, VG_sRGBA_8888, 1, 1, 1, 1);
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        ASSERT_EGL(eglMakeCurrent(display, surface, surface, ctx));
        EXPECT_EQ(texel(source), blue);
    }
}

TEST_F(EglImages, NeedContextImageAndAttributesThatFit) {
    const EGLenum parent = EGL_VG_PARENT_IMAGE_KHR;
    expectNone(eglCreateImage(EGL_NO_DISPLAY, ctx, parent, bufferOf(image), nullptr), EGL_BAD_DISPLAY);
    expectNone(eglCreateImage(display, EGL_NO_CONTEXT, parent, bufferOf(image), nullptr), EGL_BAD_CONTEXT);
    expectNone(eglCreateImage(display, this, parent, bufferOf(image), nullptr), EGL_BAD_CONTEXT);
    expectNone(eglCreateImage(display, ctx, EGL_GL_TEXTURE_2D, bufferOf(image), nullptr), EGL_BAD_PARAMETER);
    expectNone(create(VG_INVALID_HANDLE), EGL_BAD_PARAMETER);
    expectNone(create(image + 12345), EGL_BAD_PARAMETER);
    // Of another share group.
    expectNone(eglCreateImage(display, context(c), parent, bufferOf(image), nullptr), EGL_BAD_PARAMETER);
    expectNone(create(vg.childImage(image, 0, 0, 1, 1)), EGL_BAD_ACCESS);
    const EGLAttrib level[] = {EGL_GL_TEXTURE_LEVEL, 0, EGL_NONE};
    expectNone(create(image, level), EGL_BAD_PARAMETER);
    const EGLAttrib maybe[] = {EGL_IMAGE_PRESERVED, 2, EGL_NONE};
    expectNone(create(image, maybe), EGL_BAD_PARAMETER);
    // A failure changes nothing.
    EXPECT_NE(create(image), EGL_NO_IMAGE);
}

TEST_F(EglImages, OfAContextOfOpenGlDoNotMatch) {
    if (isAlone())
        GTEST_SKIP() << "there is no OpenGL ES";
    eglBindAPI(EGL_OPENGL_ES_API);
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    const EGLContext gl = eglCreateContext(display, c, EGL_NO_CONTEXT, version);
    ASSERT_NE(gl, EGL_NO_CONTEXT);
    expectNone(eglCreateImage(display, gl, EGL_VG_PARENT_IMAGE_KHR, bufferOf(image), nullptr), EGL_BAD_MATCH);
    EXPECT_TRUE(eglDestroyContext(display, gl));
}

TEST_F(EglImages, AreNoPbuffersToo) {
    EGLSurface pixels =
        eglCreatePbufferFromClientBuffer(display, EGL_OPENVG_IMAGE, bufferOf(image), c, nullptr);
    ASSERT_NE(pixels, EGL_NO_SURFACE);
    expectNone(create(image), EGL_BAD_ACCESS);
    ASSERT_TRUE(eglDestroySurface(display, pixels));
    const EGLImage made = create(image);
    ASSERT_NE(made, EGL_NO_IMAGE);
    EXPECT_EQ(eglCreatePbufferFromClientBuffer(display, EGL_OPENVG_IMAGE, bufferOf(image), c, nullptr),
              EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
    EXPECT_TRUE(destroy(made));
}

TEST_F(EglImages, AreDestroyedOnce) {
    const EGLImage made = create(image);
    EXPECT_FALSE(destroy(this));
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_FALSE(eglDestroyImage(EGL_NO_DISPLAY, made));
    EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
    EXPECT_TRUE(destroy(made));
    EXPECT_FALSE(destroy(made));
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_EQ(createTarget(made), VG_INVALID_HANDLE);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    // The image itself lives on, and may be shared anew.
    EXPECT_EQ(texel(image), 0u);
    EXPECT_NE(create(image), EGL_NO_IMAGE);
}

/// Seen by OpenGL ES as textures.
class EglImagesInGl : public WithGl<EglImages> {
protected:
    void SetUp() override {
        WithGl::SetUp();
        if (!IsSkipped())
            useGl();
    }
    /// A texture of the EGLImage, bound, and drawn into by the framebuffer that is bound.
    void bindTexture(EGLImage made) const {
        GLuint name = 0;
        function<decltype(::glGenTextures)>("glGenTextures")(1, &name);
        function<decltype(::glBindTexture)>("glBindTexture")(GL_TEXTURE_2D, name);
        function<void(GLenum, EGLImage)>("glEGLImageTargetTexture2DOES")(GL_TEXTURE_2D, made);
        GLuint framebuffer = 0;
        function<decltype(::glGenFramebuffers)>("glGenFramebuffers")(1, &framebuffer);
        function<decltype(::glBindFramebuffer)>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer);
        function<decltype(::glFramebufferTexture2D)>("glFramebufferTexture2D")(
            GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, name, 0);
        EXPECT_EQ(function<decltype(::glGetError)>("glGetError")(), GLenum(GL_NO_ERROR));
    }
    static void glFill(float r, float g, float b, float a) {
        function<decltype(::glClearColor)>("glClearColor")(r, g, b, a);
        function<decltype(::glClear)>("glClear")(GL_COLOR_BUFFER_BIT);
    }
    void set(VGImage of, VGint x, VGint y, VGuint pixel) const {
        imageSubData(of, &pixel, 4, VG_sRGBA_8888, x, y, 1, 1);
    }
};

TEST_F(EglImagesInGl, HaveTheSamePixelsInEitherApi) {
    set(image, 1, 0, 0x11223344);
    const EGLImage made = create(image);
    ASSERT_NE(made, EGL_NO_IMAGE) << std::hex << eglGetError();
    bindTexture(made);
    EXPECT_EQ(glTexel(1, 0), 0x11223344u);
    EXPECT_EQ(glTexel(0, 1), 0u);
    // The EGLImage goes, siblings stay.
    EXPECT_TRUE(destroy(made));
    useVg();
    set(image, 0, 1, 0x55667788);
    useGl();
    EXPECT_EQ(glTexel(0, 1), 0x55667788u);
    EXPECT_EQ(glTexel(1, 0), 0x11223344u);
    glFill(1, 0, 0, 1);
    useVg();
    EXPECT_EQ(texel(image), 0xff0000ffu);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
    // Both are current: waiting is enough.
    set(image, 1, 1, 0x99aabbcc);
    EXPECT_TRUE(eglWaitClient());
    EXPECT_EQ(glTexel(1, 1), 0x99aabbccu);
    EXPECT_EQ(glTexel(0, 0), 0xff0000ffu);
    glFill(0, 0, 1, 1);
    EXPECT_TRUE(eglWaitGL());
    EXPECT_EQ(texel(image), 0x0000ffffu);
    // So is what OpenVG itself has.
    set(image, 0, 1, 0x11223344);
    function<decltype(::vgFinish)>("vgFinish")();
    EXPECT_EQ(glTexel(0, 1), 0x11223344u);
}

TEST_F(EglImagesInGl, OutliveTheirSource) {
    set(image, 1, 1, 0x11223344);
    const EGLImage made = create(image);
    const VGImage target = createTarget(made);
    vg.destroyImage(image);
    bindTexture(made);
    useVg();
    set(target, 0, 0, 0x55667788);
    vg.destroyImage(target);
    useGl();
    EXPECT_EQ(glTexel(1, 1), 0x11223344u);
    EXPECT_EQ(glTexel(0, 0), 0x55667788u);
    EXPECT_TRUE(destroy(made));
    useVg();
    useGl();
    EXPECT_EQ(glTexel(0, 0), 0x55667788u);
}

TEST_F(EglImagesInGl, KeepTheBitsOfPixelsThatOpenGlLeavesAlone) {
    const VGImage small = vg.createImage(VG_sRGB_565, 2, 2, VG_IMAGE_QUALITY_NONANTIALIASED);
    const std::uint16_t pixels[] = {0x1234, 0x5678, 0x9abc, 0xdef0};
    imageSubData(small, pixels, 4, VG_sRGB_565, 0, 0, 2, 2);
    const EGLImage made = create(small);
    bindTexture(made);
    EXPECT_EQ(glTexel(0, 0) & 255u, 255u);
    function<decltype(::glEnable)>("glEnable")(GL_SCISSOR_TEST);
    function<decltype(::glScissor)>("glScissor")(1, 0, 1, 1);
    glFill(0, 1, 0, 1);
    useVg();
    std::uint16_t after[4] = {};
    vg.getImageSubData(small, after, 4, VG_sRGB_565, 0, 0, 2, 2);
    EXPECT_EQ(after[0], pixels[0]);
    EXPECT_EQ(after[1], 0x07e0);
    EXPECT_EQ(after[2], pixels[2]);
    EXPECT_EQ(after[3], pixels[3]);
}

TEST_F(EglImages, GoWithTheDisplay) {
    const EGLImage made = create(image);
    ASSERT_TRUE(eglTerminate(display));
    ASSERT_EGL(eglInitialize(display, nullptr, nullptr));
    EXPECT_FALSE(destroy(made));
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    // The context is current still.
    EXPECT_EQ(createTarget(made), VG_INVALID_HANDLE);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
}

}  // namespace
}  // namespace vtm::egl::testing
