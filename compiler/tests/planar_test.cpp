#include "compiler/planar/planar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "compiler/tests/leaf_support.hpp"

namespace vtm::compiler {
namespace {

constexpr Square square{-1, -1, 4096};

/// A line's change of winding from far left, chord by chord.
PaintId truth(const TestLeaf& leaf, LatticePoint p) {
    std::vector<int> windings(leaf.corner.size());
    leaf.forEachChord([&](const Chord& c, std::uint32_t layer) {
        if ((c.a.y < p.y) != (c.b.y < p.y) && !cornerOnLeft(c.a, c.b, p) == (c.b.y > c.a.y))
            windings[layer] += c.b.y > c.a.y ? -1 : 1;
    });
    return BitPaints(windings).paint();
}

/// The paint at p as the nearest visible chord to its right says; nothing if there is none.
std::optional<PaintId> walkTo(const PlanarLeaf& leaf, LatticePoint p) {
    double nearest = 1e30;
    std::optional<PaintId> paint;
    for (std::size_t i = 0; i < leaf.sides.size(); ++i) {
        const Edge& e = leaf.set->edges[i];
        if (leaf.sides[i].left == leaf.sides[i].right)
            continue;
        for (std::uint32_t k = 0; k < e.chordCount(); ++k) {
            const LatticePoint a = leaf.set->vertex(e, k), b = leaf.set->vertex(e, k + 1);
            if ((a.y < p.y) == (b.y < p.y))
                continue;
            const double x = a.x + double(p.y - a.y) * (b.x - a.x) / (b.y - a.y);
            if (x > p.x && x < nearest) {
                nearest = x;
                paint = b.y > a.y ? leaf.sides[i].left : leaf.sides[i].right;
            }
        }
    }
    return paint;
}

/// Snapping moves an edge by less than a step a round; points nearer than this to one are not asked.
constexpr double snapReach = 8;

bool isNearAnEdge(const TestLeaf& leaf, LatticePoint p) {
    bool near = false;
    leaf.forEachChord([&](const Chord& c, std::uint32_t) {
        const double dx = c.b.x - c.a.x, dy = c.b.y - c.a.y;
        near = near || std::abs(static_cast<double>(orient(c.a, c.b, p))) < snapReach * std::hypot(dx, dy);
    });
    return near;
}

void expectRightLabels(const TestLeaf& test, unsigned seed) {
    const Planned planned(test);
    const PlanarLeaf& leaf = planned.leaf;
    ASSERT_TRUE(leaf.certified);
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(leaf.corners[static_cast<std::size_t>(k)], truth(test, square.corner(k)));
    Random random(seed + 1000);
    int read = 0;
    for (int i = 0; i < 600; ++i) {
        const LatticePoint p{random.even(2, 4090) + 1, random.even(2, 4090) + 1};
        if (isNearAnEdge(test, p))
            continue;
        if (const auto label = walkTo(leaf, p)) {
            ++read;
            EXPECT_EQ(*label, truth(test, p)) << p.x << ", " << p.y;
        }
    }
    EXPECT_GT(read, 0);
}

std::size_t visibleEdges(const PlanarLeaf& leaf) {
    return static_cast<std::size_t>(std::count_if(leaf.sides.begin(), leaf.sides.end(),
                                                  [](const Sides& s) { return s.left != s.right; }));
}

class RandomPolygons : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomPolygons, testing::Range(0u, 40u));

TEST_P(RandomPolygons, overlappingTrianglesAreLabelledRight) {
    Random random(GetParam());
    std::vector<Polygon> polygons(8);
    for (Polygon& polygon : polygons)
        for (int i = 0; i < 3; ++i)
            polygon.push_back({random.even(-3000, 7000), random.even(-3000, 7000)});
    expectRightLabels(leafOf(square, polygons), GetParam());
}

TEST_P(RandomPolygons, selfCrossingPolygonsAreLabelledRight) {
    Random random(GetParam());
    std::vector<Polygon> polygons(3);
    for (Polygon& polygon : polygons)
        for (int i = 0; i < 20; ++i)
            polygon.push_back({random.even(-500, 4600), random.even(-500, 4600)});
    expectRightLabels(leafOf(square, polygons), GetParam());
}

TEST_P(RandomPolygons, crossingCurvesAreLabelledRight) {
    Random random(GetParam());
    const auto point = [&] { return scene::Point{random.even(-500, 4600), random.even(-500, 4600)}; };
    std::vector<scene::Path> paths(4);
    for (scene::Path& path : paths) {
        path = {scene::MoveTo{point()}};
        for (int i = 0; i < 4; ++i)
            path.push_back(scene::CubicTo{point(), point(), point()});
    }
    expectRightLabels({square, paths}, GetParam());
}

TEST_P(RandomPolygons, chainsThatShareSomeOfTheirVerticesAreLabelledRight) {
    // Two shapes whose borders run together for a while, in opposite directions, then part.
    Random random(GetParam());
    Polygon common{{300, 300}};
    for (int i = 0; i < 12; ++i)
        common.push_back({common.back().x + random.even(20, 300), common.back().y + random.even(20, 300)});
    Polygon below{common.begin() + 2, common.end() - 2}, above{common.rbegin(), common.rend()};
    below.insert(below.end(), {{4000, 3000}, {3800, 200}});
    above.insert(above.end(), {{100, 400}, {200, 3900}});
    expectRightLabels(leafOf(square, {below, above}), GetParam());
}

TEST_P(RandomPolygons, nearlyCoincidentEdgesAreCertified) {
    Random random(GetParam());
    std::vector<Polygon> polygons(12);
    for (Polygon& polygon : polygons)
        for (const LatticePoint p : {LatticePoint{-500, 300}, {4700, 1700}, {3000, 5000}, {400, 3000}})
            polygon.push_back({p.x + random.even(-4, 4), p.y + random.even(-4, 4)});
    EXPECT_TRUE(Planned(leafOf(square, polygons)).leaf.certified);
}

TEST_P(RandomPolygons, edgesWithinTheLastStepsOfTheBorderAreCertified) {
    Random random(GetParam());
    std::vector<Polygon> polygons(6);
    for (Polygon& polygon : polygons)
        for (int i = 0; i < 6; ++i)
            polygon.push_back({random.even(0, 1) * 4094 + random.even(-6, 6),
                               random.even(0, 1) * 4094 + random.even(-6, 6)});
    EXPECT_TRUE(Planned(leafOf(square, polygons)).leaf.certified);
}

TEST_P(RandomPolygons, aVertexWithHundredsOfRaysIsLabelledRight) {
    Random random(GetParam());
    constexpr int rays = 200;
    std::vector<LatticePoint> ends;
    for (int i = 0; i < rays; ++i) {
        const double angle = 2 * std::numbers::pi * i / rays, reach = random.even(600, 1800);
        ends.push_back(
            {2048 + 2 * Coord(reach / 2 * std::cos(angle)), 2048 + 2 * Coord(reach / 2 * std::sin(angle))});
    }
    std::vector<Polygon> polygons(8);  // fans of narrow triangles, overlapping those of the next layer
    for (std::size_t i = 0; i < rays; ++i)
        for (const LatticePoint p : {LatticePoint{2048, 2048}, ends[i], ends[(i + 3) % rays]})
            polygons[i % polygons.size()].push_back(p);
    expectRightLabels(leafOf(square, polygons), GetParam());
}

TEST_P(RandomPolygons, afterSnappingEdgesMeetOnlyInVertices) {
    Random random(GetParam());
    std::vector<Polygon> polygons(2);
    for (Polygon& polygon : polygons)
        for (int i = 0; i < 12; ++i)
            polygon.push_back({random.even(0, 200), random.even(0, 200)});  // a coarse lattice: much rounding
    const TestLeaf leaf = leafOf(square, polygons);
    Snapper snapper;
    const EdgeSet* set = snapper.run(square, leaf.points(), leaf.cell.clippedRuns);
    ASSERT_TRUE(set);
    std::vector<Chord> chords;
    for (const Edge& e : set->edges)
        for (std::uint32_t k = 0; k < e.chordCount(); ++k)
            chords.push_back({set->vertex(e, k), set->vertex(e, k + 1)});
    for (std::size_t i = 0; i < chords.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Chord &s = chords[i], &t = chords[j];
            const auto side = [](std::int64_t v) { return (v > 0) - (v < 0); };
            const int ta = side(orient(s.a, s.b, t.a)), tb = side(orient(s.a, s.b, t.b));
            const int sa = side(orient(t.a, t.b, s.a)), sb = side(orient(t.a, t.b, s.b));
            EXPECT_FALSE(ta * tb < 0 && sa * sb < 0) << "chords " << i << " and " << j << " cross";
        }
}

TEST_P(RandomPolygons, nearlyCoincidentChainsAreBentOnceOrTwice) {
    // Rounded crossings would make new ones for many rounds, each of which bends more.
    Random random(GetParam());
    std::vector<Polygon> polygons(10);
    for (Polygon& polygon : polygons) {
        for (int x = 100; x <= 3900; x += 100)
            polygon.push_back({x + random.even(-8, 8), 2000 + x / 40 * 2 + random.even(-2, 2)});
        polygon.insert(polygon.end(), {{3950, 3900}, {50, 3900}});
    }
    const TestLeaf leaf = leafOf(square, polygons);
    Snapper snapper;
    const EdgeSet* set = snapper.run(square, leaf.points(), leaf.cell.clippedRuns);
    ASSERT_TRUE(set);
    EXPECT_LE(set->bend, 2 * std::numbers::sqrt2);
}

TEST(Planar, uprightChordsInOneColumnMeet) {
    const TestLeaf leaf =
        leafOf(square, {{{1000, 900}, {1500, 1400}, {1500, 2600}, {2200, 3500}, {200, 3600}, {200, 900}},
                        {{1100, 500}, {1500, 1000}, {1500, 2000}, {2500, 3000}, {3800, 2900}, {3800, 400}}});
    Snapper snapper;
    const EdgeSet* set = snapper.run(square, leaf.points(), leaf.cell.clippedRuns);
    ASSERT_TRUE(set);
    std::vector<std::pair<Coord, Coord>> upright;  // y from and to
    for (const Edge& e : set->edges)
        for (std::uint32_t k = 0; k < e.chordCount(); ++k)
            if (const auto a = set->vertex(e, k), b = set->vertex(e, k + 1); a.x == 1500 && b.x == 1500)
                upright.push_back(std::minmax(a.y, b.y));
    std::sort(upright.begin(), upright.end());
    EXPECT_EQ(upright, (std::vector<std::pair<Coord, Coord>>{{1000, 1400}, {1400, 2000}, {2000, 2600}}));
}

TEST(Planar, coincidentBordersOfNeighboursLeaveNoThirdPaint) {
    const Planned planned(leafOf(square, {{{500, 500}, {2000, 900}, {1900, 3000}, {400, 3100}},
                                          {{2000, 900}, {3500, 700}, {3600, 3300}, {1900, 3000}}}));
    const PlanarLeaf& leaf = planned.leaf;
    ASSERT_TRUE(leaf.certified);
    std::size_t between = 0;  // the common edge is one edge, from paint 1 to paint 2
    for (const Sides& s : leaf.sides) {
        EXPECT_TRUE(s.left == 0 || s.right == 0 || (s.left | s.right) == 3);
        between += s.left != 0 && s.right != 0;
    }
    EXPECT_EQ(between, 1u);
}

TEST(Planar, boundariesBetweenEqualPaintsAreNotVisible) {
    struct OnePaint : RegionPaints {
        PaintId compute() override { return 5; }
    } one;
    const TestLeaf test =
        leafOf(square, {{{500, 500}, {2000, 900}, {1900, 3000}}, {{700, 400}, {2100, 1900}, {400, 3100}}});
    const RegionPaints::Layer layers[] = {{scene::FillRule::NonZero, test.corner[0], hashValue(0)},
                                          {scene::FillRule::NonZero, test.corner[1], hashValue(1)}};
    one.enter(layers);
    Planariser planariser;
    const PlanarLeaf& leaf = planariser.run(square, test.points(), test.cell.clippedRuns, one);
    EXPECT_TRUE(leaf.certified);
    EXPECT_EQ(visibleEdges(leaf), 0u);
}

TEST(Planar, aContourThatDoesNotCloseIsNotCertified) {
    TestLeaf test = leafOf(square, {{{500, 500}, {3500, 700}, {1900, 3000}}});
    test.cell.clippedRuns.pop_back();
    EXPECT_FALSE(Planned(test).leaf.certified);
}

}  // namespace
}  // namespace vtm::compiler
