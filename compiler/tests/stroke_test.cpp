#include <vtm/compiler/stroke.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <vtm/compiler/compile.hpp>
#include "compiler/stroke/chords.hpp"
#include "compiler/tests/stroke_support.hpp"

namespace vtm::compiler {
namespace {

/// Ternary search round each local minimum of the samples.
double distanceTo(const Curve& c, Point p) {
    constexpr int steps = 100;
    const auto distance = [&](double t) { return glm::distance(at(c, t), p); };
    std::array<double, steps + 1> coarse{};
    for (int i = 0; i <= steps; ++i)
        coarse[std::size_t(i)] = distance(double(i) / steps);
    double best = std::min(coarse.front(), coarse.back());
    for (int i = 0; i <= steps; ++i) {
        const int before = std::max(i - 1, 0), after = std::min(i + 1, steps);
        if (coarse[std::size_t(i)] > std::min(coarse[std::size_t(before)], coarse[std::size_t(after)]))
            continue;
        double low = double(before) / steps, high = double(after) / steps;
        for (int k = 0; k < 60; ++k) {
            const double third = (high - low) / 3;
            if (distance(low + third) < distance(high - third))
                high -= third;
            else
                low += third;
        }
        best = std::min(best, distance((low + high) / 2));
    }
    return best;
}

double distanceTo(const std::vector<Curve>& spine, Point p) {
    double best = std::numeric_limits<double>::infinity();
    for (const Curve& c : spine)
        best = std::min(best, distanceTo(c, p));
    return best;
}

Path circle(Point center, double radius) {
    const Point r{radius, radius}, x{radius, 0};
    return {MoveTo{center + x}, ArcTo{r, 0, false, true, center - x}, ArcTo{r, 0, false, true, center + x},
            Close{}};
}

// --- cusps ---------------------------------------------------------------------------------------

/// Arms shorter than the stroke is wide do not hide what the normal sweeps behind a cusp.
TEST(Stroke, TurnsAllTheWayRoundAtACusp) {
    const Path path{MoveTo{{0, 0}}, CubicTo{{1, 1}, {0, 1}, {1, 0}}};  // its tip at (0.5, 0.75), pointing up
    const Path outline = strokeOutline(path, style(20), 1e-4);
    const Point tip{0.5, 0.75};
    for (int i = 0; i < 64; ++i) {
        const Point out{std::cos(2 * pi * i / 64), std::sin(2 * pi * i / 64)};
        EXPECT_TRUE(inside(outline, tip + 9.99 * out)) << i;
    }
    EXPECT_FALSE(inside(outline, tip + Point{0, 10.01}));
}

// --- the stroke is the set of points near the path ----------------------------------------------------

/// Random points, half of them close to the boundary, must be inside or outside as their distance to the
/// path says, unless they are within the tolerance of the boundary.
void expectNeighbourhood(const Path& path, double width, double tolerance, unsigned seed, int samples = 300) {
    const Path outline = strokeOutline(path, style(width, Cap::Round, Join::Round), tolerance);
    const auto spine = curves(path), border = curves(outline);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1), angle(0, 2 * pi);
    const double rounding = 1e-9 * (width + 100);
    for (int i = 0; i < samples; ++i) {
        const Point on = at(spine[std::size_t(share(random) * double(spine.size()))], share(random));
        const double reach =
            i % 2 ? share(random) * width : width / 2 + (share(random) - 0.5) * 20 * tolerance;
        const double a = angle(random);
        const Point p = on + Point{std::cos(a), std::sin(a)} * reach;
        const double d = distanceTo(spine, p);
        if (std::abs(d - width / 2) <= tolerance + rounding)
            continue;
        const int w = winding(border, p);
        ASSERT_GE(w, 0) << "seed " << seed << " width " << width << " at " << p.x << "," << p.y;
        ASSERT_EQ(w != 0, d < width / 2) << "seed " << seed << " width " << width << " tolerance "
                                         << tolerance << " distance " << d << " at " << p.x << "," << p.y;
    }
}

Point randomPoint(std::mt19937& random) {
    std::uniform_real_distribution<double> d(0, 100);
    return {d(random), d(random)};
}

struct Case {
    double width, tolerance;
};

class Neighbourhood : public testing::TestWithParam<Case> {};

TEST_P(Neighbourhood, RandomCubics) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        std::mt19937 random(seed);
        const Point a = randomPoint(random), b = randomPoint(random), c = randomPoint(random),
                    d = randomPoint(random);
        expectNeighbourhood({MoveTo{a}, CubicTo{b, c, d}}, GetParam().width, GetParam().tolerance, seed);
    }
}

