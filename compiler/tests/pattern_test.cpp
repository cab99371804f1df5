// Patterns of many tiles, and of many tiles in tiles.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::Color;
using scene::Group;
using scene::Item;
using scene::Path;
using scene::Pattern;
using scene::Point;

constexpr double side = 256;
constexpr Color red{1, 0, 0, 1};

Item filled(Path path, scene::Paint paint) {
    Item item;
    item.path = std::make_shared<const Path>(std::move(path));
    item.geometry = scene::FillRule::NonZero;
    item.paint = std::move(paint);
    return item;
}

/// Its left half filled.
Pattern stripes(double tile, scene::Paint paint = red) {
    Group content;
    content.children.push_back({filled(scene::rectangle({0, 0}, {tile / 2, tile}), std::move(paint))});
    return {{0, 0}, {tile, tile}, std::make_shared<const Group>(std::move(content))};
}

scene::Scene picture(std::vector<Item> items) {
    scene::Scene scene;
    scene.width = scene.height = side;
    for (Item& item : items)
        scene.root.children.push_back({std::move(item)});
    return scene;
}

/// So many small triangles over the picture.
Path triangles(int perSide) {
    Path path;
    const double step = side / perSide;
    for (int i = 0; i < perSide * perSide; ++i) {
        const Point at = step * Point(i % perSide, i / perSide);
        path.insert(path.end(), {scene::MoveTo{at}, scene::LineTo{at + step * Point(0.9, 0.1)},
                                 scene::LineTo{at + step * Point(0.3, 0.9)}, scene::Close{}});
    }
    return path;
}

Result compiled(const scene::Scene& scene, asset::Mode mode = asset::Mode::Exact) {
    Options options;
    options.mode = mode;
    Result result = compile(scene, options);
    asset::validate(result.asset);
    return result;
}

image::Raster drawn(const Result& result, int pixels) {
    return asset::evaluate(result.asset, {pixels, pixels});
}

double mean(const image::Raster& raster) {
    double sum = 0;
    for (int y = 0; y < raster.height; ++y)
        for (int x = 0; x < raster.width; ++x)
            sum += double(raster.pixel(x, y)[3]);
    return sum / (double(raster.width) * raster.height);
}

void expectAnImage(const Result& result) {
    EXPECT_EQ(result.asset.images.size(), 1u);
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_NE(result.warnings[0].find("is drawn as an image"), std::string::npos) << result.warnings[0];
}

void expectExact(const Result& result) {
    EXPECT_EQ(result.asset.images.size(), 0u);
    EXPECT_EQ(result.warnings.size(), 0u);
}

TEST(ManyTiles, CutByOutlinesAreAnImage) {
    const scene::Scene scene = picture({filled(triangles(100), stripes(1))});
    const Result result = compiled(scene);
    expectAnImage(result);
    const Result solid = compiled(picture({filled(triangles(100), red)}));
    EXPECT_NEAR(mean(drawn(result, 256)), mean(drawn(solid, 256)) / 2, 1e-3);
}

TEST(ManyTiles, FarBelowAPixelAreTheirMean) {
    for (const double tile : {1e-7, 1e-20}) {
        const Result result =
            compiled(picture({filled(scene::rectangle({0, 0}, {side, side}), stripes(tile))}));
        expectAnImage(result);
        const image::Raster raster = drawn(result, 64);
        for (const auto& [x, y] : {std::pair(0, 0), std::pair(31, 17), std::pair(63, 63)})
            EXPECT_NEAR(raster.pixel(x, y)[0], 0.5, 1.0 / 255) << tile;
    }
}

/// Shapes that reach across tiles are one outline in all of them, different in each fill.
TEST(Tiles, OfManyFillsAreNotTakenForEachOther) {
    Pattern pattern = stripes(10);
    Group content = *pattern.content;
    Path star{scene::MoveTo{{0, 5}}};
    for (int i = 0; i < 40; ++i)
        star.push_back(
            scene::LineTo{5.0 + (i % 2 == 0 ? 4.9 : 2) * Point(std::cos(i / 6.0), std::sin(i / 6.0))});
    star.push_back(scene::LineTo{{10, 5}});
    content.children.push_back({filled(std::move(star), Color{0, 0, 1, 1})});
    pattern.content = std::make_shared<const Group>(std::move(content));
    std::vector<Item> fills;
    for (int i = 0; i < 30; ++i) {
        const Point at(4 + i % 6 * 42, 4 + i / 6 * 50);
        fills.push_back(filled(scene::rectangle(at, at + Point(30 + i % 3, 37)), pattern));
    }
    const scene::Scene scene = picture(std::move(fills));
    Options options;
    options.instances = false;
    const image::Raster with = drawn(compiled(scene), 256), without = drawn(compile(scene, options), 256);
    for (std::size_t i = 0; i < with.rgba.size(); ++i)
        ASSERT_NEAR(with.rgba[i], without.rgba[i], 1.5 / 255) << i;
    double expected = 0;
    for (int i = 0; i < 30; ++i)
        expected += (30 + i % 3) * 37 / (side * side);
    EXPECT_GE(mean(with), expected / 2);
    EXPECT_LE(mean(with), expected);
}

TEST(ManyTiles, TooFarFromTheirOriginAreLeftOut) {
    Pattern pattern = stripes(10);
    pattern.transform = scene::translation(1e300, 0);
    const Result result = compiled(picture({filled(scene::rectangle({0, 0}, {side, side}), pattern)}));
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_NE(result.warnings[0].find("too far from its origin; it is left out"), std::string::npos);
    EXPECT_EQ(mean(drawn(result, 16)), 0);
}

