#include <vtm/image/bitmap.hpp>

#include <limits>

#include <gtest/gtest.h>

#include "image/pixel_writer.hpp"

namespace vtm::image {
namespace {

TEST(Bitmap, RasterHoldsPremultipliedColour) {
    const Raster raster = toRaster({1, 1, {255, 0, 51, 51}});
    EXPECT_FLOAT_EQ(raster.rgba[0], 0.2f);
    EXPECT_FLOAT_EQ(raster.rgba[2], 0.04f);
    EXPECT_FLOAT_EQ(raster.rgba[3], 0.2f);
}

TEST(Bitmap, SurvivesTheRasterAndBack) {
    const Bitmap bitmap{2, 1, {1, 128, 255, 255, 7, 80, 200, 100}};
    EXPECT_EQ(toBitmap(toRaster(bitmap)).rgba, bitmap.rgba);
}

TEST(Bitmap, ClampsWhatLiesOutsideTheRange) {
    Raster raster(1, 1);
    raster.rgba = {2, -1, 0.5f, 1};
    EXPECT_EQ(toBitmap(raster).rgba, (std::vector<std::uint8_t>{255, 0, 128, 255}));
}

TEST(PixelWriter, LaysColoursOverTheGround) {
    const PixelWriter writer({0, 0, 1, 1});
    const float halfRed[4] = {0.5f, 0, 0, 0.5f};
    std::uint8_t pixel[4];
    writer.write(halfRed, pixel);
    EXPECT_EQ(std::vector<std::uint8_t>(pixel, pixel + 4), (std::vector<std::uint8_t>{128, 0, 128, 255}));
}

TEST(PixelWriter, SixteenBitsHaveTheHigherByteFirst) {
    const PixelWriter writer({}, 16);
    const float halfRed[4] = {0.5f, 0, 0, 0.5f};
    std::uint8_t pixel[8];
    writer.write(halfRed, pixel);
    EXPECT_EQ(std::vector<std::uint8_t>(pixel, pixel + 8),
              (std::vector<std::uint8_t>{255, 255, 0, 0, 0, 0, 128, 0}));
}

TEST(PixelWriter, WhatAlphaDoesNotShowIsBlack) {
    const float hidden[4] = {1e-3f, 5e-4f, 0, 1.9e-3f}, shown[4] = {1e-3f, 0, 0, 2e-3f};
    std::uint8_t pixel[4];
    PixelWriter().write(hidden, pixel);
    EXPECT_EQ(std::vector<std::uint8_t>(pixel, pixel + 4), (std::vector<std::uint8_t>{0, 0, 0, 0}));
    PixelWriter().write(shown, pixel);
    EXPECT_EQ(std::vector<std::uint8_t>(pixel, pixel + 4), (std::vector<std::uint8_t>{128, 0, 0, 1}));
    std::uint8_t deep[8];
    PixelWriter({}, 16).write(hidden, deep);
    EXPECT_EQ(deep[7], 125);  // 1.9e-3 of 65535
    EXPECT_EQ(deep[0] << 8 | deep[1], 34492);
}

TEST(PixelWriter, NanIsBlack) {
    const PixelWriter writer;
    const float broken[4] = {std::numeric_limits<float>::quiet_NaN(), 1, 0, 1};
    std::uint8_t pixel[4];
    writer.write(broken, pixel);
    EXPECT_EQ(std::vector<std::uint8_t>(pixel, pixel + 4), (std::vector<std::uint8_t>{0, 255, 0, 255}));
}

TEST(GiveRows, BitmapsLieOnTheGround) {
    const Bitmap clear{1, 2, {9, 9, 9, 0, 1, 2, 3, 255}};
    std::vector<std::uint8_t> rows;
    giveRows(clear, PixelWriter({1, 0, 0, 1}),
             [&](std::span<const std::uint8_t> row) { rows.insert(rows.end(), row.begin(), row.end()); });
    EXPECT_EQ(rows, (std::vector<std::uint8_t>{255, 0, 0, 255, 1, 2, 3, 255}));
}

}  // namespace
}  // namespace vtm::image
