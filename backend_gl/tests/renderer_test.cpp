#include <vtm/gl/renderer.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include "asset/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using asset::View;
using namespace asset::test;

struct Worst {
    double difference = 0;
    int x = 0, y = 0;
};

Worst worst(const image::Raster& a, const image::Raster& b) {
    Worst w;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 4; ++c)
                if (const double d = std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]); d > w.difference)
                    w = {d, x, y};
    return w;
}

/// Straight edges are exact in both but for roundings: of ends and centres to steps of a thousandth of a
/// pixel, which move an edge by 0.0015 pixels at most (docs/coverage.md).
constexpr double twinTolerance = 0.4 / 255;
/// Where pieces are shorter than pixels, fewer take their place (docs/coverage.md).
constexpr double detailTolerance = 1.0 / 255;
/// Curves: the evaluator sums four chords, the shader a chord and what lies between it and the curve.
constexpr double curveTolerance = 2.0 / 255;

/// Every pixel of `drawn` beside the one of `a` or `b` that is nearer to it.
Worst worstOfNearest(const image::Raster& drawn, const image::Raster& a, const image::Raster& b) {
    const auto far = [&](const image::Raster& twin, int x, int y) {
        double max = 0;
        for (int c = 0; c < 4; ++c)
            max = std::max(max, std::abs(double(drawn.pixel(x, y)[c]) - double(twin.pixel(x, y)[c])));
        return max;
    };
    Worst w;
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x)
            if (const double d = std::min(far(a, x, y), far(b, x, y)); d > w.difference)
                w = {d, x, y};
    return w;
}

/// Rough pixels come from the shaders or, where their cells are handed over, from the scanner.
image::Raster handedOver(const Asset& asset, const View& view) {
    return asset::isSumOfMaps(asset) ? asset::Scanner(asset).draw(view) : asset::evaluate(asset, view);
}

void expectTwins(Renderer& renderer, const Asset& asset, int views = 25, double tolerance = twinTolerance) {
    ASSERT_NO_THROW(asset::validate(asset));
    const Texture texture = renderer.upload(asset);
    std::mt19937 random(11);
    for (int i = 0; i < views; ++i) {
        const View view = randomView(random);
        const Worst w = worstOfNearest(renderer.render(texture, view), asset::evaluateAsShaders(asset, view),
                                       handedOver(asset, view));
        ASSERT_LE(w.difference, tolerance) << "view " << i << " pixel " << w.x << ", " << w.y;
    }
}

TEST_F(Gl, HalfPlane) { expectTwins(*renderer, halfPlane()); }
TEST_F(Gl, Wedge) { expectTwins(*renderer, wedge()); }
TEST_F(Gl, Strip) { expectTwins(*renderer, strip()); }
TEST_F(Gl, ThreeRegions) { expectTwins(*renderer, threeRegions()); }
TEST_F(Gl, Arcs) { expectTwins(*renderer, disc(), 25, curveTolerance); }
TEST_F(Gl, TwoLevelTree) { expectTwins(*renderer, twoLevels()); }
TEST_F(Gl, EveryPaint) { expectTwins(*renderer, everyPaint()); }
TEST_F(Gl, PlacedMaps) { expectTwins(*renderer, placedMaps(), 25, curveTolerance); }
TEST_F(Gl, CompatCommands) { expectTwins(*renderer, layers()); }

/// Parts of pixels have their own colours (docs/coverage.md).
TEST_F(Gl, SteepGradients) {
    for (const double length : {4.0, 1.0, 0.25}) {
        expectTwins(*renderer, steepHalves(length), 12);
        // A quarter of all shades a pixel.
        const View view = turnedView(24, 18, {29.5, 31.5}, 4 / length, 0.4);
        const Worst w = worst(renderer->render(renderer->upload(steepHalves(length)), view),
                              steepHalvesByPoints(length, view.width, view.height, view.toPixels));
        EXPECT_LE(w.difference, 4.0 / 255) << w.x << ", " << w.y;
    }
}

TEST_F(Gl, EveryBlendMode) {
    for (unsigned mode = 0; mode <= unsigned(asset::Blend::PlusLighter); ++mode) {
        SCOPED_TRACE(mode);
        expectTwins(*renderer, blendAsset(asset::Blend(mode)), 4);
    }
}

TEST_F(Gl, DeepestCell) {
    Asset asset = emptyAsset();
    for (std::uint32_t level = 0; level < asset::maxLevel; ++level) {
        asset::Node node;
        node.children.fill(asset::Entry::make(asset::Entry::Kind::Solid, 2));
        node.children[10] = asset::Entry::make(asset::Entry::Kind::Node, level + 1);
        if (level + 1 == asset::maxLevel)
            node.children[10] = addLeaf(asset, {1, 2, 2, 1}, {line({30001, 0}, {40001, 65535}, 1, 2)});
        asset.nodes.push_back(node);
    }
    asset.maps[0].root = asset::Entry::make(asset::Entry::Kind::Node, 0);
    const double side = std::ldexp(mapSide, -24), corner = mapSide * (1 - std::ldexp(1.0, -24)) * 2 / 3;
    const View view = turnedView(50, 50, {corner, corner}, 40 / side, 0.5);
    const image::Raster picture = renderer->render(renderer->upload(asset), view);
    EXPECT_LE(worst(picture, asset::evaluate(asset, view)).difference, twinTolerance);
    EXPECT_GT(picture.pixel(35, 35)[0] + picture.pixel(30, 40)[0], 0.5);  // the leaf's red half is there
}

