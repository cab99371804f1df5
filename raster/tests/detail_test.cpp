// Levels of detail: fewer pieces, as closed, with the same areas, that draw the same.

#include "raster/src/detail.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <vtm/raster/scan.hpp>
#include "asset/testing.hpp"
#include "raster/planar_map.hpp"
#include "raster/testing_views.hpp"

namespace vtm::asset::test {
namespace {

using glm::dvec2;
using Pieces = std::vector<PlanarPiece>;

constexpr DetailSquare nowhere{dvec2(-1), dvec2(-1)};

double sum(std::uint32_t paint, const PlanarPiece& p) {
    return double(p.left == paint) - double(p.right == paint);
}

Pieces merged(const Pieces& pieces, double pixel, const DetailSquare& square = nowhere) {
    return mergeChains(pieces, square, pixel);
}

/// Of a paint's region, whatever else there is.
double areaOf(const Pieces& pieces, std::uint32_t paint) {
    double area = 0;
    for (const PlanarPiece& p : pieces) {
        const dvec2 d = p.b - p.a;
        const double bulge = (p.slopeA - p.slopeB) / 12 * (d.x * d.x + d.y * d.y);
        area += sum(paint, p) * (0.5 * cross(p.a, p.b) - bulge);
    }
    return area;
}

/// Going round any point, the changes of paint cancel.
void expectClosed(const Pieces& pieces) {
    std::map<std::pair<double, double>, std::map<std::uint32_t, int>> changes;
    for (const PlanarPiece& p : pieces) {
        for (const auto& [end, sign] : {std::pair(p.a, 1), std::pair(p.b, -1)}) {
            auto& at = changes[{end.x, end.y}];
            at[p.left] += sign;
            at[p.right] -= sign;
        }
    }
    for (const auto& [point, byPaint] : changes)
        for (const auto& [paint, change] : byPaint)
            ASSERT_EQ(change, 0) << paint << " at " << point.first << ' ' << point.second;
}

/// A closed curve with a wavy radius, whole numbers as ends. Some pieces go the other way round.
void addRing(Pieces& pieces, dvec2 centre, double radius, double waves, double depth, int count,
             std::uint32_t inside, std::uint32_t outside, std::mt19937& random) {
    const auto at = [&](int i) {
        const double angle = 2 * std::numbers::pi * (i % count) / count;
        const double r = radius * (1 + depth * std::sin(waves * angle));
        return glm::round(centre + r * dvec2(std::cos(angle), std::sin(angle)));
    };
    for (int i = 0; i < count; ++i) {
        const double slope = std::uniform_real_distribution<double>(-0.1, 0.1)(random);
        if (at(i) == at(i + 1))
            continue;
        if (random() % 3 == 0)
            pieces.push_back({at(i + 1), at(i), slope, -slope, outside, inside});
        else
            pieces.push_back({at(i), at(i + 1), slope, slope, inside, outside});
    }
}

class RandomRings : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomRings, testing::Range(0u, 40u));

TEST_P(RandomRings, StayClosedAndKeepTheirAreas) {
    std::mt19937 random(GetParam());
    Pieces pieces;
    for (int ring = 0; ring < 30; ++ring)
        addRing(pieces, dvec2(double(random() % 100000), double(random() % 100000)),
                std::pow(10, double(1 + random() % 4)), double(random() % 9), 0.3, 3 + int(random() % 400),
                std::uint32_t(1 + random() % 3), std::uint32_t(4 + random() % 2), random);
    expectClosed(pieces);
    std::size_t before = pieces.size();
    for (const double pixel : {10.0, 100.0, 1000.0, 10000.0, 1e6}) {
        const Pieces fewer = merged(pieces, pixel);
        expectClosed(fewer);
        EXPECT_LE(fewer.size(), before + before / 20) << pixel;
        before = fewer.size();
        // Neighbours that both move, by d and e, change an area by d e / 2 beside what each of them should.
        const double both = 0.5 * detailTolerance * detailTolerance * double(fewer.size());
        for (std::uint32_t paint = 1; paint <= 5; ++paint)
            EXPECT_NEAR((areaOf(fewer, paint) - areaOf(pieces, paint)) / (pixel * pixel), 0, both)
                << pixel << ' ' << paint;
    }
    EXPECT_LT(before, pieces.size() / 4);
}

/// Rings cut by lines: chains that end in points where three meet.
TEST(Detail, PointsWhereChainsMeetStay) {
    Pieces pieces;
    std::mt19937 random(1);
    addRing(pieces, {5000, 5000}, 3000, 7, 0.1, 300, 1, 0, random);
    // A chord of the ring from its first point to another one: what is above is 2.
    const dvec2 from = pieces[0].left == 1 ? pieces[0].a : pieces[0].b;
    const Pieces few = merged(pieces, 100000);
    ASSERT_FALSE(few.empty());
    Pieces cut = pieces;
    cut.push_back({from, from + dvec2(10, 0), 0, 0, 3, 4});
    bool stays = false;
    for (const PlanarPiece& p : merged(cut, 100000))
        stays |= p.left + p.right == 1 && (p.a == from || p.b == from);
    EXPECT_TRUE(stays);
}

TEST(Detail, PointsOnTheSquaresBorderStay) {
    Pieces pieces;
    for (int i = 0; i < 100; ++i) {
        const auto height = [](int x) { return x == 50 ? 0.0 : 3.0; };
        pieces.push_back({{i, height(i)}, {i + 1, height(i + 1)}, 0, 0, 1, 0});
    }
    const auto touches = [](const Pieces& of) {
        return std::ranges::any_of(of, [](const PlanarPiece& p) { return p.a == dvec2(50, 0); });
    };
    EXPECT_FALSE(touches(merged(pieces, 1000)));
    EXPECT_TRUE(touches(merged(pieces, 1000, {dvec2(0), dvec2(100)})));
}

/// A picture of one square that is `mapSide` wide.
PlanarMap mapOf(Pieces pieces) {
    PlanarMap map;
    map.side = mapSide;
    map.pieces = std::move(pieces);
    return map;
}

/// Many islands far below a pixel: what each of them loses is lost many times.
TEST(Detail, ManySmallIslandsKeepTheirShareOfAPixel) {
    std::mt19937 random(2);
    Pieces pieces;
    const double pixel = double(latticeExtent) / 4, radius = pixel / 250;
    constexpr int perSide = 60;
    for (int i = 0; i < perSide * perSide; ++i) {
        const dvec2 centre = pixel * (0.2 + 3.6 / perSide * dvec2(i % perSide, i / perSide));
        addRing(pieces, centre, radius, 0, 0, 16, 1, 0, random);
    }
    Asset asset = emptyAsset();
    const PlanarMap map = mapOf(pieces);
    const Scanner scanner(std::span(&map, 1), asset);
    const View view = turnedView(6, 6, dvec2(0.5 * mapSide), 4.0 / mapSide, 0.3);
    const image::Raster drawn = scanner.draw(view);
    double alpha = 0;
    for (std::size_t i = 3; i < drawn.rgba.size(); i += 4)
        alpha += double(drawn.rgba[i]);
    EXPECT_NEAR(alpha, areaOf(pieces, 1) / (pixel * pixel), 0.5 / 255);
    EXPECT_GT(alpha, 0.1);
}

/// A sliver between two regions, drawn where it is far thinner than a pixel.
TEST(Detail, SliversStaySlivers) {
    Pieces pieces;
    std::mt19937 random(3);
    const double step = double(latticeExtent) / 20000;
    dvec2 a = glm::round(dvec2(step * 100)), b = a;
    for (int i = 0; i < 3000; ++i) {  // two borders that touch now and then
        const double y = std::round(step * double(random() % 40)) + a.y * 0 + step * 5000;
        const dvec2 nextA(std::round(step * (101 + i)), y);
        const dvec2 nextB =
            i % 17 == 0 ? nextA : nextA + dvec2(0, std::round(step * 0.01 * double(random() % 100)));
        pieces.push_back({a, nextA, 0, 0, 0, 1});
        pieces.push_back({b, nextB, 0, 0, 2, 0});
        a = nextA;
        b = nextB;
    }
    for (const double pixel : {step * 10, step * 100, step * 1000}) {
        const Pieces fewer = merged(pieces, pixel);
        EXPECT_NEAR((areaOf(fewer, 0) - areaOf(pieces, 0)) / (pixel * pixel), 0, 1e-3);
        EXPECT_LT(fewer.size(), pieces.size());
    }
}

}  // namespace
}  // namespace vtm::asset::test
