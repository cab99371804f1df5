/// \file
/// A context and a renderer for tests; without an EGL device they are skipped with its reason.
#pragma once

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <vtm/gl/renderer.hpp>
#include <vtm/image/bitmap.hpp>
#include "backend_gl/core/gl.hpp"

namespace vtm::gl {

/// One context for all tests of a suite.
class Gl : public testing::Test {
protected:
    static void SetUpTestSuite() {
        try {
            context = std::make_unique<Context>();
        } catch (const GlError& error) {
            refusal = error.what();
            return;
        }
        RendererOptions shaders;
        shaders.pixels = Pixels::Shaders;
        renderer = std::make_unique<Renderer>(shaders);
    }
    static void TearDownTestSuite() {
        renderer.reset();
        context.reset();
    }
    void SetUp() override {
        if (!context)
            GTEST_SKIP() << refusal;
    }

    static inline std::unique_ptr<Context> context;
    static inline std::unique_ptr<Renderer> renderer;
    static inline std::string refusal;
};

/// Left bound. Its pixels are `ground` at first.
class UserFramebuffer {
public:
    UserFramebuffer(GLenum format, int w, int h, std::array<float, 4> ground = {0, 0, 0, 0}, int samples = 0)
        : width(w), height(h) {
        GLuint ids[2];
        glGenRenderbuffers(1, ids);
        glGenFramebuffers(1, ids + 1);
        renderbuffer_ = ids[0];
        framebuffer = FramebufferHandle(ids[1]);
        glBindRenderbuffer(GL_RENDERBUFFER, ids[0]);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, w, h);
        bind();
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, ids[0]);
        glClearBufferfv(GL_COLOR, 0, ground.data());
        checkErrors("user's framebuffer");
    }
    ~UserFramebuffer() { glDeleteRenderbuffers(1, &renderbuffer_); }
    UserFramebuffer(const UserFramebuffer&) = delete;
    UserFramebuffer& operator=(const UserFramebuffer&) = delete;

    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get()); }

    /// Stored numbers, row 0 first.
    std::vector<std::uint8_t> bytes() const {
        std::vector<std::uint8_t> pixels(std::size_t(width * height) * 4);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.get());
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        checkErrors("reading bytes");
        return pixels;
    }
    /// Of RGB10_A2.
    image::Raster tens() const {
        std::vector<std::uint32_t> words(std::size_t(width * height));
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.get());
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, words.data());
        checkErrors("reading tens");
        image::Raster raster(width, height);
        for (std::size_t i = 0; i < words.size(); ++i)
            for (std::size_t c = 0; c < 4; ++c)
                raster.rgba[4 * i + c] =
                    float(words[i] >> (10 * c) & (c == 3 ? 3u : 1023u)) / (c == 3 ? 3.0f : 1023.0f);
        return raster;
    }
    image::Raster floats() const {
        image::Raster raster(width, height);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.get());
        glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, raster.rgba.data());
        checkErrors("reading floats");
        return raster;
    }

    int width, height;
    FramebufferHandle framebuffer;

private:
    GLuint renderbuffer_ = 0;
};

}  // namespace vtm::gl
