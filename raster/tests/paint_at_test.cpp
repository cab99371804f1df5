#include <vtm/raster/paint_at.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include <vtm/raster/evaluate.hpp>
#include "asset/testing.hpp"

namespace vtm::asset {
namespace {

using namespace test;

constexpr double step = mapSide / leafExtent;

TEST(PaintAt, BothSidesOfALine) {
    const Asset asset = halfPlane();
    for (const double y : {0.0, 0.001, 17.3, 40.0, 63.9999, 64.0}) {
        const double x = (20001 + (40003 - 20001) * y / mapSide) * step;
        for (const double away : {1e-9, 1e-4, 1.0, 15.0}) {
            EXPECT_EQ(paintAt(asset, {x - away, y}), 1u) << y << ' ' << away;
            EXPECT_EQ(paintAt(asset, {x + away, y}), 2u) << y << ' ' << away;
        }
    }
}

TEST(PaintAt, BothSidesOfCurves) {
    const Asset asset = disc();
    // On the stored curve itself, and a little to the left and to the right of it.
    for (const Piece& piece : asset.pieces)
        for (int i = 0; i <= 40; ++i) {
            const double s = i / 40.0, r = 1 - s;
            const double mA = piece.slopeA / double(slopeScale), mB = piece.slopeB / double(slopeScale);
            const glm::dvec2 a(piece.a[0], piece.a[1]), d = glm::dvec2(piece.b[0], piece.b[1]) - a;
            const glm::dvec2 normal(-d.y, d.x);
            const glm::dvec2 p = a + s * d + s * r * (mA * r - mB * s) * normal;
            const double away = 1e-7 * std::hypot(d.x, d.y);
            const glm::dvec2 way = normal / std::hypot(d.x, d.y) * away;
            EXPECT_EQ(paintAt(asset, (p + way) * step), piece.left) << s;
            EXPECT_EQ(paintAt(asset, (p - way) * step), piece.right) << s;
        }
}

TEST(PaintAt, OutsideIsTransparent) {
    const Asset asset = halfPlane();
    for (const glm::dvec2 p : {glm::dvec2(-1e-9, 5), {5, -3}, {64.001, 5}, {5, 1e9}, {NAN, 5}})
        EXPECT_EQ(paintAt(asset, p), 0u);
}

TEST(PaintAt, PlacedMapsHaveTheirOwnPaints) {
    const Asset asset = placedMaps();
    EXPECT_EQ(paintAt(asset, {mapSide / 4, mapSide / 4}), 2u);
    EXPECT_EQ(paintAt(asset, {mapSide * 3 / 4, mapSide / 2}), 3u);
    EXPECT_EQ(paintAt(asset, {mapSide / 10, mapSide / 10}), 0u);
    EXPECT_EQ(paintAt(asset, {mapSide / 2, mapSide * 9 / 10}), 0u);
}

TEST(PaintAt, CompatIsRefused) { EXPECT_THROW(paintAt(layers(), {1, 1}), std::invalid_argument); }

/// Pixels that one region fills have its colour, whatever leaves they lie in.
TEST(PaintAt, AgreesWithPixels) {
    std::mt19937 random(5);
    for (const Asset& asset : {halfPlane(), wedge(), strip(), threeRegions(), disc(), twoLevels()}) {
        constexpr int side = 256;
        const View view{side, side, {side / mapSide, 0, 0, side / mapSide, 0, 0}};
        const image::Raster raster = evaluate(asset, view);
        int compared = 0;
        for (int i = 0; i < 4000; ++i) {
            const int x = 1 + int(random() % (side - 2)), y = 1 + int(random() % (side - 2));
            const float* c = raster.pixel(x, y);
            const std::uint32_t paint = paintAt(asset, glm::dvec2(x + 0.5, y + 0.5) * (mapSide / side));
            bool pure = false;
            for (const Paint& p : asset.paints) {
                bool same = true;
                for (std::size_t k = 0; k < 4; ++k)
                    same &= std::abs(std::bit_cast<float>(p[k]) - c[k]) < 1e-4f;
                pure |= same;
            }
            if (!pure)
                continue;
            ++compared;
            for (std::size_t k = 0; k < 4; ++k)
                ASSERT_NEAR(std::bit_cast<float>(asset.paints[paint][k]), c[k], 1e-4f) << x << ' ' << y;
        }
        EXPECT_GT(compared, 3000);
    }
}

}  // namespace
}  // namespace vtm::asset