TEST_P(Neighbourhood, RandomQuads) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        const Point a = randomPoint(random), b = randomPoint(random), c = randomPoint(random);
        expectNeighbourhood({MoveTo{a}, QuadTo{b, c}}, GetParam().width, GetParam().tolerance, seed);
    }
}

TEST_P(Neighbourhood, RandomClosedMixtures) {
    for (unsigned seed = 0; seed < 25; ++seed) {
        std::mt19937 random(seed);
        Path path{MoveTo{randomPoint(random)}};
        for (int i = 0; i < 3; ++i) {
            path.push_back(LineTo{randomPoint(random)});
            const Point b = randomPoint(random), c = randomPoint(random), d = randomPoint(random);
            path.push_back(CubicTo{b, c, d});
        }
        if (seed % 2)
            path.push_back(Close{});
        expectNeighbourhood(path, GetParam().width, GetParam().tolerance, seed);
    }
}

TEST_P(Neighbourhood, RandomPolygons) {
    for (unsigned seed = 0; seed < 25; ++seed) {
        std::mt19937 random(seed);
        Path path{MoveTo{randomPoint(random)}};
        for (unsigned i = 0; i < 2 + seed % 12; ++i)
            path.push_back(LineTo{randomPoint(random)});
        if (seed % 3)
            path.push_back(Close{});
        expectNeighbourhood(path, GetParam().width, GetParam().tolerance, seed);
    }
}

TEST_P(Neighbourhood, CuspsLoopsAndHairpins) {
    const Point o{0, 0};
    const std::vector<Path> paths{
        {MoveTo{o}, CubicTo{{100, 100}, {0, 100}, {100, 0}}},          // a cusp in the middle
        {MoveTo{o}, CubicTo{{100, 100.001}, {0, 100.001}, {100, 0}}},  // a tiny loop
        {MoveTo{o}, CubicTo{{100, 99.999}, {0, 99.999}, {100, 0}}},    // nearly a cusp
        {MoveTo{o}, CubicTo{{150, 100}, {-50, 100}, {100, 0}}},        // a loop
        {MoveTo{o}, CubicTo{{150, 0}, {-50, 0}, {100, 0}}},            // back and forth on a line
        {MoveTo{o}, CubicTo{{150, 1e-7}, {-50, 0}, {100, 0}}},         // nearly so
        {MoveTo{o}, QuadTo{{100, 0.01}, {0, 0.02}}},                   // a hairpin
        {MoveTo{o}, QuadTo{{100, 0}, {0, 0}}},                         // and back
        {MoveTo{o}, CubicTo{o, {50, 80}, {100, 0}}},                   // no speed at the start
        {MoveTo{o}, CubicTo{{50, 80}, {100, 0}, {100, 0}}},            // none at the end
        {MoveTo{o}, CubicTo{o, {100, 0}, {100, 0}}},                   // at neither
        {MoveTo{o}, CubicTo{{1e-6, 1e-6}, {50, 80}, {100, 0}}},        // nearly none
        {MoveTo{o}, CubicTo{{100, 0}, {0, 0}, {0, 100}}},
        {MoveTo{o}, CubicTo{{100, 0}, o, o}},
    };
    for (std::size_t i = 0; i < paths.size(); ++i) {
        SCOPED_TRACE("path " + std::to_string(i));
        expectNeighbourhood(paths[i], GetParam().width, GetParam().tolerance, unsigned(i), 1000);
    }
}

INSTANTIATE_TEST_SUITE_P(Stroke, Neighbourhood,
                         testing::Values(Case{0.01, 1e-3}, Case{1, 1e-5}, Case{5, 1e-2}, Case{20, 1e-4},
                                         Case{20, 1e-1}, Case{60, 1e-3}, Case{200, 1e-2}, Case{1000, 1e-1},
                                         Case{1000, 1e-4}));

