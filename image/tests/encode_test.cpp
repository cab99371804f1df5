#include <vtm/image/encode.hpp>

#include <gtest/gtest.h>
#include <png.h>
#include <tbb/task_arena.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <span>
#include <string>

#include "image/src/deflate_join.hpp"

namespace vtm::image {
namespace {

Bitmap bitmapOf(int width, int height) {
    return {width, height, std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height) * 4)};
}

/// Every pixel by its place.
template <class Color>
Bitmap drawn(int width, int height, Color color) {
    Bitmap bitmap = bitmapOf(width, height);
    std::uint8_t* at = bitmap.rgba.data();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int channel : color(x, y))
                *at++ = std::uint8_t(channel);
    return bitmap;
}

using Channels = std::array<int, 4>;

Bitmap flat(int width, int height) {
    return drawn(width, height, [](int x, int y) {
        return x / 7 % 2 == y / 5 % 2 ? Channels{9, 80, 200, 255} : Channels{};
    });
}
Bitmap gradient(int width, int height) {
    return drawn(width, height, [](int x, int y) { return Channels{x, y, x + y, 255 - x}; });
}
/// As a paint varies in a picture.
Bitmap smooth(int width, int height) {
    return drawn(width, height, [](int x, int y) {
        const auto wave = [](double at) { return int(127.5 + 127 * std::sin(at)); };
        return Channels{wave(x * 0.02 + y * 0.01), wave(x * y * 0.0001), wave(y * 0.03), 255};
    });
}
/// Rings with soft edges.
Bitmap shape(int width, int height) {
    return drawn(width, height, [=](int x, int y) {
        const double inside = 6 * std::sin(std::hypot(x - width / 2.0, y - height / 3.0) / 6);
        return Channels{200, 30, 40, int(255 * std::clamp(inside, 0.0, 1.0))};
    });
}
Bitmap noise(int width, int height) {
    std::minstd_rand random(5);
    return drawn(width, height, [&](int, int) {
        return Channels{int(random() >> 8), int(random() >> 8), int(random() >> 8), int(random() >> 8)};
    });
}

int worst(const Bitmap& a, const Bitmap& b) {
    int maximum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        maximum = std::max(maximum, std::abs(a.rgba[i] - b.rgba[i]));
    return maximum;
}

TEST(PngEncoder, KeepsEveryPixel) {
    // Fewer rows than a sample, a band and a row, more bands than one, a last band that is short.
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {40, 129}, {1, 300}, {700, 1}, {255, 256}})
        for (const Bitmap& bitmap : {flat(width, height), gradient(width, height), noise(width, height)})
            EXPECT_EQ(decode(encode(bitmap, FileFormat::Png)).rgba, bitmap.rgba) << width << " x " << height;
}

TEST(PngEncoder, KeepsEveryPixelInManyParts) {
    for (const Bitmap& large : {gradient(4200, 1100), noise(1100, 1024), flat(1024, 1025), shape(1500, 900)})
        EXPECT_EQ(decode(encode(large, FileFormat::Png)).rgba, large.rgba);
}

