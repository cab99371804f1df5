// AVIF pictures, which libavif writes here.
#include <gtest/gtest.h>

#include <vtm/image/codec.hpp>

#ifdef VTM_WITH_AVIF
#include <memory>

#include <avif/avif.h>
#endif

namespace vtm::image {
namespace {

#ifndef VTM_WITH_AVIF

TEST(Avif, IsRead) { GTEST_SKIP() << "built without libavif"; }

#else

constexpr int width = 6, height = 4;

/// Different in each corner, half of it translucent.
Bitmap sample() {
    Bitmap bitmap{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int channel : {x * 50, y * 80, (x + y) * 20, y < 2 ? 255 : 100})
                bitmap.rgba.push_back(std::uint8_t(channel));
    return bitmap;
}

/// Without loss.
std::vector<std::uint8_t> encoded(const Bitmap& bitmap, int depth = 8, int quarters = 0, int mirror = -1) {
    const std::unique_ptr<avifImage, decltype(&avifImageDestroy)> image(
        avifImageCreate(std::uint32_t(bitmap.width), std::uint32_t(bitmap.height), std::uint32_t(depth),
                        AVIF_PIXEL_FORMAT_YUV444),
        avifImageDestroy);
    image->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_IDENTITY;
    if (quarters > 0) {
        image->transformFlags |= AVIF_TRANSFORM_IROT;
        image->irot.angle = std::uint8_t(quarters);
    }
    if (mirror >= 0) {
        image->transformFlags |= AVIF_TRANSFORM_IMIR;
        image->imir.mode = std::uint8_t(mirror);
    }
    avifRGBImage rgb{};
    avifRGBImageSetDefaults(&rgb, image.get());
    rgb.depth = 8;
    std::vector<std::uint8_t> pixels = bitmap.rgba;
    rgb.pixels = pixels.data();
    rgb.rowBytes = std::uint32_t(bitmap.width) * 4;
    EXPECT_EQ(avifImageRGBToYUV(image.get(), &rgb), AVIF_RESULT_OK);
    const std::unique_ptr<avifEncoder, decltype(&avifEncoderDestroy)> encoder(avifEncoderCreate(),
                                                                              avifEncoderDestroy);
    encoder->minQuantizer = encoder->maxQuantizer = AVIF_QUANTIZER_LOSSLESS;
    encoder->minQuantizerAlpha = encoder->maxQuantizerAlpha = AVIF_QUANTIZER_LOSSLESS;
    encoder->speed = AVIF_SPEED_FASTEST;
    avifRWData output = AVIF_DATA_EMPTY;
    EXPECT_EQ(avifEncoderWrite(encoder.get(), image.get(), &output), AVIF_RESULT_OK);
    std::vector<std::uint8_t> bytes(output.data, output.data + output.size);
    avifRWDataFree(&output);
    return bytes;
}

std::vector<std::uint8_t> pixelAt(const Bitmap& bitmap, int x, int y) {
    const auto first = bitmap.rgba.begin() + 4 * (std::ptrdiff_t(y) * bitmap.width + x);
    return {first, first + 4};
}

TEST(Avif, EveryByteIsRead) {
    const Bitmap decoded = decode(encoded(sample()));
    EXPECT_EQ(decoded.width, width);
    EXPECT_EQ(decoded.height, height);
    EXPECT_EQ(decoded.rgba, sample().rgba);
}

TEST(Avif, DeepColoursAreRounded) {
    const Bitmap decoded = decode(encoded(sample(), 10)), expected = sample();
    ASSERT_EQ(decoded.rgba.size(), expected.rgba.size());
    for (std::size_t i = 0; i < expected.rgba.size(); ++i)
        EXPECT_NEAR(decoded.rgba[i], expected.rgba[i], 1) << i;
}

TEST(Avif, IsTurnedAnticlockwise) {
    const Bitmap from = sample(), one = decode(encoded(from, 8, 1)), two = decode(encoded(from, 8, 2)),
                 three = decode(encoded(from, 8, 3));
    EXPECT_EQ(one.width, height);
    EXPECT_EQ(pixelAt(one, 0, 0), pixelAt(from, width - 1, 0));
    EXPECT_EQ(pixelAt(one, 0, width - 1), pixelAt(from, 0, 0));
    EXPECT_EQ(pixelAt(two, 0, 0), pixelAt(from, width - 1, height - 1));
    EXPECT_EQ(pixelAt(three, 0, 0), pixelAt(from, 0, height - 1));
    EXPECT_EQ(pixelAt(three, height - 1, 0), pixelAt(from, 0, 0));
}

TEST(Avif, IsMirrored) {
    const Bitmap from = sample();
    EXPECT_EQ(pixelAt(decode(encoded(from, 8, 0, 0)), 0, 0), pixelAt(from, 0, height - 1));
    EXPECT_EQ(pixelAt(decode(encoded(from, 8, 0, 1)), 0, 0), pixelAt(from, width - 1, 0));
    EXPECT_EQ(pixelAt(decode(encoded(from, 8, 1, 1)), height - 1, 0), pixelAt(from, width - 1, 0));
}

TEST(Avif, DamagedFilesAreErrors) {
    const std::vector<std::uint8_t> whole = encoded(sample());
    for (std::size_t size = 12; size < whole.size(); ++size)
        EXPECT_THROW(decode(std::span(whole).first(size)), CodecError) << size;
    for (std::size_t i = 12; i < whole.size(); ++i) {
        std::vector<std::uint8_t> damaged = whole;
        damaged[i] ^= 0x55;
        try {
            EXPECT_GT(decode(damaged).width, 0);
        } catch (const CodecError&) {
        }
    }
}

#endif

}  // namespace
}  // namespace vtm::image
