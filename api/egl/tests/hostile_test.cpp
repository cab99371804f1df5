// Handles that are none must give errors, and never crash: EGL specification section 3.1.2.

#include <cstdint>
#include <random>
#include <type_traits>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

using Hostile = EglTest;

/// Every function that takes a display, with one handle everywhere.
void callAll(EGLDisplay d, void* h) {
    EGLint number = 0;
    EGLAttrib attribute = 0;
    EGLConfig config = nullptr;
    const EGLint list[] = {EGL_WIDTH, 4, EGL_HEIGHT, 4, EGL_NONE};
    eglBindTexImage(d, h, EGL_BACK_BUFFER);
    eglChooseConfig(d, nullptr, &config, 1, &number);
    eglClientWaitSync(d, h, 0, 0);
    eglCopyBuffers(d, h, 0);
    eglCreateContext(d, h, h, nullptr);
    eglCreateContext(d, h, EGL_NO_CONTEXT, list);
    eglCreateImage(d, h, EGL_GL_TEXTURE_2D, h, nullptr);
    eglCreateImage(d, h, EGL_VG_PARENT_IMAGE_KHR, h, nullptr);
    function<std::remove_pointer_t<PFNEGLCREATEIMAGEKHRPROC>>("eglCreateImageKHR")(
        d, h, EGL_VG_PARENT_IMAGE_KHR, h, nullptr);
    function<std::remove_pointer_t<PFNEGLDESTROYIMAGEKHRPROC>>("eglDestroyImageKHR")(d, h);
    eglCreatePbufferFromClientBuffer(d, EGL_OPENVG_IMAGE, h, h, nullptr);
    eglCreatePbufferSurface(d, h, list);
    eglCreatePixmapSurface(d, h, 0, nullptr);
    eglCreatePlatformPixmapSurface(d, h, nullptr, nullptr);
    eglCreatePlatformWindowSurface(d, h, nullptr, nullptr);
    eglCreateSync(d, EGL_SYNC_FENCE, nullptr);
    eglCreateWindowSurface(d, h, 0, nullptr);
    eglDestroyContext(d, h);
    eglDestroyImage(d, h);
    eglDestroySurface(d, h);
    eglDestroySync(d, h);
    eglGetConfigAttrib(d, h, EGL_RED_SIZE, &number);
    eglGetConfigs(d, &config, 1, &number);
    eglGetSyncAttrib(d, h, EGL_SYNC_STATUS, &attribute);
    eglMakeCurrent(d, h, h, h);
    eglMakeCurrent(d, h, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglQueryContext(d, h, EGL_CONFIG_ID, &number);
    eglQueryString(d, EGL_VENDOR);
    eglQuerySurface(d, h, EGL_WIDTH, &number);
    eglReleaseTexImage(d, h, EGL_BACK_BUFFER);
    eglSurfaceAttrib(d, h, EGL_MIPMAP_LEVEL, 0);
    eglSwapBuffers(d, h);
    eglSwapInterval(d, 1);
    eglWaitSync(d, h, 0);
}

TEST_F(Hostile, GarbageOfEveryKindIsSurvivedWithEitherApi) {
    int local = 0;
    for (const EGLenum api : {EGL_OPENVG_API, EGL_OPENGL_ES_API}) {
        eglBindAPI(api);
        for (void* const handle :
             {static_cast<void*>(nullptr), static_cast<void*>(&local), static_cast<void*>(this),
              reinterpret_cast<void*>(std::uintptr_t(1)), reinterpret_cast<void*>(~std::uintptr_t(0))}) {
            callAll(display, handle);
            callAll(handle, handle);
            callAll(handle, display);
        }
    }
    EXPECT_EQ(eglQueryString(display, EGL_VENDOR) != nullptr, true);
}

TEST_F(Hostile, HandlesOfOneKindAreNoneOfAnother) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface s = pbuffer(c);
    const EGLContext x = context(c);
    EGLint number = 0;
    EXPECT_FALSE(eglQuerySurface(display, x, EGL_WIDTH, &number));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
    EXPECT_FALSE(eglQueryContext(display, s, EGL_CONFIG_ID, &number));
    EXPECT_EGL_ERROR(EGL_BAD_CONTEXT);
    EXPECT_FALSE(eglGetConfigAttrib(display, s, EGL_RED_SIZE, &number));
    EXPECT_EGL_ERROR(EGL_BAD_CONFIG);
    EXPECT_FALSE(eglInitialize(s, nullptr, nullptr));
    EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
    EXPECT_FALSE(eglTerminate(c));
    EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
}

TEST_F(Hostile, NoDisplayIsABadOne) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface s = pbuffer(c);
    for (const EGLDisplay bad : {EGL_NO_DISPLAY, EGLDisplay(this)}) {
        EGLint number = 0;
        EXPECT_FALSE(eglInitialize(bad, nullptr, nullptr));
        EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
        EXPECT_FALSE(eglTerminate(bad));
        EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
        EXPECT_FALSE(eglGetConfigs(bad, nullptr, 0, &number));
        EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
        EXPECT_FALSE(eglQuerySurface(bad, s, EGL_WIDTH, &number));
        EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
        EXPECT_EQ(eglCreateContext(bad, c, EGL_NO_CONTEXT, nullptr), EGL_NO_CONTEXT);
        EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
        EXPECT_FALSE(eglMakeCurrent(bad, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
        EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
        EXPECT_FALSE(eglSwapBuffers(bad, s));
        EXPECT_EGL_ERROR(EGL_BAD_DISPLAY);
    }
}

TEST_F(Hostile, AHandleIsNotGivenTwice) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface first = pbuffer(c, 1, 1);
    ASSERT_TRUE(eglDestroySurface(display, first));
    for (int i = 0; i < 1000; ++i) {
        const EGLSurface next = pbuffer(c, 1, 1);
        ASSERT_NE(next, first);
        ASSERT_TRUE(eglDestroySurface(display, next));
    }
    EXPECT_FALSE(eglDestroySurface(display, first));
    EXPECT_EGL_ERROR(EGL_BAD_SURFACE);
}

TEST_F(Hostile, RandomLivesAndDeathsOfObjects) {
    std::mt19937 random(5);
    const EGLConfig configs[] = {config(8, 8, 8, 8), config(5, 6, 5, 0), nullptr, this};
    std::vector<void*> handles{nullptr, this};
    const auto any = [&](const auto& list) { return list[random() % std::size(list)]; };
    for (int i = 0; i < 20000; ++i) {
        const EGLDisplay d = random() % 50 == 0 ? nullptr : display;
        switch (random() % 10) {
            case 0:
                handles.push_back(eglCreateContext(d, any(configs), any(handles), nullptr));
                break;
            case 1:
            case 2:
                handles.push_back(pbuffer(any(configs), EGLint(random() % 5), EGLint(random() % 5)));
                break;
            case 3:
                eglDestroyContext(d, any(handles));
                break;
            case 4:
                eglDestroySurface(d, any(handles));
                break;
            case 5:
            case 6: {
                void* const surface = any(handles);
                eglMakeCurrent(d, surface, surface, any(handles));
                break;
            }
            case 7:
                eglSwapBuffers(d, any(handles));
                break;
            case 8:
                eglMakeCurrent(d, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
                break;
            default:
                eglGetError();
        }
        if (handles.size() > 40)
            handles.erase(handles.begin() + 2, handles.begin() + 20);
    }
    EXPECT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
}

}  // namespace
}  // namespace vtm::egl::testing
