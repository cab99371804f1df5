#include "compiler/src/fit.hpp"

#include <cmath>

#include "compiler/tests/leaf_support.hpp"

namespace vtm::compiler {
namespace {

constexpr Square square{-1, -1, 4096};

/// Distance of a point, in leaf coordinates, to the nearest of the pieces' dense samples.
double distanceToPieces(const FittedLeaf& leaf, double x, double y) {
    double best = 1e30;
    for (const Tree::Piece& p : leaf.pieces)
        for (int i = 0; i <= 400; ++i) {
            const double s = i / 400.0, mA = p.slopeA / double{asset::slopeScale},
                         mB = p.slopeB / double{asset::slopeScale};
            const double t = mA * s * (1 - s) * (1 - s) - mB * s * s * (1 - s);
            const double dx = p.b[0] - p.a[0], dy = p.b[1] - p.a[1];
            best = std::min(best, std::hypot(p.a[0] + s * dx - t * dy - x, p.a[1] + s * dy + t * dx - y));
        }
    return best;
}

/// Plans and fits a leaf.
struct Fitted {
    Planned planned;
    Fitter fitter;
    const FittedLeaf& leaf;

    Fitted(const TestLeaf& test, double tolerance)
        : planned(test), leaf(fitter.run(test.square, planned.leaf, tolerance)) {
        EXPECT_TRUE(planned.leaf.certified);
    }
};

TEST(Fit, aCircleTakesFewPiecesWithinTheTolerance) {
    const scene::Path circle{scene::MoveTo{{3800, 2047}},
                             scene::ArcTo{{1800, 1800}, 0, false, true, {200, 2047}},
                             scene::ArcTo{{1800, 1800}, 0, false, true, {3800, 2047}}, scene::Close{}};
    const double tolerance = 2;
    const TestLeaf test(square, {circle});
    const Fitted fitted(test, tolerance);
    EXPECT_LE(fitted.leaf.pieces.size(), 20u);
    const double scale = double{asset::leafExtent} / square.side;
    for (const LatticePoint p : test.points())
        EXPECT_LE(distanceToPieces(fitted.leaf, (p.x + 1) * scale, (p.y + 1) * scale),
                  (tolerance + 1) * scale);
    for (const Tree::Piece& p : fitted.leaf.pieces) {
        const bool inwards = p.left == 1;  // counter-clockwise in the numbers
        EXPECT_TRUE(inwards ? p.right == 0 : p.left == 0 && p.right == 1);
    }
}

TEST(Fit, aStraightEdgeIsOnePiece) {
    const Fitted fitted(leafOf(square, {{{-3000, 500}, {7000, 1500}, {7000, 9000}, {-3000, 9000}}}), 1);
    ASSERT_EQ(fitted.leaf.pieces.size(), 1u);
    EXPECT_EQ(fitted.leaf.pieces[0].slopeA, 0);
    EXPECT_EQ(fitted.leaf.pieces[0].slopeB, 0);
}

TEST(Fit, onlyPointsOnTheBorderStayOnItAndNoneIsACorner) {
    Random random(3);
    for (int round = 0; round < 50; ++round) {
        std::vector<Polygon> polygons(5);
        for (Polygon& polygon : polygons)
            for (int i = 0; i < 3; ++i)
                polygon.push_back({random.even(-30, 4200), random.even(-30, 4200)});
        const Fitted fitted(leafOf(square, polygons), 1);
        for (const Tree::Piece& p : fitted.leaf.pieces)
            for (const auto& end : {p.a, p.b}) {
                const bool x = end[0] == 0 || end[0] == asset::leafExtent,
                           y = end[1] == 0 || end[1] == asset::leafExtent;
                EXPECT_FALSE(x && y);
            }
    }
}

TEST(Fit, aDiagonalBetweenTwoCornersIsNoSliver) {
    const Coord end = (1 << 24) - 2;
    const Fitted fitted(leafOf({-1, -1, 1 << 24}, {{{-4, end + 2}, {end + 4, 0}, {1 << 25, 1 << 25}}}), 1);
    EXPECT_EQ(fitted.leaf.pieces.size(), 1u);
}

TEST(Fit, aShapeThatEndsOnTheBorderLeavesNoSliver) {
    const Fitted fitted(
        leafOf({-1, -1, 1 << 24}, {{{0, -500}, {1 << 25, -500}, {1 << 25, 1 << 25}, {0, 1 << 25}}}), 1);
    EXPECT_TRUE(fitted.leaf.pieces.empty());
    EXPECT_EQ(fitted.leaf.corners, (std::array<PaintId, 4>{1, 1, 1, 1}));
}

}  // namespace
}  // namespace vtm::compiler
