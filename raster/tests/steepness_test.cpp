// How fast paints change, and what that is for: a part of a pixel has the colours of that part.

#include "raster/steepness.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include "asset/testing.hpp"
#include "raster/src/paint.hpp"
#include "raster/src/part_sums.hpp"
#include "raster/testing_views.hpp"

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
    return changesOf(asset)[asset.maps[0].root.payload()].steepness;
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
    for (const PaintChange& change : changesOf(halfPlane()))
        EXPECT_EQ(change.steepness, 0);
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
    const std::vector<PaintChange> changes = changesOf(asset);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    int bounded = 0;
    for (std::uint32_t paint = 0; paint < asset.paints.size(); ++paint) {
        const float steepness = changes[paint].steepness;
        if (!isProgram(asset.paints[paint]) || steepness == infinity || steepness == 0)
            continue;  // 0: programs with images, and others that do not change
        ++bounded;
        for (int i = 0; i < 3000; ++i) {
            const vec2 p(64 * unit(random), 64 * unit(random));
            const vec2 q = p + 0.25f * (vec2(unit(random), unit(random)) - 0.5f);
            const glm::vec4 change = paints.color(paint, {p}) - paints.color(paint, {q});
            for (int c = 0; c < 4; ++c)
                ASSERT_LE(std::abs(change[c]), steepness * glm::length(p - q) + 1e-4f) << paint;
        }
    }
    EXPECT_GE(bounded, 3);
}

// ---- Near a place ---------------------------------------------------------------------------------

NearChange nearOf(const std::vector<Instruction>& program, const std::vector<Texel>& data,
                  const PixelsNear& pixels) {
    const Asset asset = programAsset(program, data);
    return changeNear(asset, asset.maps[0].root.payload(), pixels);
}

NearChange near(Op op, Gradient g, const std::vector<GradientStop>& stops, const PixelsNear& pixels) {
    g.stopCount = std::uint32_t(stops.size());
    std::vector<Texel> data;
    addGradient(data, g, stops);
    return nearOf({{op, Blend::Normal, 1, 0}}, data, pixels);
}

const std::vector<GradientStop> jumpAtHalf{grey(0, 0), grey(0.5f, 0), grey(0.5f, 1), grey(1, 1)};

TEST(NearChange, HardStopsCountWhereTheyAre) {
    const Gradient g = gradient(Spread::Pad, 0.1f);  // the stop lies at x = 5
    EXPECT_FLOAT_EQ(near(Op::Linear, g, jumpAtHalf, {{4.5, 70}, 0.5, 0.1}).sum, 1);
    EXPECT_EQ(near(Op::Linear, g, jumpAtHalf, {{4, 70}, 0.5, 0.1}).sum, 0);
    EXPECT_EQ(near(Op::Linear, g, jumpAtHalf, {{-5, 70}, 0.5, 0.1}).sum, 0);
    EXPECT_FLOAT_EQ(near(Op::Radial, g, jumpAtHalf, {{3, 4}, 0.1, 0.1}).sum, 1);
    EXPECT_EQ(near(Op::Radial, g, jumpAtHalf, {{4, 4}, 0.1, 0.1}).sum, 0);
}

TEST(NearChange, PeriodsHaveTheirStopsAgain) {
    const Gradient repeated = gradient(Spread::Repeat, 0.1f), reflected = gradient(Spread::Reflect, 0.1f);
    for (const double x : {-5.0, 15.0, 25.0, 20.0, 0.0})
        EXPECT_FLOAT_EQ(near(Op::Linear, repeated, jumpAtHalf, {{x, 0}, 0.5, 0.1}).sum, 1) << x;
    for (const double x : {-5.0, 15.0, 25.0})
        EXPECT_FLOAT_EQ(near(Op::Linear, reflected, jumpAtHalf, {{x, 0}, 0.5, 0.1}).sum, 1) << x;
    for (const double x : {-10.0, 0.0, 10.0, 20.0})
        EXPECT_EQ(near(Op::Linear, reflected, jumpAtHalf, {{x, 0}, 0.5, 0.1}).sum, 0) << x;
    EXPECT_FLOAT_EQ(near(Op::Linear, repeated, jumpAtHalf, {{7.5, 0}, 50, 0.1}).sum, 2);
}

TEST(NearChange, JointIsAFourthOfTheProduct) {
    std::vector<Texel> data;
    Gradient g = gradient(Spread::Pad, 0.1f);
    g.stopCount = 4;
    const std::uint32_t ramp = addGradient(data, g, jumpAtHalf);
    const std::vector<Instruction> twice{{Op::Linear, Blend::Normal, 1, ramp},
                                         {Op::Linear, Blend::Normal, 0.5f, ramp}};
    EXPECT_FLOAT_EQ(nearOf(twice, data, {{5, 0}, 0.5, 0.1}).sum, 1.5f);
    EXPECT_FLOAT_EQ(nearOf(twice, data, {{5, 0}, 0.5, 0.1}).joint, 0.125f);
    EXPECT_EQ(nearOf(twice, data, {{8, 0}, 0.5, 0.1}).joint, 0);
    EXPECT_EQ(nearOf({twice[0]}, data, {{5, 0}, 0.5, 0.1}).joint, 0);
}

