#include "raster/src/paint.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "asset/testing.hpp"

namespace vtm::asset::test {
namespace {

using glm::mat2;
using glm::vec2;
using glm::vec4;

void expectNear(vec4 a, vec4 b, float tolerance = 1e-5f) {
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

GradientStop grey(float offset, float value, float alpha = 1) {
    const auto v = std::uint16_t(std::lround(value * 65535)), a = std::uint16_t(std::lround(alpha * 65535));
    return {offset, {v, v, v, a}, 0};
}

/// The colour of a program of one layer.
vec4 colorOf(Op op, const std::vector<Texel>& data, const PaintPlace& place, float opacity = 1) {
    const Asset asset = programAsset({{op, Blend::Normal, opacity, 0}}, data);
    return Paints(asset).color(asset.maps[0].root.payload(), place);
}

/// Over a pixel about a place, or at it.
vec4 ramp(Op op, Gradient gradient, const PaintPlace& place,
          std::vector<GradientStop> stops = {grey(0, 0), grey(1, 1)}) {
    gradient.stopCount = std::uint32_t(stops.size());
    std::vector<Texel> data;
    addGradient(data, gradient, stops);
    return colorOf(op, data, place);
}
vec4 ramp(Op op, const Gradient& gradient, vec2 point,
          std::vector<GradientStop> stops = {grey(0, 0), grey(1, 1)}) {
    return ramp(op, gradient, PaintPlace{point}, std::move(stops));
}

/// The mean of the colours at 256 × 256 points of the pixel.
vec4 sampled(Op op, const Gradient& gradient, const PaintPlace& place,
             const std::vector<GradientStop>& stops) {
    constexpr int side = 256;
    Gradient whole = gradient;
    whole.stopCount = std::uint32_t(stops.size());
    std::vector<Texel> data;
    addGradient(data, whole, stops);
    const Asset asset = programAsset({{op, Blend::Normal, 1, 0}}, data);
    const Paints paints(asset);
    glm::dvec4 sum(0);
    for (int i = 0; i < side * side; ++i) {
        const vec2 offset((float(i % side) + 0.5f) / side - 0.5f, (float(i / side) + 0.5f) / side - 0.5f);
        sum += paints.color(asset.maps[0].root.payload(), {place.point + place.pixel * offset});
    }
    return sum / double(side * side);
}

Gradient spread(Spread s) {
    Gradient g;
    g.spread = s;
    return g;
}

TEST(Paint, ShortTranslucentStretchesAreBent) {
    const std::vector<GradientStop> stops{grey(0.5f, 0, 0), grey(0.55f, 1, 1)};
    for (const float side : {0.005f, 0.01f, 0.02f, 0.04f}) {
        const PaintPlace place{vec2(0.525f, 0), mat2(side)};
        expectNear(ramp(Op::Linear, {}, place, stops), sampled(Op::Linear, {}, place, stops), 0.2f / 255);
    }
}

TEST(Paint, LinearGradientSpreads) {
    for (const auto& [x, pad, reflect, repeat] : {std::array{0.25f, 0.25f, 0.25f, 0.25f},
                                                  {-0.25f, 0, 0.25f, 0.75f},
                                                  {1.25f, 1, 0.75f, 0.25f},
                                                  {2.5f, 1, 0.5f, 0.5f},
                                                  {-3.25f, 0, 0.75f, 0.75f}}) {
        EXPECT_NEAR(ramp(Op::Linear, spread(Spread::Pad), {x, 9}).r, pad, 1e-5f);
        EXPECT_NEAR(ramp(Op::Linear, spread(Spread::Reflect), {x, 9}).r, reflect, 1e-5f);
        EXPECT_NEAR(ramp(Op::Linear, spread(Spread::Repeat), {x, 9}).r, repeat, 1e-5f);
    }
}

TEST(Paint, GradientMatrixMapsThePicture) {
    Gradient g;
    g.matrix = {0.1f, 5, 0.02f, 7, 0.3f, 9};
    EXPECT_NEAR(ramp(Op::Linear, g, {2, 10}).r, 0.2f + 0.2f + 0.3f, 1e-5f);
}

TEST(Paint, StopsInterpolateStraightThenPremultiply) {
    expectNear(ramp(Op::Linear, {}, {0.5f, 0}, {grey(0, 1, 1), grey(1, 0, 0)}),
               vec4(0.25f, 0.25f, 0.25f, 0.5f));
}

TEST(Paint, HardStopCountsFromItsOffsetOn) {
    const std::vector<GradientStop> stops{grey(0, 0), grey(0.5f, 0.2f), grey(0.5f, 0.8f), grey(1, 1)};
    EXPECT_NEAR(ramp(Op::Linear, {}, {0.49999f, 0}, stops).r, 0.2f, 1e-3f);
    EXPECT_NEAR(ramp(Op::Linear, {}, {0.5f, 0}, stops).r, 0.8f, 1e-5f);
}

TEST(Paint, OutsideTheStopsTheirEndsGoOn) {
    const std::vector<GradientStop> stops{grey(0.25f, 0.3f), grey(0.75f, 0.6f)};
    EXPECT_NEAR(ramp(Op::Linear, {}, {0.1f, 0}, stops).r, 0.3f, 1e-5f);
    EXPECT_NEAR(ramp(Op::Linear, {}, {0.9f, 0}, stops).r, 0.6f, 1e-5f);
}

TEST(Paint, ManyStops) {
    std::vector<GradientStop> stops;
    for (int i = 0; i <= 100; ++i)
        stops.push_back(grey(float(i) / 100, float(i % 2)));
    for (int i = 0; i <= 100; ++i)
        EXPECT_NEAR(ramp(Op::Linear, {}, {float(i) / 100 + 1e-5f, 0}, stops).r, float(i % 2), 2e-3f) << i;
}

/// The offset shows as the grey value, and must solve the circles' equation.
const std::vector<GradientStop> kinked{grey(0, 0.2f), grey(0.25f, 1, 0.5f), grey(0.25f, 0.1f),
                                       grey(0.8f, 0.9f), grey(1, 0)};

TEST(Paint, LinearGradientIsItsMeanOverAPixelAlongIt) {
    for (const Spread s : {Spread::Pad, Spread::Reflect, Spread::Repeat})
        for (const float width : {0.01f, 0.1f, 0.7f, 1.9f})
            for (const float x : {-1.3f, -0.003f, 0.1f, 0.249f, 0.5f, 0.999f, 2.6f}) {
                const PaintPlace place{{x, 3}, mat2(width, 0, 0, width)};
                // 256 points leave a jump anywhere within a 512th of the pixel.
                expectNear(ramp(Op::Linear, spread(s), place, kinked),
                           sampled(Op::Linear, spread(s), place, kinked), 1.5f / 512);
            }
}

TEST(Paint, LinearGradientIsItsMeanOverATurnedPixel) {
    for (const float angle : {0.2f, 0.5f, 0.785f, 1.3f})
        for (const float x : {0.1f, 0.24f, 0.26f, 0.4f, 0.97f}) {
            const vec2 side = 0.2f * vec2(std::cos(angle), std::sin(angle));
            const PaintPlace place{{x, 0}, mat2(side, vec2(-side.y, side.x))};
            expectNear(ramp(Op::Linear, {}, place, kinked), sampled(Op::Linear, {}, place, kinked), 0.012f);
        }
}

/// Without jumps, so that few samples tell the mean.
const std::vector<GradientStop> bent{grey(0.1f, 0.2f, 0.3f), grey(0.4f, 1), grey(0.45f, 0.1f, 0.6f),
                                     grey(0.95f, 0.9f, 0.1f)};

TEST(Paint, LinearGradientIsItsMeanRoundAStop) {
    for (const Spread s : {Spread::Pad, Spread::Reflect})
        for (const float side : {0.07f, 0.15f, 0.3f})
            for (const float angle : {0.0f, 0.02f, 0.5f, 0.785f})
                for (const float x : {0.09f, 0.1f, 0.2f, 0.39f, 0.41f, 0.44f, 0.7f, 0.96f}) {
                    const vec2 along = side * vec2(std::cos(angle), std::sin(angle));
                    const PaintPlace place{{x, 0}, mat2(along, vec2(-along.y, along.x))};
                    expectNear(ramp(Op::Linear, spread(s), place, bent),
                               sampled(Op::Linear, spread(s), place, bent), 1e-4f);
                }
}

TEST(Paint, ARowOfALinearGradientIsItsPixels) {
    Gradient gradient;
    gradient.stopCount = std::uint32_t(bent.size());
    std::vector<Texel> data;
    addGradient(data, gradient, bent);
    const Asset asset = programAsset({{Op::Linear, Blend::Normal, 1, 0}}, data);
    const Paints paints(asset);
    for (const float step : {0.0f, 0.001f, -0.004f, 0.03f, -0.2f})
        for (const float x : {-0.2f, 0.3f, 0.42f, 1.2f}) {
            const PaintPlace first{{x, 5}, 0.7f * mat2(step, 0, 0, step)};
            std::vector<Float4> row(150);
            paints.colors(asset.maps[0].root.payload(), first, {step, 1}, row);
            for (std::size_t i = 0; i < row.size(); ++i)
                expectNear(toVec4(row[i]),
                           ramp(Op::Linear, {}, {{x + float(i) * step, 5}, first.pixel}, bent));
        }
}

TEST(Paint, PeriodicGradientFarAwayIsItsMean) {
    // Over many periods, and far from the first one: 0.5 whatever the phase.
    for (const Spread s : {Spread::Reflect, Spread::Repeat})
        expectNear(ramp(Op::Linear, spread(s), {{1234.5f, 0}, mat2(40, 0, 0, 40)}), vec4(0.5f, 0.5f, 0.5f, 1),
                   1e-4f);
}

TEST(Paint, RadialGradientIsItsMeanAtItsTip) {
    for (const float side : {0.02f, 0.1f, 0.4f})
        for (const vec2 middle :
             {vec2(0, 0), vec2(0.3f, 0.1f), vec2(0.5f, 0.5f), vec2(-0.9f, 0.4f), vec2(2, -3)}) {
            const PaintPlace place{side * middle, mat2(side, 0, 0, side)};
            expectNear(ramp(Op::Radial, {}, place), sampled(Op::Radial, {}, place, {grey(0, 0), grey(1, 1)}),
                       0.007f * side + 1e-5f);
        }
}

TEST(Paint, RadialOffsetSolvesTheCircles) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 500; ++i) {
        Gradient g;
        g.fr = 0.5f * unit(random);
        const float angle = 6.2831853f * unit(random), distance = (1 - g.fr) * 0.95f * unit(random);
        g.fx = distance * std::cos(angle);
        g.fy = distance * std::sin(angle);
        const vec2 f(g.fx, g.fy), p(2 * unit(random) - 1, 2 * unit(random) - 1);
        const float u = ramp(Op::Radial, g, p).r;
        if (u > 0 && u < 1)
            EXPECT_NEAR(glm::length(p - (1 - u) * f), (1 - u) * g.fr + u, 2e-4f);
        else
            EXPECT_TRUE(u == 0 ? glm::length(p - f) <= g.fr + 1e-4f : glm::length(p) >= 1 - 1e-4f);
    }
}

TEST(Paint, RadialIsTransparentWhereNoCircleReaches) {
    Gradient g;
    g.fx = 0.95f;  // the focal circle sticks out of the end circle: the circles fill a cone
    g.fr = 0.2f;
    expectNear(ramp(Op::Radial, g, {3, 0}), vec4(0));
    EXPECT_GT(ramp(Op::Radial, g, {-3, 0}).a, 0);
}

TEST(Paint, RadialCentreWithoutFocalRadius) { expectNear(ramp(Op::Radial, {}, {0, 0}), vec4(0, 0, 0, 1)); }

/// A footprint of `sides` image pixels.
vec4 imageAt(vec2 point, ImageFilter filter, mat2 sides = mat2(0)) {
    std::vector<Texel> data;
    addImage(data, {{1, 0, 0, 1, 0, 0}, 0, filter});
    const Asset asset = programAsset({{Op::Image, Blend::Normal, 1, 0}}, data);
    return Paints(asset).color(asset.maps[0].root.payload(), {point, sides});
}

vec4 pixel(int x, int y) {
    const image::Bitmap bitmap = smallPicture();
    const std::uint8_t* p = &bitmap.rgba[std::size_t(y * bitmap.width + x) * 4];
    const float a = float(p[3]) / 255;
    return {float(p[0]) / 255 * a, float(p[1]) / 255 * a, float(p[2]) / 255 * a, a};
}

TEST(Paint, ImagesNearest) {
    expectNear(imageAt({0.9f, 2.1f}, ImageFilter::Nearest), pixel(0, 2));
    expectNear(imageAt({1.0f, 1.9f}, ImageFilter::Nearest), pixel(1, 1));
    expectNear(imageAt({-100, 1e9f}, ImageFilter::Nearest), pixel(0, 2));
    EXPECT_TRUE(std::isfinite(imageAt({NAN, 0.5f}, ImageFilter::Nearest).a));
}

TEST(Paint, ImagesBilinear) {
    expectNear(imageAt({1.5f, 1.5f}, ImageFilter::Bilinear), pixel(1, 1));
    expectNear(imageAt({2, 1.5f}, ImageFilter::Bilinear), (pixel(1, 1) + pixel(2, 1)) * 0.5f);
    expectNear(imageAt({1.5f, 1.25f}, ImageFilter::Bilinear), pixel(1, 0) * 0.25f + pixel(1, 1) * 0.75f);
    expectNear(imageAt({0, 0}, ImageFilter::Bilinear), pixel(0, 0));
    expectNear(imageAt({99, 99}, ImageFilter::Bilinear), pixel(3, 2));
}

TEST(Paint, ImagesTrilinearAreBilinearWhereMagnified) {
    for (const vec2 p : {vec2(0.3f, 1.9f), vec2(2, 1.5f), vec2(-3, 9)})
        expectNear(imageAt(p, ImageFilter::Trilinear, mat2(0.7f, -0.7f, 0.7f, 0.7f)),
                   imageAt(p, ImageFilter::Bilinear));
}

/// A footprint as narrow as a pixel and longer: the sum of pixels beside each other, of the last ones in
/// part.
TEST(Paint, ImagesTrilinearAreReadAlongOblongFootprints) {
    const auto across = [](float x, float y) { return imageAt({x, y}, ImageFilter::Bilinear); };
    const float all = 2 - 1.0f / 64, outer = 0.5f * (all - 1);
    expectNear(imageAt({1.2f, 1.4f}, ImageFilter::Trilinear, mat2(0.1f, 0, 0, 2)),
               (across(1.2f, 1.4f) + outer * (across(1.2f, 0.4f) + across(1.2f, 2.4f))) / all);
    expectNear(imageAt({1.2f, 1.4f}, ImageFilter::Trilinear, mat2(0, 0.5f, -2, 0)),
               (across(1.2f, 1.4f) + outer * (across(0.2f, 1.4f) + across(2.2f, 1.4f))) / all);
    // Along a diagonal, to (1, 1) · 2 √2, which is 4 long.
    const float longer = 4 - 1.0f / 64, ends = 0.5f * (longer - 3), d = 0.70710678f;
    const vec2 p(2, 1.5f), side = vec2(2.8284271f);
    vec4 sum = across(p.x, p.y) + across(p.x + d, p.y + d) + across(p.x - d, p.y - d);
    sum += ends * (across(p.x + 2 * d, p.y + 2 * d) + across(p.x - 2 * d, p.y - 2 * d));
    expectNear(imageAt(p, ImageFilter::Trilinear, mat2(side, vec2(-0.3f, 0.3f))), sum / longer);
    // Hardly oblong is round: nothing is read beside it.
    expectNear(imageAt({1.2f, 1.4f}, ImageFilter::Trilinear, mat2(1.01f, 0, 0, 1)), across(1.2f, 1.4f),
               0.02f);
    EXPECT_TRUE(std::isfinite(imageAt({1, 1}, ImageFilter::Trilinear, mat2(1e30f, 0, 0, 1)).a));
}

/// Of texels along an axis, the first at 0: the share of each in the mean of what lies within width / 2 of p;
/// beyond the ends the outermost go on.
std::vector<float> shares(std::size_t texels, float p, float width) {
    std::vector<float> of(texels);
    for (int i = -8; i < 16; ++i) {
        const float share =
            std::max(0.0f, std::min(float(i + 1), p + width / 2) - std::max(float(i), p - width / 2)) / width;
        of[std::size_t(std::clamp(i, 0, int(texels) - 1))] += share;
    }
    return of;
}

/// smallPicture() is 4 x 3 pixels: its levels have 2 x 2 and 1 x 1 texels.
TEST(Paint, ImagesTrilinearAreMeansWhereMinified) {
    vec4 whole(0), level[2][2] = {};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) {
            whole += pixel(x, y) / 12.0f;
            level[y / 2][x / 2] += pixel(x, y) / (y < 2 ? 4.0f : 2.0f);
        }
    const auto ofPixels = [](vec2 p, float width) {
        const std::vector<float> across = shares(4, p.x, width), down = shares(3, p.y, width);
        vec4 sum(0);
        for (int i = 0; i < 12; ++i)
            sum += across[std::size_t(i % 4)] * down[std::size_t(i / 4)] * pixel(i % 4, i / 4);
        return sum;
    };
    const auto ofLevel = [&](vec2 p, float width) {
        const std::vector<float> across = shares(2, p.x / 2, width / 2), down = shares(2, p.y / 2, width / 2);
        vec4 sum(0);
        for (std::size_t i = 0; i < 4; ++i)
            sum += across[i % 2] * down[i / 2] * level[i / 2][i % 2];
        return sum;
    };
    constexpr float byte = 0.5f / 255 + 1e-5f;
    expectNear(imageAt({1, 1}, ImageFilter::Trilinear, mat2(2)), level[0][0]);
    expectNear(imageAt({1, 1}, ImageFilter::Trilinear, mat2(0, 2, -2, 0)), level[0][0]);  // turned
    for (const vec2 p : {vec2(1.2f, 0.7f), vec2(2, 1.5f), vec2(3.9f, 2.5f)}) {
        for (const float width : {1.3f, 2.0f, 2.7f, 3.4f})
            expectNear(imageAt(p, ImageFilter::Trilinear, mat2(width)), ofPixels(p, width));
        expectNear(imageAt(p, ImageFilter::Trilinear, mat2(3.75f)),
                   0.5f * ofPixels(p, 3.75f) + 0.5f * ofLevel(p, 3.75f), byte);
        expectNear(imageAt(p, ImageFilter::Trilinear, mat2(4)), ofLevel(p, 4), byte);
        expectNear(imageAt(p, ImageFilter::Trilinear, mat2(1e9f)), whole, byte);
        // From the cubic to the mean of a square.
        expectNear(imageAt(p, ImageFilter::Bicubic, mat2(1.25f)), ofPixels(p, 1.25f));
    }
    EXPECT_TRUE(std::isfinite(imageAt({NAN, 0.5f}, ImageFilter::Trilinear, mat2(NAN)).a));
}

