// Covered rows as tiles: every pixel's share is kept, none is drawn twice, and they are few.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "api/openvg/gl/batch.hpp"
#include "api/openvg/gl/tiles.hpp"

namespace vtm::openvg::gl {
namespace {

/// Shares of pixels, and how many tiles have them.
struct Grid {
    int width, height;
    std::vector<float> shares;
    std::vector<int> tiles;

    Grid(int w, int h)
        : width(w),
          height(h),
          shares(std::size_t(w) * std::size_t(h), 0.0f),
          tiles(std::size_t(w) * std::size_t(h), 0) {}
    std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width) + std::size_t(x); }
};

Grid drawn(const Tiles& tiles, int width, int height) {
    Grid grid(width, height);
    for (const Tile& tile : tiles.tiles)
        for (int j = 0; j < tile.height; ++j)
            for (int i = 0; i < tile.width; ++i) {
                const std::size_t k = grid.at(tile.x + i, tile.y + j);
                ++grid.tiles[k];
                grid.shares[k] = tile.shares == Tile::allCovered
                                     ? 1
                                     : tiles.shares[tile.shares + std::size_t(j * tile.width + i)];
            }
    return grid;
}

TEST(Tiles, AFullRectangleIsOne) {
    TileBuilder builder;
    for (int y = 3; y < 203; ++y)
        builder.add(y, 5, 105, 1);
    const Tiles tiles = builder.finish();
    ASSERT_EQ(tiles.tiles.size(), 1u);
    EXPECT_TRUE(tiles.areAllCovered());
    EXPECT_EQ(tiles.tiles[0].x, 5);
    EXPECT_EQ(tiles.tiles[0].height, 200);
}

TEST(Tiles, AGlyphIsOneBlock) {
    TileBuilder builder;
    for (int y = 0; y < 12; ++y) {
        builder.add(y, 7, 8, 0.5f);
        builder.add(y, 12, 15, 0.25f);
    }
    const Tiles tiles = builder.finish();
    ASSERT_EQ(tiles.tiles.size(), 1u);
    EXPECT_EQ(tiles.shares.size(), 12u * 8u);
}

TEST(Tiles, AThinColumnIsOneBlock) {
    TileBuilder builder;
    for (int y = 0; y < 1000; ++y)
        builder.add(y, 40, 41, 0.5f);
    EXPECT_EQ(builder.finish().tiles.size(), 1u);
}

TEST(Tiles, NothingIsNone) {
    TileBuilder builder;
    EXPECT_TRUE(builder.finish().tiles.empty());
}

TEST(Tiles, KeepEveryShareOfRandomRows) {
    constexpr int width = 130, height = 90;
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        TileBuilder builder;
        Grid expected(width, height);
        for (int y = int(random() % 20); y < height; y += 1 + int(random() % 3 == 0))
            for (int x = int(random() % 60); x < width;) {
                const int end = std::min(width, x + 1 + int(random() % (random() % 2 ? 90 : 4)));
                const float share = random() % 2 ? 1 : float(1 + random() % 254) / 255;
                builder.add(y, x, end, share);
                for (; x < end; ++x)
                    expected.shares[expected.at(x, y)] = share;
                x += int(random() % 30);
            }
        const Grid grid = drawn(builder.finish(), width, height);
        EXPECT_EQ(grid.shares, expected.shares);
        EXPECT_LE(*std::ranges::max_element(grid.tiles), 1);
    }
}

TEST(Tiles, AreTheSameInParts) {
    TileBuilder builder;
    for (int y = 0; y < 200; ++y) {
        builder.add(y, 0, 100, 1);
        builder.add(y, 100 + y / 2, 210 + y / 2, 0.5f);
    }
    const Tiles whole = builder.finish();
    const Grid expected = drawn(whole, 320, 200);
    const std::vector<Tiles> parts = inParts(whole, 2000);
    EXPECT_GT(parts.size(), 3u);
    Grid grid(320, 200);
    for (const Tiles& part : parts) {
        const Grid one = drawn(part, 320, 200);
        for (std::size_t i = 0; i < grid.shares.size(); ++i) {
            grid.shares[i] += one.shares[i];
            grid.tiles[i] += one.tiles[i];
        }
    }
    EXPECT_EQ(grid.shares, expected.shares);
    EXPECT_EQ(grid.tiles, expected.tiles);
}

TEST(Tiles, TakeRowsInAnyOrder) {
    TileBuilder up, down;
    for (int y = 0; y < 40; ++y) {
        up.add(y, y, 40 + y, y % 2 ? 1 : 0.5f);
        down.add(39 - y, 39 - y, 79 - y, (39 - y) % 2 ? 1 : 0.5f);
    }
    EXPECT_EQ(drawn(up.finish(), 90, 50).shares, drawn(down.finish(), 90, 50).shares);
}

// ---- Batches --------------------------------------------------------------------------------------

Tiles square(int x, int y, int side) {
    TileBuilder builder;
    for (int j = 0; j < side; ++j)
        builder.add(y + j, x, x + side, 0.5f);
    return builder.finish();
}

Draw solidDraw(const TexturePointer& target) {
    Draw draw;
    draw.target = target;
    draw.readsTarget = true;
    return draw;
}

TEST(Batches, JoinColoursWhereFragmentsAreFetched) {
    const auto target = std::make_shared<const Texture>(std::make_shared<Discarded>(), 1, 64, 64, false);
    Batch batch(true);
    for (int i = 0; i < 5; ++i)
        batch.add(solidDraw(target), square(4 * i, 0, 8), Color(float(i)), nullptr);
    ASSERT_EQ(batch.draws.size(), 1u);
    ASSERT_EQ(batch.instances.size(), 5u);
    // Each has shares and a colour of its own.
    EXPECT_EQ(batch.instances[2].tile.shares, 2u * 64u);
    EXPECT_EQ(batch.instances[2].color, Color(2));
}

TEST(Batches, DoNotJoinWhatWouldReadACopyThatIsOutOfDate) {
    const auto target = std::make_shared<const Texture>(std::make_shared<Discarded>(), 1, 64, 64, false);
    Batch batch(false);
    batch.add(solidDraw(target), square(0, 0, 8), Color(1), nullptr);
    batch.add(solidDraw(target), square(20, 0, 8), Color(1), nullptr);
    EXPECT_EQ(batch.draws.size(), 1u);
    batch.add(solidDraw(target), square(24, 4, 8), Color(1), nullptr);
    EXPECT_EQ(batch.draws.size(), 2u);
}

TEST(Batches, NeverJoinCopiesWithinATexture) {
    const auto target = std::make_shared<const Texture>(std::make_shared<Discarded>(), 1, 64, 64, false);
    Batch batch(true);
    for (int i = 0; i < 3; ++i) {
        Draw draw = solidDraw(target);
        draw.texels[0] = target;
        batch.add(std::move(draw), square(0, 0, 8), Color(0), nullptr);
    }
    EXPECT_EQ(batch.draws.size(), 3u);
}

}  // namespace
}  // namespace vtm::openvg::gl
