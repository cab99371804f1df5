/// \file
/// A context and a renderer for tests; without an EGL device they are skipped with its reason.
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include <vtm/gl/renderer.hpp>

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

}  // namespace vtm::gl