/// Catmull-Rom's weights half way between pixels are -1, 9, 9, -1 sixteenths.
TEST(Paint, ImagesBicubic) {
    expectNear(imageAt({1.5f, 1.5f}, ImageFilter::Bicubic), pixel(1, 1));
    const vec4 expected = (9.0f * (pixel(1, 1) + pixel(2, 1)) - pixel(0, 1) - pixel(3, 1)) / 16.0f;
    const float alpha = std::min(expected.a, 1.0f);
    expectNear(imageAt({2, 1.5f}, ImageFilter::Bicubic),
               vec4(glm::clamp(glm::vec3(expected), 0.0f, alpha), alpha));
    expectNear(imageAt({1, 1}, ImageFilter::Bicubic, mat2(2)),
               imageAt({1, 1}, ImageFilter::Trilinear, mat2(2)));
    expectNear(imageAt({-9, -9}, ImageFilter::Bicubic), pixel(0, 0));
}

TEST(Paint, MaterialsAreTheCallersOrTheirFallback) {
    std::vector<Texel> data;
    addMaterial(data, {{2, 0, 0, 2, 0, 1}, 3, 0, {0.25f, 0, 0, 0.5f}});
    const Asset asset = programAsset({{Op::Material, {}, 0.5f, 0}}, data);
    const std::uint32_t paint = asset.maps[0].root.payload();
    expectNear(Paints(asset).color(paint, {{3, 4}}), vec4(0.125f, 0, 0, 0.25f));
    const auto place = [](std::uint32_t material, vec2 p) { return vec4(p.x / 10, p.y / 10, material, 2); };
    expectNear(Paints(asset).color(paint, {{3, 4}}, place), vec4(0.3f, 0.45f, 0.5f, 0.5f));
}