TEST(PngEncoder, OneThreadAndManyGiveTheSameBytes) {
    const Bitmap bitmap = shape(1500, 2000);
    const auto encoded = [&](int threads) {
        std::vector<std::uint8_t> bytes;
        tbb::task_arena(threads).execute([&] { bytes = encode(bitmap, FileFormat::Png); });
        return bytes;
    };
    EXPECT_EQ(encoded(1), encoded(4));
}

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes, int level, int strategy) {
    z_stream stream{};
    deflateInit2(&stream, level, Z_DEFLATED, -MAX_WBITS, 9, strategy);
    std::vector<std::uint8_t> result(2 * bytes.size() + 64);
    stream.next_in = const_cast<Bytef*>(bytes.data());
    stream.avail_in = uInt(bytes.size());
    stream.next_out = result.data();
    stream.avail_out = uInt(result.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    result.resize(stream.total_out);
    deflateEnd(&stream);
    return result;
}

std::vector<std::uint8_t> inflated(std::span<const std::uint8_t> bytes, std::size_t size) {
    z_stream stream{};
    inflateInit2(&stream, -MAX_WBITS);
    std::vector<std::uint8_t> result(size);
    stream.next_in = const_cast<Bytef*>(bytes.data());
    stream.avail_in = uInt(bytes.size());
    stream.next_out = result.data();
    stream.avail_out = uInt(result.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    inflateEnd(&stream);
    return result;
}

/// Blocks of all three kinds, streams that end at every place of a byte.
TEST(DeflateJoin, StreamsAreJoined) {
    for (const int side : {1, 2, 3, 5, 8, 13, 40, 301})
        for (const auto& [level, strategy] :
             {std::pair{0, Z_DEFAULT_STRATEGY}, {6, Z_FIXED}, {6, Z_DEFAULT_STRATEGY}, {9, Z_HUFFMAN_ONLY}})
            for (const Bitmap& bitmap : {shape(side, side), noise(side, side)}) {
                std::vector<std::uint8_t> joined = deflated(bitmap.rgba, level, strategy);
                openEnd(joined);
                const std::vector<std::uint8_t> last = deflated(bitmap.rgba, level, strategy);
                joined.insert(joined.end(), last.begin(), last.end());
                std::vector<std::uint8_t> twice = bitmap.rgba;
                twice.insert(twice.end(), bitmap.rgba.begin(), bitmap.rgba.end());
                EXPECT_EQ(inflated(joined, twice.size()), twice) << side << ", level " << level;
            }
}

TEST(DeflateJoin, RefusesWhatIsNoStream) {
    for (const std::vector<std::uint8_t>& bytes :
         {std::vector<std::uint8_t>{}, {7}, {5, 0, 0}, {1, 9, 0, 0xf6, 0xff}})
        EXPECT_THROW(findLastBlock(bytes), CodecError);
}

/// Bytes of libpng's file with its own choices, which cairo and others write.
std::size_t usualSize(const Bitmap& bitmap) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(bitmap.width);
    image.height = png_uint_32(bitmap.height);
    image.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = 0;
    png_image_write_get_memory_size(image, size, 0, bitmap.rgba.data(), 0, nullptr);
    return size;
}

/// Bytes of the rows as they are, deflated by zlib's best level.
std::size_t unfilteredSize(const Bitmap& bitmap) {
    std::vector<std::uint8_t> deflated(compressBound(bitmap.rgba.size()));
    uLongf size = deflated.size();
    compress2(deflated.data(), &size, bitmap.rgba.data(), bitmap.rgba.size(), Z_BEST_COMPRESSION);
    return size;
}

TEST(PngEncoder, ShapesAreSmallerThanUsual) {
    EXPECT_LT(encode(shape(300, 300), FileFormat::Png).size(), usualSize(shape(300, 300)));
}

TEST(PngEncoder, SmoothPicturesAreFiltered) {
    // Without a filter nearly every byte of them differs from its neighbours.
    const Bitmap bitmap = smooth(300, 300);
    EXPECT_LT(2 * encode(bitmap, FileFormat::Png).size(), unfilteredSize(bitmap));
}

TEST(PngEncoder, SixteenBitsAreWrittenAsTheyAre) {
    const auto encoder = makeEncoder(FileFormat::Png, 2, 1, {.depth = 16});
    const std::vector<std::uint8_t> row{1, 2, 3, 4, 5, 6, 255, 255, 0, 0, 0, 1, 128, 0, 64, 0};
    encoder->add(row);
    const Bitmap decoded = decode(encoder->finish());  // 8 bits of it
    EXPECT_EQ(decoded.width, 2);
    EXPECT_EQ(decoded.rgba[3], 255);
    EXPECT_EQ(decoded.rgba[7], 64);
}

TEST(PngEncoder, SixteenBitsWithoutAGammaAreSrgb) {
    const auto encoder = makeEncoder(FileFormat::Png, 2, 1, {.depth = 16});
    encoder->add(std::vector<std::uint8_t>{0x40, 0x40, 0x80, 0x80, 0xC0, 0xC0, 255, 255, 0, 0, 1, 1, 10, 10,
                                           255, 255});
    EXPECT_EQ(decode(encoder->finish()).rgba,
              (std::vector<std::uint8_t>{0x40, 0x80, 0xC0, 255, 0, 1, 10, 255}));
}

TEST(JpegEncoder, IsCloseAndQualityCounts) {
    Bitmap picture = gradient(64, 48);
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
        picture.rgba[i] = 255;
    const auto fine = encode(picture, FileFormat::Jpeg, {.quality = 95}),
               rough = encode(picture, FileFormat::Jpeg, {.quality = 20});
    EXPECT_LT(worst(decode(fine), picture), 16);
    EXPECT_LT(rough.size(), fine.size());
}

TEST(WebpEncoder, KeepsEveryPixelWithoutAQuality) {
    for (const Bitmap& bitmap : {flat(50, 30), gradient(50, 30), noise(50, 30)})
        EXPECT_EQ(decode(encode(bitmap, FileFormat::Webp)).rgba, bitmap.rgba);
    const Bitmap picture = noise(64, 64);
    EXPECT_LT(encode(picture, FileFormat::Webp, {.quality = 20}).size(),
              encode(picture, FileFormat::Webp).size() / 2);
}

TEST(PpmEncoder, IsAHeaderAndTheColours) {
    const std::string expected = "P6\n2 1\n255\n\x01\x02\x03\x09\x08\x07";
    const std::vector<std::uint8_t> file = encode({2, 1, {1, 2, 3, 255, 9, 8, 7, 255}}, FileFormat::Ppm);
    EXPECT_EQ(std::string(file.begin(), file.end()), expected);
    const auto deep = makeEncoder(FileFormat::Ppm, 1, 1, {.depth = 16});
    deep->add(std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 255, 255});
    const std::vector<std::uint8_t> deepFile = deep->finish();
    EXPECT_EQ(std::string(deepFile.begin(), deepFile.end()), "P6\n1 1\n65535\n\x01\x02\x03\x04\x05\x06");
}

TEST(Encoders, RefuseWhatTheFormatDoesNotHave) {
    EXPECT_THROW(makeEncoder(FileFormat::Png, 0, 1), CodecError);
    EXPECT_THROW(makeEncoder(FileFormat::Webp, 16384, 1), CodecError);
    EXPECT_THROW(makeEncoder(FileFormat::Jpeg, 1, 65501), CodecError);
    EXPECT_THROW(makeEncoder(FileFormat::Jpeg, 1, 1, {.depth = 16}), std::invalid_argument);
    EXPECT_THROW(makeEncoder(FileFormat::Png, 1, 1, {.depth = 12}), std::invalid_argument);
    EXPECT_THROW(makeEncoder(FileFormat::Jpeg, 1, 1, {.quality = 0}), std::invalid_argument);
}

TEST(Encoders, SuffixesNameTheFormat) {
    EXPECT_EQ(formatOfSuffix(".jpeg"), FileFormat::Jpeg);
    EXPECT_EQ(formatOfSuffix(".webp"), FileFormat::Webp);
    EXPECT_FALSE(formatOfSuffix(".gif"));
    EXPECT_FALSE(formatOfSuffix(""));
}

}  // namespace
}  // namespace vtm::image
