// What a renderer adds up must close: in every leaf of an asset, as quantised, the regions on both
// sides of the pieces fit together round every point and along every side.
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <vtm/asset/asset.hpp>
#include <vtm/compiler/compile.hpp>
#include "raster/planar_map.hpp"

namespace vtm::compiler {
namespace {

using asset::Asset;
using asset::Leaf;
using asset::Piece;

/// A paint's weight: sums of a few of them are equal only if the paints are.
std::uint64_t weight(std::uint32_t paint) { return std::mt19937_64(paint + 1u)(); }

/// Sum of weight(left) - weight(right) of what arrives minus what departs, by point.
using Flows = std::map<std::array<std::uint16_t, 2>, std::uint64_t>;

Flows flowsOf(const Asset& asset, const Leaf& leaf) {
    Flows flows;
    for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
        const Piece& p = asset.pieces[leaf.firstPiece + i];
        const std::uint64_t step = weight(p.left) - weight(p.right);
        flows[p.b] += step;
        flows[p.a] -= step;
    }
    return flows;
}

void expectClosed(const Asset& asset) {
    for (const Leaf& leaf : asset.leaves) {
        std::array<std::uint64_t, 4> sides{};
        for (const auto& [point, flow] : flowsOf(asset, leaf)) {
            const int side = asset::sideOf(point);
            if (side >= 0)
                sides[static_cast<std::size_t>(side)] += flow;
            else
                ASSERT_EQ(flow, 0u) << "at " << point[0] << ", " << point[1];
        }
        for (std::size_t k = 0; k < 4; ++k)
            ASSERT_EQ(sides[k], weight(leaf.corners[(k + 1) % 4]) - weight(leaf.corners[k])) << "side " << k;
    }
}

/// All boundaries together, with what lies on the borders between leaves: where paints along a side stand in
/// the wrong order, a border is missing there.
void expectMapClosed(const Asset& asset) {
    std::map<std::pair<double, double>, std::uint64_t> flows;
    for (const asset::PlanarPiece& p : asset::planarMap(asset, asset.maps[0]).pieces) {
        const std::uint64_t step = weight(p.left) - weight(p.right);
        flows[{p.b.x, p.b.y}] += step;
        flows[{p.a.x, p.a.y}] -= step;
    }
    for (const auto& [point, flow] : flows)
        ASSERT_EQ(flow, 0u) << "at " << point.first << ", " << point.second;
}

class Scribbler {
public:
    explicit Scribbler(unsigned seed) : engine_(seed) {}

    scene::Point point() { return {coordinate_(engine_), coordinate_(engine_)}; }
    /// On a grid that cells share: shapes end on their borders.
    scene::Point gridPoint() { return {double(cell_(engine_)) * 4, double(cell_(engine_)) * 4}; }
    scene::Color color() {
        return {share_(engine_), share_(engine_), share_(engine_), engine_() % 2 ? 1.0f : 0.5f};
    }
    scene::FillRule rule() { return engine_() % 2 ? scene::FillRule::EvenOdd : scene::FillRule::NonZero; }

private:
    std::mt19937 engine_;
    std::uniform_real_distribution<double> coordinate_{-8, 72};
    std::uniform_int_distribution<int> cell_{0, 16};
    std::uniform_real_distribution<float> share_{0, 1};
};

void add(scene::Scene& scene, scene::Path path, scene::Color color, scene::FillRule rule) {
    scene::Item item;
    item.path = std::make_shared<scene::Path>(std::move(path));
    item.geometry = rule;
    item.paint = color;
    scene.root.children.push_back({item});
}

class Closure : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Closure, testing::Range(0u, 20u));

TEST_P(Closure, holdsForRandomCurves) {
    Scribbler random(GetParam());
    scene::Scene scene{64, 64, {}};
    for (int i = 0; i < 12; ++i) {
        scene::Path path{scene::MoveTo{random.point()}};
        for (int k = 0; k < 3; ++k)
            path.push_back(scene::CubicTo{random.point(), random.point(), random.point()});
        add(scene, path, random.color(), random.rule());
    }
    const Asset asset = compile(scene).asset;
    EXPECT_FALSE(asset.leaves.empty());
    expectClosed(asset);
    expectMapClosed(asset);
}

TEST_P(Closure, holdsForShapesThatEndOnCellBorders) {
    Scribbler random(GetParam());
    scene::Scene scene{64, 64, {}};
    for (int i = 0; i < 20; ++i) {
        const scene::Point a = random.gridPoint(), b = random.gridPoint(), c = random.gridPoint();
        if (i % 2)
            add(scene, scene::rectangle(a, b), random.color(), random.rule());
        else
            add(scene, {scene::MoveTo{a}, scene::LineTo{b}, scene::LineTo{c}, scene::Close{}}, random.color(),
                random.rule());
    }
    const Asset asset = compile(scene).asset;
    expectClosed(asset);
    expectMapClosed(asset);
}

TEST(Rays, CloseRoundACornerOfCells) {
    // Rays of one vertex that is a corner of cells, some of them along borders: there a sliver lies behind
    // the ends of others, which go first.
    for (const int count : {4, 12, 40, 100})
        for (const scene::FillRule rule : {scene::FillRule::NonZero, scene::FillRule::EvenOdd}) {
            scene::Path rays;
            const scene::Point hub(32, 32);
            for (int i = 0; i < count; ++i) {
                const double angle = 2 * 3.14159265358979 * i / count;
                const auto at = [&](double a) { return hub + 28.0 * scene::Point(std::cos(a), std::sin(a)); };
                const scene::Path ray =
                    scene::polygon({hub, at(angle), at(angle + 3.14159265358979 / count)});
                rays.insert(rays.end(), ray.begin(), ray.end());
            }
            scene::Scene scene{64, 64, {}};
            add(scene, rays, {0, 0, 0, 1}, rule);
            const Asset asset = compile(scene).asset;
            expectClosed(asset);
            expectMapClosed(asset);
        }
}

}  // namespace
}  // namespace vtm::compiler
