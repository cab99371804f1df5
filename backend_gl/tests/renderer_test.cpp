#include "backend_gl/renderer.hpp"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "asset/evaluate.hpp"
#include "asset/tests/assets.hpp"
#include "asset/tests/views.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using asset::View;
using namespace asset::test;

/// One context for all tests of the process; without an EGL device they are skipped by name.
class Gl : public testing::Test {
protected:
    static void SetUpTestSuite() {
        try {
            context = std::make_unique<Context>();
        } catch (const GlError& error) {
            refusal = error.what();
            return;
        }
        renderer = std::make_unique<Renderer>();
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

struct Worst {
    double difference = 0;
    int x = 0, y = 0;
};

Worst worst(const image::Raster& a, const image::Raster& b) {
    Worst w;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 4; ++c)
                if (const double d = std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]); d > w.difference)
                    w = {d, x, y};
    return w;
}

/// Both run the same steps in single precision; only the roundings differ (docs/coverage.md). The
/// issue allows 2/255.
constexpr double twinTolerance = 0.25 / 255;

void expectTwins(Renderer& renderer, const Asset& asset, int views = 25, double tolerance = twinTolerance) {
    const Texture texture = renderer.upload(asset);
    std::mt19937 random(11);
    for (int i = 0; i < views; ++i) {
        const View view = randomView(random);
        const Worst w = worst(renderer.render(texture, view), asset::evaluate(asset, view));
        ASSERT_LE(w.difference, tolerance) << "view " << i << " pixel " << w.x << ", " << w.y;
    }
}

TEST_F(Gl, HalfPlane) { expectTwins(*renderer, halfPlane()); }
TEST_F(Gl, Wedge) { expectTwins(*renderer, wedge()); }
TEST_F(Gl, Strip) { expectTwins(*renderer, strip()); }
TEST_F(Gl, ThreeRegions) { expectTwins(*renderer, threeRegions()); }
TEST_F(Gl, Arcs) { expectTwins(*renderer, disc()); }
TEST_F(Gl, TwoLevelTree) { expectTwins(*renderer, twoLevels()); }
TEST_F(Gl, EveryPaint) { expectTwins(*renderer, everyPaint()); }
TEST_F(Gl, CompatCommands) { expectTwins(*renderer, layers()); }

TEST_F(Gl, EveryBlendMode) {
    for (unsigned mode = 0; mode <= unsigned(asset::Blend::Luminosity); ++mode) {
        SCOPED_TRACE(mode);
        expectTwins(*renderer, blendAsset(asset::Blend(mode)), 4);
    }
}

}  // namespace
}  // namespace vtm::gl
