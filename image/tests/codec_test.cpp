#include <vtm/image/codec.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "tests/test_folder.hpp"

namespace vtm::image {
namespace {

Bitmap sample() {
    return {
        3, 2, {255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 1, 9, 8, 7, 255, 1, 2, 3, 77, 200, 100, 50, 255}};
}

std::filesystem::path suiteResources() {
    const char* shared = std::getenv("VTM_SHARED");
    const std::filesystem::path root = shared ? shared : std::string(VTM_SOURCE_DIR) + "/../shared";
    return root / "svg-suite" / "resources";
}

TEST(Codec, PngKeepsEveryByte) {
    const Bitmap decoded = decode(encodePng(sample()));
    EXPECT_EQ(decoded.width, 3);
    EXPECT_EQ(decoded.height, 2);
    EXPECT_EQ(decoded.rgba, sample().rgba);
}

TEST(Codec, TruncatedPngIsAnError) {
    const std::vector<std::uint8_t> png = encodePng(sample());
    for (std::size_t size = 0; size < png.size() - 12; ++size)  // the last chunk, IEND, holds nothing
        EXPECT_THROW(decode(std::span(png).first(size)), CodecError) << size;
}

TEST(Codec, UnknownSignatureIsAnError) {
    EXPECT_THROW(decode(std::vector<std::uint8_t>{1, 2, 3, 4}), CodecError);
    EXPECT_THROW(decode({}), CodecError);
}

TEST(Codec, HugePngIsRefusedBeforeItsPixelsAreAllocated) {
    std::vector<std::uint8_t> png = encodePng(sample());
    png[16] = 0x40;  // width, big-endian; the checksum is wrong now as well
    EXPECT_THROW(decode(png), CodecError);
}

TEST(Codec, FilesSurviveWritingAndReading) {
    const TestFolder folder;
    const std::string path = (folder / "file").string();
    const std::vector<std::uint8_t> bytes{0, 1, 255, 13, 10};
    writeFile(path, bytes);
    EXPECT_EQ(readFile(path), bytes);
}

TEST(Codec, MissingFileIsNamed) {
    try {
        readFile("/nonexistent/picture.png");
        FAIL();
    } catch (const CodecError& error) {
        EXPECT_NE(std::string(error.what()).find("/nonexistent/picture.png"), std::string::npos);
    }
}

class CodecFormat : public testing::TestWithParam<const char*> {};

TEST_P(CodecFormat, AgreesWithThePngOfTheSamePicture) {
    if (!std::filesystem::exists(suiteResources()))
        GTEST_SKIP() << "svg-suite is absent";
    const Bitmap png = decode(readFile((suiteResources() / "image.png").string()));
    const Bitmap other = decode(readFile((suiteResources() / GetParam()).string()));
    ASSERT_EQ(other.width, png.width);
    ASSERT_EQ(other.height, png.height);
    double sum = 0;
    for (std::size_t i = 0; i < png.rgba.size(); i += 4)
        if (png.rgba[i + 3] == 255)
            for (std::size_t c = 0; c < 3; ++c)
                sum += std::abs(png.rgba[i + c] - other.rgba[i + c]);
    EXPECT_LT(sum / double(png.rgba.size()), 8) << "mean difference of a channel";
}

TEST_P(CodecFormat, SurvivesTruncationAndNoise) {
    if (!std::filesystem::exists(suiteResources()))
        GTEST_SKIP() << "svg-suite is absent";
    const std::vector<std::uint8_t> bytes = readFile((suiteResources() / GetParam()).string());
    std::minstd_rand random(7);
    for (int round = 0; round < 200; ++round) {
        std::vector<std::uint8_t> broken(bytes.begin(),
                                         bytes.begin() + std::ptrdiff_t(random() % bytes.size()));
        for (int flips = 0; flips < 8 && !broken.empty(); ++flips)
            broken[random() % broken.size()] = std::uint8_t(random());
        try {
            const Bitmap bitmap = decode(broken);
            EXPECT_EQ(bitmap.rgba.size(), std::size_t(bitmap.width) * std::size_t(bitmap.height) * 4);
        } catch (const CodecError&) {
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, CodecFormat,
                         testing::Values("image.jpg", "image.webp", "image.gif", "image.png"),
                         [](const auto& test) { return std::string(test.param).substr(6); });

}  // namespace
}  // namespace vtm::image
