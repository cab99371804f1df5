/// Areas known from geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "conformance/reference/reference.hpp"

namespace vtm::reference {
namespace {

using namespace scene;
using std::numbers::pi;

constexpr View view{64, 64, identity};
/// What sums over a few thousand trapezoids may lose to rounding.
constexpr double rounding = 1e-9;

double sum(const std::vector<double>& coverage) {
    return std::accumulate(coverage.begin(), coverage.end(), 0.0);
}

double filledArea(const Path& path, FillRule rule = FillRule::NonZero, const Affine& transform = identity) {
    return sum(fillCoverage(path, transform, rule, view));
}

Affine rotationAbout(Point center, double angle) {
    const Affine turn{std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 0, 0};
    return compose(translation(center.x, center.y), compose(turn, translation(-center.x, -center.y)));
}

Path circle(Point center, double radius) {
    const Point right{center.x + radius, center.y}, left{center.x - radius, center.y};
    return {MoveTo{right}, ArcTo{{radius, radius}, 0, false, true, left},
            ArcTo{{radius, radius}, 0, false, true, right}, Close{}};
}

void expectInUnitRange(const std::vector<double>& coverage) {
    for (const double c : coverage) {
        ASSERT_GE(c, 0);
        ASSERT_LE(c, 1 + rounding);
    }
}

TEST(FillCoverage, WholePixelsAndHalves) {
    const auto coverage = fillCoverage(rectangle({2, 3}, {4.5, 5.25}), identity, FillRule::NonZero, view);
    const auto at = [&](int x, int y) { return coverage[std::size_t(y * 64 + x)]; };
    EXPECT_DOUBLE_EQ(at(2, 3), 1);
    EXPECT_DOUBLE_EQ(at(3, 4), 1);
    EXPECT_DOUBLE_EQ(at(4, 3), 0.5);
    EXPECT_DOUBLE_EQ(at(2, 5), 0.25);
    EXPECT_DOUBLE_EQ(at(4, 5), 0.125);
    EXPECT_EQ(at(1, 3), 0);
    EXPECT_EQ(at(5, 3), 0);
    EXPECT_EQ(at(2, 2), 0);
    EXPECT_EQ(at(2, 6), 0);
}

TEST(FillCoverage, TrianglesAtAllAngles) {
    const Path triangle = polygon({{20.3, 22.7}, {45.1, 30.2}, {28.9, 44.4}});
    const double area = std::abs((45.1 - 20.3) * (44.4 - 22.7) - (28.9 - 20.3) * (30.2 - 22.7)) / 2;
    for (int i = 0; i < 72; ++i) {
        const auto coverage =
            fillCoverage(triangle, rotationAbout({32, 32}, i * pi / 36), FillRule::NonZero, view);
        EXPECT_NEAR(sum(coverage), area, rounding) << 5 * i << " degrees";
        expectInUnitRange(coverage);
    }
}

TEST(FillCoverage, HalfPlaneInOnePixel) {
    // The line x + 2y = 2.2 leaves in the pixel (1, 0) a trapezoid of heights 0.6 and 0.1.
    const auto coverage =
        fillCoverage(polygon({{-40, -30}, {42.2, -20}, {-37.8, 20}}), identity, FillRule::NonZero, view);
    EXPECT_NEAR(coverage[1], 0.35, rounding);
}

TEST(FillCoverage, CircleHasItsArea) {
    for (const double r : {0.2, 3.3, 17.9}) {
        // A chord of sagitta s leaves out 2/3 of s along the circumference.
        EXPECT_NEAR(filledArea(circle({31.7, 32.4}, r)), pi * r * r, 2 * pi * r * 1e-4) << "radius " << r;
    }
}

TEST(FillCoverage, OverlappingSquaresByBothRules) {
    Path path = rectangle({10, 10}, {30, 30});
    const Path second = rectangle({20.5, 20.25}, {40, 40});
    path.insert(path.end(), second.begin(), second.end());
    const double a = 400, b = 19.5 * 19.75, both = 9.5 * 9.75;
    for (int i = 0; i < 9; ++i) {
        const Affine turn = rotationAbout({27, 26}, i * 0.3);
        EXPECT_NEAR(filledArea(path, FillRule::NonZero, turn), a + b - both, rounding);
        EXPECT_NEAR(filledArea(path, FillRule::EvenOdd, turn), a + b - 2 * both, rounding);
    }
}

/// A pentagram in a circle of radius r: its inner pentagon has the circumradius r / phi².
TEST(FillCoverage, StarThatCrossesItself) {
    constexpr double r = 25;
    std::vector<Point> points;
    for (int i = 0; i < 5; ++i)
        points.push_back({32 + r * std::sin(i * 4 * pi / 5), 33 - r * std::cos(i * 4 * pi / 5)});
    const double inner = r / (std::numbers::phi * std::numbers::phi);
    const double whole = 5 * r * inner * std::sin(pi / 5);
    const double pentagon = 2.5 * inner * inner * std::sin(2 * pi / 5);
    EXPECT_NEAR(filledArea(polygon(points), FillRule::NonZero), whole, rounding);
    EXPECT_NEAR(filledArea(polygon(points), FillRule::EvenOdd), whole - pentagon, rounding);
}

TEST(FillCoverage, OppositeWindingsCancel) {
    Path path = rectangle({10, 10}, {30, 30});
    const Path hole = polygon({{12, 12}, {12, 20}, {20, 20}, {20, 12}});
    path.insert(path.end(), hole.begin(), hole.end());
    EXPECT_NEAR(filledArea(path), 400 - 64, rounding);
}

TEST(FillCoverage, ThinStrips) {
    for (int i = 0; i < 12; ++i) {
        const auto coverage = fillCoverage(rectangle({7, 32.01}, {57, 32.06}),
                                           rotationAbout({32, 32}, i * pi / 12), FillRule::NonZero, view);
        EXPECT_NEAR(sum(coverage), 50 * 0.05, rounding) << 15 * i << " degrees";
    }
    EXPECT_NEAR(filledArea(rectangle({31.999, 5}, {32.001, 6})), 0.002, rounding);
}

TEST(FillCoverage, CutByEachSideOfTheView) {
    EXPECT_NEAR(filledArea(rectangle({-5, -7}, {3, 4.5})), 3 * 4.5, rounding);
    EXPECT_NEAR(filledArea(rectangle({60.5, 61}, {70, 90})), 3.5 * 3, rounding);
    EXPECT_NEAR(filledArea(circle({64, 32}, 20)), 200 * pi, 0.01);
    EXPECT_NEAR(filledArea(circle({0, 0}, 20)), 100 * pi, 0.01);
    EXPECT_NEAR(filledArea(circle({32, 32}, 100)), 64 * 64, rounding);
    EXPECT_EQ(filledArea(circle({-32, 32}, 20)), 0);
    EXPECT_EQ(filledArea(circle({32, 96}, 20)), 0);
}

TEST(FillCoverage, CubicAndQuadAreasAreAnalytic) {
    // Area under a parabola arch: two thirds of base times height.
    EXPECT_NEAR(filledArea({MoveTo{{10, 40}}, QuadTo{{25, 0}, {40, 40}}}), 30 * 20 * 2 / 3.0, 0.01);
    // Controls straight above the ends: x = b(3t² - 2t³), y = 3h·t(1 - t), so the area is
    // 18·b·h·∫t²(1 - t)² = 3·b·h / 5.
    EXPECT_NEAR(filledArea({MoveTo{{10, 60}}, CubicTo{{10, 20}, {40, 20}, {40, 60}}}), 3 * 40 * 30 / 5.0,
                0.01);
}

/// The winding about a point by the crossings of a ray to the left, for closed polygons.
int windingAt(const std::vector<Point>& points, Point at) {
    int winding = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point a = points[i], b = points[(i + 1) % points.size()];
        if ((a.y <= at.y) == (b.y <= at.y))
            continue;
        if (a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x) < at.x)
            winding += b.y > a.y ? 1 : -1;
    }
    return winding;
}

