#include "image/levels.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace vtm::image {
namespace {

Bitmap noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Bitmap bitmap{width, height, {}};
    for (int i = 0; i < width * height * 4; ++i)
        bitmap.rgba.push_back(std::uint8_t(random() >> 24));
    return bitmap;
}

/// The mean by its definition, in doubles.
double mean(const Bitmap& bitmap, int level, int i, int j, int channel) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < bitmap.height; ++y)
        for (int x = 0; x < bitmap.width; ++x) {
            if (x >> level != i || y >> level != j)
                continue;
            const std::uint8_t* p = &bitmap.rgba[std::size_t(y * bitmap.width + x) * 4];
            sum += channel == 3 ? p[3] : p[channel] * p[3] / 255.0;
            ++count;
        }
    return sum / count;
}

TEST(Levels, AreRoundedMeansOfTheirBlocks) {
    for (const auto& [width, height] : {std::pair{16, 16}, {13, 9}, {1, 7}, {33, 2}, {5, 1}}) {
        const Bitmap bitmap = noise(width, height, unsigned(width * 100 + height));
        const std::vector<Level> levels = levelsOf(bitmap);
        EXPECT_EQ(levelCount(bitmap), levels.size());
        for (std::size_t l = 0; l < levels.size(); ++l) {
            const int level = int(l) + 1;
            const Level& found = levels[l];
            ASSERT_EQ(found.width, (width + (1 << level) - 1) >> level);
            ASSERT_EQ(found.height, (height + (1 << level) - 1) >> level);
            ASSERT_EQ(found.rgba.size(), std::size_t(found.width * found.height * 4));
            for (std::size_t k = 0; k < found.rgba.size(); ++k) {
                const int i = int(k / 4) % found.width, j = int(k / 4) / found.width;
                EXPECT_LE(std::abs(found.rgba[k] - mean(bitmap, level, i, j, int(k % 4))), 0.5 + 1e-9)
                    << width << " x " << height << ", level " << level << ", byte " << k;
            }
        }
        ASSERT_FALSE(levels.empty());
        EXPECT_EQ(levels.back().rgba.size(), 4u);
    }
}

TEST(Levels, APixelHasNone) {
    EXPECT_TRUE(levelsOf(noise(1, 1, 1)).empty());
    EXPECT_EQ(levelCount(noise(1, 1, 1)), 0u);
}

TEST(Levels, TransparentPixelsLendNoColour) {
    const Bitmap bitmap{2, 1, {255, 255, 255, 0, 200, 100, 0, 255}};
    EXPECT_EQ(levelsOf(bitmap).at(0).rgba, (std::vector<std::uint8_t>{100, 50, 0, 128}));
}

}  // namespace
}  // namespace vtm::image
