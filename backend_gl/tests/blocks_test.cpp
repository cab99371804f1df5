// Pictures are drawn in upright blocks of pixels, wherever they and their tiles lie.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <set>
#include <string_view>
#include <utility>

#include <glm/glm.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/svg/load.hpp>
#include "backend_gl/tests/output_support.hpp"
#include "backend_gl/tiles/atlas.hpp"
#include "backend_gl/tiles/block_grid.hpp"
#include "backend_gl/tiles/block_shape.hpp"
#include "backend_gl/tiles/blocks.hpp"
#include "backend_gl/tiles/picture.hpp"
#include "backend_gl/upload/upload.hpp"

namespace vtm::gl {
namespace {

using glm::dvec2;

/// A picture that is filled up to its borders.
Asset wholeSquare() {
    scene::Scene scene;
    scene.width = scene.height = 64;
    scene::Item item;
    item.path = std::make_shared<scene::Path>(scene::Path{scene::MoveTo{{0, 0}}, scene::LineTo{{64, 0}},
                                                          scene::LineTo{{64, 64}}, scene::LineTo{{0, 64}},
                                                          scene::Close{}});
    item.paint = scene::Color{1, 0, 0, 1};
    scene.root.children.push_back({item});
    return compiler::compile(scene).asset;
}

/// Blocks of any size that tiles allow, turned and slanted.
glm::dmat2 anyPixels(std::mt19937& random) {
    std::uniform_real_distribution<double> angle(0, 6.3), part(0.2, 1);
    const double a = angle(random), b = angle(random), largest = tileMargin();
    const dvec2 x = part(random) * largest * dvec2(std::cos(a), std::sin(a)),
                y = part(random) * largest * dvec2(std::cos(b), std::sin(b));
    const double radius = 0.5 * std::max(glm::length(x + y), glm::length(x - y));
    return std::min(1.0, largest / radius) * glm::dmat2(x, y);
}

TEST(BlockShape, HoldsTheCellsOfAllPixelCentres) {
    std::mt19937 random(1);
    std::size_t found = 0, needed = 0;
    for (int round = 0; round < 2000; ++round) {
        const glm::dmat2 toTile = anyPixels(random);
        const int blockSide = blockSideFor(toTile);
        BlockShape shape(toTile, blockSide);
        std::uniform_real_distribution<double> offset(0, cellsPerTile);
        const dvec2 middle = shape.half() + dvec2(offset(random), offset(random));
        const BlockShape::Place place = shape.placeOf(middle);
        std::set<std::pair<int, int>> cells, centres;
        for (int i = 0; i < BlockShape::maxRows; ++i)
            for (int column = 0; column < cellsPerWindow; ++column)
                if ((place.columnsOf(std::size_t(i)) >> column & 1) != 0)
                    cells.emplace(column, place.firstRow + i);
        for (int y = 0; y < blockSide; ++y)
            for (int x = 0; x < blockSide; ++x) {
                const dvec2 at =
                    middle + double(cellsPerTile) * (toTile * (dvec2(x, y) + 0.5 - 0.5 * blockSide));
                const std::pair<int, int> cell(int(std::floor(at.x)), int(std::floor(at.y)));
                ASSERT_TRUE(cells.contains(cell)) << round;
                ASSERT_LT(std::max(cell.first, cell.second), cellsPerWindow) << round;
                centres.insert(cell);
            }
        found += cells.size();
        needed += centres.size();
    }
    // Nor many others: a round of quarters of cells, and those between centres.
    EXPECT_LT(double(found), 1.35 * double(needed));
}

/// Rows of a window's cells, each a bit, are met exactly where the block's own cells are.
TEST(BlockShape, MeetsEachOfItsCells) {
    std::mt19937 random(2);
    for (int round = 0; round < 200; ++round) {
        const glm::dmat2 toTile = anyPixels(random);
        BlockShape shape(toTile, blockSideFor(toTile));
        std::uniform_real_distribution<double> offset(0, cellsPerTile);
        const BlockShape::Place place = shape.placeOf(shape.half() + dvec2(offset(random), offset(random)));
        for (std::size_t row = 0; row < BlockShape::maxRows; ++row)
            for (unsigned column = 0; column < cellsPerWindow; ++column) {
                std::array<std::uint32_t, BlockShape::maxRows> cells{};
                cells[row] = 1u << column;
                ASSERT_EQ(place.meets(cells.data()), (place.columnsOf(row) >> column & 1) != 0);
            }
    }
}

/// The largest of which the centres never meet three tiles.
TEST(Blocks, AreAsLargeAsTilesAllow) {
    const auto upright = [](double tile) { return glm::dmat2(1 / tile, 0, 0, 1 / tile); };
    const glm::dmat2 turned(std::sqrt(0.5), std::sqrt(0.5), -std::sqrt(0.5), std::sqrt(0.5));
    EXPECT_EQ(blockSideFor(upright(64)), 32);
    EXPECT_EQ(blockSideFor(upright(32)), 32);
    EXPECT_EQ(blockSideFor(turned * upright(45)), 32);
    EXPECT_EQ(blockSideFor(turned * upright(43)), 24);
    EXPECT_EQ(blockSideFor(turned * upright(32)), 16);
    std::mt19937 random(3);
    for (int round = 0; round < 1000; ++round) {
        const glm::dmat2 toTile = anyPixels(random);
        const dvec2 pixel = glm::abs(toTile[0]) + glm::abs(toTile[1]);
        const int blockSide = blockSideFor(toTile);
        EXPECT_LE((blockSide - 1) * std::max(pixel.x, pixel.y), 1);
        EXPECT_TRUE(blockSide == maxBlockSide || (blockSide + 7) * std::max(pixel.x, pixel.y) > 0.99);
    }
}

/// They hold all of a view, and GL draws no others.
TEST(Blocks, HaveTheirMiddlesInTheView) {
    for (const int blockSide : {16, 24, 32})
        for (int width = 1; width < 200; ++width) {
            const BlockGrid grid = BlockGrid::of({width, 77}, blockSide);
            const int first = grid.cornerAt({0, 0}).x, last = grid.cornerAt({width - 1, 0}).x;
            EXPECT_LE(first, 0);
            EXPECT_GE(first + blockSide / 2, 0);
            EXPECT_GE(last + blockSide, width);
            EXPECT_LE(last + blockSide / 2, width);
            EXPECT_EQ((last - first) % blockSide, 0);
            EXPECT_EQ(grid.columnsOf({{0, 0}, {width, 77}}), (last - first) / blockSide + 1);
        }
}

TEST(ScannedBlocks, StandInRowsAsLongAsTheBoxes) {
    for (const int blockSide : {16, 24, 32}) {
        const BlockGrid grid{blockSide, {0, 0}};
        const PixelBox box{{blockSide + 4, 3}, {blockSide + 4 + 5 * blockSide, 40}};  // touches six blocks
        EXPECT_EQ(scannedPlace(0, box, grid), glm::ivec2(0, 0));
        EXPECT_EQ(scannedPlace(5, box, grid), blockSide * glm::ivec2(5, 0));
        EXPECT_EQ(scannedPlace(6, box, grid), blockSide * glm::ivec2(0, 1));
        EXPECT_EQ(scannedPlace(15, box, grid), blockSide * glm::ivec2(3, 2));
    }
}

/// Those of a few blocks join the simplest that serves; what none serves stays.
TEST(BlockGroups, OfFewBlocksAreDrawnWithOthers) {
    using Kind = BlockWork::Kind;
    const auto group = [](const BlockWork& work, std::size_t count) {
        return BlockGroup{work, std::vector<BlockVertex>(count)};
    };
    const auto countOf = [](const Blocks& blocks, const BlockWork& work) {
        const auto found = std::ranges::find(blocks.groups, work, &BlockGroup::work);
        return found == blocks.groups.end() ? 0 : found->vertices.size();
    };
    const BlockWork solid, twoColors{.hasTwoColors = true}, plain{.kind = Kind::Plain},
        bent{.kind = Kind::Plain, .points = 1}, one{.kind = Kind::OnePlain},
        crowded{.kind = Kind::Plain, .crowded = true}, programs{.kind = Kind::Programs};
    Blocks blocks;
    for (const auto& [work, count] : {std::pair(twoColors, 3),
                                      {plain, 5},
                                      {solid, 50},
                                      {bent, 40},
                                      {one, 7},
                                      {crowded, 2},
                                      {programs, 9}})
        blocks.groups.push_back(group(work, std::size_t(count)));
    const Blocks all = merged(blocks, 1), some = merged(blocks, 10);
    EXPECT_EQ(all.groups.size(), blocks.groups.size());
    EXPECT_EQ(countOf(some, solid), 53);
    EXPECT_EQ(countOf(some, bent), 52);  // with plain ones and those of one paint
    EXPECT_EQ(countOf(some, crowded), 2);
    EXPECT_EQ(countOf(some, programs), 9);
    EXPECT_EQ(some.groups.size(), 4);
    // Neither what has to be run nor crowded blocks serve the other.
    EXPECT_EQ(merged(blocks, 1000).groups.size(), 2);
}

/// Blocks that the picture's borders cut, also in their middles, are drawn, each pixel once.
TEST_F(Gl, PicturesHaveAnySizeAndPlace) {
    for (const Asset& asset : assets()) {
        const Texture texture = renderer->upload(asset);
        for (const auto& [width, height] :
             {std::pair{1, 1}, {3, 17}, {8, 8}, {9, 40}, {16, 7}, {23, 24}, {33, 15}, {40, 49}, {100, 5}})
            for (const double angle : {0.0, 0.7, 2.6}) {
                const View view = turnedView(width, height, {32, 32}, 0.7, angle);
                const image::Raster expected = renderer->render(texture, view);
                EXPECT_LE(worst(expected, asset::evaluate(asset, view), identity), 2 * byteStep)
                    << width << ' ' << height;
                for (const int offset : {0, 5, 11}) {
                    const UserFramebuffer target(GL_RGBA16F, width + offset, height + offset,
                                                 {0.5f, 0, 0.25f, 0.75f});
                    Output output;
                    output.write = Output::Write::Over;
                    output.x = output.y = offset;
                    renderer->draw(texture, view, output);
                    const image::Raster drawn = target.floats();
                    for (int y = 0; y < height; ++y)
                        for (int x = 0; x < width; ++x) {
                            const Color c = pixelOf(expected, x, y),
                                        got = pixelOf(drawn, x + offset, y + offset),
                                        ground{0.5, 0, 0.25, 0.75};
                            for (std::size_t i = 0; i < 4; ++i)
                                ASSERT_NEAR(got[i], c[i] + (1 - c[3]) * ground[i], 0x1p-9)
                                    << width << ' ' << height << ' ' << offset;
                        }
                }
            }
    }
}

/// Small triangles all over the picture, of so many colours.
Asset confetti(int triangles, int colors) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-2, 66), offset(-3, 3);
    scene::Scene scene;
    scene.width = scene.height = 64;
    for (int i = 0; i < triangles; ++i) {
        const scene::Point middle{place(random), place(random)};
        const auto corner = [&] { return middle + scene::Point(offset(random), offset(random)); };
        scene::Item item;
        item.path = std::make_shared<scene::Path>(scene::Path{
            scene::MoveTo{corner()}, scene::LineTo{corner()}, scene::LineTo{corner()}, scene::Close{}});
        item.paint = scene::Color{float(i % colors) / float(colors), 0.5f, 1, 1};
        scene.root.children.push_back({item});
    }
    return compiler::compile(scene).asset;
}