TEST(FillCoverage, RandomPolygonsAgreeWithPointSamples) {
    constexpr int size = 12, n = 64;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-3, size + 3);
    for (int round = 0; round < 12; ++round) {
        std::vector<Point> points(9);
        for (Point& p : points)
            p = round % 2 == 0 ? Point{place(random), place(random)}
                               : Point{std::round(place(random)), std::round(place(random))};
        const FillRule rule = round % 3 == 0 ? FillRule::EvenOdd : FillRule::NonZero;
        const auto coverage = fillCoverage(polygon(points), identity, rule, {size, size, identity});
        for (int pixel = 0; pixel < size * size; ++pixel) {
            int inside = 0;
            for (int i = 0; i < n * n; ++i) {
                const int w =
                    windingAt(points, {pixel % size + (i % n + 0.5) / n, pixel / size + (i / n + 0.5) / n});
                inside += rule == FillRule::NonZero ? w != 0 : w % 2 != 0;
            }
            // An edge through the pixel misjudges by at most half a row of samples; few have more than four.
            EXPECT_NEAR(coverage[std::size_t(pixel)], double(inside) / (n * n), 2.0 / n)
                << "round " << round << " pixel " << pixel;
        }
    }
}

TEST(FillCoverage, ArcFlagsChooseTheirPiece) {
    const auto area = [](bool large, bool sweep) {
        return filledArea({MoveTo{{22, 32}}, ArcTo{{10, 10}, 0, large, sweep, {32, 22}}});
    };
    const double small = 25 * pi - 50, big = 75 * pi + 50;
    EXPECT_NEAR(area(false, true), small, 0.01);
    EXPECT_NEAR(area(false, false), small, 0.01);
    EXPECT_NEAR(area(true, true), big, 0.01);
    EXPECT_NEAR(area(true, false), big, 0.01);
    // Which side: the small arc with sweep bulges up and left, towards the circle about (32, 32).
    const auto coverage = fillCoverage({MoveTo{{22, 32}}, ArcTo{{10, 10}, 0, false, true, {32, 22}}},
                                       identity, FillRule::NonZero, view);
    EXPECT_NEAR(coverage[26 * 64 + 25], 1, 1e-3);
    EXPECT_EQ(coverage[28 * 64 + 28], 0);
}

