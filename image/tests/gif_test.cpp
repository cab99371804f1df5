#include <gtest/gtest.h>

#include <vtm/image/codec.hpp>

namespace vtm::image {
namespace {

/// 2 x 2, palette black, white, red, (blue); one frame with the indices 1 2 2 1.
std::vector<std::uint8_t> checker() {
    return {'G',  'I',  'F',  '8',  '9', 'a', 2,   0, 2, 0, 0x81, 0,   0,  // screen, 4 colours
            0,    0,    0,    255,  255, 255, 255, 0, 0, 0, 0,    255,     // palette
            0x21, 0xf9, 4,    0,    0,   0,   0,   0,                      // graphic control
            0x2c, 0,    0,    0,    0,   2,   0,   2, 0, 0, 2,             // frame, 2-bit literals
            3,    0x8c, 0x14, 0x05, 0,   0x3b};  // clear 1 2 2 1 end in 3 bits each, 4 after the 8th entry
}

TEST(Gif, DecodesPaletteIndices) {
    const Bitmap bitmap = decode(checker());
    ASSERT_EQ(bitmap.width, 2);
    EXPECT_EQ(bitmap.rgba, (std::vector<std::uint8_t>{255, 255, 255, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255,
                                                      255, 255, 255}));
}

TEST(Gif, LeavesTheTransparentIndexClear) {
    std::vector<std::uint8_t> bytes = checker();
    bytes[28] = 1;  // transparency flag
    bytes[31] = 1;  // white
    EXPECT_EQ(decode(bytes).rgba,
              (std::vector<std::uint8_t>{0, 0, 0, 0, 255, 0, 0, 255, 255, 0, 0, 255, 0, 0, 0, 0}));
}

TEST(Gif, WithoutAFrameIsAnError) {
    std::vector<std::uint8_t> bytes = checker();
    bytes[33] = 0x3b;
    EXPECT_THROW(decode(bytes), CodecError);
}

}  // namespace
}  // namespace vtm::image
