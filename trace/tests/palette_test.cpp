#include "trace/src/palette.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace vtm::trace {
namespace {

image::Bitmap bitmapOf(const std::vector<std::array<std::uint8_t, 4>>& pixels) {
    image::Bitmap bitmap{int(pixels.size()), 1, {}};
    for (const auto& p : pixels)
        bitmap.rgba.insert(bitmap.rgba.end(), p.begin(), p.end());
    return bitmap;
}

TEST(Palette, KeepsAFewColoursAsTheyAre) {
    const Palette palette = quantise(
        bitmapOf({{0, 0, 0, 255}, {255, 255, 255, 255}, {200, 30, 40, 255}, {0, 0, 0, 255}, {1, 2, 3, 255}}),
        8);
    EXPECT_EQ(palette.colors, (std::vector<Rgb>{{255, 255, 255}, {200, 30, 40}, {1, 2, 3}, {0, 0, 0}}));
    EXPECT_EQ(palette.indices, (std::vector<int>{3, 0, 1, 3, 2}));
}

TEST(Palette, LeavesOutWhatIsTransparent) {
    const Palette palette = quantise(bitmapOf({{9, 9, 9, 127}, {9, 9, 9, 128}, {0, 0, 0, 0}}), 4);
    EXPECT_EQ(palette.colors, (std::vector<Rgb>{{9, 9, 9}}));
    EXPECT_EQ(palette.indices, (std::vector<int>{-1, 0, -1}));
    EXPECT_TRUE(quantise(bitmapOf({{0, 0, 0, 0}}), 4).colors.empty());
}

TEST(Palette, FindsGroupsOfColours) {
    std::vector<std::array<std::uint8_t, 4>> pixels;
    for (int i = 0; i < 300; ++i) {
        const auto noise = std::uint8_t(i % 10);
        const std::array<std::uint8_t, 4> near[] = {{std::uint8_t(220 + noise), 20, 20, 255},
                                                    {20, std::uint8_t(200 + noise), 20, 255},
                                                    {10, 10, std::uint8_t(90 + noise), 255}};
        pixels.push_back(near[i % 3]);
    }
    const Palette palette = quantise(bitmapOf(pixels), 3);
    ASSERT_EQ(palette.colors.size(), 3u);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Rgb& c = palette.colors[std::size_t(palette.indices[i])];
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_LE(std::abs(c[k] - pixels[i][k]), 10);
    }
}

TEST(Palette, HasNoMoreColoursThanAsked) {
    std::vector<std::array<std::uint8_t, 4>> pixels;
    for (int i = 0; i < 1000; ++i)
        pixels.push_back({std::uint8_t(i), std::uint8_t(i * 7), std::uint8_t(i * 13), 255});
    for (const int count : {1, 2, 5, 64})
        EXPECT_LE(quantise(bitmapOf(pixels), count).colors.size(), std::size_t(count));
    EXPECT_EQ(quantise(bitmapOf(pixels), 64).colors, quantise(bitmapOf(pixels), 64).colors);
}

}  // namespace
}  // namespace vtm::trace