// --- other caps and joins ------------------------------------------------------------------------------

/// Inside, or no farther from the inside than the border's error.
bool coveredNearby(const std::vector<Curve>& border, Point p, double tolerance) {
    if (winding(border, p) > 0)
        return true;
    for (int i = 0; i < 12; ++i) {
        const double a = 2 * pi * i / 12;
        if (winding(border, p + Point{std::cos(a), std::sin(a)} * (1.5 * tolerance)) > 0)
            return true;
    }
    return false;
}

/// Whatever the style: what the normals sweep is inside, and with flat caps and joins nothing farther than
/// half the width is.
TEST_P(Neighbourhood, FlatStylesCoverTheSweep) {
    const auto [width, tolerance] = GetParam();
    for (unsigned seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        const Curve c{randomPoint(random), randomPoint(random), randomPoint(random), randomPoint(random)};
        const Path path{MoveTo{c[0]}, CubicTo{c[1], c[2], c[3]}};
        const auto border = curves(strokeOutline(path, style(width, Cap::Butt, Join::Bevel), tolerance));
        std::uniform_real_distribution<double> share(0.001, 0.999), across(-1, 1);
        for (int i = 0; i < 200; ++i) {
            const double t = share(random), e = 1e-6;
            const Point along = glm::normalize(at(c, t + e) - at(c, t - e));
            const double reach = std::max(0.0, width / 2 - 2 * tolerance) * across(random);
            const Point p = at(c, t) + Point{-along.y, along.x} * reach;
            ASSERT_TRUE(coveredNearby(border, p, tolerance))
                << "seed " << seed << " t " << t << " reach " << reach;
            const Point q = randomPoint(random) * 3.0 - Point{100, 100};
            if (distanceTo(c, q) > width / 2 + tolerance) {
                ASSERT_EQ(winding(border, q), 0) << "seed " << seed;
            }
        }
    }
}

TEST(StrokeCaps, OfALine) {
    const Path line = polyline({{10, 10}, {30, 10}});
    EXPECT_NEAR(area(strokeOutline(line, style(4, Cap::Butt), 1e-3)), 80, 1e-9);
    EXPECT_NEAR(area(strokeOutline(line, style(4, Cap::Square), 1e-3)), 96, 1e-9);
    EXPECT_NEAR(area(strokeOutline(line, style(4, Cap::Round), 1e-4)), 80 + 4 * pi, 4 * pi * 1e-4);
    EXPECT_TRUE(inside(strokeOutline(line, style(4, Cap::Square), 1e-3), {31.9, 11.9}));
    EXPECT_FALSE(inside(strokeOutline(line, style(4, Cap::Round), 1e-3), {31.9, 11.9}));
    EXPECT_FALSE(inside(strokeOutline(line, style(4, Cap::Butt), 1e-3), {30.1, 10}));
}

TEST(StrokeCaps, OfZeroLengthSubpaths) {
    for (const Path& dot : {Path{MoveTo{{5, 5}}, LineTo{{5, 5}}}, Path{MoveTo{{5, 5}}, Close{}},
                            Path{MoveTo{{5, 5}}, CubicTo{{5, 5}, {5, 5}, {5, 5}}, Close{}},
                            Path{MoveTo{{5, 5}}, ArcTo{{3, 3}, 0, true, true, {5, 5}}}}) {
        EXPECT_TRUE(strokeOutline(dot, style(2, Cap::Butt), 1e-3).empty());
        EXPECT_NEAR(area(strokeOutline(dot, style(2, Cap::Square), 1e-3)), 4, 1e-12);
        EXPECT_NEAR(area(strokeOutline(dot, style(2, Cap::Round), 1e-5)), pi, pi * 2e-5);
        EXPECT_TRUE(inside(strokeOutline(dot, style(2, Cap::Square), 1e-3), {5.99, 5.99}));
    }
    EXPECT_TRUE(strokeOutline({MoveTo{{5, 5}}}, style(2, Cap::Round), 1e-3).empty());
    EXPECT_TRUE(strokeOutline({}, style(2, Cap::Round), 1e-3).empty());
}

