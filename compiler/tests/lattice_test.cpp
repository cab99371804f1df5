#include "compiler/src/lattice.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "compiler/src/outline.hpp"
#include "compiler/src/winding.hpp"

namespace vtm::compiler {
namespace {

TEST(Lattice, roundToEvenNeverPassesAnOddInteger) {
    for (int denominator = 1; denominator <= 7; ++denominator)
        for (int numerator = -60; numerator <= 60; ++numerator) {
            const double exact = static_cast<double>(numerator) / denominator;
            const Coord even = roundToEven(numerator, denominator);
            EXPECT_EQ(even % 2, 0);
            EXPECT_LE(std::abs(even - exact), 1) << numerator << "/" << denominator;
            if (exact != std::floor(exact) || numerator / denominator % 2 == 0) {
                EXPECT_LT(std::abs(even - exact), 1) << numerator << "/" << denominator;
            }
        }
}

TEST(Lattice, cornerOnAnEdgeCountsAsMovedToTheRight) {
    const LatticePoint a{0, 0}, b{10, 10}, corner{5, 5};
    EXPECT_FALSE(cornerOnLeft(a, b, corner));  // rising: +x is the right
    EXPECT_TRUE(cornerOnLeft(b, a, corner));
}

TEST(Lattice, thePictureReachesJustBeyondTheRootSquare) {
    const Lattice lattice(1024, 600, 22);
    const Square root = lattice.square();
    EXPECT_LT(scene::apply(lattice.toSteps(), {0, 0}).x, root.x0);
    EXPECT_GT(scene::apply(lattice.toSteps(), {1024, 0}).x, root.x1());
    EXPECT_NEAR(lattice.clampMax().y, scene::apply(lattice.toSteps(), {0, 600}).y, 1e-6);
    EXPECT_LT(lattice.clampMax().y, root.y1());
}

TEST(Lattice, bordersOfCellsAreOddAtEveryLevel) {
    Square s = Lattice(1, 1, 24).square();
    for (int level = 0; level <= 10; ++level, s = s.child(1, 2)) {
        EXPECT_NE(s.x0 % 2, 0);
        EXPECT_NE(s.x1() % 2, 0);
        EXPECT_NE(s.y0 % 2, 0);
    }
}

int windingAt(const std::vector<Chord>& chords, LatticePoint p) {
    int w = 0;
    for (const Chord& c : chords)
        w += windingAlongX(c, p.y, -1001, p.x);
    return w;
}

TEST(Winding, isPlusOneInsideAContourThatIsCounterClockwiseInTheNumbers) {
    const std::vector<Chord> square{
        {{0, 0}, {100, 0}}, {{100, 0}, {100, 100}}, {{100, 100}, {0, 100}}, {{0, 100}, {0, 0}}};
    EXPECT_EQ(windingAt(square, {51, 51}), 1);
    EXPECT_EQ(windingAt(square, {151, 51}), 0);
    EXPECT_EQ(windingAt(square, {-51, 51}), 0);
}

TEST(Winding, isTheSameByEveryWay) {
    const std::vector<Chord> triangle{{{2, 4}, {96, 30}}, {{96, 30}, {20, 88}}, {{20, 88}, {2, 4}}};
    const LatticePoint from{-11, -11};
    for (Coord y = -9; y < 100; y += 2)
        for (Coord x = -9; x < 110; x += 2) {
            int byCorner = 0;
            for (const Chord& c : triangle)
                byCorner += windingBetween(c, from, {x, y});
            EXPECT_EQ(byCorner, windingAt(triangle, {x, y})) << x << ", " << y;
        }
}

std::vector<Chord> outlineInBox(const scene::Path& path, double tolerance = 0.5) {
    return outline(path, scene::identity, tolerance, {-16, -16}, {1000, 1000});
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
    for (const Chord& c : outlineInBox(path))
        sum.x += c.b.x - c.a.x, sum.y += c.b.y - c.a.y;
    EXPECT_EQ(sum, (LatticePoint{0, 0}));
    EXPECT_EQ(outlineInBox(path).size(), 6u);
}

TEST(Outline, chordsOfACircleStayWithinTheTolerance) {
    const scene::Path circle{scene::MoveTo{{900, 500}}, scene::ArcTo{{400, 400}, 0, false, true, {100, 500}},
                             scene::ArcTo{{400, 400}, 0, false, true, {900, 500}}, scene::Close{}};
    const std::vector<Chord> chords = outlineInBox(circle, 2);
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
    const std::vector<Chord> chords = outlineInBox(huge);
    EXPECT_LT(chords.size(), 100u);
    EXPECT_EQ(windingAt(chords, {101, 101}), 1);
    EXPECT_EQ(windingAt(chords, {901, 401}), 1);
    EXPECT_EQ(windingAt(chords, {101, 601}), 0);
}

TEST(Outline, radiiTooSmallForTheirChordGrow) {
    const scene::Path arc{scene::MoveTo{{100, 500}}, scene::ArcTo{{1, 1}, 0, false, true, {900, 500}},
                          scene::Close{}};
    Coord top = 1000;
    for (const Chord& c : outlineInBox(arc))
        top = std::min(top, c.a.y);
    EXPECT_NEAR(top, 100, 2);
}

}  // namespace
}  // namespace vtm::compiler
