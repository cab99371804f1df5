// Fills that share an outline of the stroke which hides their own.

#include <random>

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/scene/scene.hpp>
#include "compiler/lower/lower.hpp"
#include "compiler/lower/lowered_scene.hpp"
#include "compiler/tests/comparison.hpp"

namespace vtm::compiler {
namespace {

using scene::Color;
using scene::FillRule;
using scene::Group;
using scene::Item;
using scene::Path;
using scene::Point;
using scene::Scene;
using scene::StrokeStyle;

constexpr double size = 100;

/// Closed subpaths of lines and curves that cross themselves and each other.
class RandomRings {
public:
    explicit RandomRings(unsigned seed) : random_(seed) {}

    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
    Point point() { return {number(10, 90), number(10, 90)}; }

    std::shared_ptr<const Path> path() {
        Path path;
        for (int rings = 1 + pick(3); rings > 0; --rings) {
            path.push_back(scene::MoveTo{point()});
            for (int segments = 2 + pick(4); segments > 0; --segments) {
                const int kind = pick(4);
                if (kind == 0)
                    path.push_back(scene::LineTo{point()});
                else if (kind == 1)
                    path.push_back(scene::QuadTo{point(), point()});
                else if (kind == 2)
                    path.push_back(
                        scene::ArcTo{{number(5, 40), number(5, 40)}, number(0, 3), false, true, point()});
                else
                    path.push_back(scene::CubicTo{point(), point(), point()});
            }
            path.push_back(scene::Close{});
        }
        return std::make_shared<const Path>(std::move(path));
    }

    StrokeStyle style() {
        StrokeStyle style;
        style.width = std::exp(number(std::log(0.02), std::log(20)));
        style.join = std::array{scene::Join::Miter, scene::Join::MiterClip, scene::Join::Round,
                                scene::Join::Bevel}[std::size_t(pick(4))];
        style.miterLimit = number(1, 8);
        return style;
    }

private:
    std::mt19937 random_;
};

Scene sceneOf(std::vector<scene::Node> children) {
    Scene scene;
    scene.width = scene.height = size;
    scene.root.children = std::move(children);
    return scene;
}

Item filled(const std::shared_ptr<const Path>& path, FillRule rule) {
    return {path, scene::identity, rule, Color{1, 0.8f, 0, 1}, 1};
}

Item stroked(const std::shared_ptr<const Path>& path, const StrokeStyle& style, Color color) {
    return {path, scene::identity, style, color, 1};
}

/// In a group of its own an item has no neighbour to share with.
Group alone(Item item) {
    Group group;
    group.children.push_back({std::move(item)});
    return group;
}

class SharedOutlines : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seed, SharedOutlines, testing::Range(0u, 60u));

TEST_P(SharedOutlines, changesNoPicture) {
    RandomRings random(GetParam());
    const auto path = random.path();
    const StrokeStyle style = random.style();
    const FillRule rule = random.pick(2) ? FillRule::NonZero : FillRule::EvenOdd;
    const Item fill = filled(path, rule), stroke = stroked(path, style, {0, 0, 0.5f, 1});
    Options options;
    options.tolerance = 1.0 / 4096;
    const Result shared = compile(sceneOf({{fill}, {stroke}}), options),
                 apart = compile(sceneOf({{alone(fill)}, {alone(stroke)}}), options);
    test::Comparison(shared.asset, apart.asset, options.tolerance).run();
    EXPECT_EQ(shared.asset.fallbackLeaves, 0u);
}

/// One path in many places, moved, turned, mirrored and beyond the picture: the outlines of as many paths.
TEST_P(SharedOutlines, ofRepeatedPathsAreThoseOfCopies) {
    RandomRings random(GetParam());
    const auto path = random.path();
    std::vector<scene::Node> repeated, copies;
    for (int i = 0; i < 20; ++i) {
        scene::Affine place = scene::translation(random.number(-80, 80), random.number(-80, 80));
        if (i % 5 == 4)
            place = scene::compose(place, scene::Affine(0.6, 0.8, -0.8, 0.6, 30, -10));
        if (i % 7 == 6)
            place = scene::compose(place, scene::Affine(-0.5, 0, 0, 0.5, 50, 0));
        Item item = filled(path, FillRule::NonZero);
        item.transform = place;
        repeated.push_back({item});
        item.path = std::make_shared<const Path>(*path);
        copies.push_back({item});
    }
    const Lattice lattice(size, size, 20);
    const auto lowered = [&](const std::vector<scene::Node>& items) {
        const Scene scene = sceneOf(items);
        return lower(scene, wholeOf(scene), lattice, ErrorBudget(1.0 / 4096, 20), Sharing::All);
    };
    const LoweredScene a = lowered(repeated), b = lowered(copies);
    ASSERT_EQ(a.layers.size(), b.layers.size());
    ASSERT_EQ(a.outlines.points.size(), b.outlines.points.size());
    ASSERT_EQ(a.outlines.runs.size(), b.outlines.runs.size());
    for (std::size_t i = 0; i < a.outlines.points.size(); ++i) {
        // Even numbers, which a last digit before rounding may tell apart.
        ASSERT_LE(std::abs(a.outlines.points[i].x - b.outlines.points[i].x), 2) << i;
        ASSERT_LE(std::abs(a.outlines.points[i].y - b.outlines.points[i].y), 2) << i;
    }
}

TEST(SharedOutline, takesTheFirstRunsOfAStroke) {
    const auto layersOf = [](Path path) {
        const auto shape = std::make_shared<const Path>(std::move(path));
        const Lattice lattice(size, size, 20);
        const scene::Scene scene =
            sceneOf({{filled(shape, FillRule::NonZero)}, {stroked(shape, {}, {0, 0, 0, 1})}});
        return lower(scene, wholeOf(scene), lattice, ErrorBudget(1.0 / 4096, 20), Sharing::Outlines).layers;
    };
    Path ring{scene::MoveTo{{20, 20}}, scene::CubicTo{{40, 10}, {90, 50}, {80, 80}}, scene::LineTo{{30, 70}},
              scene::Close{}};
    std::vector<Layer> layers = layersOf(ring);
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].firstRun, layers[1].firstRun);
    EXPECT_GT(layers[0].runCount, 0u);
    EXPECT_LT(layers[0].runCount, layers[1].runCount);
    ring.pop_back();  // the fill closes it, the stroke does not
    layers = layersOf(ring);
    EXPECT_GE(layers[0].firstRun, layers[1].firstRun + layers[1].runCount);
}

TEST(SharedOutline, needsAStrokeThatHides) {
    RandomRings random(1);
    const auto path = random.path();
    StrokeStyle style;
    style.width = 4;
    const Item fill = filled(path, FillRule::NonZero);
    const auto expectNotShared = [&](const Item& stroke) {
        EXPECT_EQ(asset::write(compile(sceneOf({{fill}, {stroke}})).asset),
                  asset::write(compile(sceneOf({{alone(fill)}, {alone(stroke)}})).asset));
    };
    expectNotShared(stroked(path, style, {0, 0, 0.5f, 0.5f}));
    Item faint = stroked(path, style, {0, 0, 0.5f, 1});
    faint.opacity = 0.5f;
    expectNotShared(faint);
    StrokeStyle dashed = style;
    dashed.dashes = {3, 2};
    expectNotShared(stroked(path, dashed, {0, 0, 0.5f, 1}));
    expectNotShared(stroked(std::make_shared<const Path>(*path), style, {0, 0, 0.5f, 1}));
}

}  // namespace
}  // namespace vtm::compiler
