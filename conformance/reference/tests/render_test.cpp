/// Colours known by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "conformance/reference/tests/scenes.hpp"

namespace vtm::reference {
namespace {

INSTANTIATE_TEST_SUITE_P(Render, BothModes, testing::Values(Mode::Exact, Mode::Compat),
                         [](const auto& mode) { return mode.param == Mode::Exact ? "Exact" : "Compat"; });

TEST_P(BothModes, EmptySceneIsTransparent) {
    for (const float v : draw(sceneOf({})).rgba)
        EXPECT_EQ(v, 0);
}

TEST_P(BothModes, CoverageOfOneShape) {
    const auto raster =
        draw(sceneOf({{fill(rectangle({1.5, 2}, {4, 3.25}), Color{1, 0.5f, 0, 0.5f}, 0.5f)}}));
    expectPixel(raster, 2, 2, {0.25, 0.125, 0, 0.25});
    expectPixel(raster, 1, 2, {0.125, 0.0625, 0, 0.125});
    expectPixel(raster, 1, 3, {0.03125, 0.015625, 0, 0.03125});
    expectPixel(raster, 0, 2, {0, 0, 0, 0});
    expectPixel(raster, 4, 2, {0, 0, 0, 0});
}

TEST_P(BothModes, LaterLiesOnTop) {
    const auto raster = draw(sceneOf({{fillAll(red)}, {fillAll(blue, 0.25f)}}));
    expectPixel(raster, 3, 3, {0.75, 0, 0.25, 1});
}

TEST_P(BothModes, GroupOpacityCountsOnce) {
    Group both = group({{fill(rectangle({0, 0}, {5, 8}), red)}, {fill(rectangle({3, 0}, {8, 8}), blue)}});
    both.opacity = 0.5;
    const auto raster = draw(sceneOf({{both}}));
    expectPixel(raster, 1, 1, {0.5, 0, 0, 0.5});
    expectPixel(raster, 4, 1, {0, 0, 0.5, 0.5});
}

TEST_P(BothModes, GroupsNestAndReturn) {
    Group inner = group({{fillAll(white)}});
    inner.opacity = 0.5;
    Group outer = group({{fillAll(red)}, {inner}, {fill(rectangle({0, 0}, {2, 2}), blue)}});
    outer.opacity = 0.5;
    const auto raster = draw(sceneOf({{fillAll(black)}, {outer}, {fill(rectangle({6, 6}, {8, 8}), green)}}));
    expectPixel(raster, 4, 4, {0.5, 0.25, 0.25, 1});
    expectPixel(raster, 1, 1, {0, 0, 0.5, 1});
    expectPixel(raster, 7, 7, {0, 1, 0, 1});
}

TEST_P(BothModes, SceneIsCutAtItsBorder) {
    Scene small = sceneOf({{fillAll(red)}}, 4.5);
    const auto raster = render(small, {8, 8, translation(1, 0)}, {GetParam(), 32});
    expectPixel(raster, 0, 2, {0, 0, 0, 0});
    expectPixel(raster, 1, 0, {1, 0, 0, 1});
    expectPixel(raster, 5, 2, {0.5, 0, 0, 0.5});
    expectPixel(raster, 6, 2, {0, 0, 0, 0});
    expectPixel(raster, 3, 4, {0.5, 0, 0, 0.5});
    expectPixel(raster, 3, 5, {0, 0, 0, 0});
}

TEST_P(BothModes, ViewMovesScalesAndTurns) {
    const Scene scene = sceneOf({{fill(rectangle({1, 2}, {4, 3}), red)}});
    const View zoomed{8, 8, compose(scaling(2, 2), translation(-1, -1))};
    const auto raster = render(scene, zoomed, {GetParam(), 32});
    expectPixel(raster, 0, 1, {0, 0, 0, 0});
    expectPixel(raster, 0, 2, {1, 0, 0, 1});
    expectPixel(raster, 5, 3, {1, 0, 0, 1});
    expectPixel(raster, 6, 3, {0, 0, 0, 0});
    const View turned{8, 8, {0, 1, -1, 0, 8, 0}};  // (x, y) to (8 - y, x)
    const auto quarter = render(scene, turned, {GetParam(), 32});
    expectPixel(quarter, 5, 1, {1, 0, 0, 1});
    expectPixel(quarter, 5, 3, {1, 0, 0, 1});
    expectPixel(quarter, 4, 1, {0, 0, 0, 0});
}

TEST_P(BothModes, ItemTransformMapsThePath) {
    Item item = fill(rectangle({0, 0}, {1, 1}), red);
    item.transform = compose(translation(3, 4), scaling(2, 0.5));
    const auto raster = draw(sceneOf({{item}}));
    expectPixel(raster, 4, 4, {0.5, 0, 0, 0.5});
    expectPixel(raster, 5, 4, {0, 0, 0, 0});
}

TEST_P(BothModes, StrokesArePainted) {
    Item item = fill({MoveTo{{1, 4}}, LineTo{{7, 4}}}, red);
    item.geometry = StrokeStyle{2, Cap::Butt, Join::Miter, 4, {}, 0};
    const auto raster = draw(sceneOf({{item}}));
    expectPixel(raster, 1, 3, {1, 0, 0, 1});
    expectPixel(raster, 6, 4, {1, 0, 0, 1});
    expectPixel(raster, 7, 4, {0, 0, 0, 0});
    expectPixel(raster, 3, 5, {0, 0, 0, 0});
}

TEST_P(BothModes, RenderingTwiceIsTheSame) {
    std::vector<Node> nodes;
    for (int i = 0; i < 40; ++i)
        nodes.push_back(
            {fill({MoveTo{{0.1 * i, 0.3 * (i % 7)}}, CubicTo{{9, 1.0 * (i % 5)}, {-3, 6}, {7, 8}}},
                  Color{0.02f * float(i), 0.5f, 1, 0.4f})});
    EXPECT_EQ(draw(sceneOf(nodes), 200).rgba, draw(sceneOf(nodes), 200).rgba);
}

TEST_P(BothModes, HugeCoordinatesStayInTime) {
    Item stroke = fill({MoveTo{{-1e30, 4}}, LineTo{{1e30, 4}}}, green);
    stroke.geometry = StrokeStyle{2, Cap::Round, Join::Round, 4, {1, 1}, 0.5};
    Item wild =
        fill({MoveTo{{-1e30, 3e29}}, CubicTo{{1e300, -1e30}, {-1e30, -1e300}, {1e30, 1e30}}}, blue, 0.5f);
    wild.transform = scaling(1e200, 1e200);
    const auto raster =
        draw(sceneOf({{fill(rectangle({-1e30, -1e30}, {1e30, 1e30}), red)}, {stroke}, {wild}}));
    expectPixel(raster, 4, 7, {raster.pixel(4, 7)[0], 0, 1 - raster.pixel(4, 7)[0], 1});
}

TEST(Render, ArgumentsOutOfRange) {
    const Scene scene = sceneOf({{fillAll(red)}});
    EXPECT_THROW(render(scene, {8, 8, identity}, {Mode::Exact, 0}), std::invalid_argument);
    EXPECT_THROW(render(scene, {8, 8, identity}, {Mode::Exact, 257}), std::invalid_argument);
    EXPECT_THROW(render(scene, {0, 8, identity}), std::invalid_argument);
    EXPECT_THROW(render(scene, {16385, 1, identity}), std::length_error);
    EXPECT_THROW(render(scene, {16384, 16384, identity}), std::length_error);
}

// Seams: what tells the two modes apart.

/// Two halves of a turned square, abutting along a line through its middle.
std::array<Path, 2> halves(double angle) {
    const auto at = [&](double x, double y) {
        return Point{16 + x * std::cos(angle) - y * std::sin(angle),
                     16 + x * std::sin(angle) + y * std::cos(angle)};
    };
    const Point top = at(0, -10), bottom = at(0, 10);
    return {Path{MoveTo{top}, LineTo{bottom}, LineTo{at(-10, 10)}, LineTo{at(-10, -10)}, Close{}},
            Path{MoveTo{bottom}, LineTo{top}, LineTo{at(10, -10)}, LineTo{at(10, 10)}, Close{}}};
}

TEST(Seams, ExactModeLeaksNothing) {
    for (int i = 0; i < 24; ++i) {
        const auto [left, right] = halves(0.13 + i * 0.26);
        const auto raster = renderAt(
            sceneOf({{fillAll(black)}, {fill(left, white)}, {fill(right, white)}}, 32), Mode::Exact, 32);
        for (int y = 10; y < 22; ++y)
            for (int x = 10; x < 22; ++x)
                expectPixel(raster, x, y, {1, 1, 1, 1});
    }
}

TEST(Seams, ExactModeLeaksNothingWhereAnEdgeIsCut) {
    // Opposite the one long edge stand two short ones, whose common end lies on it up to rounding.
    const Point a{3.1, 1.7}, b{20.3, 29.9}, middle = a + 0.37 * (b - a);
    const Path left{MoveTo{a}, LineTo{b}, LineTo{{-40, 31}}, LineTo{{-40, 0}}, Close{}};
    const Path upper{MoveTo{a}, LineTo{middle}, LineTo{{70, 12}}, LineTo{{70, 0}}, Close{}};
    const Path lower{MoveTo{middle}, LineTo{b}, LineTo{{70, 31}}, LineTo{{70, 12}}, Close{}};
    const auto raster = renderAt(
        sceneOf({{fillAll(black)}, {fill(left, white)}, {fill(upper, white)}, {fill(lower, white)}}, 32),
        Mode::Exact, 32);
    for (int y = 4; y < 28; ++y)
        for (int x = 0; x < 32; ++x)
            expectPixel(raster, x, y, {1, 1, 1, 1});
}

TEST(Seams, CompatModeLeaksAsLayersDo) {
    const auto [left, right] = halves(0.3);
    const auto raster = renderAt(sceneOf({{fillAll(black)}, {fill(left, white)}, {fill(right, white)}}, 32),
                                 Mode::Compat, 32);
    const auto share = fillCoverage(left, identity, FillRule::NonZero, {32, 32, identity});
    double worst = 1;
    for (int y = 10; y < 22; ++y) {
        for (int x = 10; x < 22; ++x) {
            const double c = share[std::size_t(y * 32 + x)],
                         sum = c * c + (1 - c);  // (1 - c) over c over black
            expectPixel(raster, x, y, {sum, sum, sum, 1});
            worst = std::min(worst, sum);
        }
    }
    EXPECT_LT(worst, 0.76);
}

TEST(Seams, ExactModeHidesWhatIsCovered) {
    // The same outline twice: layers let a rim of the lower one through.
    const Path path = halves(0.3)[0];
    const Scene scene = sceneOf({{fill(path, red)}, {fill(path, blue)}}, 32);
    const auto exact = renderAt(scene, Mode::Exact, 32);
    for (std::size_t i = 0; i < exact.rgba.size(); i += 4)
        EXPECT_LT(exact.rgba[i], 1e-9f);
    const auto compat = renderAt(scene, Mode::Compat, 32);
    EXPECT_GT(*std::max_element(compat.rgba.begin(), compat.rgba.end()), 0.2f);
}

}  // namespace
}  // namespace vtm::reference