TEST(ManyTiles, StandWhereTheirTilesStand) {
    Pattern pattern = stripes(10);
    const double angle = 0.4;
    pattern.transform = {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 3, 5};
    const Item square = filled(scene::rectangle({20, 30}, {240, 220}), pattern);
    expectExact(compiled(picture({square})));
    expectExact(compiled(picture({square}), asset::Mode::Compat));  // tile by tile
    pattern.transform = scene::compose(pattern.transform, scene::scaling(0.6, 0.6));
    const Item many = filled(scene::rectangle({20, 30}, {240, 220}), pattern);
    const Result expected = compiled(picture({many})),
                 asImage = compiled(picture({many}), asset::Mode::Compat);
    expectExact(expected);
    expectAnImage(asImage);
    const image::Raster a = drawn(expected, 512), b = drawn(asImage, 512);
    double squares = 0;
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x)
            squares += std::pow(double(a.pixel(x, y)[3] - b.pixel(x, y)[3]), 2);
    // Of edges that are softer; half a pixel aside it would be 52/255.
    EXPECT_LE(std::sqrt(squares) / 512, 12.0 / 255);
}

/// Tiles beyond the picture's corners are not counted.
TEST(ManyTiles, TurnedInADiscAreExact) {
    Pattern pattern = stripes(0.5);
    const double angle = 0.3;
    pattern.transform = {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 0, 0};
    Path disc{scene::MoveTo{{side, side / 2}}};
    for (int i = 1; i < 64; ++i) {
        const double at = 2 * std::numbers::pi * i / 64;
        disc.push_back(scene::LineTo{side / 2 * (Point(1) + Point(std::cos(at), std::sin(at)))});
    }
    disc.push_back(scene::Close{});
    expectExact(compiled(picture({filled(disc, pattern)})));
}

TEST(ManyTiles, InTilesAreExactWhereEitherCanBePlaced) {
    // 16 tiles of 16 of 256; 4 tiles of 65 536.
    const Pattern three = stripes(64, stripes(8, stripes(0.5)));
    const Pattern few = stripes(128, stripes(0.25));
    for (const Pattern& pattern : {three, few}) {
        const Result result = compiled(picture({filled(scene::rectangle({0, 0}, {side, side}), pattern)}));
        expectExact(result);
        EXPECT_NEAR(mean(drawn(result, 256)), pattern.max.x == 64 ? 0.125 : 0.25, 1e-3);
    }
}

TEST(ManyTiles, InManyTilesAreImages) {
    const Pattern pattern = stripes(2, stripes(0.002));
    const Result result = compiled(picture({filled(scene::rectangle({0, 0}, {side, side}), pattern)}));
    expectAnImage(result);
    EXPECT_NEAR(mean(drawn(result, 256)), 0.25, 2e-3);
}

/// Each pattern is in the next, twice.
TEST(ManyTiles, NestedDeepEnd) {
    Pattern pattern = stripes(0.01);
    for (int depth = 0; depth < 12; ++depth) {
        const double tile = 2 * pattern.max.x;
        Group content;
        content.children.push_back({filled(scene::rectangle({0, 0}, {tile, tile / 2}), pattern)});
        content.children.push_back({filled(scene::rectangle({0, tile / 2}, {tile, tile}), pattern)});
        pattern = {{0, 0}, {tile, tile}, std::make_shared<const Group>(std::move(content))};
    }
    const Result result = compiled(picture({filled(scene::rectangle({0, 0}, {side, side}), pattern)}));
    EXPECT_NEAR(mean(drawn(result, 128)), 0.5, 4e-3);
}

/// All images together have a number of pixels: the more patterns, the coarser, but none is left out.
TEST(ManyTiles, OfManyPatternsAreCoarser) {
    constexpr int patterns = 32;
    constexpr double row = side / (2 * patterns);
    std::vector<Item> items;
    for (int i = 0; i < patterns; ++i) {
        Path rows;  // far apart, so that the image has half the picture
        for (const double top : {i * row, (i + patterns) * row})
            std::ranges::copy(scene::rectangle({0, top}, {side, top + row}), std::back_inserter(rows));
        items.push_back(filled(std::move(rows), stripes(0.5 + 0.01 * i)));
    }
    const Result result = compiled(picture(std::move(items)), asset::Mode::Compat);
    EXPECT_EQ(result.asset.images.size(), std::size_t(patterns));
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_NE(result.warnings[0].find("is drawn as an image"), std::string::npos) << result.warnings[0];
    EXPECT_NEAR(mean(drawn(result, 64)), 0.5, 0.01);
}

TEST(ManyTiles, FillsShareTheirImage) {
    const Pattern pattern = stripes(0.5);
    std::vector<Item> items;
    for (int i = 0; i < 100; ++i)
        items.push_back(filled(
            scene::rectangle(Point(i % 10, i / 10) * 25.0, Point(i % 10, i / 10) * 25.0 + 24.0), pattern));
    const Result result = compiled(picture(std::move(items)), asset::Mode::Compat);
    EXPECT_LE(result.asset.images.size(), 2u);
    EXPECT_NEAR(mean(drawn(result, 256)), 0.5 * 2400 * 24 / (side * side), 3e-3);
}

}  // namespace
}  // namespace vtm::compiler
