// How fast paints change, and what that is for: a part of a pixel has the colours of that part.

#include "asset/steepness.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <vtm/asset/evaluate.hpp>
#include <vtm/asset/scan.hpp>
#include "asset/src/paint.hpp"
#include "asset/src/row_sums.hpp"
#include "asset/testing.hpp"
#include "asset/testing_views.hpp"

namespace vtm::asset::test {
namespace {

using glm::dmat2;
using glm::vec2;

constexpr float infinity = std::numeric_limits<float>::infinity();

GradientStop grey(float offset, float value, float alpha = 1) {
    const auto word = [](float v) { return std::uint16_t(std::lround(v * 65535)); };
    return {offset, {word(value), word(value), word(value), word(alpha)}, 0};
}

Gradient gradient(Spread spread = Spread::Pad, float scale = 1) {
    Gradient g;
    g.matrix = {scale, 0, 0, scale, 0, 0};
    g.spread = spread;
    return g;
}

/// Of a program, the map's only paint.
float steepnessOfProgram(const std::vector<Instruction>& program, const std::vector<Texel>& data) {
    const Asset asset = programAsset(program, data);
    return steepnessOf(asset)[asset.maps[0].root.payload()];
}

float steepness(Op op, Gradient g, const std::vector<GradientStop>& stops, float opacity = 1) {
    g.stopCount = std::uint32_t(stops.size());
    std::vector<Texel> data;
    addGradient(data, g, stops);
    return steepnessOfProgram({{op, Blend::Normal, opacity, 0}}, data);
}

const std::vector<GradientStop> blackToWhite{grey(0, 0), grey(1, 1)};

TEST(Steepness, OfLinearGradientsIsTheSteepestStretch) {
    EXPECT_FLOAT_EQ(steepness(Op::Linear, gradient(), blackToWhite), 1);
    EXPECT_FLOAT_EQ(steepness(Op::Linear, gradient(Spread::Pad, 3), blackToWhite, 0.5f), 1.5f);
    EXPECT_FLOAT_EQ(
        steepness(Op::Linear, gradient(Spread::Reflect), {grey(0, 0), grey(0.25f, 1), grey(1, 0)}), 4);
    Gradient turned = gradient();
    turned.matrix = {3, 7, 4, 9, 1, 1};
    EXPECT_FLOAT_EQ(steepness(Op::Linear, turned, blackToWhite), 5);
}

TEST(Steepness, OfRadialGradientsGrowsWithTheFocus) {
    EXPECT_FLOAT_EQ(steepness(Op::Radial, gradient(Spread::Pad, 2), blackToWhite), 2);
    Gradient g = gradient(Spread::Pad, 2);
    g.fx = 0.3f;
    g.fy = 0.4f;
    EXPECT_FLOAT_EQ(steepness(Op::Radial, g, blackToWhite), 4);
    g.fx = 0.9f;
    EXPECT_EQ(steepness(Op::Radial, g, blackToWhite), infinity);
}

TEST(Steepness, OfWhatHasNoBoundIsInfinite) {
    const std::vector<GradientStop> hard{grey(0, 0), grey(0.5f, 0), grey(0.5f, 1), grey(1, 1)};
    EXPECT_EQ(steepness(Op::Linear, gradient(), hard), infinity);
    EXPECT_EQ(steepness(Op::Linear, gradient(Spread::Repeat), blackToWhite), infinity);
    EXPECT_EQ(steepness(Op::Linear, gradient(), std::vector(300, grey(0, 0))), infinity);
    EXPECT_EQ(steepnessOfProgram({{Op::Material, Blend::Normal, 1, 0}}, {}), infinity);
    EXPECT_EQ(steepnessOfProgram({{Op::Material, Blend::Normal, 0, 0}}, {}), 0);
}

TEST(Steepness, OfProgramsWithImagesIsNothing) {
    std::vector<Texel> data;
    addImage(data, {{1, 0, 0, 1, 0, 0}, 0, ImageFilter::Bilinear});
    EXPECT_EQ(steepnessOfProgram({{Op::Image, Blend::Normal, 1, 0}}, data), 0);
    Gradient g = gradient();
    g.stopCount = 2;
    const std::uint32_t ramp = addGradient(data, g, blackToWhite);
    EXPECT_EQ(
        steepnessOfProgram({{Op::Linear, Blend::Normal, 1, ramp}, {Op::Image, Blend::Normal, 1, 0}}, data),
        0);
}

TEST(Steepness, OfLittleChangeIsNothing) {
    EXPECT_EQ(steepness(Op::Linear, gradient(), {grey(0, 0.5f), grey(0.5f, 0.5f), grey(0.5f, 0.52f)}), 0);
    EXPECT_EQ(steepness(Op::Linear, gradient(Spread::Repeat), {grey(0, 0.5f), grey(1, 0.5f)}), 0);
    for (const float s : steepnessOf(halfPlane()))
        EXPECT_EQ(s, 0);
}

/// Blend modes may make anything of a change, but not of none.
TEST(Steepness, OfGroups) {
    std::vector<Texel> data;
    Gradient g = gradient();
    g.stopCount = 2;
    const std::uint32_t ramp = addGradient(data, g, blackToWhite), color = addColor(data, haze);
    const auto inGroup = [&](Op op, std::uint32_t argument, Blend blend) {
        return steepnessOfProgram({{Op::Linear, Blend::Normal, argument == color ? 0.0f : 1.0f, ramp},
                                   {Op::Push, Blend::Normal, 1, 0},
                                   {op, Blend::Normal, 1, argument},
                                   {Op::Pop, blend, 1, 0}},
                                  data);
    };
    EXPECT_FLOAT_EQ(inGroup(Op::Linear, ramp, Blend::Normal), 2);
    EXPECT_EQ(inGroup(Op::Linear, ramp, Blend::ColorDodge), infinity);
    EXPECT_EQ(inGroup(Op::Solid, color, Blend::ColorDodge), 0);
}

/// No two points of a picture with every kind of paint differ by more.
TEST(Steepness, BoundsEveryPaint) {
    const Asset asset = everyPaint();
    const Paints paints(asset);
    const std::vector<float> steepness = steepnessOf(asset);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    int bounded = 0;
    for (std::uint32_t paint = 0; paint < asset.paints.size(); ++paint) {
        if (!isProgram(asset.paints[paint]) || steepness[paint] == infinity || steepness[paint] == 0)
            continue;  // 0: programs with images, and others that do not change
        ++bounded;
        for (int i = 0; i < 3000; ++i) {
            const vec2 p(64 * unit(random), 64 * unit(random));
            const vec2 q = p + 0.25f * (vec2(unit(random), unit(random)) - 0.5f);
            const glm::vec4 change = paints.color(paint, {p}) - paints.color(paint, {q});
            for (int c = 0; c < 4; ++c)
                ASSERT_LE(std::abs(change[c]), steepness[paint] * glm::length(p - q) + 1e-4f) << paint;
        }
    }
    EXPECT_GE(bounded, 3);
}

TEST(Steepness, LeastIsThatOfAPixelsLongestStep) {
    EXPECT_FLOAT_EQ(leastSteepness(dmat2(0.5, 0, 0, 0.25)), float(2 * leastSteepChange));
    EXPECT_FLOAT_EQ(leastSteepness(dmat2(0.6, 0.8, -0.8, 0.6)), float(leastSteepChange));
}

// ---- Parts of pixels ------------------------------------------------------------------------------

/// Triangles that reach beyond the picture, against 64 × 64 points a quarter: off by less than what a row of
/// points is for each of three edges.
TEST(Quarters, AreThoseOfDensePoints) {
    constexpr int width = 7, height = 5, side = 64;
    std::mt19937 random(23);
    std::uniform_real_distribution<float> unit(0, 1);
    Accumulator<Quarters> quarters;
    quarters.resize(width);
    for (int i = 0; i < 60; ++i) {
        std::array<vec2, 3> p;
        for (vec2& corner : p)
            corner = vec2(-2, -2) + vec2(width + 4, height + 4) * vec2(unit(random), unit(random));
        const auto side2 = [](vec2 a, vec2 b, vec2 q) {
            return (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x);
        };
        const float sign = side2(p[0], p[1], p[2]) > 0 ? 1.0f : -1.0f;
        for (std::size_t k = 0; k < 3; ++k)
            quarters.add({p[k], p[(k + 1) % 3], 1, 0}, 0, height, sign);
        for (int y = 0; y < height; ++y)
            quarters.resolve(std::size_t(y), [&](int first, int end, Float4 shares) {
                for (int x = first; x < end; ++x)
                    for (int q = 0; q < 4; ++q) {
                        int within = 0;
                        for (int n = 0; n < side * side; ++n) {
                            const vec2 inQuarter = (vec2(n % side, n / side) + 0.5f) / float(side);
                            const vec2 point = vec2(x, y) + 0.5f * (vec2(q % 2, q / 2) + inQuarter);
                            within += sign * side2(p[0], p[1], point) > 0 &&
                                      sign * side2(p[1], p[2], point) > 0 &&
                                      sign * side2(p[2], p[0], point) > 0;
                        }
                        ASSERT_NEAR(shares[q], float(within) / (side * side), 1.5f / side) << x << ' ' << y;
                    }
            });
    }
}

double worst(const image::Raster& a, const image::Raster& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        worst = std::max(worst, std::abs(double(a.rgba[i]) - double(b.rgba[i])));
    return worst;
}

/// `change`: of shades over a pixel; `bound`: in 1/255.
void expectPartsToHaveTheirColors(double change, double bound) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 24; ++i) {
        const double zoom = std::exp2(1 + 5 * unit(random)), length = 1 / (change * zoom);
        const View view = turnedView(24, 18, {29 + unit(random), 31 + unit(random)}, zoom,
                                     6.28 * unit(random), i % 2 == 0 ? 0 : 0.4, i % 3 == 0);
        const Asset asset = steepHalves(length);
        const image::Raster points = steepHalvesByPoints(length, view);
        EXPECT_LE(255 * worst(evaluate(asset, view), points), bound) << "evaluator, view " << i;
        EXPECT_LE(255 * worst(Scanner(asset).draw(view), points), bound) << "scanner, view " << i;
    }
}

