// EGL specification sections 3.1 to 3.3, 3.11 and 3.12.

#include <cstring>
#include <set>
#include <sstream>
#include <thread>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

using Displays = EglTest;

std::set<std::string> words(const char* text) {
    std::istringstream stream(text ? text : "");
    std::set<std::string> result;
    for (std::string word; stream >> word;)
        EXPECT_TRUE(result.insert(word).second) << word << " twice";
    return result;
}

TEST_F(Displays, TheSameArgumentGivesTheSameHandle) {
    EXPECT_EQ(eglGetDisplay(EGL_DEFAULT_DISPLAY), display);
}

TEST_F(Displays, OpenVgIsAmongTheClientApis) {
    const auto apis = words(eglQueryString(display, EGL_CLIENT_APIS));
    EXPECT_TRUE(apis.contains("OpenVG"));
    EXPECT_EQ(apis.contains("OpenGL_ES"), !isAlone());
}

TEST_F(Displays, TheVersionStringBeginsWithTheVersion) {
    EGLint major = 0, minor = 0;
    ASSERT_EGL(eglInitialize(display, &major, &minor));
    const std::string begin = std::to_string(major) + "." + std::to_string(minor) + " ";
    EXPECT_EQ(std::string(eglQueryString(display, EGL_VERSION)).substr(0, begin.size()), begin);
    EXPECT_GE(major * 10 + minor, 14);
}

TEST_F(Displays, StringsStayWhereTheyAre) {
    const char* const before = eglQueryString(display, EGL_EXTENSIONS);
    const std::string text = before;
    eglTerminate(display);
    ASSERT_EGL(eglInitialize(display, nullptr, nullptr));
    EXPECT_EQ(text, before);
    EXPECT_NE(std::string(eglQueryString(display, EGL_VENDOR)).find("VTM"), std::string::npos);
}

TEST_F(Displays, ClientExtensionsAreOtherOnesThanTheDisplays) {
    const auto client = words(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS));
    EXPECT_TRUE(client.contains("EGL_EXT_client_extensions"));
    for (const std::string& name : words(eglQueryString(display, EGL_EXTENSIONS)))
        EXPECT_FALSE(client.contains(name)) << name;
}

TEST_F(Displays, UnknownStringsAreErrors) {
    EXPECT_EQ(eglQueryString(display, EGL_WIDTH), nullptr);
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_EQ(eglQueryString(EGL_NO_DISPLAY, EGL_VENDOR), nullptr);
    EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
}

TEST_F(Displays, InitializingTwiceIsNoError) {
    EXPECT_TRUE(eglInitialize(display, nullptr, nullptr));
    EXPECT_EGL_ERROR(EGL_SUCCESS);
}

TEST_F(Displays, ATerminatedDisplayIsNotInitialized) {
    const EGLConfig before = config(8, 8, 8, 8);
    ASSERT_TRUE(eglTerminate(display));
    EXPECT_TRUE(eglTerminate(display));
    EGLint count = 0;
    EXPECT_FALSE(eglGetConfigs(display, nullptr, 0, &count));
    EXPECT_EGL_ERROR(EGL_NOT_INITIALIZED);
    EXPECT_FALSE(eglChooseConfig(display, nullptr, nullptr, 0, &count));
    EXPECT_EGL_ERROR(EGL_NOT_INITIALIZED);
    EXPECT_EQ(eglQueryString(display, EGL_VENDOR), nullptr);
    EXPECT_EGL_ERROR(EGL_NOT_INITIALIZED);
    EXPECT_EQ(context(before), EGL_NO_CONTEXT);
    EXPECT_EGL_ERROR(EGL_NOT_INITIALIZED);
    EXPECT_EQ(pbuffer(before), EGL_NO_SURFACE);
    EXPECT_EGL_ERROR(EGL_NOT_INITIALIZED);
    EXPECT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    EXPECT_FALSE(eglMakeCurrent(display, &count, &count, EGL_NO_CONTEXT));
    EXPECT_EGL_ERROR(EGL_NOT_INITIALIZED);
}

