#include "compiler/src/planar.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "compiler/src/fit.hpp"
#include "compiler/src/snap.hpp"
#include "compiler/src/winding.hpp"

namespace vtm::compiler {
namespace {

constexpr Square square{-1, -1, 4096};

/// Closed random polygons over and around the square, one a layer.
struct Scene {
    std::vector<LeafChord> all;     ///< also those that miss the square
    std::vector<LeafChord> inside;  ///< those that meet it
    std::vector<int> corner;        ///< windings at its first corner
};

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    Coord even(Coord low, Coord high) {
        return 2 * std::uniform_int_distribution<Coord>(low / 2, high / 2)(engine_);
    }

private:
    std::mt19937 engine_;
};

Scene makeScene(const std::vector<std::vector<LatticePoint>>& polygons) {
    Scene scene;
    for (std::uint32_t layer = 0; layer < polygons.size(); ++layer) {
        scene.corner.push_back(0);
        for (std::size_t i = 0; i < polygons[layer].size(); ++i) {
            const Chord c{polygons[layer][i], polygons[layer][(i + 1) % polygons[layer].size()]};
            if (c.a == c.b)
                continue;
            scene.all.push_back({c, layer});
            scene.corner.back() += windingAlongX(c, square.y0, -(1 << 20) - 1, square.x0);
            if (meets(c, square))
                scene.inside.push_back({c, layer});
        }
    }
    return scene;
}

/// Each combination of inside and outside is a paint of its own.
std::uint16_t bits(std::span<const int> windings) {
    std::uint16_t b = 0;
    for (std::size_t i = 0; i < windings.size(); ++i)
        b = static_cast<std::uint16_t>(b | (windings[i] != 0 ? 1 << i : 0));
    return b;
}

std::uint16_t truth(const Scene& scene, LatticePoint p) {
    std::vector<int> windings(scene.corner.size());
    for (const LeafChord& c : scene.all)
        windings[c.layer] += windingAlongX(c.chord, p.y, -(1 << 20) - 1, p.x);
    return bits(windings);
}

/// The paint at p as the nearest visible edge to its right says; 0xFFFF if there is none.
std::uint16_t walkTo(const PlanarLeaf& leaf, LatticePoint p) {
    std::vector<std::pair<double, const PlanarEdge*>> crossed;
    for (const PlanarEdge& e : leaf.edges)
        if ((e.a.y < p.y) != (e.b.y < p.y)) {
            const double x = e.a.x + double(p.y - e.a.y) * (e.b.x - e.a.x) / (e.b.y - e.a.y);
            if (x > p.x)
                crossed.emplace_back(x, &e);
        }
    if (crossed.empty())
        return 0xFFFF;
    const PlanarEdge& nearest = *std::min_element(crossed.begin(), crossed.end())->second;
    return nearest.b.y > nearest.a.y ? nearest.left : nearest.right;
}

/// Snapping moves an edge by less than a step a round; points nearer than this to one are not asked.
constexpr double snapReach = 8;

bool isNearAnEdge(const Scene& scene, LatticePoint p) {
    return std::any_of(scene.all.begin(), scene.all.end(), [&](const LeafChord& c) {
        const double dx = c.chord.b.x - c.chord.a.x, dy = c.chord.b.y - c.chord.a.y;
        return std::abs(static_cast<double>(orient(c.chord.a, c.chord.b, p))) <
               snapReach * std::hypot(dx, dy);
    });
}

void expectRightLabels(const Scene& scene, unsigned seed) {
    const PlanarLeaf leaf = planarise(square, scene.inside, scene.corner, bits);
    ASSERT_TRUE(leaf.certified);
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(leaf.corners[static_cast<std::size_t>(k)], truth(scene, square.corner(k)));
    Random random(seed + 1000);
    int read = 0;
    for (int i = 0; i < 600; ++i) {
        const LatticePoint p{random.even(2, 4090) + 1, random.even(2, 4090) + 1};
        if (isNearAnEdge(scene, p))
            continue;
        if (const std::uint16_t label = walkTo(leaf, p); label != 0xFFFF) {
            ++read;
            EXPECT_EQ(label, truth(scene, p)) << p.x << ", " << p.y;
        }
    }
    EXPECT_GT(read, 0);
}

class RandomPolygons : public testing::TestWithParam<unsigned> {};

TEST_P(RandomPolygons, overlappingTrianglesAreLabelledRight) {
    Random random(GetParam());
    std::vector<std::vector<LatticePoint>> polygons(8);
    for (auto& polygon : polygons)
        for (int i = 0; i < 3; ++i)
            polygon.push_back({random.even(-3000, 7000), random.even(-3000, 7000)});
    expectRightLabels(makeScene(polygons), GetParam());
}

TEST_P(RandomPolygons, selfCrossingPolygonsAreLabelledRight) {
    Random random(GetParam());
    std::vector<std::vector<LatticePoint>> polygons(3);
    for (auto& polygon : polygons)
        for (int i = 0; i < 20; ++i)
            polygon.push_back({random.even(-500, 4600), random.even(-500, 4600)});
    expectRightLabels(makeScene(polygons), GetParam());
}

TEST_P(RandomPolygons, nearlyCoincidentEdgesAreCertified) {
    Random random(GetParam());
    std::vector<std::vector<LatticePoint>> polygons(12);
    for (auto& polygon : polygons)
        for (const LatticePoint p : {LatticePoint{-500, 300}, {4700, 1700}, {3000, 5000}, {400, 3000}})
            polygon.push_back({p.x + random.even(-4, 4), p.y + random.even(-4, 4)});
    const Scene scene = makeScene(polygons);
    EXPECT_TRUE(planarise(square, scene.inside, scene.corner, bits).certified);
}

TEST_P(RandomPolygons, edgesWithinTheLastStepsOfTheBorderAreCertified) {
    Random random(GetParam());
    std::vector<std::vector<LatticePoint>> polygons(6);
    for (auto& polygon : polygons)
        for (int i = 0; i < 6; ++i)
            polygon.push_back({random.even(0, 1) * 4094 + random.even(-6, 6),
                               random.even(0, 1) * 4094 + random.even(-6, 6)});
    const Scene scene = makeScene(polygons);
    EXPECT_TRUE(planarise(square, scene.inside, scene.corner, bits).certified);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPolygons, testing::Range(0u, 40u));

TEST(Planar, coincidentBordersOfNeighboursLeaveNoThirdPaint) {
    const Scene scene = makeScene({{{500, 500}, {2000, 900}, {1900, 3000}, {400, 3100}},
                                   {{2000, 900}, {3500, 700}, {3600, 3300}, {1900, 3000}}});
    const PlanarLeaf leaf = planarise(square, scene.inside, scene.corner, bits);
    ASSERT_TRUE(leaf.certified);
    EXPECT_EQ(leaf.edges.size(), 7u);  // the common edge is one edge, from paint 1 to paint 2
    for (const PlanarEdge& e : leaf.edges)
        EXPECT_TRUE(e.left == 0 || e.right == 0 || (e.left | e.right) == 3);
}

TEST(Planar, boundariesBetweenEqualPaintsVanish) {
    const Scene scene =
        makeScene({{{500, 500}, {2000, 900}, {1900, 3000}}, {{700, 400}, {2100, 1900}, {400, 3100}}});
    const PlanarLeaf leaf =
        planarise(square, scene.inside, scene.corner, [](std::span<const int>) { return std::uint16_t{5}; });
    EXPECT_TRUE(leaf.certified);
    EXPECT_TRUE(leaf.edges.empty());
}

TEST(Planar, aContourThatDoesNotCloseIsNotCertified) {
    Scene scene = makeScene({{{500, 500}, {3500, 700}, {1900, 3000}}});
    scene.inside.pop_back();
    EXPECT_FALSE(planarise(square, scene.inside, scene.corner, bits).certified);
}

// ---- snapping ---------------------------------------------------------------------------------

TEST_P(RandomPolygons, afterSnappingEdgesMeetOnlyInVertices) {
    Random random(GetParam());
    std::vector<std::vector<LatticePoint>> polygons(2);
    for (auto& polygon : polygons)
        for (int i = 0; i < 12; ++i)
            polygon.push_back({random.even(0, 200), random.even(0, 200)});  // a coarse lattice: much rounding
    const auto set = snap(square, makeScene(polygons).inside);
    ASSERT_TRUE(set);
    for (std::size_t i = 0; i < set->edges.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Edge &s = set->edges[i], &t = set->edges[j];
            const auto side = [](std::int64_t v) { return (v > 0) - (v < 0); };
            const int ta = side(orient(s.a, s.b, t.a)), tb = side(orient(s.a, s.b, t.b));
            const int sa = side(orient(t.a, t.b, s.a)), sb = side(orient(t.a, t.b, s.b));
            EXPECT_FALSE(ta * tb < 0 && sa * sb < 0) << "edges " << i << " and " << j << " cross";
        }
}

// ---- fitting ----------------------------------------------------------------------------------

/// Distance of a point, in leaf coordinates, to the nearest of the pieces' dense samples.
double distanceToPieces(const FittedLeaf& leaf, double x, double y) {
    double best = 1e30;
    for (const asset::Piece& p : leaf.pieces)
        for (int i = 0; i <= 400; ++i) {
            const double s = i / 400.0, mA = p.slopeA / double{asset::slopeScale},
                         mB = p.slopeB / double{asset::slopeScale};
            const double t = mA * s * (1 - s) * (1 - s) - mB * s * s * (1 - s);
            const double dx = p.b[0] - p.a[0], dy = p.b[1] - p.a[1];
            best = std::min(best, std::hypot(p.a[0] + s * dx - t * dy - x, p.a[1] + s * dy + t * dx - y));
        }
    return best;
}

TEST(Fit, aCircleTakesFewPiecesWithinTheTolerance) {
    const scene::Path circle{scene::MoveTo{{3800, 2047}},
                             scene::ArcTo{{1800, 1800}, 0, false, true, {200, 2047}},
                             scene::ArcTo{{1800, 1800}, 0, false, true, {3800, 2047}}, scene::Close{}};
    std::vector<LeafChord> chords;
    for (const Chord& c : outline(circle, scene::identity, 0.5, {-16, -16}, {4110, 4110}))
        chords.push_back({c, 0});
    const PlanarLeaf planar = planarise(square, chords, std::vector<int>{0}, bits);
    ASSERT_TRUE(planar.certified);
    const double tolerance = 2;
    const FittedLeaf leaf = fit(square, planar, tolerance);
    EXPECT_LE(leaf.pieces.size(), 20u);
    const double scale = double{asset::leafExtent} / square.side;
    for (const PlanarEdge& e : planar.edges)
        EXPECT_LE(distanceToPieces(leaf, (e.a.x + 1) * scale, (e.a.y + 1) * scale), (tolerance + 1) * scale);
    for (const asset::Piece& p : leaf.pieces) {
        const bool inwards = p.left == 1;  // counter-clockwise in the numbers
        EXPECT_TRUE(inwards ? p.right == 0 : p.left == 0 && p.right == 1);
    }
}

TEST(Fit, aStraightEdgeIsOnePiece) {
    const Scene scene = makeScene({{{-3000, 500}, {7000, 1500}, {7000, 9000}, {-3000, 9000}}});
    const FittedLeaf leaf = fit(square, planarise(square, scene.inside, scene.corner, bits), 1);
    ASSERT_EQ(leaf.pieces.size(), 1u);
    EXPECT_EQ(leaf.pieces[0].slopeA, 0);
    EXPECT_EQ(leaf.pieces[0].slopeB, 0);
}

TEST(Fit, onlyPointsOnTheBorderStayOnItAndNoneIsACorner) {
    Random random(3);
    for (int round = 0; round < 50; ++round) {
        std::vector<std::vector<LatticePoint>> polygons(5);
        for (auto& polygon : polygons)
            for (int i = 0; i < 3; ++i)
                polygon.push_back({random.even(-30, 4200), random.even(-30, 4200)});
        const Scene scene = makeScene(polygons);
        for (const asset::Piece& p :
             fit(square, planarise(square, scene.inside, scene.corner, bits), 1).pieces)
            for (const auto& end : {p.a, p.b}) {
                const bool x = end[0] == 0 || end[0] == asset::leafExtent,
                           y = end[1] == 0 || end[1] == asset::leafExtent;
                EXPECT_FALSE(x && y);
            }
    }
}

TEST(Fit, aDiagonalBetweenTwoCornersIsNoSliver) {
    const Square big{-1, -1, 1 << 24};
    const Coord end = (1 << 24) - 2;
    std::vector<LeafChord> chords;
    const std::vector<LatticePoint> shape{{-4, end + 2}, {end + 4, 0}, {1 << 25, 1 << 25}};
    for (std::size_t i = 0; i < 3; ++i)
        if (const Chord c{shape[i], shape[(i + 1) % 3]}; meets(c, big))
            chords.push_back({c, 0});
    const FittedLeaf leaf = fit(big, planarise(big, chords, std::vector<int>{0}, bits), 1);
    EXPECT_EQ(leaf.pieces.size(), 1u);
}

TEST(Fit, aShapeThatEndsOnTheBorderLeavesNoSliver) {
    const Square big{-1, -1, 1 << 24};
    std::vector<LeafChord> chords;
    const std::vector<LatticePoint> shape{{0, -500}, {1 << 25, -500}, {1 << 25, 1 << 25}, {0, 1 << 25}};
    for (std::size_t i = 0; i < 4; ++i)
        if (const Chord c{shape[i], shape[(i + 1) % 4]}; meets(c, big))
            chords.push_back({c, 0});
    const FittedLeaf leaf = fit(big, planarise(big, chords, std::vector<int>{0}, bits), 1);
    EXPECT_TRUE(leaf.pieces.empty());
    EXPECT_EQ(leaf.corners, (std::array<std::uint16_t, 4>{1, 1, 1, 1}));
}

}  // namespace
}  // namespace vtm::compiler
