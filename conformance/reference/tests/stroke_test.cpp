/// Areas of strokes known from geometry.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <glm/geometric.hpp>

#include "conformance/reference/reference.hpp"

namespace vtm::reference {
namespace {

using namespace scene;
using std::numbers::pi;
using std::numbers::sqrt2;

constexpr View view{64, 64, identity};
constexpr double rounding = 1e-9;
/// Round parts are polygons within 1e-4 pixels of the circle; their circumferences here are below 100.
constexpr double roundness = 0.01;

std::vector<double> coverage(const Path& path, const StrokeStyle& style, const Affine& transform = identity) {
    return strokeCoverage(path, transform, style, view);
}

double area(const Path& path, const StrokeStyle& style, const Affine& transform = identity) {
    const std::vector<double> c = coverage(path, style, transform);
    return std::accumulate(c.begin(), c.end(), 0.0);
}

double coverageAt(const std::vector<double>& c, int x, int y) { return c[std::size_t(y * 64 + x)]; }

Affine rotationAbout(Point center, double angle) {
    const Affine turn{std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 0, 0};
    return compose(translation(center.x, center.y), compose(turn, translation(-center.x, -center.y)));
}

Path line(Point a, Point b) { return {MoveTo{a}, LineTo{b}}; }

Path circle(Point center, double radius) {
    const Point right{center.x + radius, center.y}, left{center.x - radius, center.y};
    return {MoveTo{right}, ArcTo{{radius, radius}, 0, false, true, left},
            ArcTo{{radius, radius}, 0, false, true, right}, Close{}};
}

StrokeStyle styleOf(double width, Cap cap = Cap::Butt, Join join = Join::Miter, double miterLimit = 4) {
    return {width, cap, join, miterLimit, {}, 0};
}

StrokeStyle dashed(std::vector<double> dashes, double phase = 0, Cap cap = Cap::Butt) {
    return {2, cap, Join::Miter, 4, std::move(dashes), phase};
}

TEST(StrokeCoverage, CapsAtAllAngles) {
    for (int i = 0; i < 16; ++i) {
        const Affine turn = rotationAbout({32, 32}, i * pi / 8 + 0.1);
        const Path path = line({20, 32}, {44, 32});
        EXPECT_NEAR(area(path, styleOf(3), turn), 72, rounding);
        EXPECT_NEAR(area(path, styleOf(3, Cap::Square), turn), 81, rounding);
        EXPECT_NEAR(area(path, styleOf(3, Cap::Round), turn), 72 + 2.25 * pi, roundness);
    }
}

TEST(StrokeCoverage, DotsAreDrawnInGapsToo) {
    StrokeStyle style = styleOf(4, Cap::Square);
    style.dashes = {3, 5};
    for (const double phase : {0.0, 4.0}) {
        style.dashPhase = phase;
        EXPECT_NEAR(area({MoveTo{{20, 20}}, LineTo{{20, 20}}}, style), 16, rounding);
    }
}

/// A right angle between two lines of length 30: what the join adds to the two rectangles.
double joinArea(const StrokeStyle& style, bool mirrored) {
    const Path path = mirrored ? Path{MoveTo{{40, 10}}, LineTo{{40, 40}}, LineTo{{10, 40}}}
                               : Path{MoveTo{{10, 40}}, LineTo{{40, 40}}, LineTo{{40, 10}}};
    const double half = style.width / 2;
    return area(path, style) - (2 * 30 * style.width - half * half);
}

TEST(StrokeCoverage, JoinsOfARightAngle) {
    for (const bool mirrored : {false, true}) {
        const auto added = [&](Join join, double limit) {
            return joinArea(styleOf(8, Cap::Butt, join, limit), mirrored);
        };
        EXPECT_NEAR(added(Join::Bevel, 4), 8, rounding);
        EXPECT_NEAR(added(Join::Round, 4), 4 * pi, roundness);
        EXPECT_NEAR(added(Join::Miter, 4), 16, rounding);
        EXPECT_NEAR(added(Join::MiterClip, 4), 16, rounding);
        // The mitre is sqrt(2) times the width long.
        EXPECT_NEAR(added(Join::Miter, sqrt2), 16, rounding);
        EXPECT_NEAR(added(Join::Miter, 1.41), 8, rounding);
        EXPECT_NEAR(added(Join::MiterClip, 1.2), 16 - std::pow(4 * (sqrt2 - 1.2), 2), rounding);
        EXPECT_NEAR(added(Join::MiterClip, 1), 16 - std::pow(4 * (sqrt2 - 1), 2), rounding);
    }
}

TEST(StrokeCoverage, TurningBack) {
    const Path path{MoveTo{{10, 30}}, LineTo{{30, 30}}, LineTo{{10, 30}}};
    EXPECT_NEAR(area(path, styleOf(4, Cap::Butt, Join::Miter)), 80, rounding);
    EXPECT_NEAR(area(path, styleOf(4, Cap::Butt, Join::Bevel)), 80, rounding);
    EXPECT_NEAR(area(path, styleOf(4, Cap::Butt, Join::Round)), 80 + 2 * pi, roundness);
    EXPECT_NEAR(area(path, styleOf(4, Cap::Butt, Join::MiterClip, 3)), 80 + 6 * 4, rounding);
}

/// Where rounding turns the line by a little more or less than half a turn.
TEST(StrokeCoverage, TurningBackWithinRounding) {
    for (int i = 0; i < 200; ++i) {
        const Point a{32.1, 31.7}, b = a + 17.3 * Point(std::cos(0.1 * i), std::sin(0.1 * i));
        const Path path{MoveTo{a}, LineTo{b}, LineTo{b + 0.3 * (a - b)}};
        EXPECT_NEAR(area(path, styleOf(4, Cap::Butt, Join::MiterClip, 3)), 4 * 17.3 + 6 * 4, 1e-6) << i;
        // The clipped mitre leaves the view: half the line.
        const double all = area({MoveTo{a + 1e3 * (b - a)}, LineTo{a}}, styleOf(4));
        EXPECT_NEAR(area(path, styleOf(4, Cap::Butt, Join::MiterClip, 2e9)), all, 1e-3) << i;
    }
}

TEST(StrokeCoverage, ClosedAndOpenSquares) {
    Path path = rectangle({20, 20}, {40, 40});
    EXPECT_NEAR(area(path, styleOf(4)), 24 * 24 - 16 * 16, rounding);
    EXPECT_NEAR(area(path, styleOf(4, Cap::Square, Join::Bevel)), 24 * 24 - 16 * 16 - 4 * 2, rounding);
    path.back() = LineTo{{20, 20}};  // the same without a join at the start
    EXPECT_NEAR(area(path, styleOf(4)), 24 * 24 - 16 * 16 - 4, rounding);
}

TEST(StrokeCoverage, LineFromTheClosedStart) {
    Path path = rectangle({20, 20}, {30, 30});
    path.push_back(LineTo{{10, 20}});
    EXPECT_NEAR(area(path, styleOf(2)), 12 * 12 - 8 * 8 + 9 * 2, rounding);
}

TEST(StrokeCoverage, CirclesBecomeRings) {
    EXPECT_NEAR(area(circle({31.3, 32.2}, 15), styleOf(6)), pi * 15 * 2 * 6, 2 * roundness);
    // Wider than the circle: the inner side runs backwards, and all is filled.
    EXPECT_NEAR(area(circle({31.3, 32.2}, 5), styleOf(20)), pi * 15 * 15, roundness);
    const Path ellipse{MoveTo{{12, 32}}, ArcTo{{20, 4}, 0, false, true, {52, 32}},
                       ArcTo{{20, 4}, 0, false, true, {12, 32}}, Close{}};
    for (const double c : coverage(ellipse, styleOf(14)))
        ASSERT_LE(c, 1 + rounding);
    // An offset further out than every radius of curvature: Steiner, area + perimeter·d + pi·d², for
    // the perimeter from the series in h = ((a-b)/(a+b))².
    const double h = 4.0 / 9,
                 perimeter =
                     pi * 24 * (1 + h / 4 + h * h / 64 + h * h * h / 256 + 25 * h * h * h * h / 16384);
    const double outer = 80 * pi + perimeter * 7 + 49 * pi;
    EXPECT_NEAR(area(ellipse, styleOf(14)), outer, 0.3);
}

TEST(StrokeCoverage, CurvesStartAcrossTheirTangent) {
    // A quarter ring: its ends are cut along the axes.
    const Path path{MoveTo{{10, 10}}, ArcTo{{30, 30}, 0, false, true, {40, 40}}};
    const auto c = coverage(path, styleOf(10));
    EXPECT_NEAR(std::accumulate(c.begin(), c.end(), 0.0), pi * 30 * 10 / 2, roundness);
    EXPECT_NEAR(coverageAt(c, 9, 7), 0, 1e-6);
    EXPECT_NEAR(coverageAt(c, 38, 40), 0, 1e-6);
    EXPECT_NEAR(coverageAt(c, 38, 39), 1, 1e-6);
}

TEST(StrokeCoverage, CuspIsRounded) {
    // Crossed control arms as long as the box is wide make a cusp at t = 1/2: (30, 17.5), pointing up.
    const Path path{MoveTo{{10, 40}}, CubicTo{{50, 10}, {10, 10}, {50, 40}}};
    const auto c = coverage(path, styleOf(8));
    EXPECT_NEAR(coverageAt(c, 29, 14), 1, 1e-3);
    EXPECT_NEAR(coverageAt(c, 29, 12), 0, 1e-3);
    const Path spike{MoveTo{{10, 30}}, CubicTo{{50, 30}, {50, 30}, {10, 30}}};  // turns back at x = 40
    EXPECT_NEAR(area(spike, styleOf(6)), 30 * 6 + 4.5 * pi, roundness);
}

Point cubicAt(const std::array<Point, 4>& p, double t) {
    const double u = 1 - t;
    return u * u * u * p[0] + 3 * u * u * t * p[1] + 3 * u * t * t * p[2] + t * t * t * p[3];
}

double distanceTo(const std::array<Point, 4>& curve, Point at) {
    double minimum = 1e9;
    for (int i = 0; i <= 2000; ++i) {
        const Point d = cubicAt(curve, i / 2000.0) - at;
        minimum = std::min(minimum, std::hypot(d.x, d.y));
    }
    return minimum;
}

/// With round caps a stroke is all that lies within half its width of the line.
TEST(StrokeCoverage, RoundStrokesAreWithinTheirDistance) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(8, 56);
    for (int round = 0; round < 20; ++round) {
        std::array<Point, 4> p;
        for (Point& q : p)
            q = {place(random), place(random)};
        if (round % 4 == 1)
            p[1] = p[0];
        if (round % 4 == 2)
            p[2] = p[1] + 0.01 * (p[2] - p[1]);
        const double half = 0.5 + round * 0.6;
        const auto c = coverage({MoveTo{p[0]}, CubicTo{p[1], p[2], p[3]}}, styleOf(2 * half, Cap::Round));
        for (int pixel = 0; pixel < 64 * 64; pixel += 3) {
            const double distance = distanceTo(p, {pixel % 64 + 0.5, pixel / 64 + 0.5});
            if (std::abs(distance - half) < 0.75)  // half a diagonal and the search's step
                continue;
            EXPECT_NEAR(c[std::size_t(pixel)], distance < half ? 1 : 0, 1e-6)
                << "round " << round << " pixel " << pixel;
        }
    }
}

TEST(StrokeCoverage, CoincidentPointsChangeNothing) {
    const Path plain{MoveTo{{10, 40}}, LineTo{{40, 40}}, LineTo{{40, 10}}};
    const Path doubled{MoveTo{{10, 40}}, LineTo{{10, 40}},
                       LineTo{{40, 40}}, CubicTo{{40, 40}, {40, 40}, {40, 40}},
                       LineTo{{40, 10}}, LineTo{{40, 10}}};
    EXPECT_EQ(coverage(plain, styleOf(5)), coverage(doubled, styleOf(5)));
    // Control points upon the ends: the direction comes from the next one.
    const Path curve{MoveTo{{10, 40}}, CubicTo{{10, 40}, {40, 40}, {40, 40}}};
    EXPECT_NEAR(area(curve, styleOf(5, Cap::Square)), 30 * 5 + 25, rounding);
    // Decimals whose thirds are rounded.
    const Point a{18.6472, 29.1723}, b{40, 48};
    for (const Point control : {a, b})
        EXPECT_NEAR(area({MoveTo{a}, QuadTo{control, b}}, styleOf(1)), glm::distance(a, b), rounding);
}

TEST(StrokeCoverage, RoundingAtTheClosingPointMakesNoJoin) {
    Path path = rectangle({20, 20}, {40, 40});
    path.back() = LineTo{{20 + 4e-15, 20 - 4e-15}};
    path.push_back(Close{});
    EXPECT_NEAR(area(path, styleOf(4)), 24 * 24 - 16 * 16, rounding);
    EXPECT_NEAR(area(path, styleOf(4, Cap::Butt, Join::Bevel)), 24 * 24 - 16 * 16 - 4 * 2, rounding);
}

TEST(StrokeCoverage, ZeroLengthSubpaths) {
    const std::vector<Path> dots{{MoveTo{{20, 20}}, Close{}},
                                 {MoveTo{{20, 20}}, LineTo{{20, 20}}},
                                 {MoveTo{{20, 20}}, CubicTo{{20, 20}, {20, 20}, {20, 20}}, Close{}}};
    for (const Path& dot : dots) {
        EXPECT_EQ(area(dot, styleOf(6)), 0);
        EXPECT_NEAR(area(dot, styleOf(6, Cap::Square)), 36, rounding);
        EXPECT_NEAR(area(dot, styleOf(6, Cap::Round)), 9 * pi, roundness);
    }
    EXPECT_EQ(area({MoveTo{{20, 20}}}, styleOf(6, Cap::Round)), 0);
    EXPECT_EQ(area({}, styleOf(6, Cap::Round)), 0);
}

TEST(StrokeCoverage, DashesFollowTheirPhase) {
    const Path path = line({10, 20}, {50, 20});
    // On [0, 3], [6, 11], [14, 19], [22, 27], [30, 35], [38, 40].
    EXPECT_NEAR(area(path, dashed({5, 3}, 2)), 25 * 2, rounding);
    EXPECT_NEAR(area(path, dashed({5, 3}, 2 - 80)), 25 * 2, rounding);
    EXPECT_NEAR(area(path, dashed({5, 3}, 2 + 800)), 25 * 2, rounding);
    // From 6 on: a gap [0, 2], on [2, 7], ….
    const auto c = coverage(path, dashed({5, 3}, 6));
    EXPECT_NEAR(coverageAt(c, 11, 20), 0, rounding);
    EXPECT_NEAR(coverageAt(c, 12, 20), 1, rounding);
    EXPECT_NEAR(coverageAt(c, 16, 20), 1, rounding);
    EXPECT_NEAR(coverageAt(c, 17, 20), 0, rounding);
}

TEST(StrokeCoverage, DashCapsAndDots) {
    const Path path = line({10, 20}, {49, 20});
    EXPECT_NEAR(area(path, dashed({6, 10}, 0, Cap::Square)), 3 * (6 + 2) * 2, rounding);
    EXPECT_NEAR(area(path, dashed({0, 10}, 0, Cap::Round)), 4 * pi, roundness);
    EXPECT_NEAR(area(path, dashed({0, 10}, 0, Cap::Butt)), 0, rounding);
}

TEST(StrokeCoverage, DashesTurnCornersAndRestartInSubpaths) {
    // The second dash, [15, 25], turns the corner at 20 with a mitre.
    const Path path{MoveTo{{10, 40}}, LineTo{{30, 40}}, LineTo{{30, 20}}};
    EXPECT_NEAR(area(path, dashed({10, 5})), (10 + 10 + 10) * 2, rounding);
    const Path two{MoveTo{{10, 10}}, LineTo{{22, 10}}, MoveTo{{10, 20}}, LineTo{{22, 20}}};
    EXPECT_NEAR(area(two, dashed({10, 5})), 40, rounding);
}

/// A square of perimeter 80 from its first corner; the decimals make sums of lengths inexact.
const Path& dashedSquare() {
    static const Path path = rectangle({20.1, 20.3}, {40.1, 40.3});
    return path;
}

StrokeStyle dashedWide(std::vector<double> dashes, double phase, Join join, Cap cap = Cap::Butt) {
    return {4, cap, join, 4, std::move(dashes), phase};
}

TEST(StrokeCoverage, DashesRunOverAClosedStart) {
    // Every corner is the middle of a dash of 10: two arms of 5 by 4 that share 2 by 2, and the join.
    const auto dashArea = [](Join join, Cap cap) {
        return area(dashedSquare(), dashedWide({10, 10}, 5, join, cap)) / 4;
    };
    EXPECT_NEAR(dashArea(Join::Bevel, Cap::Butt), 36 + 2, rounding);
    EXPECT_NEAR(dashArea(Join::Miter, Cap::Butt), 36 + 4, rounding);
    EXPECT_NEAR(dashArea(Join::Round, Cap::Butt), 36 + pi, roundness);
    EXPECT_NEAR(dashArea(Join::Bevel, Cap::Square), 36 + 2 + 2 * 2 * 4, rounding);
    EXPECT_NEAR(dashArea(Join::Bevel, Cap::Round), 36 + 2 + 4 * pi, roundness);
}

TEST(StrokeCoverage, DashesThatGoAllTheWayRoundAreClosed) {
    EXPECT_NEAR(area(dashedSquare(), dashedWide({100, 5}, 0, Join::Miter)), 24 * 24 - 16 * 16, rounding);
    EXPECT_NEAR(area(dashedSquare(), dashedWide({100, 5}, 0, Join::Bevel, Cap::Square)),
                24 * 24 - 16 * 16 - 4 * 2, rounding);
}

TEST(StrokeCoverage, DashesThatEndAtAClosedStartHaveTheirCaps) {
    // On [0, 10], [35, 45] round a corner, [70, 80].
    EXPECT_NEAR(area(dashedSquare(), dashedWide({10, 25}, 0, Join::Miter)), 3 * 40 - 4, rounding);
    // All the way round, but no further.
    EXPECT_NEAR(area(dashedSquare(), dashedWide({80, 5}, 0, Join::Miter)), 24 * 24 - 16 * 16 - 4, rounding);
}

TEST(StrokeCoverage, DashesThatEndAtAVertexDoNotTurn) {
    const Path path{MoveTo{{10, 40}}, LineTo{{30, 40}}, LineTo{{30, 20}}};
    EXPECT_NEAR(area(path, dashed({20, 5})), 20 * 2 + 15 * 2, rounding);
    // On [0, 0] and [70, 80], both at the start.
    const Path square = rectangle({20, 20}, {40, 40});
    EXPECT_NEAR(area(square, dashed({0, 70, 10, 90})), 10 * 2, rounding);
}

TEST(StrokeCoverage, DashesThatEndAtTheStartLeaveNoCapThere) {
    // On [10, 15] and [25, 30].
    EXPECT_NEAR(area(line({10, 20}, {48, 20}), dashed({5, 10}, 5, Cap::Square)), 2 * (5 + 2) * 2, rounding);
}

TEST(StrokeCoverage, HiddenClosedStarts) {
    Path path = rectangle({-1e6, -1e6}, {32, 32});
    const auto closed = coverage(path, dashed({7, 6}));
    path.back() = LineTo{{-1e6, -1e6}};
    EXPECT_TRUE(closed == coverage(path, dashed({7, 6})));
    EXPECT_NEAR(std::accumulate(closed.begin(), closed.end(), 0.0), 64 * 2 * 7 / 13.0, 16);
}

TEST(StrokeCoverage, DashesMeasureCurves) {
    const double halfTurn = pi * 15;
    EXPECT_NEAR(area(circle({32, 32}, 15), dashed({halfTurn, halfTurn})), halfTurn * 2, roundness);
    const auto c = coverage(circle({32, 32}, 15), dashed({halfTurn, halfTurn}));
    EXPECT_NEAR(coverageAt(c, 31, 46), 1, 1e-3);  // the lower half: the circle starts at its right
    EXPECT_NEAR(coverageAt(c, 31, 17), 0, 1e-3);
    EXPECT_NEAR(area(circle({32, 32}, 15), dashed({1, 2})), halfTurn * 2 * 2 / 3.0, 2.0);
}

TEST(StrokeCoverage, StrokesAreMadeBeforeTheTransform) {
    const Affine wide{3, 0, 0, 1, 0, 0};
    EXPECT_NEAR(area(circle({10, 30}, 5), styleOf(2), wide), 3 * pi * 5 * 2 * 2, 0.02);
    EXPECT_NEAR(area(line({10, 10}, {10, 40}), styleOf(2), wide), 30 * 6, rounding);
    const Affine mirrored{-1, 0, 0, 1, 64, 0};
    EXPECT_NEAR(area(circle({31.3, 32.2}, 15), styleOf(6), mirrored), pi * 15 * 2 * 6, 0.02);
    const Affine flat{1, 0, 0, 0, 0, 20.5};
    EXPECT_NEAR(area(circle({31.3, 32.2}, 15), styleOf(6), flat), 0, rounding);
}

TEST(StrokeCoverage, HugeStrokes) {
    EXPECT_NEAR(area(line({-1e30, 20}, {1e30, 20}), styleOf(4)), 256, rounding);
    EXPECT_NEAR(area(line({-1e9, 20}, {1e9, 20}), dashed({1, 1})), 64, 1e-3);
    EXPECT_NEAR(area(circle({32, 32}, 10), styleOf(1e20)), 4096, rounding);
    EXPECT_NEAR(area(circle({32 - 1e6, 32}, 1e6), styleOf(4)), 256, 0.1);
    const Path wild{MoveTo{{-1e30, 3e29}}, CubicTo{{1e30, -1e30}, {-1e30, -1e30}, {1e30, 1e30}}};
    for (const double c : coverage(wild, {1e25, Cap::Round, Join::Round, 4, {1, 2}, 0}))
        ASSERT_LE(c, 1 + 1e-6);
}

TEST(StrokeCoverage, TooManyDashesAreSolid) {
    EXPECT_NEAR(area(line({0, 20}, {64, 20}), dashed({1e-5, 1e-5})), 128, rounding);
    EXPECT_NEAR(area(line({0, 20}, {64, 20}), dashed({0.005, 0.005})), 64, 0.1);
    EXPECT_NEAR(area(line({0, 20}, {64, 20}), dashed({1e-300, 1e-300})), 128, rounding);
}

TEST(StrokeCoverage, MiterReachesIntoTheView) {
    // The corner lies outside, 10 above the view; the mitre of limit 20 points down into it.
    const Path path{MoveTo{{12, -400}}, LineTo{{32, -10}}, LineTo{{52, -400}}};
    const auto c = coverage(path, styleOf(4, Cap::Butt, Join::Miter, 20));
    EXPECT_GT(coverageAt(c, 31, 5), 0.9);
    EXPECT_EQ(area(path, styleOf(4, Cap::Butt, Join::Bevel)), 0);
}

}  // namespace
}  // namespace vtm::reference