TEST_F(Displays, TerminationMakesHandlesInvalidForEver) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface surface = pbuffer(c);
    const EGLContext ctx = context(c);
    ASSERT_EGL(eglMakeCurrent(display, surface, surface, ctx));
    ASSERT_TRUE(eglTerminate(display));
    ASSERT_EGL(eglInitialize(display, nullptr, nullptr));
    EXPECT_FALSE(eglMakeCurrent(display, surface, surface, ctx));
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
    EXPECT_FALSE(eglDestroySurface(display, surface));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    EXPECT_FALSE(eglDestroyContext(display, ctx));
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
    // What was current goes on, until it is let go of.
    EXPECT_NE(vtmGetCurrentContext(), nullptr);
    EXPECT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    EXPECT_EQ(vtmGetCurrentContext(), nullptr);
    const EGLConfig again = config(8, 8, 8, 8);
    const EGLSurface surface2 = pbuffer(again);
    EXPECT_NE(surface2, surface);
    EXPECT_TRUE(eglMakeCurrent(display, surface2, surface2, context(again)));
}

TEST_F(Displays, ErrorsAreOfTheLastCallAndOfTheThread) {
    EXPECT_FALSE(eglDestroySurface(display, EGL_NO_SURFACE));
    std::thread([] { EXPECT_EGL_ERROR(EGL_SUCCESS); }).join();
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    EXPECT_EGL_ERROR(EGL_SUCCESS);
    // Ours, then one of the system's, then ours again.
    EXPECT_EQ(pbuffer(config(8, 8, 8, 8), -1), EGL_NO_SURFACE);
    EXPECT_FALSE(eglDestroySurface(display, this));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    EXPECT_FALSE(eglDestroySurface(display, this));
    EXPECT_NE(eglQueryAPI(), EGLenum(EGL_NONE));
    EXPECT_EGL_ERROR(EGL_SUCCESS);
}

TEST_F(Displays, TheApiIsOfTheThread) {
    EXPECT_EQ(eglQueryAPI(), EGLenum(EGL_OPENVG_API));
    std::thread([] {
        EXPECT_EQ(eglQueryAPI(), EGLenum(isAlone() ? EGL_NONE : EGL_OPENGL_ES_API));
        EXPECT_EQ(eglBindAPI(EGL_OPENGL_ES_API), EGLBoolean(!isAlone()));
        EXPECT_EGL_ERROR(isAlone() ? EGL_BAD_PARAMETER : EGL_SUCCESS);
    }).join();
    EXPECT_EQ(eglQueryAPI(), EGLenum(EGL_OPENVG_API));
    EXPECT_FALSE(eglBindAPI(EGL_WIDTH));
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    EXPECT_EQ(eglQueryAPI(), EGLenum(EGL_OPENVG_API));
}

TEST_F(Displays, ReleasingTheThreadLetsGoOfAll) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface surface = pbuffer(c);
    ASSERT_EGL(eglMakeCurrent(display, surface, surface, context(c)));
    EXPECT_TRUE(eglReleaseThread());
    EXPECT_EQ(vtmGetCurrentContext(), nullptr);
    EXPECT_NE(eglQueryAPI(), EGLenum(EGL_OPENVG_API));
    EXPECT_TRUE(eglReleaseThread());
    EXPECT_EQ(query(surface, EGL_WIDTH), 16);
}

TEST_F(Displays, AddressesAreOursTheSystemsOrNone) {
    EXPECT_EQ(eglGetProcAddress("eglBindAPI"),
              reinterpret_cast<__eglMustCastToProperFunctionPointerType>(&eglBindAPI));
    EXPECT_NE(eglGetProcAddress("vgGetError"), nullptr);
    EXPECT_NE(eglGetProcAddress("vtmCreateContext"), nullptr);
    EXPECT_EQ(eglGetProcAddress("glClear") != nullptr, !isAlone());
    EXPECT_EQ(eglGetProcAddress("eglNoSuchFunction"), nullptr);
    EXPECT_EQ(eglGetProcAddress(nullptr), nullptr);
    EXPECT_EQ(eglGetProcAddress(""), nullptr);
}

TEST_F(Displays, APlatformsDisplayHasOpenVgToo) {
    const EGLDisplay other = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    ASSERT_NE(other, EGL_NO_DISPLAY);
    ASSERT_EGL(eglInitialize(other, nullptr, nullptr));
    EXPECT_TRUE(words(eglQueryString(other, EGL_CLIENT_APIS)).contains("OpenVG"));
    EXPECT_EQ(eglGetPlatformDisplay(EGL_WIDTH, nullptr, nullptr), EGL_NO_DISPLAY);
    EXPECT_EGL_ERROR(EGL_BAD_PARAMETER);
    if (const auto get = function<EGLDisplay(EGLenum, void*, const EGLint*)>("eglGetPlatformDisplayEXT")) {
        EXPECT_EQ(get(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr), other);
    }
    if (other != display) {
        EXPECT_TRUE(eglTerminate(other));
    }
}

}  // namespace
}  // namespace vtm::egl::testing