TEST(Steepness, PartsHaveTheirColorsWhereAGradientIsSteep) { expectPartsToHaveTheirColors(0.25, 3); }
TEST(Steepness, PartsHaveTheirColorsWhereAGradientIsSmall) { expectPartsToHaveTheirColors(0.8, 3); }
TEST(Steepness, PartsHaveTheirColorsWhereAGradientIsAsSmallAsAPixel) { expectPartsToHaveTheirColors(1, 4); }

// ---- Rough pixels ---------------------------------------------------------------------------------

constexpr int truthSide = 32;

/// Every pixel the mean of truthSide² of the scanner's, which are so fine that nothing is rough in them.
image::Raster meanOfFinePicture(const Scanner& scanner, const View& view) {
    View fine = view;
    fine.width *= truthSide;
    fine.height *= truthSide;
    for (int i = 0; i < 3; ++i)
        fine.toPixels[i] *= double(truthSide);
    const image::Raster points = scanner.draw(fine);
    image::Raster mean(view.width, view.height);
    for (int y = 0; y < fine.height; ++y)
        for (int x = 0; x < fine.width; ++x)
            for (int c = 0; c < 4; ++c)
                mean.pixel(x / truthSide, y / truthSide)[c] +=
                    points.pixel(x, y)[c] / float(truthSide * truthSide);
    return mean;
}