TEST_F(Gl, ManyRowsOfTexels) {
    Asset asset = emptyAsset();
    asset.nodes.resize(1 + 16 + 256);
    for (std::uint32_t n = 0; n < 17; ++n)
        for (std::uint32_t i = 0; i < 16; ++i)
            asset.nodes[n].children[i] = asset::Entry::make(asset::Entry::Kind::Node, n * 16 + i + 1);
    for (std::uint32_t n = 17; n < asset.nodes.size(); ++n)
        for (asset::Entry& child : asset.nodes[n].children) {
            const auto x = std::uint16_t(asset.leaves.size() * 15 + 1);
            child = addLeaf(asset, {1, 2, 2, 1}, {line({x, 0}, {std::uint16_t(x + 99), 65535}, 1, 2)});
        }
    asset.maps[0].root = asset::Entry::make(asset::Entry::Kind::Node, 0);
    ASSERT_GT(asset.leaves.size() + asset.pieces.size(), 4096u);
    expectTwins(*renderer, asset, 6, detailTolerance);
}

TEST_F(Gl, ViewsLargerThanATile) {
    const Asset asset = layers();
    for (const View& view : {turnedView(4500, 9, {32, 32}, 70, 0.2), turnedView(7, 4200, {32, 32}, 60, 0.1)})
        EXPECT_LE(
            worst(renderer->render(renderer->upload(asset), view), asset::evaluate(asset, view)).difference,
            twinTolerance);
}

/// Masks of all sizes over each other, the same one several times, groups inside groups.
Asset randomLayers(std::mt19937& random) {
    Asset asset = layers();
    const auto maps = std::uint32_t(asset.maps.size());
    for (std::uint32_t i = 0; i < 30; ++i) {
        asset::Map map = asset.maps[random() % maps];
        map.x = double(random() % 60) - 10;
        map.y = double(random() % 60) - 10;
        map.side = double(1 + random() % 40);
        asset.maps.push_back(map);
    }
    using K = asset::Command::Kind;
    const auto any = [&](std::size_t count) { return std::uint32_t(random() % count); };
    asset.commands.clear();
    unsigned open = 0;
    for (int i = 0; i < 80 || open > 0; ++i) {
        const std::uint32_t choice = i < 80 ? any(12) : 11;
        if (choice == 10 && open < 4) {
            asset.commands.push_back({K::Push, {}, 1, 0, 0});
            ++open;
        } else if (choice == 11 && open > 0) {
            const K kinds[] = {K::Pop, K::Pop, K::PopMaskAlpha, K::PopMaskLuminance, K::PopMaskLinear};
            asset.commands.push_back({kinds[any(5)], asset::Blend(any(17)), float(any(5)) / 4, 0, 0});
            --open;
        } else if (choice == 9 && open > 0) {
            asset.commands.push_back({K::ClipMask, {}, 1, any(asset.maps.size()), 0});
        } else {
            asset.commands.push_back({K::FillMask, {}, 1, any(asset.maps.size()), any(asset.paints.size())});
        }
    }
    return asset;
}

TEST_F(Gl, RandomLayers) {
    std::mt19937 random(21);
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        expectTwins(*renderer, randomLayers(random), 4);
    }
}

/// Of pictures that no compiler of ours makes, and validation lets pass.
TEST_F(Gl, MapsThatAddUp) {
    Asset asset = strip();
    asset.maps.push_back(asset.maps[0]);
    asset.maps[1].x += 17;
    asset.maps[1].side *= 0.5;
    asset.commands.push_back({asset::Command::Kind::DrawMap, {}, 1, 1, 0});
    asset.paints[1] = asset.paints[2] = solid({0.25f, 0.125f, 0, 0.375f});  // sums stay below 1
    asset.paints[3] = solid({0, 0, 0.25f, 0.25f});
    expectTwins(*renderer, asset);
    const asset::Scanner scanner(asset);
    std::mt19937 random(4);
    for (int i = 0; i < 10; ++i) {
        const View view = randomView(random);
        EXPECT_LE(worst(scanner.draw(view), asset::evaluate(asset, view)).difference, twinTolerance);
    }
}

TEST_F(Gl, PicturesLeaveNothingBehind) {
    const Texture a = renderer->upload(layers()), b = renderer->upload(everyPaint());
    const View view = turnedView(64, 64, {32, 32}, 1, 0.3);
    const image::Raster first = renderer->render(a, view);
    renderer->render(b, view);
    renderer->draw(b, turnedView(33, 70, {32, 32}, 5, 0));
    EXPECT_EQ(renderer->render(a, view).rgba, first.rgba);
}

TEST_F(Gl, FlattenedViewDrawsNothing) {
    const image::Raster raster =
        renderer->render(renderer->upload(halfPlane()), {8, 8, glm::dmat3x2(1, 1, 2, 2, 0, 0)});
    EXPECT_EQ(*std::ranges::max_element(raster.rgba), 0);
}

TEST_F(Gl, RejectsViewsBeyondTheLimits) {
    const Texture texture = renderer->upload(halfPlane());
    EXPECT_THROW(renderer->render(texture, {asset::maxViewSide + 1, 1, {}}), std::length_error);
    EXPECT_THROW(renderer->draw(texture, {16000, 16000, {}}), std::length_error);
    EXPECT_TRUE(renderer->render(texture, {0, 5, {}}).rgba.empty());
}

TEST_F(Gl, EmptyAssetIsTransparent) {
    Asset asset = emptyAsset();
    asset.commands.clear();
    const image::Raster raster = renderer->render(renderer->upload(asset), {4, 4, {}});
    EXPECT_EQ(raster.rgba, std::vector<float>(64));
}

}  // namespace
}  // namespace vtm::gl
