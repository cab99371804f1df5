#include "raster/blend.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

namespace vtm::asset {
namespace {

using glm::vec4;

constexpr unsigned modes = unsigned(Blend::PlusLighter) + 1;

void expectNear(vec4 a, vec4 b, const char* what = "") {
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(a[c], b[c], 1e-6f) << what << " channel " << c;
}

/// Opaque colours: the result is B(cb, cs) alone. Values worked by hand from section 10's formulas.
struct Case {
    Blend mode;
    float backdrop, source, result;
};

TEST(Blend, SeparableModesOnOpaqueGreys) {
    for (const Case c : {Case{Blend::Normal, 0.25f, 0.6f, 0.6f},
                         {Blend::Multiply, 0.25f, 0.6f, 0.15f},
                         {Blend::Screen, 0.25f, 0.6f, 0.7f},
                         {Blend::Overlay, 0.25f, 0.6f, 0.3f},  // hard light with roles swapped: 2 · .25 · .6
                         {Blend::Overlay, 0.75f, 0.6f, 0.8f},  // screen(.6, .5)
                         {Blend::Darken, 0.25f, 0.6f, 0.25f},
                         {Blend::Lighten, 0.25f, 0.6f, 0.6f},
                         {Blend::ColorDodge, 0.25f, 0.6f, 0.625f},
                         {Blend::ColorDodge, 0, 1, 0},
                         {Blend::ColorDodge, 0.5f, 1, 1},
                         {Blend::ColorBurn, 0.75f, 0.5f, 0.5f},
                         {Blend::ColorBurn, 1, 0, 1},
                         {Blend::ColorBurn, 0.5f, 0, 0},
                         {Blend::HardLight, 0.25f, 0.6f, 0.4f},  // screen(.25, .2)
                         {Blend::HardLight, 0.25f, 0.4f, 0.2f},  // 2 · .25 · .4
                         {Blend::SoftLight, 0.25f, 0.25f, 0.15625f},
                         {Blend::SoftLight, 0.64f, 0.75f, 0.72f},  // .64 + .5 (.8 - .64)
                         {Blend::SoftLight, 0.125f, 0.75f, 0.234375f},
                         {Blend::Difference, 0.25f, 0.6f, 0.35f},
                         {Blend::Exclusion, 0.25f, 0.6f, 0.55f}}) {
        const vec4 result =
            blend(c.mode, vec4(c.source, c.source, c.source, 1), vec4(c.backdrop, c.backdrop, c.backdrop, 1));
        EXPECT_NEAR(result.g, c.result, 1e-6f)
            << "mode " << unsigned(c.mode) << " of " << c.source << " on " << c.backdrop;
        EXPECT_EQ(result.a, 1);
    }
}

TEST(Blend, PlusLighterAddsUpToOne) {
    expectNear(blend(Blend::PlusLighter, {0.25f, 0.125f, 0, 0.25f}, {0.5f, 0.25f, 0, 0.5f}),
               {0.75f, 0.375f, 0, 0.75f});
    expectNear(blend(Blend::PlusLighter, {0.5f, 0.25f, 0, 1}, {0.75f, 0, 0, 1}), {1, 0.25f, 0, 1});
}

float lum(vec4 c) { return 0.3f * c.r + 0.59f * c.g + 0.11f * c.b; }
float sat(vec4 c) { return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}); }

TEST(Blend, NonSeparableModesTakeWhatTheirNamesSay) {
    const vec4 source(0.5f, 0.4f, 0.3f, 1), backdrop(0.45f, 0.5f, 0.55f, 1);
    EXPECT_NEAR(lum(blend(Blend::Luminosity, source, backdrop)), lum(source), 1e-6f);
    EXPECT_NEAR(sat(blend(Blend::Luminosity, source, backdrop)), sat(backdrop), 1e-6f);
    EXPECT_NEAR(lum(blend(Blend::Color, source, backdrop)), lum(backdrop), 1e-6f);
    EXPECT_NEAR(sat(blend(Blend::Color, source, backdrop)), sat(source), 1e-6f);
    EXPECT_NEAR(sat(blend(Blend::Saturation, source, backdrop)), sat(source), 1e-6f);
    const vec4 hue = blend(Blend::Hue, source, backdrop);
    EXPECT_NEAR(sat(hue), sat(backdrop), 1e-6f);
    EXPECT_NEAR((hue.r - hue.g) / (hue.g - hue.b), 1, 1e-4f);  // the source's hue: equal steps
}

TEST(Blend, ClippedColoursStayInRange) {
    const vec4 result = blend(Blend::Luminosity, vec4(1, 1, 0.9f, 1), vec4(0, 0, 1, 1));
    for (int c = 0; c < 3; ++c) {
        EXPECT_GE(result[c], -1e-6f);
        EXPECT_LE(result[c], 1 + 1e-6f);
    }
}

TEST(Blend, EveryModeLeavesWhatTheOtherDoesNotCover) {
    const vec4 color(0.3f, 0.1f, 0.2f, 0.4f);
    for (unsigned m = 0; m < modes; ++m) {
        expectNear(blend(Blend(m), color, vec4(0)), color, "on nothing");
        expectNear(blend(Blend(m), vec4(0), color), color, "of nothing");
    }
}

TEST(Blend, NormalIsSourceOver) {
    expectNear(blend(Blend::Normal, vec4(0.2f, 0, 0, 0.5f), vec4(0, 0.6f, 0, 0.6f)),
               vec4(0.2f, 0.3f, 0, 0.8f));
}

TEST(Blend, TranslucentMixWeighsTheThreeShares) {
    // as = ab = 1/2: a quarter of each alone, a quarter of the product.
    expectNear(blend(Blend::Multiply, vec4(0.5f, 0, 0, 0.5f), vec4(0.25f, 0.25f, 0, 0.5f)),
               vec4(0.25f + 0.125f + 0.125f, 0.125f, 0, 0.75f));
}

TEST(Mask, Factors) {
    const vec4 mask(0.25f, 0.1f, 0, 0.5f);
    EXPECT_FLOAT_EQ(maskFactor(Op::PopMaskAlpha, mask), 0.5f);
    EXPECT_NEAR(maskFactor(Op::PopMaskLuminance, mask), 0.2126f * 0.25f + 0.7152f * 0.1f, 1e-6f);
    // Straight 0.5 and 0.2 are 0.214041 and 0.033105 in linear light (IEC 61966-2-1).
    EXPECT_NEAR(maskFactor(Op::PopMaskLinear, mask), 0.5f * (0.2126f * 0.214041f + 0.7152f * 0.033105f),
                1e-6f);
    EXPECT_EQ(maskFactor(Op::PopMaskLinear, vec4(0)), 0);
    EXPECT_NEAR(maskFactor(Op::PopMaskLinear, vec4(1)), 1, 1e-6f);
}

}  // namespace
}  // namespace vtm::asset
