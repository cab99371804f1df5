#include "compiler/coverage_map.hpp"

#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <vtm/compiler/compile.hpp>
#include "raster/coverage.hpp"

namespace vtm::compiler {
namespace {

using asset::PlanarMap;
using scene::Point;

constexpr int side = 64;
constexpr double tolerance = 1.0 / (1 << 17);

using Path = std::shared_ptr<const scene::Path>;

/// Contours that cross themselves and each other, from `low` to `high` in each axis.
Path scribble(unsigned seed, double low, double high, int contours, int curves) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(low, high);
    const auto point = [&] { return Point(coordinate(random), coordinate(random)); };
    scene::Path path;
    for (int i = 0; i < contours; ++i) {
        path.push_back(scene::MoveTo{point()});
        for (int k = 0; k < curves; ++k)
            path.push_back(scene::CubicTo{point(), point(), point()});
    }
    return std::make_shared<const scene::Path>(std::move(path));
}

std::vector<float> pixelsOf(const asset::CoverageScanner& scanner) {
    std::vector<float> pixels(side * side);
    scanner.scan({side, side, scene::identity}, [&](int y, std::span<const asset::CoverageRun> runs) {
        for (const asset::CoverageRun& run : runs)
            std::fill(&pixels[std::size_t(y * side + run.first)], &pixels[std::size_t(y * side)] + run.end,
                      run.share);
    });
    return pixels;
}

asset::CoverageScanner throughAnAsset(const Path& path, scene::FillRule rule) {
    scene::Item item;
    item.path = path;
    item.geometry = rule;
    item.paint = scene::Color{0, 0, 0, 1};
    scene::Scene scene{side, side, {}};
    scene.root.children.push_back({std::move(item)});
    return asset::CoverageScanner(compile(scene, {.tolerance = tolerance}).asset);
}

PlanarMap mapOf(const Path& path, scene::FillRule rule) {
    return coverageMap(path, rule, scene::identity, {side, side}, {.tolerance = tolerance});
}

/// Going round any point, the changes cancel.
void expectClosed(const PlanarMap& map) {
    std::map<std::pair<double, double>, int> flows;
    for (const asset::PlanarPiece& p : map.pieces) {
        const int change = int(p.left != 0) - int(p.right != 0);
        flows[{p.b.x, p.b.y}] += change;
        flows[{p.a.x, p.a.y}] -= change;
    }
    for (const auto& [point, flow] : flows)
        ASSERT_EQ(flow, 0) << "at " << point.first << ", " << point.second;
}

/// Both are within the tolerance, 1/2048 of a pixel, along no more than some pixel sides of edges a pixel.
void expectSame(const Path& path, scene::FillRule rule) {
    const PlanarMap map = mapOf(path, rule);
    expectClosed(map);
    const std::vector<float> direct = pixelsOf(asset::CoverageScanner(map)),
                             expected = pixelsOf(throughAnAsset(path, rule));
    double covered = 0;
    for (std::size_t i = 0; i < direct.size(); ++i) {
        covered += double(direct[i]);
        ASSERT_NEAR(direct[i], expected[i], 16 * 2 * tolerance * side) << i % side << ' ' << i / side;
    }
    EXPECT_GT(covered, 1);
}

bool hasCurves(const PlanarMap& map) {
    return std::ranges::any_of(map.pieces, [](const asset::PlanarPiece& p) { return p.slopeA != 0; });
}

TEST(CoverageMap, IsThatOfTheAsset) {
    for (unsigned seed = 0; seed < 12; ++seed)
        for (const scene::FillRule rule : {scene::FillRule::NonZero, scene::FillRule::EvenOdd})
            expectSame(scribble(seed, 4, 60, 2, 3), rule);
}

/// What reaches beyond the picture ends at its border, which closes the map.
TEST(CoverageMap, EndsAtThePicturesBorder) {
    for (unsigned seed = 0; seed < 12; ++seed)
        for (const scene::FillRule rule : {scene::FillRule::NonZero, scene::FillRule::EvenOdd})
            expectSame(scribble(seed, -40, 104, 2, 3), rule);
}

TEST(CoverageMap, OfTheWholePicture) {
    expectSame(std::make_shared<const scene::Path>(scene::rectangle({-5, -5}, {70, 70})),
               scene::FillRule::NonZero);
}

TEST(CoverageMap, OfNothing) {
    const Path path = std::make_shared<const scene::Path>(scene::rectangle({-50, -50}, {-20, -20}));
    EXPECT_TRUE(mapOf(path, scene::FillRule::NonZero).pieces.empty());
}

/// Few chords stay as they are, many take leaves with curves.
TEST(CoverageMap, ManyChordsTakeLeaves) {
    EXPECT_FALSE(hasCurves(mapOf(scribble(1, 4, 60, 1, 3), scene::FillRule::EvenOdd)));
    const Path tangled = scribble(1, 4, 60, 40, 10);
    EXPECT_TRUE(hasCurves(mapOf(tangled, scene::FillRule::EvenOdd)));
    expectSame(tangled, scene::FillRule::EvenOdd);
}

TEST(CoverageMap, RefusesWhatCompileRefuses) {
    const auto of = [](const scene::Path& path, double tolerated) {
        return coverageMap(std::make_shared<const scene::Path>(path), scene::FillRule::NonZero,
                           scene::identity, {side, side}, {.tolerance = tolerated});
    };
    EXPECT_THROW(of(scene::rectangle({1, 1}, {NAN, 5}), tolerance), scene::InvalidScene);
    EXPECT_THROW(of(scene::rectangle({1, 1}, {5, 5}), 1), std::invalid_argument);
}

}  // namespace
}  // namespace vtm::compiler