/// The corner of a right angle at (10, 0), the path turning from +x to +y; its outer corner lies at (11, -1)
/// for width 2.
Path corner() { return polyline({{0, 0}, {10, 0}, {10, 10}}); }
double cornerArea(StrokeStyle s) { return area(strokeOutline(corner(), s, 1e-5)); }

TEST(StrokeJoins, AtARightAngle) {
    // Two arms of 10 x 2 that overlap in a unit square, and the join.
    EXPECT_NEAR(cornerArea(style(2, Cap::Butt, Join::Bevel)), 39 + 0.5, 1e-9);
    EXPECT_NEAR(cornerArea(style(2, Cap::Butt, Join::Miter)), 39 + 1, 1e-9);
    EXPECT_NEAR(cornerArea(style(2, Cap::Butt, Join::Round)), 39 + pi / 4, 1e-4);
}

TEST(StrokeJoins, MiterLimit) {
    StrokeStyle s = style(2, Cap::Butt, Join::Miter);
    s.miterLimit = std::sqrt(2) + 1e-9;
    EXPECT_NEAR(cornerArea(s), 40, 1e-9);
    s.miterLimit = std::sqrt(2) - 1e-9;
    EXPECT_NEAR(cornerArea(s), 39.5, 1e-9);
    s.join = Join::MiterClip;  // the mitre's tip reaches √2 from the corner
    EXPECT_NEAR(cornerArea(s), 40, 1e-7);
    s.miterLimit = 1.2;
    const double cut = std::sqrt(2) - 1.2;  // a right isosceles triangle of this height is missing
    EXPECT_NEAR(cornerArea(s), 40 - cut * cut, 1e-9);
}

TEST(StrokeJoins, TurningBack) {
    const Path path = polyline({{0, 0}, {10, 0}, {0, 0}});
    EXPECT_FALSE(inside(strokeOutline(path, style(2, Cap::Butt, Join::Bevel), 1e-3), {10.5, 0}));
    EXPECT_FALSE(inside(strokeOutline(path, style(2, Cap::Butt, Join::Miter), 1e-3), {10.5, 0}));
    EXPECT_TRUE(inside(strokeOutline(path, style(2, Cap::Butt, Join::Round), 1e-3), {10.9, 0}));
    EXPECT_FALSE(inside(strokeOutline(path, style(2, Cap::Butt, Join::Round), 1e-3), {-0.1, 0}));
    StrokeStyle clip = style(2, Cap::Butt, Join::MiterClip);
    clip.miterLimit = 3;
    EXPECT_TRUE(inside(strokeOutline(path, clip, 1e-3), {12.9, 0.9}));
    EXPECT_FALSE(inside(strokeOutline(path, clip, 1e-3), {13.1, 0}));
}

