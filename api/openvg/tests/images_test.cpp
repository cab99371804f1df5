// Section 10, and section 3.4: image formats, conversions, pixels in and out, child images.

#include <cmath>
#include <limits>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

constexpr VGint greatest = std::numeric_limits<VGint>::max(), minimum = std::numeric_limits<VGint>::min();

struct Format {
    VGImageFormat name;
    unsigned bits;
};
std::vector<Format> allFormats() {
    std::vector<Format> formats;
    const auto orders = [&](VGint base, unsigned bits, std::initializer_list<VGint> offsets) {
        for (const VGint order : offsets)
            formats.push_back({VGImageFormat(base | order), bits});
    };
    for (const VGint base :
         {VG_sRGBX_8888, VG_sRGBA_8888, VG_sRGBA_8888_PRE, VG_lRGBX_8888, VG_lRGBA_8888, VG_lRGBA_8888_PRE})
        orders(base, 32, {0, 1 << 6, 1 << 7, 3 << 6});
    orders(VG_sRGB_565, 16, {0, 1 << 7});
    orders(VG_sRGBA_5551, 16, {0, 1 << 6, 1 << 7, 3 << 6});
    orders(VG_sRGBA_4444, 16, {0, 1 << 6, 1 << 7, 3 << 6});
    for (const VGint base : {VG_sL_8, VG_lL_8, VG_A_8})
        orders(base, 8, {0});
    orders(VG_A_4, 4, {0});
    orders(VG_A_1, 1, {0});
    orders(VG_BW_1, 1, {0});
    return formats;
}
bool isPremultiplied(VGint format) {
    return (format & 63) == VG_sRGBA_8888_PRE || (format & 63) == VG_lRGBA_8888_PRE;
}
bool isPadded(VGint format) { return (format & 63) == VG_sRGBX_8888 || (format & 63) == VG_lRGBX_8888; }

class ImagesTest : public VgTest {};

