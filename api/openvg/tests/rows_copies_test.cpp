// Rows of pixels that are copied and converted, beside single pixels.

#include "api/openvg/tests/rows_fixture.hpp"

namespace vtm::openvg::testing {
namespace {

constexpr std::array formats{VG_sRGBX_8888,
                             VG_sRGBA_8888,
                             VG_sRGBA_8888_PRE,
                             VG_sRGB_565,
                             VG_sRGBA_5551,
                             VG_sRGBA_4444,
                             VG_sL_8,
                             VG_lRGBX_8888,
                             VG_lRGBA_8888,
                             VG_lRGBA_8888_PRE,
                             VG_lL_8,
                             VG_A_8,
                             VG_BW_1,
                             VG_A_1,
                             VG_A_4,
                             VG_sXRGB_8888,
                             VG_sARGB_8888,
                             VG_sARGB_8888_PRE,
                             VG_sARGB_1555,
                             VG_sARGB_4444,
                             VG_sBGRX_8888,
                             VG_sBGRA_8888,
                             VG_sBGRA_8888_PRE,
                             VG_sBGR_565,
                             VG_sBGRA_5551,
                             VG_sBGRA_4444,
                             VG_sXBGR_8888,
                             VG_sABGR_8888,
                             VG_sABGR_8888_PRE,
                             VG_lABGR_8888_PRE};

TEST_F(RowsTest, EveryFormatBecomesEveryOther) {
    for (const VGImageFormat from : formats)
        for (const VGImageFormat to : formats) {
            const TwinImage given = randomImage(from, width, height);
            const VGImage image = uploaded(given), other = newImage(to, width, height);
            vgCopyImage(other, 0, 0, image, 0, 0, width, height, VG_FALSE);
            TwinImage result(to, width, height);
            std::vector<std::uint8_t> bytes(std::size_t(result.stride() * height));
            vgGetImageSubData(other, bytes.data(), result.stride(), to, 0, 0, width, height);
            result.setBytes(bytes);
            int wrong = 0;
            for (std::size_t i = 0; i < given.words.size(); ++i) {
                const ColorSpace space = result.format.space;
                Color expected =
                    fullyConverted(given.format.decode(given.words[i]), given.format.space, space);
                if (result.format.alpha.bits == 0)
                    expected.a = 1;
                wrong += !testing::isNear(result.format, result.words[i],
                                          space.premultiplied ? expected : premultiplied(expected));
            }
            EXPECT_EQ(wrong, 0) << std::hex << from << " to " << to;
            if (from == to) {
                EXPECT_EQ(given.words, result.words) << std::hex << from;
            }
            vgDestroyImage(image);
            vgDestroyImage(other);
        }
}

/// Many pixels are converted by tables, few one by one.
TEST_F(RowsTest, ManyPixelsBecomeWhatFewDo) {
    constexpr int side = 256, rows = side + 64, strip = 32;
    // Each byte beside each alpha, wherever that is; above, rows that are mostly opaque.
    std::vector<std::uint8_t> bytes(side * rows * 4);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < side; ++x)
            for (std::size_t i = 0; i < 4; ++i) {
                const bool isOpaque = y >= side && (x + y) % 23 > 2, isFirst = i == 0, isLast = i == 3;
                bytes[(y * side + x) * 4 + i] = std::uint8_t(isOpaque && (isFirst || isLast) ? 255
                                                             : isFirst                       ? y
                                                             : isLast                        ? x + y
                                                                                             : x);
            }
    const auto bytesOf = [](VGImage image, VGImageFormat format) {
        std::vector<std::uint8_t> result(side * rows * 4);
        vgGetImageSubData(image, result.data(), side * 4, format, 0, 0, side, rows);
        return result;
    };
    for (const VGImageFormat from : formats) {
        const VGImage image = newImage(from, side, rows);
        vgImageSubData(image, bytes.data(), side * 4, from, 0, 0, side, rows);
        for (const VGImageFormat to : formats) {
            const VGImage whole = newImage(to, side, rows), inStrips = newImage(to, side, rows);
            vgCopyImage(whole, 0, 0, image, 0, 0, side, rows, VG_FALSE);
            for (int y = 0; y < rows; y += strip)
                vgCopyImage(inStrips, 0, y, image, 0, y, side, strip, VG_FALSE);
            EXPECT_EQ(bytesOf(whole, to), bytesOf(inStrips, to)) << std::hex << from << " to " << to;
            vgImageSubData(whole, bytes.data(), side * 4, from, 0, 0, side, rows);
            for (int y = 0; y < rows; y += strip)
                vgImageSubData(inStrips, &bytes[std::size_t(y) * side * 4], side * 4, from, 0, y, side,
                               strip);
            EXPECT_EQ(bytesOf(whole, to), bytesOf(inStrips, to)) << std::hex << from << " into " << to;
            vgDestroyImage(whole);
            vgDestroyImage(inStrips);
        }
        vgDestroyImage(image);
    }
}

TEST_F(RowsTest, ColoursOfProgramsAreClampedToTheirAlpha) {
    for (const VGImageFormat to : {VG_sRGBA_8888_PRE, VG_sABGR_8888_PRE, VG_lRGBA_8888_PRE, VG_sRGBA_8888}) {
        TwinImage given(VG_sRGBA_8888_PRE, width, height), clamped = given;
        for (std::size_t i = 0; i < given.words.size(); ++i) {
            given.words[i] = std::uint32_t(random_());
            clamped.words[i] = given.format.encode(given.format.decode(given.words[i]));
        }
        const VGImage a = newImage(to, width, height), b = newImage(to, width, height);
        TwinImage results[]{TwinImage(to, width, height), TwinImage(to, width, height)};
        for (const auto& [image, pixels, result] :
             {std::tuple(a, &given, &results[0]), std::tuple(b, &clamped, &results[1])}) {
            vgImageSubData(image, pixels->bytes().data(), pixels->stride(), pixels->name, 0, 0, width,
                           height);
            vgGetImageSubData(image, result->words.data(), 4 * width, to, 0, 0, width, height);
        }
        EXPECT_EQ(results[0].words, results[1].words) << std::hex << to;
    }
}

TEST_F(RowsTest, CopiesMayOverlap) {
    for (const auto& [dx, dy] : {std::pair(3, 0), std::pair(-3, 0), std::pair(5, 1), std::pair(0, -1)}) {
        const TwinImage given = randomImage(VG_sABGR_8888, width, height);
        const VGImage image = uploaded(given);
        useSurface(width, height, surfaces[1].format);
        vgSetPixels(0, 0, image, 0, 0, width, height);
        vgCopyImage(image, dx, dy, image, 0, 0, width, height, VG_FALSE);
        vgCopyPixels(dx, dy, 0, 0, width, height);
        TwinImage expected = given, inImage(given.name, width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (x + dx >= 0 && x + dx < width && y + dy >= 0 && y + dy < height)
                    expected.word(x + dx, y + dy) = given.word(x, y);
        vgGetImageSubData(image, inImage.words.data(), 4 * width, given.name, 0, 0, width, height);
        EXPECT_EQ(inImage.words, expected.words) << dx << " " << dy;
        EXPECT_EQ(read(given.name).words, expected.words) << dx << " " << dy;
        vgDestroyImage(image);
    }
}

}  // namespace
}  // namespace vtm::openvg::testing