/// Gradients that are plain, steep ones and such with jumps beside each other.
Asset gradients() {
    constexpr std::string_view text = R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="64" height="64">
        <linearGradient id="a"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>
        <radialGradient id="b"><stop stop-color="white"/><stop offset=".5" stop-color="green"/>
            <stop offset=".5" stop-color="black"/><stop offset="1" stop-color="white"/></radialGradient>
        <linearGradient id="c" spreadMethod="reflect" x2=".1" y2=".1"><stop stop-color="yellow"/>
            <stop offset="1" stop-color="black"/></linearGradient>
        <rect width="64" height="40" fill="url(#a)"/><circle cx="40" cy="40" r="20" fill="url(#b)"/>
        <path d="M2 30l20 3-7 30z" fill="url(#c)"/><path d="M50 5l3 40 2-40 3 40 2-40z" fill="gold"/></svg>)svg";
    return compiler::compile(
               svg::load({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}).scene)
        .asset;
}

/// In blocks of up to so many pixels a side, in groups of as few as that.
image::Raster drawnInBlocks(int largest, std::size_t fewest, UploadedAsset& asset, Programs& programs,
                            const View& view) {
    const UserFramebuffer target(GL_RGBA32F, view.width, view.height);
    glViewport(0, 0, view.width, view.height);
    glDisable(GL_BLEND);
    PictureBuffers buffers;
    buffers.costs = {largest, fewest};
    drawPicture(programs, buffers, asset, view, {{0, 0}, {view.width, view.height}}, {}, true);
    return target.floats();
}

