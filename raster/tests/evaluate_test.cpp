#include <vtm/raster/evaluate.hpp>

#include <algorithm>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include "asset/testing.hpp"
#include "raster/testing_views.hpp"

namespace vtm::asset::test {
namespace {

using glm::dvec2;
using glm::vec4;
using Polygon = std::vector<dvec2>;

// ---- The brute truth: polygons clipped to each pixel, in double -----------------------------------

/// Keeps what lies where `distance` >= 0 (Sutherland and Hodgman).
template <class Distance>
Polygon clip(const Polygon& polygon, Distance&& distance) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double da = distance(a), db = distance(b);
        if (da >= 0)
            kept.push_back(a);
        if ((da >= 0) != (db >= 0))
            kept.push_back(a + (b - a) * (da / (da - db)));
    }
    return kept;
}

double area(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2;
}

/// A region of one paint; points in leaf steps of a map that is one leaf.
struct Region {
    Polygon polygon;
    vec4 color;
};

image::Raster bruteForce(const std::vector<Region>& regions, const View& view) {
    image::Raster raster(view.width, view.height);
    for (const Region& region : regions)
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                Polygon p;
                for (const dvec2 q : region.polygon)
                    p.push_back(view.toPixels * glm::dvec3(q * (mapSide / leafExtent), 1) - dvec2(x, y));
                p = clip(p, [](dvec2 q) { return q.x; });
                p = clip(p, [](dvec2 q) { return 1 - q.x; });
                p = clip(p, [](dvec2 q) { return q.y; });
                p = clip(p, [](dvec2 q) { return 1 - q.y; });
                for (int c = 0; c < 4; ++c)
                    raster.pixel(x, y)[c] += region.color[c] * float(area(p));
            }
    return raster;
}

double worst(const image::Raster& a, const image::Raster& b) {
    double difference = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        difference = std::max(difference, double(std::abs(a.rgba[i] - b.rgba[i])));
    return difference;
}

/// Single precision at 4096 pixels a leaf places a boundary within 5e-4 pixels (docs/coverage.md).
constexpr double floatTolerance = 1e-3;

void expectSame(const Asset& asset, const std::vector<Region>& regions, double tolerance, int views = 40) {
    std::mt19937 random(7);
    for (int i = 0; i < views; ++i) {
        const View view = randomView(random);
        ASSERT_LE(worst(evaluate(asset, view), bruteForce(regions, view)), tolerance) << "view " << i;
    }
}

constexpr double e = leafExtent;

// ---- Coverage -------------------------------------------------------------------------------------

TEST(Evaluate, HalfPlanesAtManyAngles) {
    for (const int bottom : {0, 1, 7001, 32001, 65533})
        for (const int top : {1, 20001, 65535}) {
            const double b = bottom, t = top;
            expectSame(halfPlane(std::uint16_t(bottom), std::uint16_t(top)),
                       {{{{0, 0}, {b, 0}, {t, e}, {0, e}}, red}, {{{b, 0}, {e, 0}, {e, e}, {t, e}}, green}},
                       floatTolerance, 12);
        }
}

TEST(Evaluate, CornerInsideTheLeaf) {
    expectSame(wedge(),
               {{{{20001, 0}, {40001, 0}, {30001, 50001}}, red},
                {{{0, 0}, {20001, 0}, {30001, 50001}, {30001, e}, {0, e}}, green},
                {{{40001, 0}, {e, 0}, {e, e}, {30001, e}, {30001, 50001}}, green}},
               floatTolerance);
}

TEST(Evaluate, StripThinnerThanAPixel) {
    expectSame(strip(), {{{{0, 29900}, {e, 39900}, {e, 40000}, {0, 30000}}, blue}}, floatTolerance);
}

TEST(Evaluate, ThreeRegionsAroundAVertex) {
    const dvec2 hub(33001, 30001);
    expectSame(threeRegions(),
               {{{{0, 0}, {e, 0}, {e, 20001}, hub, {0, 22001}}, red},
                {{{e, 20001}, {e, e}, {30001, e}, hub}, green},
                {{{30001, e}, {0, e}, {0, 22001}, hub}, blue}},
               floatTolerance);
}

/// The Hermite pieces themselves, 64 chords each.
Polygon outline(const Asset& asset) {
    Polygon polygon;
    for (const Piece& piece : asset.pieces)
        for (int i = 0; i < 64; ++i) {
            const dvec2 a(piece.a[0], piece.a[1]), d = dvec2(piece.b[0], piece.b[1]) - a;
            const double s = i / 64.0;
            const double t =
                (piece.slopeA * s * (1 - s) * (1 - s) - piece.slopeB * s * s * (1 - s)) / slopeScale;
            polygon.push_back(a + s * d + t * dvec2(-d.y, d.x));
        }
    return polygon;
}

