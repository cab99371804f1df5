#include <random>

#include <gtest/gtest.h>

#include <vtm/raster/paint_at.hpp>
#include "asset/testing.hpp"
#include "raster/planar_map.hpp"

namespace vtm::asset {
namespace {

using namespace test;

PlanarIndex indexOf(const Asset& asset) { return PlanarIndex(planarMap(asset, asset.maps[0])); }

/// Off a boundary both say the same: leaves of their own pieces, the index of the pieces in a row.
TEST(PlanarIndex, AgreesWithLeaves) {
    std::mt19937_64 random(7);
    for (const Asset& asset : {halfPlane(), wedge(), strip(), threeRegions(), disc(), twoLevels()}) {
        const PlanarIndex index = indexOf(asset);
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec2 share(double(random() % 1000003) / 1000003,
                                   double(random() % 1000033) / 1000033);
            ASSERT_EQ(index.paintAt(share * index.map().extent), paintAt(asset, share * mapSide))
                << share.x << ' ' << share.y;
        }
    }
}

/// A row through the ends of pieces is that just above it.
TEST(PlanarIndex, RowsThroughEndsOfPieces) {
    int compared = 0;
    for (const Asset& asset : {halfPlane(), wedge(), threeRegions(), disc(), twoLevels()}) {
        const PlanarIndex index = indexOf(asset);
        for (const PlanarPiece& p : index.map().pieces)
            for (const glm::dvec2 end : {p.a, p.b})
                for (int i = 0; i < 16; ++i) {
                    const glm::dvec2 here((i + 0.503) / 16 * index.map().extent, end.y);
                    const glm::dvec2 above(here.x, here.y + 1), below(here.x, here.y - 1);
                    if (index.paintAt(above) != index.paintAt(below) || end.y <= 0 ||
                        end.y >= index.map().extent)
                        continue;
                    ++compared;
                    ASSERT_EQ(index.paintAt(here), index.paintAt(above)) << here.x << ' ' << here.y;
                }
    }
    EXPECT_GT(compared, 100);
}

/// Points of a chord that its curve leaves far behind are on one side of it, whichever rounding says.
TEST(PlanarIndex, PointsOfAChordLieBesideItsCurve) {
    const Asset asset = disc();
    const PlanarIndex index = indexOf(asset);
    for (const PlanarPiece& p : index.map().pieces) {
        if (p.slopeA == 0 && p.slopeB == 0)
            continue;
        for (const double s : {0.25, 0.5, 0.75}) {
            const std::uint32_t side = p.height(s) > 0 ? p.right : p.left;
            EXPECT_EQ(index.paintAt(p.a + s * (p.b - p.a)), side) << s;
        }
    }
}

TEST(PlanarIndex, OutsideIsTransparent) {
    const PlanarIndex index = indexOf(halfPlane());
    const double extent = index.map().extent;
    for (const glm::dvec2 p : {glm::dvec2(-1, 5), {5, -3}, {extent + 1, 5}, {5, 1e30}, {NAN, 5}})
        EXPECT_EQ(index.paintAt(p), 0u);
}

TEST(PlanarMaps, CompatIsRefused) { EXPECT_THROW(planarMaps(layers()), std::invalid_argument); }

}  // namespace
}  // namespace vtm::asset