/// Layers of gradients that change together, and blend modes, in pixels that hold much of them.
void expectMeans(const Asset& asset, double bound) {
    const Scanner scanner(asset);
    std::mt19937 random(29);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 12; ++i) {
        const View view =
            turnedView(12, 9, {29 + unit(random), 31 + unit(random)}, std::exp2(-2 + 3 * unit(random)),
                       6.28 * unit(random), i % 2 == 0 ? 0 : 0.4, i % 3 == 0);
        const image::Raster truth = meanOfFinePicture(scanner, view);
        EXPECT_LE(255 * worst(scanner.draw(view), truth), bound) << "scanner, view " << i;
        EXPECT_LE(255 * worst(evaluate(asset, view), truth), bound) << "evaluator, view " << i;
    }
}

TEST(Rough, BlendedLayersAreTheirMean) {
    for (const Blend mode : {Blend::Normal, Blend::Multiply, Blend::Overlay, Blend::Difference}) {
        SCOPED_TRACE(unsigned(mode));
        expectMeans(blendAsset(mode), 4);
    }
}
/// Their colours jump, where what is below is grey or the division ends at 1, and no four points need show
/// it.
TEST(Rough, LayersOfModesThatJumpAreNearlyTheirMean) {
    for (const Blend mode : {Blend::ColorDodge, Blend::Hue})
        expectMeans(blendAsset(mode), 8);
}
TEST(Rough, LayersUnderAnEdgeAreTheirMean) { expectMeans(steepHalves(8), 4); }

}  // namespace
}  // namespace vtm::asset::test