TEST(Evaluate, ArcsStayWithinTheChordBound) {
    const Asset asset = disc();
    expectSame(asset, {{outline(asset), red}}, 1.0 / 255, 25);
}

TEST(Evaluate, ArcPiecesFollowTheCircle) {
    const Asset asset = disc();
    for (const dvec2 p : outline(asset))
        EXPECT_NEAR(std::hypot(p.x - discCentre.x, p.y - discCentre.y), discRadius, 6);
}

TEST(Evaluate, NoSeamsBetweenLeaves) {
    Asset asset = twoLevels();
    for (Paint& paint : asset.paints)
        paint = solid(red);
    std::mt19937 random(3);
    for (int i = 0; i < 40; ++i) {
        const View view = randomView(random);
        const std::vector<Region> whole{{{{0, 0}, {e, 0}, {e, e}, {0, e}}, red}};
        ASSERT_LE(worst(evaluate(asset, view), bruteForce(whole, view)), floatTolerance) << "view " << i;
    }
}

TEST(Evaluate, TreePlacesItsChildrenRowByRow) {
    Asset asset = emptyAsset();
    Node node;
    for (std::uint32_t i = 0; i < 16; ++i) {
        node.children[i] = Entry::make(Entry::Kind::Solid, i);
        asset.paints.resize(16);
        asset.paints[i] = solid(vec4(float(i) / 16, 0, 0, 1));
    }
    asset.nodes = {node};
    asset.maps[0].root = Entry::make(Entry::Kind::Node, 0);
    const image::Raster raster = evaluate(asset, turnedView(4, 4, {32, 32}, 4 / mapSide, 0));
    for (int i = 0; i < 16; ++i)
        EXPECT_FLOAT_EQ(raster.pixel(i % 4, i / 4)[0], float(i) / 16);
}

/// Deep zoom: cells are placed in double, so a tiny one is as sharp as a large one.
TEST(Evaluate, DeepestCellIsPlacedExactly) {
    Asset asset = emptyAsset();
    for (std::uint32_t level = 0; level < maxLevel; ++level) {
        Node node;
        node.children.fill(Entry::make(Entry::Kind::Solid, 2));
        node.children[10] = level + 1 < maxLevel
                                ? Entry::make(Entry::Kind::Node, level + 1)
                                : addLeaf(asset, {1, 2, 2, 1}, {line({30001, 0}, {30001, 65535}, 1, 2)});
        asset.nodes.push_back(node);
    }
    asset.maps[0].root = Entry::make(Entry::Kind::Node, 0);
    const double side = std::ldexp(mapSide, -24), corner = mapSide * (1 - std::ldexp(1.0, -24)) * 2 / 3;
    const View view = turnedView(65, 65, {corner + side / 2, corner + side / 2}, 65 / side, 0);
    const image::Raster raster = evaluate(asset, view);
    const float edge = 30001.0f / 65535 * 65;
    EXPECT_NEAR(raster.pixel(int(edge), 30)[0], edge - std::floor(edge), 1e-3);
    EXPECT_NEAR(raster.pixel(2, 30)[0], 1, 1e-3);
    EXPECT_NEAR(raster.pixel(62, 30)[1], 1, 1e-3);
}

TEST(Evaluate, FlattenedViewDrawsNothing) {
    const image::Raster raster = evaluate(halfPlane(), {8, 8, glm::dmat3x2(1, 1, 2, 2, 0, 0)});
    EXPECT_EQ(*std::ranges::max_element(raster.rgba), 0);
}

TEST(Evaluate, RejectsViewsBeyondTheLimits) {
    EXPECT_THROW(evaluate(halfPlane(), {maxViewSide + 1, 1, {}}), std::length_error);
    EXPECT_THROW(evaluate(halfPlane(), {16000, 16000, {}}), std::length_error);
    EXPECT_THROW(evaluate(halfPlane(), {-1, 4, {}}), std::length_error);
    EXPECT_THROW(evaluate(halfPlane(), {4, 4, glm::dmat3x2(NAN, 0, 0, 1, 0, 0)}), std::length_error);
    EXPECT_TRUE(evaluate(halfPlane(), {0, 0, {}}).rgba.empty());
}

}  // namespace
}  // namespace vtm::asset::test