TEST(FillCoverage, ArcRadiiScaleUpAndEllipsesRotate) {
    EXPECT_NEAR(filledArea({MoveTo{{12, 32}}, ArcTo{{1, 1}, 0, false, true, {52, 32}}}), 200 * pi, 0.01);
    const Path ellipse{MoveTo{{32 + 20 * std::cos(0.5), 32 + 20 * std::sin(0.5)}},
                       ArcTo{{20, -7}, 0.5, true, true, {32 - 20 * std::cos(0.5), 32 - 20 * std::sin(0.5)}},
                       ArcTo{{20, 7}, 0.5, true, true, {32 + 20 * std::cos(0.5), 32 + 20 * std::sin(0.5)}}};
    EXPECT_NEAR(filledArea(ellipse), 140 * pi, 0.01);
    EXPECT_EQ(filledArea({MoveTo{{12, 32}}, ArcTo{{0, 5}, 0, false, true, {52, 32}}}), 0);
}

TEST(FillCoverage, TransformAndViewCompose) {
    const View half{32, 32, scaling(0.5, 0.5)};
    const auto coverage =
        fillCoverage(rectangle({0, 0}, {10, 10}), translation(20, 8), FillRule::NonZero, half);
    EXPECT_NEAR(sum(coverage), 25, rounding);
    EXPECT_DOUBLE_EQ(coverage[4 * 32 + 10], 1);
    EXPECT_EQ(coverage[4 * 32 + 9], 0);
}

TEST(FillCoverage, HugeCoordinates) {
    EXPECT_NEAR(filledArea(rectangle({-1e30, 10}, {1e30, 20})), 640, rounding);
    EXPECT_NEAR(
        filledArea(rectangle({-1e300, -1e300}, {1e300, 1e300}), FillRule::NonZero, scaling(1e10, 1e10)), 4096,
        rounding);
    EXPECT_NEAR(filledArea(circle({32, 32}, 1e30)), 4096, rounding);
    EXPECT_NEAR(filledArea(circle({32 - 1e6, 32}, 1e6)), 2048, 0.1);
    const Path wild{MoveTo{{-1e30, 3e29}}, CubicTo{{1e30, -1e30}, {-1e30, -1e30}, {1e30, 1e30}}};
    expectInUnitRange(fillCoverage(wild, identity, FillRule::NonZero, view));
}

TEST(Coverage, ViewLimits) {
    const Path path = rectangle({0, 0}, {1, 1});
    const auto cover = [&](int w, int h) {
        return fillCoverage(path, identity, FillRule::NonZero, {w, h, identity});
    };
    EXPECT_THROW(cover(16385, 1), std::length_error);
    EXPECT_THROW(cover(16384, 8193), std::length_error);
    EXPECT_THROW(cover(0, 5), std::invalid_argument);
    EXPECT_THROW(strokeCoverage(path, identity, {}, {1, -1, identity}), std::invalid_argument);
    EXPECT_NEAR(sum(cover(16384, 2)), 1, rounding);
}

}  // namespace
}  // namespace vtm::reference