TEST(StrokeJoins, ClosedSquareHasAHole) {
    const Path square = polyline({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, true);
    const Path outline = strokeOutline(square, style(2), 1e-3);
    EXPECT_EQ(contours(outline), 2u);
    EXPECT_EQ(edges(outline), 8u);
    EXPECT_NEAR(area(outline), 12 * 12 - 8 * 8, 1e-9);
    // A closing line of no length has no join of its own.
    const Path explicitly = polyline({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}, true);
    EXPECT_NEAR(area(strokeOutline(explicitly, style(2), 1e-3)), 80, 1e-9);
    EXPECT_EQ(edges(strokeOutline(explicitly, style(2), 1e-3)), 8u);
}

TEST(StrokeJoins, WideStrokeLeavesNoHole) {
    for (const double width : {15.0, 20.0, 25.0, 100.0}) {
        const Path triangle = polyline({{0, 0}, {20, 0}, {10, 17}}, true);
        EXPECT_TRUE(inside(strokeOutline(triangle, style(width), 1e-3), {10, 5.7})) << width;
    }
}

TEST(StrokeJoins, SmoothOnesAddNothing) {
    const Path straight = polyline({{0, 0}, {5, 0}, {10, 0}});
    EXPECT_EQ(edges(strokeOutline(straight, style(2), 1e-3)), 6u);
    const Path halves{MoveTo{{0, 0}}, CubicTo{{5, 10}, {15, 10}, {20, 0}},
                      CubicTo{{25, -10}, {35, -10}, {40, 0}}};
    const auto whole = edges(strokeOutline(halves, style(2), 1e-2));
    for (const Join join : {Join::Bevel, Join::Round, Join::MiterClip})
        EXPECT_EQ(edges(strokeOutline(halves, style(2, Cap::Butt, join), 1e-2)), whole);
}

// --- edges ---------------------------------------------------------------------------------------------

/// Up to its end the curve is tighter than the stroke is wide, and goes on as a line.
TEST(StrokeJoins, LinesGoOnFromTightEnds) {
    const Path there{MoveTo{{175, 15}}, CubicTo{{175, 30}, {175.1, 175}, {175, 175}}, LineTo{{15, 175}}};
    const Path back{MoveTo{{15, 175}}, LineTo{{175, 175}}, CubicTo{{175.1, 175}, {175, 30}, {175, 15}}};
    const Path arc{MoveTo{{15, 175}}, LineTo{{175, 175}}, ArcTo{{2, 2}, 0, false, false, {177, 173}},
                   LineTo{{177, 15}}};
    for (const Path& path : {there, back, arc})
        for (const auto& outline :
             {strokeOutline(path, style(20), 1e-3), strokeOutlineOfChords(path, style(20), 5e-4, 5e-4)})
            for (const double along : {20.0, 60.0, 120.0, 160.0}) {
                for (const double across : {-9.9, -5.0, 0.0, 5.0, 9.9})
                    EXPECT_TRUE(inside(outline, {along, 175 + across})) << along << ' ' << across;
                EXPECT_FALSE(inside(outline, {along, 164.9})) << along;
                EXPECT_FALSE(inside(outline, {along, 185.1})) << along;
            }
}

TEST(StrokeEdges, LineTakesFour) {
    EXPECT_EQ(edges(strokeOutline(polyline({{1, 2}, {30, 40}}), style(3), 1e-3)), 4u);
    EXPECT_EQ(contours(strokeOutline(polyline({{1, 2}, {30, 40}}), style(3), 1e-3)), 1u);
}

TEST(StrokeEdges, CircleTakesFewCubics) {
    for (const auto& [tolerance, maximum] : {std::pair{1e-1, 8u}, {1e-2, 16u}, {1e-3, 18u}, {1e-5, 40u}}) {
        const Path outline = strokeOutline(circle({50, 50}, 40), style(10), tolerance);
        EXPECT_EQ(contours(outline), 2u);
        EXPECT_LE(edges(outline), maximum + 2u) << tolerance;  // and two Close
        EXPECT_NEAR(area(outline), pi * (45 * 45 - 35 * 35), 2 * pi * 80 * tolerance);
    }
}

TEST(StrokeEdges, CircleFilledToItsCentre) {
    const Path outline = strokeOutline(circle({0, 0}, 10), style(20), 1e-3);
    EXPECT_LE(edges(outline), 30u);
    for (double x = 0.01; x < 20; x += 0.3)
        EXPECT_EQ(inside(outline, {x * 0.6, x * 0.8}), x < 20);
}

TEST(StrokeEdges, CubicCircleFilledToItsCentre) {
    const double k = 5.522847498;  // the usual arm of a quarter circle of radius 10
    const Path path{MoveTo{{10, 0}},
                    CubicTo{{10, k}, {k, 10}, {0, 10}},
                    CubicTo{{-k, 10}, {-10, k}, {-10, 0}},
                    CubicTo{{-10, -k}, {-k, -10}, {0, -10}},
                    CubicTo{{k, -10}, {10, -k}, {10, 0}},
                    Close{}};
    EXPECT_LE(edges(strokeOutline(path, style(20), 0.1)), 16u);
    for (const double tolerance : {1e-1, 1e-2, 1e-4})
        expectNeighbourhood(path, 20, tolerance, 1);
}

TEST(StrokeArcs, CirclesOfAnyWidth) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(0, 2 * pi);
    for (const double width : {0.1, 5.0, 19.0, 20.0, 21.0, 30.0, 200.0})
        for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
            const auto border = curves(strokeOutline(circle({3, 4}, 10), style(width), tolerance));
            for (double r = 0.0137; r < 10 + width; r += (10 + width) / 97) {
                const double a = angle(random), d = std::abs(r - 10) - width / 2;
                if (std::abs(d) > tolerance) {
                    EXPECT_EQ(winding(border, Point{3, 4} + Point{std::cos(a), std::sin(a)} * r) > 0, d < 0)
                        << width << " " << tolerance << " " << r;
                }
            }
        }
}

