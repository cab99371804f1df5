// Coverage against the evaluator's alpha of the same shapes in opaque white.

#include "raster/coverage.hpp"

#include <bit>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>
#include <glm/vec4.hpp>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>
#include "asset/testing.hpp"
#include "raster/testing_views.hpp"

namespace vtm::asset::test {
namespace {

/// As in scan_test.cpp: roundings, and the evaluator's chords.
constexpr double straight = 0.25 / 255, curved = 1.5 / 255;

Asset inWhite(Asset asset) {
    for (std::size_t i = 1; i < asset.paints.size(); ++i)
        asset.paints[i] = std::bit_cast<Paint>(glm::vec4(1));
    return asset;
}

void expectAlpha(const Asset& asset, double tolerance) {
    ASSERT_NO_THROW(validate(asset));
    const CoverageScanner scanner(asset);
    std::mt19937 random(5);
    for (int i = 0; i < 40; ++i) {
        const View view = randomView(random);
        image::Raster coverage(view.width, view.height);
        int lastRow = -1;
        scanner.scan(view, [&](int y, std::span<const CoverageRun> runs) {
            ASSERT_GT(y, lastRow);
            lastRow = y;
            int done = 0;
            for (const CoverageRun& run : runs) {
                ASSERT_GE(run.first, done);
                ASSERT_LT(run.first, run.end);
                done = run.end;
                for (int x = run.first; x < run.end; ++x)
                    coverage.pixel(x, y)[3] = run.share;
            }
            ASSERT_LE(done, view.width);
        });
        const image::Raster expected = evaluate(asset, view);
        double worst = 0;
        for (std::size_t p = 3; p < expected.rgba.size(); p += 4)
            worst = std::max(worst, std::abs(double(coverage.rgba[p]) - double(expected.rgba[p])));
        ASSERT_LE(worst, tolerance) << "view " << i;
    }
}

TEST(CoverageScan, HalfPlane) { expectAlpha(inWhite(halfPlane()), straight); }
TEST(CoverageScan, Wedge) { expectAlpha(inWhite(wedge()), straight); }
TEST(CoverageScan, Strip) { expectAlpha(inWhite(strip()), straight); }
TEST(CoverageScan, SeveralPaintsAreOne) { expectAlpha(inWhite(threeRegions()), straight); }
TEST(CoverageScan, TwoLevelTree) { expectAlpha(inWhite(twoLevels()), straight); }
TEST(CoverageScan, Arcs) { expectAlpha(inWhite(disc()), curved); }

TEST(CoverageScan, FlatViewsCoverNothing) {
    View view;
    view.width = view.height = 16;
    view.toPixels = {0, 0, 0, 0, 3, 3};
    CoverageScanner(disc()).scan(view, [](int, auto) { FAIL(); });
}

TEST(CoverageScan, LayersAreNoMask) { EXPECT_THROW(CoverageScanner{layers()}, std::invalid_argument); }

}  // namespace
}  // namespace vtm::asset::test
