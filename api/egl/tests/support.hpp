/// \file
/// What the tests of EGL begin with: an initialised display, and OpenVG's functions by name.
#pragma once

#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <gtest/gtest.h>

#include <VG/openvg.h>
#include <vtm/vg.h>

namespace vtm::egl::testing {

using Attributes = std::vector<EGLint>;

/// Says which call it was.
#define EXPECT_EGL_ERROR(error) EXPECT_EQ(eglGetError(), error)
#define ASSERT_EGL(call) ASSERT_TRUE(call) << "error " << std::hex << eglGetError()

/// A function that eglGetProcAddress gives.
template <class F>
F* function(const char* name) {
    return reinterpret_cast<F*>(eglGetProcAddress(name));
}

/// True if the tests run without a library of the system's.
inline bool isAlone() {
    const char* const named = std::getenv("VTM_SYSTEM_EGL");
    return named && std::string(named) == "none";
}

class EglTest : public ::testing::Test {
protected:
    void SetUp() override {
        display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
        ASSERT_NE(display, EGL_NO_DISPLAY);
        ASSERT_EGL(eglInitialize(display, nullptr, nullptr));
        ASSERT_EGL(eglBindAPI(EGL_OPENVG_API));
    }
    void TearDown() override {
        eglReleaseThread();
        eglTerminate(display);
    }

    std::vector<EGLConfig> choose(Attributes attributes) const {
        attributes.push_back(EGL_NONE);
        EGLint count = 0;
        EXPECT_TRUE(eglChooseConfig(display, attributes.data(), nullptr, 0, &count))
            << std::hex << eglGetError();
        std::vector<EGLConfig> configs(std::size_t(count), nullptr);
        EXPECT_TRUE(eglChooseConfig(display, attributes.data(), configs.data(), count, &count));
        return configs;
    }

    EGLint value(EGLConfig config, EGLint name) const {
        EGLint result = -12345;
        EXPECT_TRUE(eglGetConfigAttrib(display, config, name, &result)) << std::hex << name;
        return result;
    }

    EGLint query(EGLSurface surface, EGLint name) const {
        EGLint result = -12345;
        EXPECT_TRUE(eglQuerySurface(display, surface, name, &result)) << std::hex << name;
        return result;
    }

    /// The config with these sizes for OpenVG and pbuffers.
    EGLConfig config(EGLint red, EGLint green, EGLint blue, EGLint alpha, EGLint luminance = 0) const {
        for (const EGLConfig c : choose({EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE,
                                         EGL_PBUFFER_BIT, EGL_COLOR_BUFFER_TYPE, EGL_DONT_CARE}))
            if (value(c, EGL_RED_SIZE) == red && value(c, EGL_GREEN_SIZE) == green &&
                value(c, EGL_BLUE_SIZE) == blue && value(c, EGL_ALPHA_SIZE) == alpha &&
                value(c, EGL_LUMINANCE_SIZE) == luminance)
                return c;
        ADD_FAILURE() << "no such config";
        return nullptr;
    }

    EGLSurface pbuffer(EGLConfig config, EGLint width = 16, EGLint height = 8, Attributes more = {}) const {
        more.insert(more.end(), {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE});
        return eglCreatePbufferSurface(display, config, more.data());
    }

    EGLContext context(EGLConfig config, EGLContext share = EGL_NO_CONTEXT) const {
        return eglCreateContext(display, config, share, nullptr);
    }

    EGLDisplay display = EGL_NO_DISPLAY;
};

/// There is a pbuffer and a context of OpenVG of one config; neither is current.
class ContextTest : public EglTest {
protected:
    void SetUp() override {
        EglTest::SetUp();
        c = config(8, 8, 8, 8);
        surface = pbuffer(c);
        ctx = context(c);
    }

    bool makeCurrent(EGLSurface s, EGLContext handle) const { return eglMakeCurrent(display, s, s, handle); }

    EGLConfig c = nullptr;
    EGLSurface surface = EGL_NO_SURFACE;
    EGLContext ctx = EGL_NO_CONTEXT;
};

/// Beside what Base makes there is a context of OpenGL ES 2, with a pbuffer of its own. Skipped without
/// OpenGL ES.
template <class Base>
class WithGl : public Base {
protected:
    void SetUp() override {
        Base::SetUp();
        if (isAlone())
            GTEST_SKIP() << "there is no OpenGL ES";
        eglBindAPI(EGL_OPENGL_ES_API);
        const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
        gl = eglCreateContext(this->display, this->c, EGL_NO_CONTEXT, version);
        ASSERT_NE(gl, EGL_NO_CONTEXT) << std::hex << eglGetError();
        glSurface = this->pbuffer(this->c);
    }
    void useGl() const {
        eglBindAPI(EGL_OPENGL_ES_API);
        ASSERT_EGL(eglMakeCurrent(this->display, glSurface, glSurface, gl));
    }
    void useVg() const {
        eglBindAPI(EGL_OPENVG_API);
        ASSERT_EGL(eglMakeCurrent(this->display, this->surface, this->surface, this->ctx));
    }
    /// Of what OpenGL draws into: red, green, blue, alpha from the highest to the lowest byte.
    static VGuint glTexel(GLint x, GLint y) {
        std::array<GLubyte, 4> b{};
        function<decltype(::glReadPixels)>("glReadPixels")(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, b.data());
        return VGuint(b[0]) << 24 | VGuint(b[1]) << 16 | VGuint(b[2]) << 8 | b[3];
    }

    EGLContext gl = EGL_NO_CONTEXT;
    EGLSurface glSurface = EGL_NO_SURFACE;
};

/// OpenVG's, as far as the tests draw.
struct Vg {
    decltype(&::vgClear) clear = function<decltype(::vgClear)>("vgClear");
    decltype(&::vgSetfv) setfv = function<decltype(::vgSetfv)>("vgSetfv");
    decltype(&::vgReadPixels) readPixels = function<decltype(::vgReadPixels)>("vgReadPixels");
    decltype(&::vgCreateImage) createImage = function<decltype(::vgCreateImage)>("vgCreateImage");
    decltype(&::vgChildImage) childImage = function<decltype(::vgChildImage)>("vgChildImage");
    decltype(&::vgDestroyImage) destroyImage = function<decltype(::vgDestroyImage)>("vgDestroyImage");
    decltype(&::vgGetImageSubData) getImageSubData =
        function<decltype(::vgGetImageSubData)>("vgGetImageSubData");

    decltype(&::vgCreatePaint) createPaint = function<decltype(::vgCreatePaint)>("vgCreatePaint");
    decltype(&::vgPaintPattern) paintPattern = function<decltype(::vgPaintPattern)>("vgPaintPattern");

    explicit operator bool() const {
        return clear && setfv && readPixels && createImage && childImage && destroyImage && getImageSubData &&
               createPaint && paintPattern;
    }

    void fill(EGLint width, EGLint height, const VGfloat (&color)[4]) const {
        setfv(VG_CLEAR_COLOR, 4, color);
        clear(0, 0, width, height);
    }

    /// Red, green, blue, alpha from the highest to the lowest byte.
    VGuint pixel(VGint x, VGint y) const {
        VGuint result = 0;
        readPixels(&result, 4, VG_sRGBA_8888, x, y, 1, 1);
        return result;
    }
};

}  // namespace vtm::egl::testing
