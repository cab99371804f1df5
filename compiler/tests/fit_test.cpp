#include "compiler/fit/fit.hpp"

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

/// Points 0 .. last of an arc over a chord of `length`, and one more that must not matter.
struct Arc {
    std::vector<double> x, y;

    Arc(std::uint32_t last, double length) {
        for (std::uint32_t i = 0; i <= last; ++i) {
            const double s = double(i) / last;
            x.push_back(100 + s * length), y.push_back(200 + 0.1 * length * s * (1 - s));
        }
        x.push_back(-1e6), y.push_back(1e6);
    }
    double fit(PieceFit& piece, double tolerance) const {
        const std::size_t last = x.size() - 2;
        return piece.run(x.data(), y.data(), static_cast<std::uint32_t>(last), Pair{x[0], y[0]},
                         Pair{x[last], y[last]}, tolerance);
    }
};

TEST(PieceFit, seesEveryPoint) {
    constexpr double length = 10000, tolerance = 60;
    PieceFit piece;
    for (std::uint32_t last = 4; last <= LocalPoints::maxChords; ++last) {
        const Arc arc(last, length);
        EXPECT_LE(arc.fit(piece, tolerance), 1) << last;
        for (std::uint32_t i = 1; i < last; ++i) {
            Arc high = arc, back = arc;
            high.y[i] += 5 * tolerance;
            EXPECT_GT(high.fit(piece, tolerance), 1) << i << " of " << last;
            back.x[i] = arc.x[i - 1];
            EXPECT_GT(back.fit(piece, tolerance), 1) << i << " of " << last;
        }
    }
}

/// With few points the sag of the piece between them is what counts.
TEST(PieceFit, keepsToTheToleranceBetweenPoints) {
    constexpr double length = 10000;
    PieceFit piece;
    for (std::uint32_t last = 2; last <= LocalPoints::maxChords; ++last) {
        const Arc arc(last, length);
        double tolerance = 0.01;
        while (arc.fit(piece, tolerance) > 1)
            tolerance *= 1.1;
        const double mA = piece.slopes().a / double{asset::slopeScale},
                     mB = piece.slopes().b / double{asset::slopeScale};
        double worst = 0;
        for (int k = 0; k <= 1000; ++k) {
            const double s = k / 1000.0, at = s * last;
            const auto i = std::min(static_cast<std::uint32_t>(at), last - 1);
            const double chain = arc.y[i] + (arc.y[i + 1] - arc.y[i]) * (at - i) - arc.y[0],
                         curve = length * s * (1 - s) * (mA * (1 - s) - mB * s);
            worst = std::max(worst, std::abs(chain - curve));
        }
        EXPECT_LE(worst, tolerance + 1e-6) << last;
        EXPECT_GE(worst, tolerance / 2) << last;  // the bound is not idle
    }
}

}  // namespace
}  // namespace vtm::compiler
