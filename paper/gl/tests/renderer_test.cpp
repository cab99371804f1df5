// Paper mode: the shader and its twin on the CPU, on assets made by hand.

#include "paper/gl/renderer.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "asset/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "paper/evaluate.hpp"
#include "raster/testing_views.hpp"

namespace vtm::paper {

using namespace gl;
namespace {

using namespace asset::test;

/// A piece in cell coordinates.
Piece piece(glm::dvec2 a, glm::dvec2 b, double slopeA, double slopeB) {
    const auto place = [](glm::dvec2 p) {
        return std::array{std::uint16_t(std::lround(p.x * cellExtent)),
                          std::uint16_t(std::lround(p.y * cellExtent))};
    };
    return {place(a), place(b), std::int16_t(std::lround(slopeA * slopeScale)),
            std::int16_t(std::lround(slopeB * slopeScale))};
}

/// Two levels of cells with either operator, with one piece and with none, and a mip of many greys.
Mask everyCell(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto anyPiece = [&] {
        return piece({0.3 * unit(random), unit(random)}, {1 - 0.3 * unit(random), unit(random)},
                     2 * unit(random) - 1, 2 * unit(random) - 1);
    };
    using asset::Entry;
    Mask mask;
    mask.side = mapSide;
    mask.root = asset::Entry::make(asset::Entry::Kind::Node, 0);
    mask.nodes.resize(2);
    for (std::uint32_t i = 0; i < 32; ++i) {
        asset::Entry& entry = mask.nodes[i / 16].children[i % 16];
        entry = asset::Entry::make(asset::Entry::Kind::Solid, i % 2);
        if (i % 5 == 0)
            continue;
        entry = asset::Entry::make(asset::Entry::Kind::Leaf, std::uint32_t(mask.cells.size()));
        mask.cells.push_back({{anyPiece(), anyPiece()}, std::uint8_t(1 + (i % 3 != 0)), Operator(i % 2)});
    }
    mask.nodes[0].children[6] = asset::Entry::make(asset::Entry::Kind::Node, 1);
    mask.mip.sizeLog2 = 3;
    for (int i = 0; i < 64 + 16 + 4 + 1; ++i)
        mask.mip.texels.push_back(std::uint8_t(random()));
    return mask;
}

/// Layers of paints 1 and up behind masks, over a part that is not written.
Asset layersOf(const asset::Asset& palette, std::uint32_t paints) {
    Asset asset;
    asset.width = asset.height = mapSide;
    asset.palette.paints = palette.paints;
    asset.palette.data = palette.data;
    asset.palette.images = palette.images;
    asset.palette.materials = palette.materials;
    asset.nodes.push_back({noIndex, 1, {}, {0, noIndex, true}});
    for (std::uint32_t i = 1; i < paints; ++i) {
        asset.masks.push_back(everyCell(i));
        asset.nodes.push_back({i - 1, 0.75f, {i, i - 1, false}, {0, i - 1, false}});
        if (i % 3 == 0)  // a clip: outside it, what lies one layer below
            asset.nodes.back() = {i - 1, 1, {0, i - 1, false}, {0, i - 2, false}};
    }
    asset.root = std::uint32_t(asset.nodes.size() - 1);
    validate(asset);
    return asset;
}

/// Bound of the GPU against the evaluator, of 1.
constexpr float bound = 2.0f / 255;

TEST_F(Gl, PaperModeEqualsItsTwinUnderRandomViews) {
    Renderer paper;
    const Asset asset = layersOf(emptyAsset(), 5);
    const Texture texture(asset);
    std::mt19937 random(5);
    for (int i = 0; i < 60; ++i) {
        const asset::View view = randomView(random);
        const image::Raster gpu = paper.render(texture, view), cpu = evaluate(asset, view);
        std::size_t wrong = 0;
        for (std::size_t c = 0; c < gpu.rgba.size(); ++c)
            wrong += std::abs(gpu.rgba[c] - cpu.rgba[c]) > bound ? 1 : 0;
        EXPECT_EQ(wrong, 0u) << "view " << i;
    }
}

TEST_F(Gl, PaperModeKnowsEveryPaint) {
    Renderer paper;
    const asset::Asset palette = everyPaint();
    const std::uint32_t paints = std::uint32_t(palette.paints.size());
    const Asset asset = layersOf(palette, paints);
    const asset::View view = turnedView(64, 64, {32, 32}, 0.9, 0.3);
    const image::Raster gpu = paper.render(Texture(asset), view), cpu = evaluate(asset, view);
    for (std::size_t c = 0; c < gpu.rgba.size(); ++c)
        ASSERT_NEAR(gpu.rgba[c], cpu.rgba[c], bound) << "pixel " << c / 4 % 64 << ", " << c / 256;
}

TEST_F(Gl, PaperModeDrawsNothingOfNothing) {
    Renderer paper;
    Asset asset = layersOf(emptyAsset(), 1);
    const asset::View view{8, 8, {0.125, 0, 0, 0.125, 0, 0}};
    for (const std::uint32_t root : {noIndex, 0u}) {
        asset.root = root;
        for (const float channel : paper.render(Texture(asset), view).rgba)
            EXPECT_EQ(channel, 0);
    }
}

}  // namespace
}  // namespace vtm::paper