TEST_F(ImagesTest, EveryFormatKeepsItsPixels) {
    // Section 10.2: bits of a row from the least on; words in the machine's order.
    constexpr int side = 8;
    for (const Format& format : allFormats()) {
        SCOPED_TRACE(VGint(format.name));
        const std::size_t rowBytes = side * format.bits / 8;
        std::vector<std::uint8_t> in(side * rowBytes), out(in.size(), 0x5a);
        for (std::size_t i = 0; i < in.size(); ++i)
            in[i] = std::uint8_t(i * 73 + i / 8 * 29 + 11);
        if (format.bits == 32)
            for (std::size_t i = 0; i < in.size(); i += 4) {
                // Legal premultiplied colours: alpha is the greatest. Padding is not kept.
                const std::size_t last = VGint(format.name) & (1 << 6) ? 3 : 0;
                if (isPremultiplied(format.name))
                    in[i + last] = 255;
                if (isPadded(format.name))
                    in[i + last] = 0;
            }
        const VGImage image = newImage(format.name, side, side);
        ASSERT_NE(image, VG_INVALID_HANDLE);
        vgImageSubData(image, in.data(), VGint(rowBytes), format.name, 0, 0, side, side);
        vgGetImageSubData(image, out.data(), VGint(rowBytes), format.name, 0, 0, side, side);
        if (isPadded(format.name))  // what padding reads as is not said
            for (std::size_t i = 0; i < out.size(); i += 4)
                out[i + (VGint(format.name) & (1 << 6) ? 3 : 0)] = 0;
        EXPECT_EQ(in, out);
        vgDestroyImage(image);
    }
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(ImagesTest, ChannelsLieWhereTheNameSays) {
    // The name lists channels from the highest bit on (section 10.2).
    const VGImage image = newImage({{0x11, 0x22, 0x33, 0x44}});
    const auto word = [&](VGImageFormat format) {
        std::uint32_t w = 0;
        vgGetImageSubData(image, &w, 4, format, 0, 0, 1, 1);
        return w;
    };
    EXPECT_EQ(word(VG_sRGBA_8888), 0x11223344u);
    EXPECT_EQ(word(VG_sARGB_8888), 0x44112233u);
    EXPECT_EQ(word(VG_sBGRA_8888), 0x33221144u);
    EXPECT_EQ(word(VG_sABGR_8888), 0x44332211u);
    const VGImage plain = newImage({{0xff, 0, 0x84, 0xff}});
    const auto half = [&](VGImageFormat format) {
        std::uint16_t w = 0;
        vgGetImageSubData(plain, &w, 2, format, 0, 0, 1, 1);
        return int(w);
    };
    EXPECT_EQ(half(VG_sRGB_565), 0xf810);
    EXPECT_EQ(half(VG_sBGR_565), 0x801f);
    EXPECT_EQ(half(VG_sRGBA_5551), 0xf821);
    EXPECT_EQ(half(VG_sARGB_1555), 0xfc10);
    EXPECT_EQ(half(VG_sRGBA_4444), 0xf08f);
    EXPECT_EQ(half(VG_sABGR_4444), 0xf80f);
}

double decoded(double x) { return x <= 0.03928 ? x / 12.92 : std::pow((x + 0.0556) / 1.0556, 2.4); }
double encoded(double x) { return x <= 0.00304 ? 12.92 * x : 1.0556 * std::pow(x, 1 / 2.4) - 0.0556; }
int byteOf(double x) { return int(std::floor(x * 255 + 0.5)); }

TEST_F(ImagesTest, ConversionsOfSection34) {
    for (const int v : {0, 1, 8, 60, 128, 200, 254, 255}) {
        const VGImage image = newImage({{v, 255 - v, 70, 200}});
        EXPECT_TRUE(isNear(
            texel(image, 0, 0, VG_lRGBA_8888),
            {byteOf(decoded(v / 255.0)), byteOf(decoded(1 - v / 255.0)), byteOf(decoded(70 / 255.0)), 200},
            0));
        const auto pre = [&](int c) { return byteOf(c / 255.0 * 200 / 255.0); };
        EXPECT_TRUE(isNear(texel(image, 0, 0, VG_sRGBA_8888_PRE), {pre(v), pre(255 - v), pre(70), 200}, 0));
        // Formula (3), of linear light.
        const double grey =
            0.2126 * decoded(v / 255.0) + 0.7152 * decoded(1 - v / 255.0) + 0.0722 * decoded(70 / 255.0);
        std::uint8_t linear = 0, nonLinear = 0;
        vgGetImageSubData(image, &linear, 1, VG_lL_8, 0, 0, 1, 1);
        vgGetImageSubData(image, &nonLinear, 1, VG_sL_8, 0, 0, 1, 1);
        EXPECT_EQ(linear, byteOf(grey));
        EXPECT_EQ(nonLinear, byteOf(encoded(grey)));
        // Grey in both kinds is the same light; alpha alone is white.
        const VGImage lightness = newImage(VG_sL_8, 1, 1);
        const auto byte = std::uint8_t(v);
        vgImageSubData(lightness, &byte, 1, VG_sL_8, 0, 0, 1, 1);
        EXPECT_EQ(texel(lightness, 0, 0), (Rgba{v, v, v, 255}));
        EXPECT_TRUE(isNear(
            texel(lightness, 0, 0, VG_lRGBA_8888),
            {byteOf(decoded(v / 255.0)), byteOf(decoded(v / 255.0)), byteOf(decoded(v / 255.0)), 255}, 0));
        const VGImage alpha = newImage(VG_A_8, 1, 1);
        vgImageSubData(alpha, &byte, 1, VG_A_8, 0, 0, 1, 1);
        EXPECT_EQ(texel(alpha, 0, 0), (Rgba{255, 255, 255, v}));
    }
}

TEST_F(ImagesTest, FewerBitsAreRoundedToTheNearest) {
    // Section 3.4.4: from n bits to m by value, not by shifting.
    for (int v = 0; v < 256; ++v) {
        const VGImage image = newImage({{v, v, v, v}});
        std::uint16_t word = 0;
        vgGetImageSubData(image, &word, 2, VG_sRGBA_4444, 0, 0, 1, 1);
        EXPECT_EQ(word >> 12, int(std::floor(v * 15 / 255.0 + 0.5)));
        std::uint8_t bits = 0;
        vgGetImageSubData(image, &bits, 1, VG_A_1, 0, 0, 1, 1);
        EXPECT_EQ(bits & 1, v >= 128);
        vgDestroyImage(image);
    }
}

TEST_F(ImagesTest, StridesMayBeNegativeOrZero) {
    const VGImage image = newImage(VG_A_8, 3, 3);
    const std::array<std::uint8_t, 9> rows{1, 2, 3, 4, 5, 6, 7, 8, 9};
    vgImageSubData(image, rows.data() + 6, -3, VG_A_8, 0, 0, 3, 3);
    std::array<std::uint8_t, 9> out{};
    vgGetImageSubData(image, out.data(), 3, VG_A_8, 0, 0, 3, 3);
    EXPECT_EQ(out, (std::array<std::uint8_t, 9>{7, 8, 9, 4, 5, 6, 1, 2, 3}));
    vgImageSubData(image, rows.data(), 0, VG_A_8, 0, 0, 3, 3);
    vgGetImageSubData(image, out.data() + 6, -3, VG_A_8, 0, 0, 3, 3);
    EXPECT_EQ(out, (std::array<std::uint8_t, 9>{1, 2, 3, 1, 2, 3, 1, 2, 3}));
}

TEST_F(ImagesTest, SubByteRowsKeepTheirNeighbours) {
    const VGImage image = newImage(VG_A_1, 3, 1);
    std::uint8_t bits = 0xff;
    vgGetImageSubData(image, &bits, 1, VG_A_1, 0, 0, 3, 1);  // zeros
    EXPECT_EQ(bits, 0xf8);
    bits = 0x02;
    vgImageSubData(image, &bits, 1, VG_A_1, 0, 0, 3, 1);
    EXPECT_EQ(texel(image, 0, 0)[3], 0);
    EXPECT_EQ(texel(image, 1, 0)[3], 255);
    EXPECT_EQ(texel(image, 2, 0)[3], 0);
    const std::array<std::uint8_t, 2> nibbles{0x21, 0x43};
    const VGImage four = newImage(VG_A_4, 4, 1);
    vgImageSubData(four, nibbles.data(), 2, VG_A_4, 0, 0, 4, 1);
    for (int x = 0; x < 4; ++x)
        EXPECT_EQ(texel(four, x, 0)[3], 17 * (x + 1));
}

TEST_F(ImagesTest, AreasAreClippedWhateverTheirNumbers) {
    const VGImage image = newImage(VG_A_8, 4, 4);
    std::array<std::uint8_t, 16> data{};
    for (std::size_t i = 0; i < 16; ++i)
        data[i] = std::uint8_t(i + 1);
    vgImageSubData(image, data.data(), 4, VG_A_8, 2, 3, 4, 4);
    EXPECT_EQ(texel(image, 2, 3)[3], 1);
    EXPECT_EQ(texel(image, 3, 3)[3], 2);
    EXPECT_EQ(texel(image, 1, 3)[3], 0);
    vgImageSubData(image, data.data(), 4, VG_A_8, -2, -2, 4, 4);
    EXPECT_EQ(texel(image, 0, 0)[3], 11);
    for (const VGint x : {minimum, greatest, -16})
        for (const VGint y : {minimum, greatest, 0}) {
            vgImageSubData(image, data.data(), 4, VG_A_8, x, y, 4, 4);
            vgGetImageSubData(image, data.data(), 4, VG_A_8, x, y, 4, 4);
            vgClearImage(image, x, y, 4, 4);
            vgCopyImage(image, x, y, image, y, x, greatest, greatest, VG_TRUE);
            vgSetPixels(x, y, image, 0, 0, greatest, greatest);
            vgGetPixels(image, x, y, y, x, greatest, 1);
            vgCopyPixels(x, 0, y, 0, greatest, greatest);
            vgWritePixels(data.data(), 4, VG_A_8, x, y, 4, 4);
            vgReadPixels(data.data(), 4, VG_A_8, x, y, 4, 4);
        }
    EXPECT_EQ(texel(image, 0, 0)[3], 11);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(ImagesTest, NewImagesAreTransparentBlackAndClearedByTheColor) {
    const VGImage image = newImage(VG_sRGBA_8888, 4, 4);
    EXPECT_EQ(texel(image, 3, 3), (Rgba{0, 0, 0, 0}));
    const std::array<VGfloat, 4> color{0.2f, 0.4f, 7, -1};
    vgSetfv(VG_CLEAR_COLOR, 4, color.data());
    vgClearImage(image, 1, 1, 2, greatest);
    EXPECT_EQ(texel(image, 0, 1), (Rgba{0, 0, 0, 0}));
    EXPECT_EQ(texel(image, 1, 3), (Rgba{51, 102, 255, 0}));
}

TEST_F(ImagesTest, ChildrenShareTheirParentsPixels) {
    const VGImage a = newImage(VG_sRGBA_8888, 8, 8), b = vgChildImage(a, 2, 1, 4, 4),
                  c = vgChildImage(b, 1, 1, 2, 2);
    EXPECT_EQ(vgGetParameteri(c, VG_IMAGE_WIDTH), 2);
    EXPECT_EQ(vgGetParameteri(c, VG_IMAGE_FORMAT), VG_sRGBA_8888);
    const std::uint32_t red = wordOf({255, 0, 0, 255});
    vgImageSubData(c, &red, 4, VG_sRGBA_8888, 0, 0, 1, 1);
    EXPECT_EQ(texel(a, 3, 2), (Rgba{255, 0, 0, 255}));
    EXPECT_EQ(texel(b, 1, 1), (Rgba{255, 0, 0, 255}));
    // Section 10.6, vgGetParent's example.
    EXPECT_EQ(vgGetParent(a), a);
    EXPECT_EQ(vgGetParent(b), a);
    EXPECT_EQ(vgGetParent(c), b);
    vgDestroyImage(b);
    EXPECT_EQ(vgGetParent(c), a);
    vgDestroyImage(a);
    EXPECT_EQ(vgGetParent(c), c);
    EXPECT_EQ(texel(c, 0, 0), (Rgba{255, 0, 0, 255}));
    EXPECT_VG_ERROR(VG_BAD_HANDLE_ERROR, vgDrawImage(a));
}

TEST_F(ImagesTest, CopiesMayOverlap) {
    const VGImage image = newImage(VG_A_8, 5, 1);
    const std::array<std::uint8_t, 5> data{1, 2, 3, 4, 5};
    std::array<std::uint8_t, 5> out{};
    for (const VGint shift : {1, -1, 2}) {
        vgImageSubData(image, data.data(), 5, VG_A_8, 0, 0, 5, 1);
        vgCopyImage(image, shift, 0, image, 0, 0, 5, 1, VG_FALSE);
        vgGetImageSubData(image, out.data(), 5, VG_A_8, 0, 0, 5, 1);
        for (int x = 0; x < 5; ++x)
            EXPECT_EQ(out[std::size_t(x)], x - shift >= 0 && x - shift < 5 ? x - shift + 1 : x + 1);
    }
    for (int x = 0; x < 5; ++x)
        setPixel(x, 0, {10 * x, 0, 0, 255});
    vgCopyPixels(1, 0, 0, 0, 4, 1);
    for (int x = 1; x < 5; ++x)
        EXPECT_EQ(pixel(x, 0), (Rgba{10 * (x - 1), 0, 0, 255}));
}

TEST_F(ImagesTest, PixelsPassBetweenImagesAndTheSurface) {
    const VGImage image = newImage({{1, 2, 3, 255}, {40, 50, 60, 128}});
    vgSetPixels(3, 4, image, 0, 0, 2, 1);
    EXPECT_EQ(pixel(3, 4), (Rgba{1, 2, 3, 255}));
    EXPECT_EQ(pixel(4, 4), (Rgba{40, 50, 60, 128}));
    const VGImage back = newImage(VG_sRGBA_8888, 2, 1);
    vgGetPixels(back, 1, 0, 4, 4, 1, 1);
    EXPECT_EQ(texel(back, 1, 0), (Rgba{40, 50, 60, 128}));
    EXPECT_EQ(texel(back, 0, 0), (Rgba{0, 0, 0, 0}));
    // Blending, masking and matrices do not matter (section 10.9).
    vgSeti(VG_BLEND_MODE, VG_BLEND_DST_OVER);
    vgSetPixels(3, 4, image, 1, 0, 1, 1);
    EXPECT_EQ(pixel(3, 4), (Rgba{40, 50, 60, 128}));
}

TEST_F(ImagesTest, FarAwayImagesAreNotSeen) {
    // Corners beyond what an int holds.
    const VGImage image = newImage({{255, 255, 255, 255}});
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    for (const VGfloat far : {3e9f, -3e9f, 1e30f, -1e30f, 3e38f}) {
        vgLoadIdentity();
        vgTranslate(far, 0);
        vgDrawImage(image);
        vgLoadIdentity();
        vgTranslate(0, far);
        vgDrawImage(image);
    }
    for (int x = 0; x < 16; ++x)
        EXPECT_EQ(pixel(x, 0), (Rgba{0, 0, 0, 0}));
    vgLoadIdentity();
    vgTranslate(-1e10f, -1e10f);
    vgScale(2e10f, 2e10f);
    vgDrawImage(image);
    EXPECT_EQ(pixel(15, 15), (Rgba{255, 255, 255, 255}));
}

}  // namespace

}  // namespace vtm::openvg::testing
