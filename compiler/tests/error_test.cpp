// The error that the compiler claims to prove.

#include <cmath>
#include <numbers>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/stroke.hpp>
#include "asset/walk.hpp"
#include "compiler/stroke/chords.hpp"
#include "compiler/tests/leaf_support.hpp"
#include "raster/coverage.hpp"

namespace vtm::compiler {
namespace {

using scene::Path;
using scene::Point;

constexpr Square square{-1, -1, 4096};

// ---- snapping ---------------------------------------------------------------------------------

double distance(LatticePoint p, const Chord& c) {
    const double dx = c.b.x - c.a.x, dy = c.b.y - c.a.y, x = p.x - c.a.x, y = p.y - c.a.y;
    const double t = std::clamp((x * dx + y * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    return std::hypot(x - t * dx, y - t * dy);
}

/// On a coarse lattice, where rounding makes new crossings again and again.
TestLeaf tangle(unsigned seed) {
    Random random(seed);
    std::vector<Polygon> polygons(3);
    for (Polygon& polygon : polygons)
        for (int i = 0; i < 12; ++i)
            polygon.push_back({random.even(0, 200), random.even(0, 200)});
    return leafOf(square, polygons);
}

/// The farthest that an edge lies from its layer's outline, at its vertices.
double farthest(const TestLeaf& leaf, const EdgeSet& set) {
    double worst = 0;
    for (const Edge& e : set.edges)
        for (const Change& change : set.of(e))
            for (const LatticePoint p : {e.a, e.b}) {
                double best = 1e30;
                leaf.forEachChord([&](const Chord& c, std::uint32_t layer) {
                    if (layer == change.layer)
                        best = std::min(best, distance(p, c));
                });
                worst = std::max(worst, best);
            }
    return worst;
}

TEST(Error, snappingTellsHowFarItBendsEdges) {
    Snapper snapper;
    double maximum = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        const TestLeaf leaf = tangle(seed);
        const EdgeSet* set = snapper.run(square, leaf.points(), leaf.cell.clippedRuns);
        ASSERT_TRUE(set);
        const double moved = farthest(leaf, *set);
        EXPECT_LE(moved, set->bend + 1e-9) << "seed " << seed;
        maximum = std::max(maximum, moved);
    }
    EXPECT_GT(maximum, 1);  // steps: the test looks at something
}

TEST(Error, crossingsOnTheLatticeBendNothing) {
    const TestLeaf leaf =
        leafOf(square, {{{0, 0}, {200, 200}, {0, 200}}, {{0, 100}, {300, 100}, {300, 300}}});
    Snapper snapper;
    const EdgeSet* set = snapper.run(square, leaf.points(), leaf.cell.clippedRuns);
    ASSERT_TRUE(set);
    EXPECT_EQ(set->bend, 0);
}

// ---- fitting ----------------------------------------------------------------------------------

/// Of a point in leaf coordinates to a piece: the nearest of many points.
double distance(Point p, const Tree::Piece& piece) {
    constexpr int steps = 200;
    const Point a(piece.a[0], piece.a[1]), ab = Point(piece.b[0], piece.b[1]) - a;
    double best = 1e30;
    for (int i = 0; i <= steps; ++i) {
        const double s = double(i) / steps, mA = piece.slopeA / double{asset::slopeScale},
                     mB = piece.slopeB / double{asset::slopeScale};
        const double t = s * (1 - s) * (mA * (1 - s) - mB * s);
        best = std::min(best, std::hypot(a.x + s * ab.x - t * ab.y - p.x, a.y + s * ab.y + t * ab.x - p.y));
    }
    return best;
}

/// Chains of few long chords, on which the cubic's sag between the vertices counts.
TEST(Error, fittedPiecesLieWithinTheToleranceBetweenVerticesToo) {
    constexpr double tolerance = 6, scale = double{asset::leafExtent} / 4096;
    std::size_t pieces = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        Polygon polygon;
        for (int i = 0; i < 40; ++i) {
            const double angle = 2 * 3.14159265358979 * i / 40;
            polygon.push_back({2000 + 2 * Coord(400 * std::cos(angle)) + random.even(-6, 6),
                               2000 + 2 * Coord(400 * std::sin(angle)) + random.even(-6, 6)});
        }
        const TestLeaf test = leafOf(square, {polygon});
        const Planned planned(test);
        ASSERT_TRUE(planned.leaf.certified);
        Fitter fitter;
        const FittedLeaf& fitted = fitter.run(square, planned.leaf, tolerance);
        pieces += fitted.pieces.size();
        test.forEachChord([&](const Chord& c, std::uint32_t) {
            for (int i = 0; i < 16; ++i) {
                const Point p =
                    (Point(c.a.x, c.a.y) + i / 16.0 * Point(c.b.x - c.a.x, c.b.y - c.a.y) + 1.0) * scale;
                double best = 1e30;
                for (const Tree::Piece& piece : fitted.pieces)
                    best = std::min(best, distance(p, piece));
                EXPECT_LE(best, tolerance * scale + 1) << "seed " << seed;
            }
        });
    }
    EXPECT_LT(pieces, 20u * 40u);  // some chords were joined
}

// ---- strokes ----------------------------------------------------------------------------------

using Bezier = std::array<Point, 4>;

Point at(const Bezier& c, double t) {
    const double u = 1 - t;
    return c[0] * (u * u * u) + c[1] * (3 * u * u * t) + c[2] * (3 * u * t * t) + c[3] * (t * t * t);
}

/// The nearest of many points, made better by ternary search.
double distance(Point p, const Bezier& c) {
    constexpr int steps = 400;
    const auto to = [&](double t) { return std::hypot(at(c, t).x - p.x, at(c, t).y - p.y); };
    int nearest = 0;
    for (int i = 1; i <= steps; ++i)
        nearest = to(double(i) / steps) < to(double(nearest) / steps) ? i : nearest;
    double low = std::max(0, nearest - 1) / double(steps),
           high = std::min(steps, nearest + 1) / double(steps);
    for (int i = 0; i < 60; ++i) {
        const double a = (2 * low + high) / 3, b = (low + 2 * high) / 3;
        (to(a) < to(b) ? high : low) = to(a) < to(b) ? b : a;
    }
    return to((low + high) / 2);
}

/// Offsets are tested at fifteen points of a piece when they are made; here at many, with round caps so that
/// all of the outline should lie at half the width. (Inner loops may lie nearer.)
TEST(Error, ofOffsetCurvesStaysInItsShareBetweenTheSamples) {
    double worst = 0;
    for (const double tolerance : {1e-2, 1e-4, 1e-6})
        for (unsigned seed = 0; seed < 12; ++seed) {
            Random random(seed);
            Bezier c;
            for (Point& p : c)
                p = {random.even(0, 100), random.even(0, 100)};
            scene::StrokeStyle round;
            round.width = 4, round.cap = scene::Cap::Round, round.join = scene::Join::Round;
            Point from(0);
            for (const scene::Command& command :
                 strokeOutline({scene::MoveTo{c[0]}, scene::CubicTo{c[1], c[2], c[3]}}, round, tolerance)) {
                if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
                    for (int i = 1; i < 60; ++i)
                        worst = std::max(
                            worst,
                            (distance(at({from, cubic->control1, cubic->control2, cubic->to}, i / 60.0), c) -
                             round.width / 2) /
                                tolerance);
                }
                std::visit(
                    [&](const auto& d) {
                        if constexpr (requires { d.to; })
                            from = d.to;
                    },
                    command);
            }
        }
    EXPECT_LE(worst, 1);
    EXPECT_GE(worst, 0.3);  // tolerances: the fit makes use of them
    RecordProperty("worst", std::to_string(worst));
}

/// Curves that are nowhere tighter than the stroke: all of both sides should lie at half the width.
TEST(Error, ofOffsetsAsChordsStaysInItsShare) {
    constexpr double share = 1.0 / 3;  // of the whole, the rest is for the chords
    double worst = 0;
    for (const double tolerance : {1e-1, 1e-3})
        for (unsigned seed = 0; seed < 12; ++seed) {
            Random random(seed);
            const Bezier c{Point(0, 0), Point(random.even(10, 40), random.even(0, 40)),
                           Point(random.even(60, 90), random.even(60, 100)), Point(100, 100)};
            scene::StrokeStyle butt;
            butt.width = 0.5;
            Point from(0);
            for (const scene::Command& command :
                 strokeOutlineOfChords({scene::MoveTo{c[0]}, scene::CubicTo{c[1], c[2], c[3]}}, butt,
                                       tolerance * share, tolerance * (1 - share))) {
                EXPECT_FALSE(std::holds_alternative<scene::CubicTo>(command));
                const auto* line = std::get_if<scene::LineTo>(&command);
                if (const auto* start = std::get_if<scene::MoveTo>(&command))
                    from = start->to;
                if (!line)
                    continue;
                const bool isEnd = std::hypot(line->to.x - from.x, line->to.y - from.y) > 0.49 &&
                                   std::min(distance(line->to, {c[0], c[0], c[0], c[0]}),
                                            distance(line->to, {c[3], c[3], c[3], c[3]})) < 0.26;
                for (int i = 0; i <= 8 && !isEnd; ++i) {
                    const Point p = from + (line->to - from) * (i / 8.0);
                    worst = std::max(worst, std::abs(distance(p, c) - butt.width / 2) / tolerance);
                }
                from = line->to;
            }
        }
    EXPECT_LE(worst, 1);
    EXPECT_GE(worst, 0.5);  // the chords make use of it
    RecordProperty("worst", std::to_string(worst));
}

// ---- the whole --------------------------------------------------------------------------------

scene::Scene sceneOf(Path path, std::variant<scene::FillRule, scene::StrokeStyle> geometry,
                     double side = 64) {
    scene::Item item;
    item.path = std::make_shared<Path>(std::move(path));
    item.geometry = std::move(geometry);
    item.paint = scene::Color{0, 0, 0, 1};
    scene::Scene scene{side, side, {}};
    scene.root.children.push_back({item});
    return scene;
}

const Path ellipses{scene::MoveTo{{60, 32}},
                    scene::ArcTo{{28, 20}, 0, false, true, {4, 32}},
                    scene::ArcTo{{28, 20}, 0, false, true, {60, 32}},
                    scene::Close{},
                    scene::MoveTo{{40, 60}},
                    scene::ArcTo{{15, 28}, 0.3, false, true, {30, 4}},
                    scene::ArcTo{{15, 28}, 0.3, false, true, {40, 60}}};

TEST(Error, isWithinTheToleranceAtAllThatCanBeProven) {
    scene::StrokeStyle line;
    line.width = 3;
    for (const scene::Scene& scene : {sceneOf(ellipses, scene::FillRule::EvenOdd), sceneOf(ellipses, line)})
        for (int bits = 6; bits <= 24; ++bits)
            for (const double share : {1.0, 0.7}) {
                const double tolerance = std::max(share * std::ldexp(1.0, -bits), std::ldexp(1.0, -24));
                const Result result = compile(scene, {.tolerance = tolerance});
                EXPECT_LE(result.provenError, tolerance) << tolerance;
                EXPECT_GT(result.provenError, tolerance / 4) << tolerance;
                EXPECT_TRUE(result.unproven.empty());
                EXPECT_TRUE(result.warnings.empty());
            }
}

/// How far a stroke's drawn pieces begin from half its width beside the curve, at most, in units of what is
/// proven. With round ends all that shows lies there.
double strayOf(const Bezier& curve, double width, double tolerance, int& pieces) {
    scene::StrokeStyle round;
    round.width = width, round.cap = scene::Cap::Round, round.join = scene::Join::Round;
    const Result result =
        compile(sceneOf({scene::MoveTo{curve[0]}, scene::CubicTo{curve[1], curve[2], curve[3]}}, round),
                {.tolerance = tolerance});
    const asset::Asset& asset = result.asset;
    const asset::Map& map = asset.maps[0];
    double worst = 0;
    asset::walk(asset, map.root, [&](asset::Cell cell, asset::Entry entry) {
        if (entry.kind() != asset::Entry::Kind::Leaf)
            return;
        const double side = std::ldexp(map.side, -2 * int(cell.level));
        const asset::Leaf& leaf = asset.leaves[entry.payload()];
        for (std::uint32_t i = 0; i < leaf.pieceCount; ++i, ++pieces) {
            const asset::Piece& piece = asset.pieces[leaf.firstPiece + i];
            const Point p = Point(map.x, map.y) +
                            side * (Point(cell.x, cell.y) + Point(piece.a[0], piece.a[1]) / 65535.0);
            worst = std::max(worst, std::abs(distance(p, curve) - width / 2) / (64 * result.provenError));
        }
    });
    return worst;
}

/// Where a curve is tighter than the stroke, its inner side turns in a cusp, between whose two branches
/// rounding may open threads, deep inside the stroke. A control point in the end of a curve makes it
/// infinitely tight there, for so little of a turn that the branches lie side by side all the way.
TEST(Error, ofStrokesOfTightCurvesIsWithinTheTolerance) {
    double worst = 0;
    int pieces = 0;
    for (unsigned seed = 0; seed < 25; ++seed) {
        Random random(seed);
        const auto place = [&] {
            return Point(random.even(12000, 52000), random.even(12000, 52000)) / 1000.0;
        };
        const Point a = place(), b = place(), c = place(), d = place();
        for (const Bezier& curve : {Bezier{a, a, c, d}, Bezier{a, b, d, d}, Bezier{a, b, c, d}})
            for (const double width : {3.0, 20.0})
                for (const double tolerance : {0x1p-12, 0x1p-16})
                    worst = std::max(worst, strayOf(curve, width, tolerance, pieces));
    }
    EXPECT_LE(worst, 1);
    EXPECT_GE(pieces, 25 * 12 * 30);
}

TEST(Error, isSaidToBeLargerWhereTheLatticeIsTooCoarse) {
    const double tolerance = std::ldexp(1.0, -26);
    const Result result = compile(sceneOf(ellipses, scene::FillRule::EvenOdd), {.tolerance = tolerance});
    EXPECT_GT(result.provenError, tolerance);
    EXPECT_LT(result.provenError, 8 * tolerance);
    EXPECT_EQ(result.warnings.size(), 1u);
}

TEST(Error, ofWholeSquaresIsNone) {
    EXPECT_EQ(compile(sceneOf(scene::rectangle({0, 0}, {64, 64}), scene::FillRule::NonZero)).provenError, 0);
}

/// More chords than a leaf may have, in a square of the last level.
TEST(Error, leavesThatAreGivenUpAreNamed) {
    Path needles;
    for (int i = 0; i < 3000; ++i) {
        const double y = 32.1 + 0.8 * i / 3000;
        needles.insert(needles.end(), {scene::MoveTo{{40.2, y}}, scene::LineTo{{40.8, y + 1e-4}},
                                       scene::LineTo{{40.5, y + 2e-4}}});
    }
    const Result result =
        compile(sceneOf(needles, scene::FillRule::NonZero), {.tolerance = 1e-6, .maxDepth = 3});
    EXPECT_EQ(result.asset.fallbackLeaves, 1u);
    ASSERT_EQ(result.unproven.size(), 1u);
    EXPECT_EQ(result.unproven[0].x, 40);
    EXPECT_EQ(result.unproven[0].y, 32);
    EXPECT_EQ(result.unproven[0].side, 1);
}

/// Triangles that miss each other by ten tolerances or so, at 2^-20.
scene::Scene nearlyCoincident(int count) {
    int k = 0;
    const auto near = [&k](double x, double y) {
        const auto off = [&k] { return ++k, 1e-5 * std::sin(1.7 * k * k); };
        const double right = off(), down = off();
        return Point{x + right, y + down};
    };
    Path path;
    for (int i = 0; i < count; ++i) {
        const Point a = near(5, 9), b = near(59, 50), c = near(30, 61);
        path.insert(path.end(), {scene::MoveTo{a}, scene::LineTo{b}, scene::LineTo{c}, scene::Close{}});
    }
    return sceneOf(path, scene::FillRule::EvenOdd);
}

/// Thin triangles with a corner in one point.
scene::Scene rays(int count) {
    const Point middle{32.17, 31.89};
    Path path;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        const Point along{30 * std::cos(angle), 30 * std::sin(angle)}, aside{-along.y / 9000, along.x / 9000};
        path.insert(path.end(), {scene::MoveTo{middle}, scene::LineTo{middle + along},
                                 scene::LineTo{middle + along + aside}, scene::Close{}});
    }
    return sceneOf(path, scene::FillRule::EvenOdd);
}

