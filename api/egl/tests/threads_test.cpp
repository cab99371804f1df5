// EGL specification section 2.6: any function may be called in any thread. Under ThreadSanitizer this tells
// of races.

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <thread>

#include "api/egl/tests/support.hpp"

namespace vtm::egl::testing {
namespace {

using Threads = EglTest;

void inParallel(int count, const std::function<void(int)>& body) {
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i)
        threads.emplace_back(body, i);
    for (std::thread& thread : threads)
        thread.join();
}

TEST_F(Threads, EachHasItsContext) {
    const Vg vg;
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLContext shared = context(c);
    inParallel(4, [&](int i) {
        ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
        for (int round = 0; round < 20; ++round) {
            const EGLSurface s = pbuffer(c, 8 + i, 8);
            const EGLContext x = context(c, i % 2 ? shared : EGL_NO_CONTEXT);
            ASSERT_EGL(eglMakeCurrent(display, s, s, x));
            EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), s);
            EXPECT_EQ(query(s, EGL_WIDTH), 8 + i);
            if (vg) {
                vg.fill(16, 16, {i % 2 ? 1.0f : 0.0f, i / 2 ? 1.0f : 0.0f, 0, 1});
                EXPECT_EQ(vg.pixel(4, 4), (i % 2 ? 0xff000000u : 0) | (i / 2 ? 0xff0000u : 0) | 0xffu);
            }
            EXPECT_TRUE(eglSwapBuffers(display, s));
            EXPECT_TRUE(eglDestroySurface(display, s));
            EXPECT_TRUE(eglDestroyContext(display, x));
            if (round % 3 == 0) {
                EXPECT_TRUE(eglReleaseThread());
                ASSERT_TRUE(eglBindAPI(EGL_OPENVG_API));
            }
        }
    });
}

TEST_F(Threads, OneContextGoesRound) {
    const EGLConfig c = config(8, 8, 8, 8);
    const EGLSurface s = pbuffer(c);
    const EGLContext x = context(c);
    std::atomic<int> had = 0;
    inParallel(4, [&](int) {
        eglBindAPI(EGL_OPENVG_API);
        for (int round = 0; round < 200; ++round) {
            if (eglMakeCurrent(display, s, s, x)) {
                ++had;
                EXPECT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
            } else {
                EXPECT_EGL_ERROR(EGL_BAD_ACCESS);
            }
        }
    });
    EXPECT_GT(had, 0);
}

TEST_F(Threads, ThreadsEndWithContexts) {
    const EGLConfig c = config(8, 8, 8, 8);
    inParallel(4, [&](int i) {
        eglBindAPI(EGL_OPENVG_API);
        const EGLSurface s = pbuffer(c);
        const EGLContext x = context(c);
        ASSERT_EGL(eglMakeCurrent(display, s, s, x));
        if (i % 2) {
            eglDestroySurface(display, s);
            eglDestroyContext(display, x);
        }
    });
}

TEST_F(Threads, SomeInitializeWhileOthersTerminate) {
    inParallel(4, [&](int i) {
        eglBindAPI(EGL_OPENVG_API);
        for (int round = 0; round < 10; ++round) {
            EXPECT_TRUE(eglInitialize(display, nullptr, nullptr));
            EGLConfig c = nullptr;
            EGLint count = 0;
            const EGLint attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE,
                                         EGL_PBUFFER_BIT, EGL_NONE};
            if (eglChooseConfig(display, attributes, &c, 1, &count) && count == 1) {
                const EGLSurface s = pbuffer(c);
                const EGLContext x = context(c);
                eglMakeCurrent(display, s, s, x);
                eglQueryString(display, EGL_EXTENSIONS);
            }
            if (i == 0) {
                EXPECT_TRUE(eglTerminate(display));
            }
        }
    });
    EXPECT_TRUE(eglInitialize(display, nullptr, nullptr));
}

TEST_F(Threads, SomeChooseConfigsWhileOthersTerminate) {
    // A thread must be interrupted within a call for this to tell anything.
    const int rounds = isAlone() ? 20'000 : 300;
    std::atomic<int> choosing = 3;
    const auto terminates = [&] {
        while (choosing > 0)
            EXPECT_TRUE(eglTerminate(display));
    };
    const auto chooses = [&] {
        for (int round = 0; round < rounds; ++round) {
            EXPECT_TRUE(eglInitialize(display, nullptr, nullptr));
            std::array<EGLConfig, 64> configs{};
            EGLint count = 0;
            const EGLint attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENVG_BIT, EGL_SURFACE_TYPE,
                                         EGL_PBUFFER_BIT, EGL_NONE};
            if (eglChooseConfig(display, attributes, configs.data(), EGLint(configs.size()), &count)) {
                EXPECT_EQ(std::ranges::count(configs, EGLConfig(nullptr)), 64 - std::min(count, 64));
            }
        }
        --choosing;
    };
    inParallel(4, [&](int i) { i == 0 ? terminates() : chooses(); });
    EXPECT_TRUE(eglInitialize(display, nullptr, nullptr));
}

}  // namespace
}  // namespace vtm::egl::testing
