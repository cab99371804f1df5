// EGLImages of OpenVG's images: EGL_KHR_image_base, EGL_KHR_vg_parent_image.

#include <type_traits>

#include <VG/vgext.h>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

EGLClientBuffer bufferOf(VGImage image) { return reinterpret_cast<EGLClientBuffer>(std::uintptr_t(image)); }

class EglImages : public EglTest {
protected:
    void SetUp() override {
        EglTest::SetUp();
        c = config(8, 8, 8, 8);
        surface = pbuffer(c);
        ctx = context(c);
        ASSERT_EGL(eglMakeCurrent(display, surface, surface, ctx));
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
    EGLConfig c = nullptr;
    EGLSurface surface = EGL_NO_SURFACE;
    EGLContext ctx = EGL_NO_CONTEXT;
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
