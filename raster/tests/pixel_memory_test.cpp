#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/svg/load.hpp>
#include "raster/src/pixel_memory.hpp"

namespace vtm::asset {
namespace {

constexpr std::size_t MB = 1 << 20;

TEST(PixelMemory, FreeBlocksAreUsedAgain) {
    const BlocksOfDrawing drawing;
    void* const block = takeBlock(48 * MB);
    giveBlock(block, 48 * MB);
    void* const same = takeBlock(48 * MB);
    EXPECT_EQ(block, same);
    giveBlock(same, 48 * MB);
    void* const smaller = takeBlock(30 * MB);
    EXPECT_EQ(block, smaller) << "of at least half of the size";
    giveBlock(smaller, 30 * MB);
    void* const whole = takeBlock(48 * MB);
    EXPECT_EQ(block, whole) << "it is as large as before";
    giveBlock(whole, 48 * MB);
    void* const small = takeBlock(20 * MB);
    EXPECT_NE(block, small);
    giveBlock(small, 20 * MB);
}

TEST(PixelMemory, ABlockMayOutliveItsDrawing) {
    std::vector<void*> blocks;
    {
        const BlocksOfDrawing drawing;
        void* const large = takeBlock(40 * MB);
        giveBlock(large, 40 * MB);
        blocks.push_back(takeBlock(25 * MB));  // lent for less
        blocks.push_back(takeBlock(100'000));
    }
    static_cast<char*>(blocks[0])[25 * MB - 1] = 1;
    giveBlock(blocks[0], 25 * MB);
    giveBlock(blocks[1], 100'000);
}

TEST(PixelMemory, MostGoesBackToTheSystemAfterADrawing) {
    constexpr std::size_t count = 20, bytes = 16 * MB, keptBetween = 192 * MB;
    const std::size_t before = limits::residentBytes();
    {
        const BlocksOfDrawing drawing;
        std::vector<void*> blocks;
        for (std::size_t i = 0; i < count; ++i) {
            blocks.push_back(takeBlock(bytes));
            for (std::size_t at = 0; at < bytes; at += 4096)
                static_cast<volatile char*>(blocks.back())[at] = 1;
        }
        EXPECT_GT(limits::residentBytes(), before + count * bytes - keptBetween - 16 * MB);
        for (void* const block : blocks)
            giveBlock(block, bytes);
    }
    constexpr std::size_t shadow = count * bytes / 8;  // what the address sanitizer has of what was touched
    EXPECT_LT(limits::residentBytes(), before + keptBetween + shadow + 16 * MB);
}

/// Blocks of the heap did not fit in where such blocks had been: its pages came and went.
TEST(PixelMemory, DrawingFiltersAgainTakesNoMoreMemory) {
    const std::string svg =
        "<svg xmlns='http://www.w3.org/2000/svg' width='512' height='512'><filter id='f'>"
        "<feDropShadow dx='8' dy='8' stdDeviation='6' flood-opacity='0.6'/></filter>"
        "<g filter='url(#f)'><circle cx='200' cy='200' r='150' fill='#c33'/>"
        "<rect x='220' y='220' width='200' height='180' fill='#36c'/></g></svg>";
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size());
    const View view{1024, 1024, {2, 0, 0, 2, 0, 0}};
    std::vector<std::size_t> resident;
    for (int i = 0; i < 20; ++i) {
        const Asset asset = compiler::compile(svg::load(bytes).scene).asset;
        Evaluator(asset).draw(view);
        resident.push_back(limits::residentBytes());
    }
    // It was 400 MB. The address sanitizer keeps what is freed for a while.
    EXPECT_LT(resident.back(), resident[2] + 160 * MB);
}

}  // namespace
}  // namespace vtm::asset