constexpr int blockSides[] = {minBlockSide, minBlockSide + blockSideStep, maxBlockSide};

/// With cells that are drawn, that are scanned, and some of either.
TEST_F(Gl, BlocksOfAnySizeShowThePicture) {
    Programs programs;
    for (const Asset& asset : {disc(), confetti(300, 7), gradients()})
        for (const std::uint32_t maxTurns : {0u, 2u, turnsPerPixel}) {
            UploadedAsset uploaded(asset, 0, maxTurns);
            for (const auto& [width, height] : {std::pair{3, 17}, {100, 97}, {131, 61}})
                for (const double angle : {0.0, 0.3, 0.8})
                    for (const double pixels : {0.3, 1.0, 1.4, 1.9}) {
                        const View view = turnedView(width, height, {30, 32}, pixels, angle);
                        const image::Raster expected = asset::evaluate(asset, view);
                        for (const int largest : blockSides)
                            for (const std::size_t fewest : {1, 1000})
                                EXPECT_LE(worst(drawnInBlocks(largest, fewest, uploaded, programs, view),
                                                expected, identity),
                                          2 * byteStep)
                                    << width << ' ' << angle << ' ' << pixels << ' ' << largest << ' '
                                    << fewest << ' ' << maxTurns;
                    }
        }
}

