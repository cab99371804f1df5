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
    void* const block = takeBlock(480 * MB);
    giveBlock(block, 480 * MB);
    void* const same = takeBlock(480 * MB);
    EXPECT_EQ(block, same);
    giveBlock(same, 480 * MB);
    void* const smaller = takeBlock(300 * MB);
    EXPECT_EQ(block, smaller) << "of at least half of the size";
    giveBlock(smaller, 300 * MB);
    void* const whole = takeBlock(480 * MB);
    EXPECT_EQ(block, whole) << "it is as large as before";
    giveBlock(whole, 480 * MB);
    void* const small = takeBlock(200 * MB);
    EXPECT_NE(block, small);
    giveBlock(small, 200 * MB);
}

TEST(PixelMemory, ABlockMayOutliveItsDrawing) {
    // Larger than what other tests leave.
    void *large = nullptr, *lent = nullptr, *small = nullptr;
    {
        const BlocksOfDrawing drawing;
        large = takeBlock(400 * MB);
        giveBlock(large, 400 * MB);
        lent = takeBlock(250 * MB);
        small = takeBlock(100'000);
    }
    EXPECT_EQ(large, lent);
    static_cast<char*>(lent)[250 * MB - 1] = 1;
    giveBlock(small, 100'000);
    const BlocksOfDrawing next;
    giveBlock(lent, 250 * MB);
    void* const again = takeBlock(400 * MB);
    EXPECT_EQ(large, again) << "it is as large as before";
    giveBlock(again, 400 * MB);
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

/// With blocks from glibc's heap the process grew with each drawing.
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
    // From the heap it was 404 MB more. The address sanitizer keeps what is freed for a while.
    EXPECT_LT(resident.back(), resident[2] + 160 * MB);
}

}  // namespace
}  // namespace vtm::asset