TEST(StrokeArcs, SectorBeyondTheCentre) {
    // A quarter of a circle of radius 2, three wide to each side: flat ends sweep over the centre.
    const Path quarter{MoveTo{{2, 0}}, ArcTo{{2, 2}, 0, false, true, {0, 2}}};
    const Path outline = strokeOutline(quarter, style(6), 1e-4);
    EXPECT_TRUE(inside(outline, Point{0.7, 0.7} * 4.9));
    EXPECT_TRUE(inside(outline, Point{-0.7, -0.7} * 0.9));
    EXPECT_FALSE(inside(outline, Point{-0.7, -0.7} * 1.1));
    EXPECT_FALSE(inside(outline, {1, -0.1}));
    EXPECT_FALSE(inside(outline, {-0.9, 0.1}));
    EXPECT_NEAR(area(outline), pi / 4 * (25 + 1), 1e-2);
}

TEST(StrokeEdges, ErrorFallsWithTheSixthPower) {
    const Path path{MoveTo{{0, 0}}, CubicTo{{20, 60}, {70, 80}, {100, 30}}};
    const auto coarse = edges(strokeOutline(path, style(10), 1e-2)),
               fine = edges(strokeOutline(path, style(10), 1e-5));
    EXPECT_LE(coarse, 8u);
    EXPECT_LE(fine, 3 * coarse) << "a thousandth of the error for √10 = 3.2 times the pieces";
}

TEST(StrokeEdges, ChordsLieWhereTheOffsetsDo) {
    constexpr double tolerance = 1e-4, reach = 1.1 * tolerance;
    const stroke::Cubic curves[] = {{{0, 0}, {20, 60}, {70, 80}, {100, 30}},
                                    {{0, 0}, {0, 0}, {-5.4, -9.1}, {-1.9, -7.2}},  // tight where it begins
                                    {{0, 0}, {60, 40}, {20, -40}, {90, 20}},       // with an inflection
                                    {{0, 0}, {40, 10}, {60, -10}, {100, 0}}};
    for (const stroke::Cubic& c : curves) {
        const Path path{MoveTo{c.p0}, CubicTo{c.p1, c.p2, c.p3}};
        const Path outline = strokeOutlineOfChords(path, style(0.4), tolerance / 4, tolerance * 3 / 4);
        for (int i = 2; i < 1000; ++i) {
            const double t = i / 1000.0 * i / 1000.0;
            const Point on = c.at(t), side = stroke::perp(stroke::tangentAt(c, t));
            if (std::min(glm::distance(on, c.p0), glm::distance(on, c.p3)) < 2 * reach)
                continue;  // by the caps
            for (const double sign : {-1.0, 1.0}) {
                EXPECT_TRUE(inside(outline, on + side * (sign * (0.2 - reach)))) << t;
                EXPECT_FALSE(inside(outline, on + side * (sign * (0.2 + reach)))) << t;
            }
        }
    }
}

TEST(StrokeEdges, EllipticalArcs) {
    const Path ellipse{MoveTo{{30, 0}}, ArcTo{{30, 10}, 0, false, true, {-30, 0}},
                       ArcTo{{30, 10}, 0, false, true, {30, 0}}, Close{}};
    const Path outline = strokeOutline(ellipse, style(2), 1e-4);
    for (int i = 0; i < 100; ++i) {
        const double a = 2 * pi * i / 100;
        const Point on{30 * std::cos(a), 10 * std::sin(a)};
        const Point normal = glm::normalize(Point{10 * std::cos(a), 30 * std::sin(a)});
        EXPECT_TRUE(inside(outline, on + normal * 0.999));
        EXPECT_TRUE(inside(outline, on - normal * 0.999));
        EXPECT_FALSE(inside(outline, on + normal * 1.001));
        EXPECT_FALSE(inside(outline, on - normal * 1.001));
    }
    // Radii too small for the chord grow until they fit; none at all mean a straight line.
    const Path small{MoveTo{{0, 0}}, ArcTo{{1, 1}, 0, false, true, {20, 0}}};
    EXPECT_TRUE(inside(strokeOutline(small, style(2), 1e-3), {10, -10}));
    const Path flat{MoveTo{{0, 0}}, ArcTo{{0, 5}, 0, false, true, {20, 0}}};
    EXPECT_EQ(edges(strokeOutline(flat, style(2), 1e-3)), 4u);
}

