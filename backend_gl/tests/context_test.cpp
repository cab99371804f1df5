// Contexts: ours and users', several of them, lost ones, full ones.
#include <functional>
#include <optional>

#include <EGL/egl.h>

#include <vtm/gl/sampled_texture.hpp>
#include "asset/testing.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using namespace asset::test;

/// Of GL_KHR_robustness.
constexpr unsigned unknownReset = 0x8255;

const asset::View view = turnedView(40, 40, {32, 32}, 0.6, 0.3);

std::vector<float> pictureOf(Renderer& renderer, const asset::Asset& asset = everyPaint()) {
    return renderer.render(renderer.upload(asset), view).rgba;
}

/// Tests that make contexts of their own.
class Contexts : public Gl {
protected:
    void SetUp() override {
        Gl::SetUp();
        if (context)
            context->makeCurrent();
    }
    void TearDown() override {
        if (context)
            context->makeCurrent();
    }
};

std::string refusalOf(const std::function<void()>& work) {
    try {
        work();
    } catch (const GlError& error) {
        return error.what();
    }
    return "";
}

TEST_F(Contexts, WithoutOneThereIsNoRenderer) {
    std::optional<Context> gone(std::in_place);
    gone.reset();
    EXPECT_EQ(refusalOf([] { Renderer(); }), "no GL context is current");
}

TEST_F(Contexts, WithoutOneThereIsNoSampledTexture) {
    std::optional<Context> gone(std::in_place);
    gone.reset();
    EXPECT_EQ(refusalOf([] { const SampledTexture made(halfPlane()); }), "no GL context is current");
}

TEST_F(Contexts, OlderOnesAreRefusedByName) {
    const EGLDisplay display = eglGetCurrentDisplay();
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 1, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        GTEST_SKIP() << "no OpenGL ES 1";
    const EGLContext old = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    if (old == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, old))
        GTEST_SKIP() << "no OpenGL ES 1";
    EXPECT_NE(refusalOf([] { Renderer(); }).find("OpenGL ES 3.0 or later is needed"), std::string::npos);
    context->makeCurrent();
    eglDestroyContext(display, old);
}

TEST_F(Contexts, UsersOwnAreGoodEnough) {
    const EGLDisplay display = eglGetCurrentDisplay();
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    ASSERT_TRUE(eglChooseConfig(display, wanted, &config, 1, &count));
    const std::vector<float> expected = pictureOf(*renderer);
    const EGLContext users = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    ASSERT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, users));
    {
        Renderer inUsers;
        EXPECT_EQ(pictureOf(inUsers), expected);
    }
    context->makeCurrent();
    eglDestroyContext(display, users);
}

TEST_F(Contexts, ARendererWantsItsOwn) {
    const Texture texture = renderer->upload(disc());
    const Context other;
    EXPECT_EQ(refusalOf([&] { renderer->render(texture, view); }), "the renderer's context is not current");
    EXPECT_EQ(refusalOf([&] { renderer->draw(texture, view, Output{}); }),
              "the renderer's context is not current");
    EXPECT_EQ(refusalOf([&] { renderer->upload(disc()); }), "the renderer's context is not current");
    context->makeCurrent();
    EXPECT_NO_THROW(renderer->render(texture, view));
}

TEST_F(Contexts, SeveralDrawInTurns) {
    const std::vector<float> expected = pictureOf(*renderer), layered = pictureOf(*renderer, layers());
    for (const bool share : {false, true}) {
        ContextOptions options;
        options.share = share ? context.get() : nullptr;
        const Context second(options);
        Renderer other;
        const Texture there = other.upload(everyPaint());
        context->makeCurrent();
        const Texture here = renderer->upload(layers());
        for (int i = 0; i < 3; ++i) {
            second.makeCurrent();
            EXPECT_EQ(other.render(there, view).rgba, expected);
            context->makeCurrent();
            EXPECT_EQ(renderer->render(here, view).rgba, layered);
        }
        second.makeCurrent();
    }
}

TEST_F(Contexts, OnesThatAreGoneAreRebuiltFromTheAsset) {
    const std::vector<float> expected = pictureOf(*renderer);
    auto first = std::make_unique<Context>();
    auto old = std::make_unique<Renderer>();
    auto texture = std::make_unique<Texture>(old->upload(everyPaint()));
    EXPECT_EQ(old->render(*texture, view).rgba, expected);
    first.reset();
    EXPECT_EQ(refusalOf([&] { old->render(*texture, view); }), "the renderer's context is not current");
    texture.reset();
    old.reset();
    const Context second;
    Renderer anew;
    EXPECT_EQ(pictureOf(anew), expected);
}