void expectProven(const scene::Scene& scene, double tolerance) {
    const Result result = compile(scene, {.tolerance = tolerance});
    EXPECT_LE(result.provenError, tolerance);
    EXPECT_EQ(result.asset.fallbackLeaves, 0u);
    EXPECT_TRUE(result.unproven.empty());
    EXPECT_TRUE(result.warnings.empty());
}

TEST(Error, isProvenForManyNearlyCoincidentOutlines) { expectProven(nearlyCoincident(300), 0x1p-20); }

TEST(Error, isProvenWhereManyOutlinesMeet) { expectProven(rays(3000), 0x1p-16); }

TEST(Error, strokesAlongCurvesAreCounted) {
    scene::StrokeStyle line;
    line.width = 3;
    const Path circle{scene::MoveTo{{60, 32}}, scene::ArcTo{{28, 28}, 0, false, true, {4, 32}}};
    const Path curve{scene::MoveTo{{60, 32}}, scene::QuadTo{{28, 28}, {4, 32}}};
    EXPECT_EQ(compile(sceneOf(ellipses, line)).sampledStrokes, 1u);
    EXPECT_EQ(compile(sceneOf(curve, line)).sampledStrokes, 1u);
    EXPECT_EQ(compile(sceneOf(circle, line)).sampledStrokes, 0u);
    EXPECT_EQ(compile(sceneOf(ellipses, scene::FillRule::NonZero)).sampledStrokes, 0u);
}

}  // namespace
}  // namespace vtm::compiler