// --- dashes --------------------------------------------------------------------------------------------

StrokeStyle dashed(double width, std::vector<double> dashes, double phase = 0, Cap cap = Cap::Butt) {
    StrokeStyle s = style(width, cap);
    s.dashes = std::move(dashes);
    s.dashPhase = phase;
    return s;
}

TEST(StrokeDashes, OnALine) {
    const Path line = polyline({{0, 0}, {100, 0}});
    const Path outline = strokeOutline(line, dashed(2, {10, 5}), 1e-3);
    EXPECT_EQ(contours(outline), 7u);
    EXPECT_NEAR(area(outline), 2 * 70, 1e-9);
    EXPECT_TRUE(inside(outline, {9.99, 0}));
    EXPECT_FALSE(inside(outline, {10.01, 0}));
    EXPECT_TRUE(inside(outline, {15.01, 0}));
}

TEST(StrokeDashes, Phase) {
    const Path line = polyline({{0, 0}, {100, 0}});
    for (const double phase : {12.0, 27.0, -3.0, 12.0 + 15e6}) {
        const Path outline = strokeOutline(line, dashed(2, {10, 5}, phase), 1e-3);
        EXPECT_FALSE(inside(outline, {2.99, 0})) << phase;
        EXPECT_TRUE(inside(outline, {3.01, 0})) << phase;
        EXPECT_TRUE(inside(outline, {12.99, 0})) << phase;
        EXPECT_FALSE(inside(outline, {13.01, 0})) << phase;
    }
}

TEST(StrokeDashes, GoRoundCornersWithAJoin) {
    const Path outline = strokeOutline(corner(), dashed(2, {14, 100}, -3), 1e-3);
    EXPECT_EQ(contours(outline), 1u);
    EXPECT_TRUE(inside(outline, {10.9, -0.9}));
    EXPECT_NEAR(area(outline), 14 * 2, 1e-9);
}

TEST(StrokeDashes, EndAtACornerWithoutTurning) {
    const Path outline = strokeOutline(corner(), dashed(2, {10, 100}), 1e-3);
    EXPECT_EQ(edges(outline), 4u);
    EXPECT_NEAR(area(outline), 20, 1e-9);
}