/// No two points of a pixel differ by more.
TEST(NearChange, BoundsGradients) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 2000; ++i) {
        Gradient g = gradient(Spread(i % 3));
        for (float& m : g.matrix)
            m = 0.4f * (unit(random) - 0.5f);
        // Also circles that touch, or do not lie within each other.
        const float reach = i % 4 < 2 ? 0.8f : 3;
        g.fx = reach * (unit(random) - 0.5f);
        g.fy = i % 8 < 4 ? 0 : reach * (unit(random) - 0.5f);
        g.fr = i % 5 == 0 ? 0.5f * unit(random) : 0;
        if (i % 11 == 10)
            g.fx = 1 - g.fr - 0.01f * unit(random), g.fy = 0;
        g.stopCount = 5;
        std::vector<GradientStop> stops{grey(0, unit(random), unit(random))};
        for (const float offset : {0.2f, 0.2f + 0.1f * unit(random), 0.7f, 1.0f})
            stops.push_back(grey(offset, unit(random), unit(random)));
        std::vector<Texel> data;
        addGradient(data, g, stops);
        const Asset asset = programAsset({{i % 2 ? Op::Linear : Op::Radial, Blend::Normal, 1, 0}}, data);
        const Paints paints(asset);
        const std::uint32_t paint = asset.maps[0].root.payload();
        const vec2 middle(20 * unit(random), 20 * unit(random));
        const float radius = 2 * unit(random), pixel = 2 * unit(random);
        const auto inDisc = [&](float r) {
            const float angle = 6.2831853f * unit(random);
            return r * std::sqrt(unit(random)) * vec2(std::cos(angle), std::sin(angle));
        };
        const float maximum = changeNear(asset, paint, {middle, radius, pixel}).sum;
        for (int k = 0; k < 200; ++k) {
            const vec2 p = middle + inDisc(radius);
            const glm::vec4 change = paints.color(paint, {p + inDisc(0.5f * pixel)}) -
                                     paints.color(paint, {p + inDisc(0.5f * pixel)});
            for (int c = 0; c < 4; ++c)
                ASSERT_LE(std::abs(change[c]), maximum + 1e-4f) << i;
        }
    }
}

// ---- Of paints near a place -----------------------------------------------------------------------

PaintChange changeOf(const std::vector<Instruction>& program, const std::vector<Texel>& data,
                     const PixelsNear& pixels) {
    const Asset asset = programAsset(program, data);
    return PaintChanges(asset).near(asset.maps[0].root.payload(), pixels);
}

TEST(PaintChanges, OnlyStretchesNearbyCount) {
    std::vector<Texel> data;
    Gradient g = gradient(Spread::Pad, 0.1f);  // a jump at x = 5, a slope of 0.1 from 8 to 10
    g.stopCount = 5;
    const std::uint32_t ramp =
        addGradient(data, g, {grey(0, 0), grey(0.5f, 0), grey(0.5f, 0.8f), grey(0.8f, 0.8f), grey(1, 1)});
    const std::vector<Instruction> program{{Op::Linear, Blend::Normal, 1, ramp}};
    const auto at = [&](double x) { return changeOf(program, data, {{x, 0}, 0.5, 0.1}); };
    EXPECT_EQ(at(4), PaintChange{});
    EXPECT_EQ(at(4.5).steepness, infinity);
    EXPECT_FLOAT_EQ(at(4.5).variation, 0.08f);
    EXPECT_EQ(at(6), PaintChange{});
    EXPECT_NEAR(at(9).steepness, 0.1f, 1e-5f);
    EXPECT_EQ(at(11), PaintChange{});
}

TEST(PaintChanges, ModesJumpWhereWhatIsBelowChanges) {
    std::vector<Texel> data;
    Gradient g = gradient(Spread::Pad, 0.1f);
    g.stopCount = 4;
    const std::uint32_t ramp = addGradient(data, g, jumpAtHalf), color = std::uint32_t(data.size());
    data.push_back(std::bit_cast<Texel>(glm::vec4(0, 0, 1, 1)));
    const std::vector<Instruction> program{{Op::Linear, Blend::Normal, 1, ramp},
                                           {Op::Push, Blend::Normal, 1, 0},
                                           {Op::Solid, Blend::Normal, 1, color},
                                           {Op::Pop, Blend::Screen, 1, 0}};
    EXPECT_EQ(changeOf(program, data, {{3, 0}, 0.5, 0.1}), PaintChange{});
    EXPECT_TRUE(changeOf(program, data, {{5, 0}, 0.5, 0.1}).mayJump);
}

