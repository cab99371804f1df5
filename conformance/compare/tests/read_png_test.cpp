#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "conformance/compare/compare.hpp"
#include "tests/test_folder.hpp"

namespace vtm::compare {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string temporaryPath(const std::string& name) {
    static const TestFolder folder;
    return (folder / name).string();
}

/// Writes one row of pixels in the given PNG format.
std::string writeRow(const std::string& name, int width, int depth, int colorType, const Bytes& row) {
    const std::string path = temporaryPath(name);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"), std::fclose);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file.get());
    png_set_IHDR(png, info, png_uint_32(width), 1, depth, colorType, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const png_color palette[] = {{10, 20, 30}, {40, 50, 60}};
    if (colorType == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 2);
    png_write_info(png, info);
    png_write_row(png, row.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return path;
}

void expectPixel(const image::Raster& raster, int x, double r, double g, double b, double a) {
    const double expected[] = {r, g, b, a};
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(raster.pixel(x, 0)[c], expected[c], 1e-6) << "pixel " << x << " channel " << c;
}

/// What the exception says; empty if there is none.
std::string errorOf(const std::string& path) {
    try {
        readPng(path);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(ReadPng, EightBitIsStraight) {
    const image::Raster r =
        readPng(writeRow("rgba8.png", 2, 8, PNG_COLOR_TYPE_RGB_ALPHA, {255, 51, 0, 51, 0, 0, 255, 255}));
    ASSERT_EQ(r.width, 2);
    ASSERT_EQ(r.height, 1);
    expectPixel(r, 0, 0.2, 0.04, 0, 0.2);
    expectPixel(r, 1, 0, 0, 1, 1);
}

TEST(ReadPng, SixteenBitIsPremultiplied) {
    const image::Raster r = readPng(
        writeRow("rgba16.png", 1, 16, PNG_COLOR_TYPE_RGB_ALPHA, {0x12, 0x34, 0, 1, 0xff, 0xff, 0x80, 0}));
    expectPixel(r, 0, 0x1234 / 65535.0, 1 / 65535.0, 1, 0x8000 / 65535.0);
}

TEST(ReadPng, OtherEightBitTypesBecomeRgba) {
    expectPixel(readPng(writeRow("rgb.png", 1, 8, PNG_COLOR_TYPE_RGB, {51, 102, 153})), 0, 0.2, 0.4, 0.6, 1);
    expectPixel(readPng(writeRow("gray.png", 1, 8, PNG_COLOR_TYPE_GRAY, {51})), 0, 0.2, 0.2, 0.2, 1);
    expectPixel(readPng(writeRow("graya.png", 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {255, 51})), 0, 0.2, 0.2, 0.2,
                0.2);
    expectPixel(readPng(writeRow("bit.png", 2, 1, PNG_COLOR_TYPE_GRAY, {0x40})), 1, 1, 1, 1, 1);
    expectPixel(readPng(writeRow("palette.png", 2, 1, PNG_COLOR_TYPE_PALETTE, {0x40})), 1, 40 / 255.0,
                50 / 255.0, 60 / 255.0, 1);
}

TEST(ReadPng, ErrorsNameThePath) {
    const std::string missing = temporaryPath("missing.png");
    EXPECT_NE(errorOf(missing).find(missing), std::string::npos);
    const std::string text = temporaryPath("text.png");
    std::ofstream(text) << "this is no picture";
    EXPECT_NE(errorOf(text).find(text), std::string::npos);
    const std::string deepGray = writeRow("gray16.png", 1, 16, PNG_COLOR_TYPE_GRAY, {1, 2});
    EXPECT_NE(errorOf(deepGray).find("not RGBA"), std::string::npos);
}

TEST(ReadPng, EveryTruncationIsAnError) {
    const std::string whole = writeRow("whole.png", 1, 8, PNG_COLOR_TYPE_RGB, {51, 102, 153});
    const std::string cut = temporaryPath("cut.png");
    for (std::uintmax_t size = 0; size + 12 < std::filesystem::file_size(whole); ++size) {  // 12: IEND
        std::filesystem::copy_file(whole, cut, std::filesystem::copy_options::overwrite_existing);
        std::filesystem::resize_file(cut, size);
        EXPECT_NE(errorOf(cut), "") << size << " bytes";
    }
}

}  // namespace
}  // namespace vtm::compare
