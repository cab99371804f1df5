// Single filled paths against their exact coverage, under random affine views.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "asset/scan.hpp"
#include "compiler/compile.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases {
namespace {

using scene::FillRule;
using scene::Path;
using scene::Point;

constexpr double pi = 3.14159265358979323846;

/// User units of the picture; every path lies inside.
constexpr double side = 1024;
constexpr Point centre{side / 2, side / 2};

constexpr double polygonBound = 2, curveBound = 4;  // 1/255 of coverage

constexpr int views = 20, raster = 256;

/// Rotated, sheared, sometimes mirrored; `focus` lands near the middle of the raster.
asset::View randomView(std::mt19937& random, Point focus) {
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double angle = uniform(0, 2 * pi), skew = uniform(-0.3, 0.3);
    const double sx = std::exp2(uniform(-3, 0.5)),
                 sy = sx * uniform(0.75, 1.3) * (random() % 4 == 0 ? -1 : 1);
    const glm::dvec2 x = sx * glm::dvec2(std::cos(angle), std::sin(angle));
    const glm::dvec2 y = sy * glm::dvec2(-std::sin(angle + skew), std::cos(angle + skew));
    const glm::dvec2 target = glm::dvec2(raster / 2.0) + glm::dvec2(uniform(-9, 9), uniform(-9, 9));
    return {raster, raster, {x, y, target - focus.x * x - focus.y * y}};
}

double worstError(const image::Raster& drawn, const std::vector<double>& coverage) {
    double worst = 0;
    for (std::size_t i = 0; i < coverage.size(); ++i)
        worst = std::max(worst, 255 * std::abs(double(drawn.rgba[4 * i + 3]) - coverage[i]));
    return worst;
}

class SinglePath : public testing::TestWithParam<FillRule> {
protected:
    void expectCoverage(const Path& path, Point focus, double bound, const std::string& what) {
        const asset::Asset asset = compiler::compile(sceneOf(path, GetParam(), side)).asset;
        const gl::Texture texture = gl_.renderer.upload(asset);
        const asset::Scanner scanner(asset);
        for (int i = 0; i < views; ++i) {
            const asset::View view = randomView(random_, focus);
            const auto coverage = reference::fillCoverage(path, scene::identity, GetParam(),
                                                          {view.width, view.height, view.toPixels});
            EXPECT_LE(worstError(gl_.renderer.render(texture, view), coverage), bound)
                << what << ", view " << i;
            EXPECT_LE(worstError(scanner.draw(view), coverage), bound) << what << " scanned, view " << i;
        }
    }

private:
    Gl gl_;
    std::mt19937 random_{2005};  // fixed, so that a failure can be repeated
};

INSTANTIATE_TEST_SUITE_P(Rule, SinglePath, testing::Values(FillRule::NonZero, FillRule::EvenOdd),
                         [](const auto& tested) {
                             return tested.param == FillRule::NonZero ? "NonZero" : "EvenOdd";
                         });

Point polar(double radius, double angle) { return centre + radius * Point(std::cos(angle), std::sin(angle)); }

/// Every `step`-th of `corners` points on a circle, turned by `turn`.
Path star(int corners, int step, double radius, double turn) {
    std::vector<Point> points;
    for (int i = 0; i < corners; ++i)
        points.push_back(polar(radius, turn + 2 * pi * (i * step % corners) / corners));
    return scene::polygon(points);
}

TEST_P(SinglePath, Polygons) {
    for (const int corners : {3, 4, 5, 7})
        for (const double turn : {0.0, 0.1, 0.7, 1.3})
            expectCoverage(star(corners, 1, 300, turn), centre, polygonBound,
                           std::to_string(corners) + " corners turned by " + std::to_string(turn));
}

TEST_P(SinglePath, StarsThatCrossThemselves) {
    expectCoverage(star(5, 2, 400, 0.2), centre, polygonBound, "pentagram");
    expectCoverage(star(11, 5, 400, 0.3), centre, polygonBound, "eleven rays");
}

TEST_P(SinglePath, StarOfHundredRays) {
    std::vector<Point> points;
    for (int i = 0; i < 200; ++i)
        points.push_back(polar(i % 2 == 0 ? 480 : 30, pi * i / 100 + 0.01));
    expectCoverage(scene::polygon(points), polar(300, 1), polygonBound, "hundred rays");
}

TEST_P(SinglePath, StripsThinnerThanAPixel) {
    for (const double width : {0.05, 0.2, 0.5, 1.0, 2.0})
        for (const double angle : {0.0, 0.4, 1.1}) {
            const Point along{std::cos(angle), std::sin(angle)},
                across{-along.y * width / 2, along.x * width / 2};
            expectCoverage(scene::polygon({centre - 400.0 * along - across, centre + 400.0 * along - across,
                                           centre + 400.0 * along + across, centre - 400.0 * along + across}),
                           centre, polygonBound, "strip of " + std::to_string(width));
        }
}

Path circle(double radius) {
    const Point left{centre.x - radius, centre.y}, right{centre.x + radius, centre.y};
    return {scene::MoveTo{left}, scene::ArcTo{{radius, radius}, 0, false, true, right},
            scene::ArcTo{{radius, radius}, 0, false, true, left}, scene::Close{}};
}

TEST_P(SinglePath, Circles) {
    for (const double radius : {2.0, 5.0, 20.0, 100.0, 500.0})
        expectCoverage(circle(radius), polar(radius > 50 ? radius : 0, 0.7), curveBound,
                       "radius " + std::to_string(radius));
}

Path cubic(Point a, Point b, Point c, Point d) {
    return {scene::MoveTo{a}, scene::CubicTo{b, c, d}, scene::Close{}};
}

TEST_P(SinglePath, CubicsWithCuspsAndLoops) {
    expectCoverage(cubic({300, 700}, {700, 300}, {300, 300}, {700, 700}), centre, curveBound, "cusp");
    expectCoverage(cubic({300, 700}, {900, 200}, {100, 200}, {700, 700}), centre, curveBound, "loop");
    expectCoverage(cubic({300, 500}, {500, 100}, {500, 900}, {700, 500}), centre, curveBound, "inflection");
    expectCoverage(cubic({300, 500}, {300, 500}, {700, 500}, {600, 300}), centre, curveBound,
                   "doubled control");
    expectCoverage(cubic({300, 500}, {800, 500}, {200, 500.5}, {700, 501}), centre, curveBound,
                   "turns back on itself");
}

}  // namespace
}  // namespace vtm::cases