TEST(StrokeDashes, RunOverTheStartOfAClosedPath) {
    const Path square = polyline({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, true);
    // From 35 along the fourth side over the start to 5 on the first: one piece with a mitred corner.
    const Path outline = strokeOutline(square, dashed(2, {10, 30}, 5), 1e-3);
    EXPECT_EQ(contours(outline), 1u);
    EXPECT_TRUE(inside(outline, {-0.9, -0.9}));
    EXPECT_NEAR(area(outline), 20, 1e-9);
    // A dash without end leaves the ring closed.
    EXPECT_EQ(contours(strokeOutline(square, dashed(2, {1000, 1}), 1e-3)), 2u);
    EXPECT_EQ(contours(strokeOutline(square, dashed(2, {1, 0}), 1e-3)), 2u);
}

TEST(StrokeDashes, HaveEqualLengthsOnCurves) {
    const double r = 40, period = 2 * pi * r / 16;
    const Path outline = strokeOutline(circle({0, 0}, r), dashed(4, {period / 2, period / 2}), 1e-5);
    EXPECT_EQ(contours(outline), 16u);
    for (int i = 0; i < 16; ++i)
        for (const double edge : {0.0, 0.5}) {
            const double a = 2 * pi * (i + edge) / 16;
            const bool starts = edge == 0;
            EXPECT_EQ(inside(outline, Point{std::cos(a + 1e-4), std::sin(a + 1e-4)} * r), starts);
            EXPECT_EQ(inside(outline, Point{std::cos(a - 1e-4), std::sin(a - 1e-4)} * r), !starts);
        }
}

TEST(StrokeDashes, OfNoLengthAreDots) {
    const Path line = polyline({{0, 0}, {7, 7}});
    EXPECT_TRUE(strokeOutline(line, dashed(2, {0, 3}), 1e-3).empty());
    const Path squares = strokeOutline(line, dashed(2, {0, 3}, 0, Cap::Square), 1e-3);
    EXPECT_EQ(contours(squares), 4u);
    EXPECT_TRUE(inside(squares, {1.3, 0})) << "turned with the path: corner at √2";
}

TEST(StrokeDashes, TooManyThrow) {
    const Path line = polyline({{0, 0}, {100, 0}});
    EXPECT_THROW(strokeOutline(line, dashed(2, {1e-5, 1e-5}), 1e-3), LimitError);
    EXPECT_THROW(strokeOutline(line, dashed(2, {1e-300, 1e-300}), 1e-3), LimitError);
    EXPECT_NO_THROW(strokeOutline(line, dashed(2, {1e-2, 1e-2}), 1e-3));
}

// --- hostile input -------------------------------------------------------------------------------------

TEST(StrokeLimits, ExtremeSizesEnd) {
    for (const double size : {1e-200, 1e-30, 1e-9, 1e9, 1e30, 1e47})
        for (const double width : {1e-30, 1.0, 1e30}) {
            const Path path{MoveTo{{0, 0}}, CubicTo{{size, size}, {0, size}, {size, 0}},
                            CubicTo{{3 * size, 0}, {-size, size / 7}, {0, size / 9}}, Close{}};
            const Path outline = strokeOutline(path, style(width, Cap::Square, Join::MiterClip), 1e-5);
            EXPECT_LT(outline.size(), 10000u) << size << " " << width;
            for (const Curve& c : curves(outline))
                for (const Point p : c)
                    EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << size << " " << width;
        }
    EXPECT_THROW(strokeOutline(polyline({{0, 0}, {1e60, 0}}), style(1), 1e-3), LimitError);
}

TEST(StrokeLimits, SegmentsTooShortForTheWidth) {
    for (const Join join : {Join::Miter, Join::MiterClip, Join::Round, Join::Bevel})
        for (const bool closed : {false, true}) {
            const double e = 1e-20;
            StrokeStyle s = style(2, Cap::Square, join);
            s.miterLimit = 1e300;
            const Path path = polyline({{0, 0}, {e, e}, {2 * e, -e}, {-e, -3 * e}, {e, e}}, closed);
            for (const Curve& c : curves(strokeOutline(path, s, 1e-3)))
                for (const Point p : c)
                    EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
        }
}

TEST(StrokeLimits, MitreOfATurnBackIsFinite) {
    StrokeStyle s = style(2, Cap::Butt, Join::Miter);
    s.miterLimit = 1e300;
    const Path outline = strokeOutline(polyline({{0, 0}, {10, 0}, {0, 0}}), s, 1e-3);
    EXPECT_FALSE(inside(outline, {10.5, 0}));
    for (const Curve& c : curves(outline))
        EXPECT_TRUE(std::isfinite(c[3].x) && std::isfinite(c[3].y));
}

TEST(StrokeLimits, ControlPointsOnALattice) {
    // Every coincidence of control points that a 3 x 3 lattice allows.
    for (int code = 0; code < 9 * 9 * 9; ++code) {
        const auto lattice = [](int i) { return Point{double(i % 3), double(i / 3)} * 10.0; };
        const Path path{MoveTo{lattice(4)},
                        CubicTo{lattice(code % 9), lattice(code / 9 % 9), lattice(code / 81)}};
        expectNeighbourhood(path, 3, 1e-2, unsigned(code), 40);
        if (HasFatalFailure())
            FAIL() << "code " << code;
    }
}

}  // namespace
}  // namespace vtm::compiler