/// No two points in the pixels differ by more, and nowhere by more than anywhere.
TEST(PaintChanges, BoundColorsNearby) {
    const Asset asset = everyPaint();
    const Paints paints(asset);
    const PaintChanges changes(asset);
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    int lower = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto paint = std::uint32_t(random() % asset.paints.size());
        const float anywhere = changes.byPaint()[paint].steepness;
        if (anywhere == 0)
            continue;  // programs with images do, too
        const vec2 middle = 80.0f * vec2(unit(random), unit(random)) - 8.0f;
        const float radius = 4 * unit(random), pixel = 2 * unit(random);
        const float maximum = changes.near(paint, {middle, radius, pixel}).steepness;
        ASSERT_LE(maximum, anywhere);
        lower += maximum < anywhere;
        const auto inDisc = [&](float r) {
            const float angle = 6.2831853f * unit(random);
            return r * std::sqrt(unit(random)) * vec2(std::cos(angle), std::sin(angle));
        };
        for (int k = 0; k < 20; ++k) {
            const vec2 centre = middle + inDisc(radius), p = centre + inDisc(0.5f * pixel),
                       q = centre + inDisc(0.5f * pixel);
            const glm::vec4 change = paints.color(paint, {p}) - paints.color(paint, {q});
            for (int c = 0; c < 4; ++c)
                ASSERT_LE(std::abs(change[c]), maximum * glm::length(p - q) + 1e-4f) << paint;
        }
    }
    EXPECT_GT(lower, 500);
}

TEST(Steepness, LeastIsThatOfAPixelsLongestStep) {
    EXPECT_FLOAT_EQ(minSteepness(dmat2(0.5, 0, 0, 0.25)), float(2 * minSteepChange));
    EXPECT_FLOAT_EQ(minSteepness(dmat2(0.6, 0.8, -0.8, 0.6)), float(minSteepChange));
}

// ---- Parts of pixels ------------------------------------------------------------------------------

/// Chords of any length, also at the ends of single precision: the shares are those of the coverage.
TEST(PartSums, SharesAreTheCoverage) {
    constexpr int width = 70, height = 9;
    std::mt19937 random(29);
    std::uniform_real_distribution<float> unit(-1, 1);
    PartSums sums;
    Accumulator<float> coverage;
    sums.resize(width);
    coverage.resize(width);
    for (int i = 0; i < 4000; ++i) {
        const float size =
            std::exp2(std::floor(i % 100 < 90 ? 4 + 6 * unit(random) : 64 + 62 * unit(random)));
        const auto place = [&] { return vec2(35, 4) + size * vec2(unit(random), unit(random)); };
        Chord chord{place(), place(), 1, 0};
        if (i % 7 == 0)
            chord.b.x = chord.a.x;
        if (i % 11 == 0)
            chord.b.y = chord.a.y;
        sums.add(chord, 0, height, 1);
        coverage.add(chord, 0, height, 1);
        for (int y = 0; y < height; ++y) {
            std::array<float, width> shares{}, expected{};
            sums.resolve(std::size_t(y), 0, width + 1, [&](int first, int end, Float4 sum) {
                for (int x = first; x < end; ++x)
                    shares[std::size_t(x)] = PartOfPixel(sum).share;
            });
            coverage.resolve(std::size_t(y), 0, width + 1, [&](int first, int end, float share) {
                for (int x = first; x < end; ++x)
                    expected[std::size_t(x)] = share;
            });
            if (size > 1e5f)
                continue;  // where it crosses a row is not known to a pixel
            for (std::size_t x = 0; x < width; ++x)
                ASSERT_NEAR(shares[x], expected[x], 1e-6f * std::max(size, 10.0f))
                    << i << ": " << x << ' ' << y;
        }
    }
}

