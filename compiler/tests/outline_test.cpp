#include "compiler/lower/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "compiler/lower/even_shares.hpp"
#include "compiler/planar/clipped_run.hpp"
#include "compiler/stroke/chords.hpp"

namespace vtm::compiler {
namespace {

Outlines outlineInBox(const scene::Path& path, double tolerance = 0.5) {
    Outlines outlines;
    addOutline(outlines, path, scene::identity, tolerance, {-16, -16}, {1000, 1000});
    return outlines;
}

std::vector<Chord> chordsOf(const Outlines& outlines) {
    std::vector<Chord> chords;
    for (const auto& run : outlines.runs)
        for (std::uint32_t i = run.first; i < run.last; ++i)
            chords.push_back(outlines.chord(i));
    return chords;
}

int windingAt(const Outlines& outlines, LatticePoint p) {
    int w = 0;
    for (const auto& run : outlines.runs)
        w += windingAlongX(outlines.points, {run.first, run.last, 0}, p.y, -1001, p.x);
    return w;
}

const scene::Path wave{scene::MoveTo{{10, 400}}, scene::CubicTo{{200, -500}, {400, 1300}, {600, 300}},
                       scene::LineTo{{900, 900}}, scene::QuadTo{{300, 1000}, {20, 700}}, scene::Close{}};

/// Chords of a path that were made for another place.
TEST(Outline, ContoursMovedAreThoseOfThePathThere) {
    const scene::Point min{-16, -16}, max{1000, 1000};
    const scene::Affine linear{0.5, 0.1, -0.2, 0.4, 0, 0};
    const FlatContours contours = flatten(wave, linear, 0.5);
    for (const scene::Point by : {scene::Point{300.25, 200.5}, scene::Point{411.375, 251}}) {
        Outlines moved, there;
        ASSERT_TRUE(addContours(moved, contours, by, min, max));
        addOutline(there, wave, {linear[0], linear[1], by}, 0.5, min, max);
        EXPECT_TRUE(std::ranges::equal(moved.points, there.points));
        EXPECT_TRUE(
            std::ranges::equal(moved.runs, there.runs, [](const compiler::Run& a, const compiler::Run& b) {
                return a.first == b.first && a.last == b.last;
            }));
    }
    Outlines none;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const scene::Point by : {scene::Point{-900, 300}, scene::Point{300, 2000}, scene::Point{nan, 300}})
        EXPECT_FALSE(addContours(none, contours, by, min, max));
    EXPECT_TRUE(none.points.empty() && none.runs.empty());
}

TEST(Winding, isPlusOneInsideAContourThatIsCounterClockwiseInTheNumbers) {
    const Outlines square = outlineInBox(scene::polygon({{0, 0}, {100, 0}, {100, 100}, {0, 100}}));
    EXPECT_EQ(windingAt(square, {51, 51}), 1);
    EXPECT_EQ(windingAt(square, {151, 51}), 0);
    EXPECT_EQ(windingAt(square, {-51, 51}), 0);
}

TEST(Winding, isTheSameByEveryWay) {
    const Outlines outlines = outlineInBox(wave);
    const LatticePoint from{-21, -21};
    for (Coord y = -9; y < 1000; y += 14)
        for (Coord x = -9; x < 1000; x += 14) {
            int byCorner = 0;
            for (const auto& run : outlines.runs)
                byCorner += windingBetween(outlines.points, {run.first, run.last, 0}, from, {x, y});
            EXPECT_EQ(byCorner, windingAt(outlines, {x, y})) << x << ", " << y;
        }
}

TEST(ClippedRun, holdsExactlyTheChordsThatPassThroughASquare) {
    const Outlines outlines = outlineInBox(wave);
    for (const Coord side : {16, 64, 256})
        for (Coord y = -1; y < 1000; y += side)
            for (Coord x = -1; x < 1000; x += side) {
                const Square square{x, y, side};
                for (const auto& run : outlines.runs) {
                    const ClippedRun s = narrowed(outlines.points, {run.first, run.last, 0}, square);
                    for (std::uint32_t i = run.first; i < run.last; ++i)
                        EXPECT_EQ(i >= s.first && i < s.last,
                                  meets(outlines.points[i], outlines.points[i + 1], square));
                }
            }
}

TEST(Outline, runsAreMonotoneAndFollowEachOther) {
    const Outlines outlines = outlineInBox(wave);
    EXPECT_GT(outlines.runs.size(), 3u);
    EXPECT_LT(outlines.runs.size(), 16u);
    for (std::size_t r = 0; r < outlines.runs.size(); ++r) {
        const auto run = outlines.runs[r];
        EXPECT_EQ(run.first, r > 0 ? outlines.runs[r - 1].last : 0);
        const LatticePoint a = outlines.points[run.first], b = outlines.points[run.last];
        for (const std::uint32_t i : {run.first, run.last - 1}) {
            const Chord c = outlines.chord(i);
            EXPECT_GE(std::int64_t{c.b.x - c.a.x} * (b.x - a.x), 0);
            EXPECT_GE(std::int64_t{c.b.y - c.a.y} * (b.y - a.y), 0);
        }
    }
}

TEST(Outline, closesEverySubpath) {
    const scene::Path path{scene::MoveTo{{10, 10}},
                           scene::LineTo{{50, 10}},
                           scene::LineTo{{50, 60}},
                           scene::MoveTo{{100, 100}},
                           scene::LineTo{{140, 100}},
                           scene::LineTo{{140, 160}},
                           scene::Close{}};
    LatticePoint sum{};
    const std::vector<Chord> chords = chordsOf(outlineInBox(path));
    for (const Chord& c : chords)
        sum.x += c.b.x - c.a.x, sum.y += c.b.y - c.a.y;
    EXPECT_EQ(sum, (LatticePoint{0, 0}));
    EXPECT_EQ(chords.size(), 6u);
}

TEST(Outline, pointsAloneMakeNoRuns) {
    const Outlines outlines = outlineInBox(
        {scene::MoveTo{{10, 10}}, scene::MoveTo{{20, 20}}, scene::LineTo{{20, 20}}, scene::Close{}});
    EXPECT_TRUE(outlines.runs.empty());
    EXPECT_TRUE(outlines.points.empty());
}

/// As that of a `line` element.
TEST(Outline, linesThereAndBackMakeNoRuns) {
    const scene::Path triangle = scene::polygon({{0, 0}, {100, 0}, {100, 100}});
    const Outlines expected = outlineInBox(triangle);
    scene::Path path{scene::MoveTo{{10, 10}}, scene::LineTo{{500, 700}}};
    path.insert(path.end(), triangle.begin(), triangle.end());
    for (const scene::Path& line :
         {scene::Path{scene::MoveTo{{10, 10}}, scene::LineTo{{500, 10}}, scene::Close{}},
          scene::Path{scene::MoveTo{{3, 3}}, scene::LineTo{{3, 3}}, scene::LineTo{{900, 600}}}})
        path.insert(path.end(), line.begin(), line.end());
    const Outlines outlines = outlineInBox(path);
    EXPECT_EQ(outlines.runs.size(), expected.runs.size());
    EXPECT_TRUE(std::ranges::equal(outlines.points, expected.points));
}

TEST(Outline, chordsOfACircleStayWithinTheTolerance) {
    const scene::Path circle{scene::MoveTo{{900, 500}}, scene::ArcTo{{400, 400}, 0, false, true, {100, 500}},
                             scene::ArcTo{{400, 400}, 0, false, true, {900, 500}}, scene::Close{}};
    const std::vector<Chord> chords = chordsOf(outlineInBox(circle, 2));
    EXPECT_GT(chords.size(), 15u);
    for (const Chord& c : chords) {
        const double x = (c.a.x + c.b.x) / 2.0 - 500, y = (c.a.y + c.b.y) / 2.0 - 500;
        EXPECT_NEAR(std::hypot(x, y), 400, 2 + 1.5);  // sagitta, and even vertices
    }
}

TEST(Outline, geometryBeyondTheBoxKeepsItsWindingsInside) {
    const scene::Path huge{scene::MoveTo{{-1e30, -1e30}}, scene::LineTo{{1e30, -1e30}},
                           scene::LineTo{{1e30, 500}},
                           scene::CubicTo{{1e20, 500}, {-1e20, 500}, {-1e30, 500}}, scene::Close{}};
    const Outlines outlines = outlineInBox(huge);
    EXPECT_LT(outlines.points.size(), 100u);
    EXPECT_EQ(windingAt(outlines, {101, 101}), 1);
    EXPECT_EQ(windingAt(outlines, {901, 401}), 1);
    EXPECT_EQ(windingAt(outlines, {101, 601}), 0);
}

/// Near the box such a curve is the rounding of numbers that cancel each other, and no chord of it can be
/// proven.
TEST(Outline, curvesTooLargeForDoublesEnd) {
    const scene::Affine lean{-1.265625, 0, 1.828, 0.5156, 491, 341};
    for (const double far : {1e20, 1e33, 1e48}) {
        const scene::Path huge{scene::MoveTo{{845, 139}},
                               scene::CubicTo{{-far, -far}, {124, 368}, {263, 313}}, scene::Close{}};
        Outlines outlines;
        addOutline(outlines, huge, lean, 0.5, {-100, -100}, {1100, 1100});
        EXPECT_LT(outlines.points.size(), 5000u) << far;
    }
}

TEST(Outline, curvesThatLeaveTheBoxKeepTheirWindingsInside) {
    const scene::Path leaves{scene::MoveTo{{500, 500}},
                             scene::CubicTo{{3000, -2000}, {4000, 3000}, {400, 800}},
                             scene::CubicTo{{-3000, 4000}, {-2500, -2500}, {300, 200}}, scene::Close{}};
    Outlines whole;
    addOutline(whole, leaves, scene::identity, 0.5, {-10000, -10000}, {10000, 10000});
    const Outlines cut = outlineInBox(leaves);
    EXPECT_LT(3 * cut.points.size(), 2 * whole.points.size());
    for (Coord y = -9; y < 1000; y += 14)
        for (Coord x = -9; x < 1000; x += 14) {
            int winding = 0;
            for (const auto& run : whole.runs)
                winding += windingAlongX(whole.points, {run.first, run.last, 0}, y, -10001, x);
            EXPECT_EQ(windingAt(cut, {x, y}), winding) << x << ", " << y;
        }
}

TEST(Outline, ofAStrokeIsThatOfItsPath) {
    const scene::Affine map{0.9, 0.1, -0.2, 1.1, 30, -40};
    for (const auto join : {scene::Join::Miter, scene::Join::Round})
        for (const double width : {3.0, 400.0}) {
            scene::StrokeStyle style;
            style.width = width;
            style.join = join;
            Outlines straight, byPath;
            addStroke(straight, wave, style, 0.125, 0.375, map, 0.375, {-16, -16}, {1000, 1000});
            addOutline(byPath, strokeOutlineOfChords(wave, style, 0.125, 0.375), map, 0.375, {-16, -16},
                       {1000, 1000});
            EXPECT_EQ(straight.points, byPath.points);
            EXPECT_EQ(straight.runs.size(), byPath.runs.size());
        }
}

TEST(EvenShares, cutWhereTheIntegralsAreEqual) {
    // sqrt(t) from 1 to 4, times 3: the integral is 2 t^(3/2) - 2.
    for (const double scale : {1.0, 20.0}) {  // with few steps and with many
        EvenShares shares;
        const double sum = shares.integrate(1, 4, [&](Pair t) { return 3 * scale * squareRoot(t); });
        EXPECT_NEAR(sum, 14 * scale, 0.02 * scale);
        std::array<double, 6> ends;
        shares.cut(7, ends.data());
        for (int k = 1; k < 7; ++k)
            EXPECT_NEAR(ends[std::size_t(k - 1)], std::pow(k + 1, 2.0 / 3), 2e-3);
    }
}

TEST(Outline, radiiTooSmallForTheirChordGrow) {
    const scene::Path arc{scene::MoveTo{{100, 500}}, scene::ArcTo{{1, 1}, 0, false, true, {900, 500}},
                          scene::Close{}};
    Coord top = 1000;
    for (const LatticePoint p : outlineInBox(arc).points)
        top = std::min(top, p.y);
    EXPECT_NEAR(top, 100, 2);
}

}  // namespace
}  // namespace vtm::compiler