/// Names are small numbers that every context gives out again.
TEST_F(Contexts, NothingIsDeletedInAnother) {
    const Context first;
    auto old = std::make_unique<Renderer>();
    auto texture = std::make_unique<Texture>(old->upload(everyPaint()));
    old->render(*texture, view);
    const Context second;
    GLuint textures[64], buffers[64], framebuffers[64], arrays[64];
    glGenTextures(64, textures);
    glGenBuffers(64, buffers);
    glGenFramebuffers(64, framebuffers);
    glGenVertexArrays(64, arrays);
    for (std::size_t i = 0; i < 64; ++i) {
        glBindTexture(GL_TEXTURE_2D, textures[i]);
        glBindBuffer(GL_ARRAY_BUFFER, buffers[i]);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers[i]);
        glBindVertexArray(arrays[i]);
    }
    texture.reset();
    old.reset();
    for (std::size_t i = 0; i < 64; ++i)
        EXPECT_TRUE(glIsTexture(textures[i]) && glIsBuffer(buffers[i]) && glIsFramebuffer(framebuffers[i]) &&
                    glIsVertexArray(arrays[i]));
}

TEST_F(Contexts, LossIsAnErrorUntilAllIsRebuilt) {
    const std::vector<float> expected = pictureOf(*renderer);
    unsigned status = 0;
    RendererOptions options;
    options.resetStatus = [&] { return status; };
    Renderer old(options);
    const Texture texture = old.upload(everyPaint());
    EXPECT_EQ(old.render(texture, view).rgba, expected);
    EXPECT_FALSE(old.lost());
    status = unknownReset;
    EXPECT_TRUE(old.lost());
    EXPECT_THROW(old.render(texture, view), ContextLost);
    status = 0;  // GL tells once; what was lost stays so
    EXPECT_TRUE(old.lost());
    EXPECT_THROW(old.upload(disc()), ContextLost);
    EXPECT_THROW(old.renderBitmap(texture, view), ContextLost);
    Renderer anew(options);
    EXPECT_EQ(pictureOf(anew), expected);
}

TEST_F(Contexts, LossWhileDrawingIsAnErrorOfThatCall) {
    int questions = 0;
    RendererOptions options;
    options.resetStatus = [&] { return ++questions > 3 ? unknownReset : 0u; };
    Renderer old(options);
    const Texture texture = old.upload(disc());
    questions = 2;  // the next is at the beginning of the call, the one after it at its end
    EXPECT_THROW(old.render(texture, view), ContextLost);
    EXPECT_TRUE(old.lost());
}

TEST_F(Contexts, DriversTellOfLossWhereTheyCan) {
    if (!hasExtension("GL_KHR_robustness") && !hasExtension("GL_EXT_robustness"))
        GTEST_SKIP() << "the driver has no robustness extension";
    const Context robust;
    const std::function<unsigned()> status = driversResetStatus();
    if (!status)
        GTEST_SKIP() << "EGL gives no notice of resets";
    EXPECT_EQ(status(), 0u);
    ContextOptions options;
    options.robust = false;
    const Context plain(options);
    EXPECT_FALSE(driversResetStatus());
}

TEST_F(Contexts, FullMemoryIsAnErrorThatRenderersSurvive) {
    const std::vector<float> expected = pictureOf(*renderer);
    const Texture texture = renderer->upload(everyPaint());
    const int side = limit(GL_MAX_TEXTURE_SIZE);
    std::vector<TextureHandle> taken;
    bool full = false;
    for (int i = 0; i < 4 && !full; ++i) {
        try {
            taken.push_back(makeTexture(GL_RGBA32F, side, side));
        } catch (const OutOfMemory&) {
            full = true;
        }
    }
    if (!full)
        GTEST_SKIP() << "memory for " << taken.size() << " of the largest textures";
    EXPECT_EQ(renderer->render(texture, view).rgba, expected);
    EXPECT_EQ(pictureOf(*renderer), expected);
}

}  // namespace
}  // namespace vtm::gl