/// Triangles that reach beyond the picture, against 64 × 64 points a pixel: off by less than what a row of
/// points is for each of three edges.
TEST(PartSums, AreThoseOfDensePoints) {
    constexpr int width = 7, height = 5, side = 64;
    std::mt19937 random(23);
    std::uniform_real_distribution<float> unit(0, 1);
    PartSums sums;
    sums.resize(width);
    for (int i = 0; i < 200; ++i) {
        std::array<vec2, 3> p;
        const float size = i % 2 == 0 ? 1 : 0.1f;  // some within a pixel
        const vec2 place = vec2(width, height) * vec2(unit(random), unit(random));
        for (vec2& corner : p)
            corner = place + size * (vec2(width + 4, height + 4) * (vec2(unit(random), unit(random)) - 0.5f));
        const auto side2 = [](vec2 a, vec2 b, vec2 q) {
            return (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x);
        };
        const float sign = side2(p[0], p[1], p[2]) > 0 ? 1.0f : -1.0f;
        for (std::size_t k = 0; k < 3; ++k)
            sums.add({p[k], p[(k + 1) % 3], 1, 0}, 0, height, sign);
        for (int y = 0; y < height; ++y)
            sums.resolve(std::size_t(y), 0, width + 1, [&](int first, int end, Float4 sum) {
                const PartOfPixel part(sum);
                for (int x = first; x < end; ++x) {
                    glm::vec3 expected(0);
                    for (int n = 0; n < side * side; ++n) {
                        const vec2 inPixel = (vec2(n % side, n / side) + 0.5f) / float(side);
                        const vec2 point = vec2(x, y) + inPixel;
                        if (sign * side2(p[0], p[1], point) > 0 && sign * side2(p[1], p[2], point) > 0 &&
                            sign * side2(p[2], p[0], point) > 0)
                            expected += glm::vec3(1, inPixel - 0.5f) / float(side * side);
                    }
                    ASSERT_NEAR(part.share, expected[0], 1.5f / side) << i << ": " << x << ' ' << y;
                    ASSERT_NEAR(part.moment.x, expected[1], 0.75f / side) << i << ": " << x << ' ' << y;
                    ASSERT_NEAR(part.moment.y, expected[2], 0.75f / side) << i << ": " << x << ' ' << y;
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
        const image::Raster points = steepHalvesByPoints(length, view.width, view.height, view.toPixels);
        EXPECT_LE(255 * worst(evaluate(asset, view), points), bound) << "evaluator, view " << i;
        EXPECT_LE(255 * worst(Scanner(asset).draw(view), points), bound) << "scanner, view " << i;
    }
}

TEST(Steepness, PartsHaveTheirColorsWhereAGradientIsSteep) { expectPartsToHaveTheirColors(0.25, 3); }
TEST(Steepness, PartsHaveTheirColorsWhereAGradientIsSmall) { expectPartsToHaveTheirColors(0.8, 3); }
TEST(Steepness, PartsHaveTheirColorsWhereAGradientIsAsSmallAsAPixel) { expectPartsToHaveTheirColors(1, 4); }

// ---- Hard stops -----------------------------------------------------------------------------------

/// What of a pixel lies where dot(p, normal) < offset: a polygon's area, by cutting the pixel.
double shareBelow(glm::dvec2 pixel, glm::dvec2 normal, double offset) {
    const std::array<glm::dvec2, 4> corners{pixel, pixel + glm::dvec2(1, 0), pixel + glm::dvec2(1, 1),
                                            pixel + glm::dvec2(0, 1)};
    std::vector<glm::dvec2> part;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % 4];
        const double atA = glm::dot(a, normal) - offset, atB = glm::dot(b, normal) - offset;
        if (atA < 0)
            part.push_back(a);
        if ((atA < 0) != (atB < 0))
            part.push_back(a + (b - a) * (atA / (atA - atB)));
    }
    double area = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const glm::dvec2 a = part[i], b = part[(i + 1) % part.size()];
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return area;
}

TEST(HardStops, CutTurnedPixelsExactly) {
    std::vector<Texel> data;
    for (int i = 0; i < 64; ++i) {
        const double angle = i * 0.0981 + 0.01;
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        const double scale = 1.0 / (1 << i % 8), offset = 32 * (normal.x + normal.y) + 0.3;
        Gradient g;
        g.matrix = {float(scale * normal.x), 0, float(scale * normal.y), 0, float(0.5 - scale * offset), 0};
        g.stopCount = 4;
        data.clear();
        addGradient(data, g, jumpAtHalf);
        const Asset asset = programAsset({{Op::Linear, Blend::Normal, 1, 0}}, data);
        const View view{64, 64, {1, 0, 0, 1, 0, 0}};
        const image::Raster drawn = evaluate(asset, view), scanned = Scanner(asset).draw(view);
        for (int y = 29; y < 35; ++y)
            for (int x = 29; x < 35; ++x) {
                const double white = 1 - shareBelow({x, y}, normal, offset);
                ASSERT_NEAR(drawn.pixel(x, y)[0], white, 0.25 / 255) << i << ' ' << x << ' ' << y;
                ASSERT_NEAR(scanned.pixel(x, y)[0], white, 0.25 / 255) << i << ' ' << x << ' ' << y;
            }
    }
}

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
    for (unsigned mode = 0; mode <= unsigned(Blend::PlusLighter); ++mode) {
        SCOPED_TRACE(mode);
        expectMeans(blendAsset(Blend(mode)), 4);
    }
}
TEST(Rough, LayersUnderAnEdgeAreTheirMean) { expectMeans(steepHalves(8), 4); }

}  // namespace
}  // namespace vtm::asset::test
