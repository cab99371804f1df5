#include <vtm/raster/prefilter.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include <vtm/raster/evaluate.hpp>
#include "asset/testing.hpp"
#include "raster/testing_prefilter.hpp"

namespace vtm::asset::test {
namespace {

using glm::mat2;
using glm::vec2;
using glm::vec4;

/// Half a step of rounding, and what single precision adds.
constexpr double texelTolerance = 0.5 + 0.02;

/// The whole picture on a raster of a level's size.
image::Raster wholePicture(const Asset& asset, PyramidSize size) {
    return evaluate(asset, {int(size.width), int(size.height),
                            glm::dmat3x2(size.width / asset.width, 0, 0, size.height / asset.height, 0, 0)});
}

Asset withPrefilter(Asset asset, PyramidSize size) {
    asset.prefilter = buildPrefilter(asset, size);
    return asset;
}

// ---- Sizes ----------------------------------------------------------------------------------------

TEST(Pyramid, LevelsAreMadeOfWholeTexels) {
    for (std::uint32_t width = 1; width <= 192; ++width)
        for (std::uint32_t height = 1; height <= 192; ++height) {
            if (!isPyramidSide(width) || !isPyramidSide(height))
                continue;
            const PyramidSize size{width, height};
            EXPECT_EQ(size.level(size.levels() - 1), (PyramidSize{1, 1}));
            for (unsigned l = 1; l < size.levels(); ++l) {
                EXPECT_EQ(size.level(l - 1).width % size.level(l).width, 0u) << width;
                EXPECT_EQ(size.level(l - 1).height % size.level(l).height, 0u) << height;
            }
        }
}

TEST(Pyramid, AllowedSides) {
    std::vector<std::uint32_t> sides;
    for (std::uint32_t side = 0; side <= 2 * maxPyramidSide; ++side)
        if (isPyramidSide(side))
            sides.push_back(side);
    EXPECT_EQ(sides,
              (std::vector<std::uint32_t>{1,  2,   3,   4,   6,   8,   12,  16,   24,   32,   48,   64,
                                          96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096}));
}

/// A grid of 4^levels × 4^levels leaves, each half red and half green.
Asset manyLeaves(unsigned levels) {
    Asset asset = halfPlane();
    Entry below = asset.maps[0].root;
    for (unsigned l = levels; l-- > 0;) {
        Node node;
        node.children.fill(below);
        asset.nodes.insert(asset.nodes.begin(), node);
        below = Entry::make(Entry::Kind::Node, l);
    }
    for (std::uint32_t i = 0; i + 1 < levels; ++i)
        asset.nodes[i].children.fill(Entry::make(Entry::Kind::Node, i + 1));
    asset.maps[0].root = below;
    return asset;
}

TEST(PrefilterSize, FollowsTheTree) {
    EXPECT_EQ(prefilterSize(emptyAsset()), (PyramidSize{1, 1}));
    EXPECT_EQ(prefilterSize(halfPlane()), (PyramidSize{1, 1}));
    EXPECT_LE(prefilterSize(twoLevels()).width, 16u);
    // 64 × 64 leaves: a footprint as large as a leaf meets 2 × 2 of them, which is too many, one that is 3/4
    // as large fewer. A base texel is half of the former.
    EXPECT_EQ(prefilterSize(manyLeaves(3)), (PyramidSize{128, 128}));
    EXPECT_EQ(prefilterSize(manyLeaves(4)), (PyramidSize{512, 512}));
    EXPECT_EQ(prefilterSize(manyLeaves(5)), (PyramidSize{512, 512}));
}

/// One leaf with an edge of so many pieces: no footprint meets more squares.
Asset manyPieces(int count, Asset asset = emptyAsset()) {
    std::vector<Piece> pieces;
    const auto at = [&](int i) { return std::uint16_t(65535 * i / count); };
    for (int i = 0; i < count; ++i)
        pieces.push_back(line({30001, at(i)}, {30001, at(i + 1)}, 1, 2));
    asset.maps[0].root = addLeaf(asset, {1, 2, 2, 1}, pieces);
    return asset;
}

TEST(PrefilterSize, IsFinerWhereThatSavesTimeAndBytesAllowIt) {
    const Asset asset = manyPieces(100);
    EXPECT_EQ(prefilterSize(manyPieces(3)), (PyramidSize{1, 1}));
    EXPECT_EQ(prefilterSize(asset, {.timesTree = 0}), (PyramidSize{1, 1}));
    for (const double times : {2.0, 6.0, 12.0, 20.0}) {
        const PyramidSize size = prefilterSize(asset, {.timesTree = times});
        const double bytes = double(size.texelsBefore(size.levels()) * sizeof(Rgba8)),
                     most = times * double(summarize(asset).bytes);
        EXPECT_LE(bytes, most);
        EXPECT_GT(bytes, most / 3);  // allowed sides are a third or a half apart
    }
    EXPECT_EQ(prefilterSize(asset, {.timesTree = 1e9}).width, 384u);
    EXPECT_THROW(prefilterSize(asset, {.timesTree = NAN}), std::invalid_argument);
}

/// A mean over more than an image's pixel is not what drawing shows, and of a material we know nothing.
TEST(PrefilterSize, IsNoFinerThanImagesAndMaterialsWant) {
    Asset asset = manyPieces(100);
    ASSERT_GT(prefilterSize(asset).width, 8u);
    asset.materials.push_back({"grain", "vec4 grain(vec2 p) { return vec4(1.0); }"});
    EXPECT_EQ(prefilterSize(asset), (PyramidSize{1, 1}));
    std::vector<Texel> data;
    addImage(data, {{0.1f, 0, 0, 0.1f, 0, 0}, 0, ImageFilter::Bilinear});
    EXPECT_LE(prefilterSize(manyPieces(100, programAsset({{Op::Image, Blend::Normal, 1, 0}}, data))).width,
              8u);
}

TEST(PrefilterSize, FollowsTheOptions) {
    PrefilterOptions options;
    options.largestSide = 100;
    EXPECT_EQ(prefilterSize(manyLeaves(4), options), (PyramidSize{96, 96}));
    options.squaresPerFootprint = 1000;
    EXPECT_LT(prefilterSize(manyLeaves(4), options).width, 48u);
    options.largestSide = 0;
    EXPECT_THROW(prefilterSize(disc(), options), std::invalid_argument);
    options.largestSide = maxPyramidSide + 1;
    EXPECT_THROW(prefilterSize(disc(), options), std::invalid_argument);
    options = {};
    options.squaresPerFootprint = NAN;
    EXPECT_THROW(prefilterSize(disc(), options), std::invalid_argument);
}

TEST(PrefilterSize, TexelsAreNearlySquare) {
    Asset asset = manyLeaves(4);
    for (const double ratio : {0.001, 0.1, 0.3, 0.4, 0.61, 0.75, 0.9, 1.0}) {
        asset.width = mapSide;
        asset.height = mapSide * ratio;
        const PyramidSize wide = prefilterSize(asset);
        std::swap(asset.width, asset.height);
        const PyramidSize high = prefilterSize(asset);
        EXPECT_EQ(wide, (PyramidSize{high.height, high.width}));
        if (wide.width * ratio >= 1) {
            EXPECT_LE(std::abs(std::log2(wide.height / (wide.width * ratio))), 0.5 * std::log2(1.5) + 1e-9);
        }
    }
}

/// A bilinear image fill skips pixels once a footprint is larger than two of them, a trilinear one blurs
/// oblong ones.
TEST(PrefilterSize, FollowsImages) {
    const auto asset = [](float pixelsPerUnit) {
        std::vector<Texel> data;
        addImage(data, {{pixelsPerUnit, 0, 0, pixelsPerUnit, 0, 0}, 0, ImageFilter::Bilinear});
        return programAsset({{Op::Image, Blend::Normal, 1, 0}}, data);
    };
    EXPECT_EQ(prefilterSize(asset(2)).width, 128u);  // 2 pixels a unit, 64 units
    EXPECT_EQ(prefilterSize(asset(100)).width, 512u);
    EXPECT_LE(prefilterSize(asset(0.1f)).width, 8u);
}

// ---- Building -------------------------------------------------------------------------------------

TEST(Prefilter, EveryTexelOfEveryLevelIsTheMeanOverIt) {
    for (const Asset& plain : {halfPlane(), wedge(), strip(), threeRegions(), twoLevels(), manyLeaves(2)})
        for (const std::uint32_t side : {32u, 48u}) {
            const Asset asset = withPrefilter(plain, {side, side});
            for (unsigned l = 0; l < asset.prefilter.size.levels(); ++l) {
                const PyramidSize size = asset.prefilter.size.level(l);
                const image::Raster exact = wholePicture(asset, size);
                const Rgba8* texel = &asset.prefilter.texels[asset.prefilter.size.texelsBefore(l)];
                for (std::size_t i = 0; i < exact.rgba.size(); ++i)
                    ASSERT_NEAR(texel[i / 4][i % 4], exact.rgba[i] * 255.0, texelTolerance) << "level " << l;
            }
        }
}

/// Paints that vary within a texel are looked at on a grid four times finer; in compat mode too. Engines
/// differ by up to 1.5 in one of the finer pixels, where an edge cuts a steep paint (Scan.EveryBlendMode).
TEST(Prefilter, GradientsImagesAndGroupsAreAveraged) {
    constexpr double cut = 1.5 / 16;
    for (const Asset& plain : {everyPaint(), layers()}) {
        const Asset asset = withPrefilter(plain, {16, 16});
        const image::Raster fine = wholePicture(asset, {64, 64});
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                for (int c = 0; c < 4; ++c) {
                    double mean = 0;
                    for (int i = 0; i < 16; ++i)
                        mean += fine.pixel(x * 4 + i % 4, y * 4 + i / 4)[c] / 16;
                    ASSERT_NEAR(asset.prefilter.texels[std::size_t(y * 16 + x)][std::size_t(c)], mean * 255,
                                texelTolerance + cut);
                }
    }
}

TEST(Prefilter, DoesNotDependOnThreads) {
    const PyramidSize size{256, 192};
    for (const Asset& asset : {everyPaint(), layers(), disc(), placedMaps()}) {
        const Prefilter one = buildPrefilter(asset, size, 1);
        EXPECT_EQ(buildPrefilter(asset, size, 5).texels, one.texels);
        EXPECT_EQ(buildPrefilter(asset, size).texels, one.texels);
    }
}

TEST(Pyramid, RefusesWhatItCannotBe) {
    EXPECT_THROW(buildPrefilter(disc(), PyramidSize{4, 7}), std::invalid_argument);
    EXPECT_THROW(buildPrefilter(disc(), PyramidSize{8192, 1}), std::invalid_argument);
    EXPECT_THROW(buildPrefilter(disc(), PyramidSize{5, 4}), std::invalid_argument);
    EXPECT_THROW(buildPrefilter(disc(), PyramidSize{0, 0}), std::invalid_argument);
}

// ---- Sampling -------------------------------------------------------------------------------------

constexpr std::array filters{Minification::Trilinear, Minification::Taps2, Minification::Taps4};

TEST(SamplePrefilter, AFlatPictureIsFlatUnderEveryFootprint) {
    Asset asset = manyLeaves(2);
    for (Paint& paint : asset.paints)
        paint = solid({0.2f, 0.4f, 0, 0.8f});
    asset = withPrefilter(asset, {64, 64});
    for (const Minification filter : filters)
        for (const Wrap wrap : {Wrap::Clamp, Wrap::Repeat, Wrap::Mirror})
            for (const float size : {0.0f, 0.001f, 0.03f, 0.2f, 1.0f, 30.0f}) {
                const vec4 color = samplePrefilter(asset, {0.3f, -0.8f},
                                                   mat2(size, 0.1f * size, -size, 2 * size), filter, wrap);
                EXPECT_NEAR(color.r, 0.2, 1e-5);
                EXPECT_NEAR(color.g, 0.4, 1e-5);
                EXPECT_NEAR(color.a, 0.8, 1e-5);
            }
}

TEST(SamplePrefilter, WrapsAsAsked) {
    const Asset asset = withPrefilter(halfPlane(), {64, 64});
    const mat2 texel(1.0f / 64);
    const vec4 inside = samplePrefilter(asset, {0.9f, 0.5f}, texel);
    EXPECT_NEAR(inside.g, 1, 1e-6);
    EXPECT_EQ(samplePrefilter(asset, {1.9f, 0.5f}, texel), vec4(0));
    EXPECT_EQ(samplePrefilter(asset, {1.9f, 0.5f}, texel, Minification::Taps4, Wrap::Clamp), inside);
    EXPECT_EQ(samplePrefilter(asset, {-0.1f, 3.5f}, texel, Minification::Taps4, Wrap::Repeat), inside);
    for (const vec2 st : {vec2(1.1f, 0.5f), vec2(-0.9f, -0.5f), vec2(2.9f, 1.5f)})
        EXPECT_EQ(samplePrefilter(asset, st, texel, Minification::Taps4, Wrap::Mirror), inside) << st.x;
    const vec4 border = samplePrefilter(asset, {1, 0.5f}, texel);
    EXPECT_NEAR(border.g, 0.5, 1e-6);
    EXPECT_NEAR(border.a, 0.5, 1e-6);
}

/// A picture of one column, a base texel wide.
Asset columnAt(std::uint32_t column) {
    Asset asset = emptyAsset();
    asset.prefilter.size = {256, 256};
    for (unsigned l = 0; l < asset.prefilter.size.levels(); ++l) {
        const PyramidSize size = asset.prefilter.size.level(l);
        for (std::size_t i = 0; i < size.texels(); ++i)
            asset.prefilter.texels.push_back(
                {0, 0, 0, std::uint8_t(i % size.width == column >> l ? 128 >> l : 0)});
    }
    return asset;
}

/// A column's response, averaged over where the column lies in the texels of the level that is used, has the
/// second moment that the spacing of the taps promises: (width² + h²) / 12 for a footprint of that width and
/// texels of h.
TEST(SamplePrefilter, TheFilterIsAsWideAsPromised) {
    for (const int taps : {2, 4})
        for (const float width : {4.0f, 8.0f, 16.0f}) {  // base texels
            double sum = 0, square = 0;
            for (std::uint32_t column = 120; column < 136; ++column) {
                const Asset asset = columnAt(column);
                for (double distance = -32; distance < 32; distance += 0.25) {
                    const double x = (column + 0.5 + distance) / 256;
                    const double a = samplePrefilter(asset, {float(x), 0.5f}, mat2(width / 256),
                                                     taps == 2 ? Minification::Taps2 : Minification::Taps4)
                                         .a;
                    sum += a;
                    square += a * distance * distance;
                }
            }
            // The column's own width takes 1 of width²: 1/32 of the smallest.
            EXPECT_NEAR(std::sqrt(12 * square / sum), std::hypot(width, width / float(taps)), width / 30)
                << taps;
        }
}

TEST(SamplePrefilter, WithoutPrefilterNothing) {
    EXPECT_EQ(samplePrefilter(disc(), {0.5f, 0.5f}, mat2(0.1f)), vec4(0));
    EXPECT_EQ(prefilterShare(disc(), mat2(100)), 0);
}

TEST(SamplePrefilter, TakesAnyNumbers) {
    const Asset asset = withPrefilter(disc(), {64, 64});
    const float wild[] = {NAN, INFINITY, -INFINITY, 1e38f, -1e38f, 1e-45f};
    for (const float a : wild)
        for (const Wrap wrap : {Wrap::Border, Wrap::Clamp, Wrap::Repeat, Wrap::Mirror}) {
            samplePrefilter(asset, {a, 0.5f}, mat2(0.1f), Minification::Taps4, wrap);
            samplePrefilter(asset, {0.5f, 0.5f}, mat2(a, 0, 0, 0.1f), Minification::Taps4, wrap);
            samplePrefilter(asset, {0.5f, 0.5f}, mat2(a), Minification::Taps2, wrap);
            prefilterShare(asset, mat2(a));
        }
}

TEST(PrefilterShare, RisesFromTheTreesFootprintsToTheFilters) {
    const Asset asset = withPrefilter(halfPlane(), {64, 64});
    EXPECT_EQ(prefilterShare(asset, mat2(1.0f / 64)), 0);
    EXPECT_EQ(prefilterShare(asset, mat2(fadeFrom / 64)), 0);
    EXPECT_NEAR(prefilterShare(asset, mat2(std::sqrt(fadeFrom * fadeTo) / 64)), 0.5, 1e-6);
    EXPECT_EQ(prefilterShare(asset, mat2(fadeTo / 64)), 1);
    EXPECT_EQ(prefilterShare(asset, mat2(100)), 1);
}

}  // namespace
}  // namespace vtm::asset::test