/// A block may be as wide as a tile, whose border stands in the tile beside the picture, too: pixels of the
/// next one have none.
TEST_F(Gl, NothingIsDrawnBesideSmallPictures) {
    Programs programs;
    UploadedAsset uploaded(wholeSquare(), 0);
    for (double zoom = 0.5; zoom < 1; zoom *= 1.03)
        for (const double angle : {0.0, 0.3, 0.785})
            for (const double offset : {0.0, 0.5}) {
                View view = turnedView(250, 250, {32, 32}, zoom, angle);
                view.toPixels[2] += offset;
                const glm::dmat2 toPicture = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
                for (const int largest : blockSides) {
                    const image::Raster drawn = drawnInBlocks(largest, 1, uploaded, programs, view);
                    for (int y = 0; y < view.height; ++y)
                        for (int x = 0; x < view.width; ++x) {
                            const dvec2 at = toPicture * (dvec2(x, y) + 0.5 - view.toPixels[2]),
                                        off = glm::abs(at - 32.0) - 32.0;
                            const bool isBeside = std::max(off.x, off.y) > 1 / zoom;
                            ASSERT_TRUE(!isBeside || drawn.pixel(x, y)[3] == 0)
                                << x << ' ' << y << ' ' << zoom << ' ' << angle << ' ' << largest;
                        }
                }
            }
}

/// Where cells have many pieces two of them are met at a time: even and odd numbers, of two colours and of
/// several.
TEST_F(Gl, LongListsAreExact) {
    for (const int triangles : {30, 300, 900})
        for (const int colors : {1, 7}) {
            const Asset asset = confetti(triangles, colors);
            const Texture texture = renderer->upload(asset);
            for (const double angle : {0.0, 0.5, 1.9}) {
                const View view = turnedView(70, 61, {32, 32}, 0.9, angle);
                EXPECT_LE(worst(renderer->render(texture, view), asset::evaluate(asset, view), identity),
                          2 * byteStep)
                    << triangles << ' ' << colors;
            }
        }
}

}  // namespace
}  // namespace vtm::gl