TEST(Paint, LayersComposeInOrder) {
    std::vector<Texel> data;
    const std::uint32_t red50 = addColor(data, {0.5f, 0, 0, 0.5f}), blue1 = addColor(data, blue);
    const Asset asset = programAsset({{Op::Solid, {}, 1, blue1}, {Op::Solid, {}, 0.5f, red50}}, data);
    expectNear(Paints(asset).color(asset.maps[0].root.payload(), {}), vec4(0.25f, 0, 0.75f, 1));
}

TEST(Paint, GroupsNestMasksMultiply) {
    std::vector<Texel> data;
    const std::uint32_t opaqueRed = addColor(data, red), translucent = addColor(data, {0, 0, 0, 0.25f});
    const Asset asset = programAsset({{Op::Push, {}, 1, 0},
                                      {Op::Solid, {}, 1, opaqueRed},
                                      {Op::Push, {}, 1, 0},
                                      {Op::Solid, {}, 1, translucent},
                                      {Op::PopMaskAlpha, {}, 1, 0},
                                      {Op::Pop, Blend::Screen, 0.5f, 0}},
                                     data);
    expectNear(Paints(asset).color(asset.maps[0].root.payload(), {}), vec4(0.125f, 0, 0, 0.125f));
}

}  // namespace
}  // namespace vtm::asset::test
