#include "asset/container.hpp"

#include <cstring>
#include <random>

#include <gtest/gtest.h>
#include <zlib.h>

#include "asset/evaluate.hpp"
#include "asset/testing.hpp"
#include "asset/testing_views.hpp"

namespace vtm::asset::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t headerBytes = 32, checksumOffset = 28;

void fixChecksum(Bytes& bytes) {
    const auto sum = std::uint32_t(crc32_z(0, bytes.data() + headerBytes, bytes.size() - headerBytes));
    std::memcpy(&bytes[checksumOffset], &sum, sizeof sum);
}

std::string refusal(const Bytes& bytes) {
    try {
        read(bytes);
    } catch (const FormatError& error) {
        return error.what();
    }
    return {};
}

/// Every section has records, pictures raw and compressed.
Asset sample() {
    Asset asset = everyPaint();
    image::Bitmap flat{32, 32, Bytes(32 * 32 * 4, 77)};
    asset.images.push_back(flat);
    asset.fallbackLeaves = 3;
    return asset;
}

TEST(Container, ReadsWhatItWrote) {
    for (const Asset& asset : {sample(), layers(), disc(), twoLevels(), emptyAsset()}) {
        const Asset copy = read(write(asset));
        EXPECT_EQ(write(copy), write(asset));
        EXPECT_EQ(copy.commands.size(), asset.commands.size());
        EXPECT_EQ(copy.fallbackLeaves, asset.fallbackLeaves);
        EXPECT_EQ(copy.images.size(), asset.images.size());
        ASSERT_EQ(copy.materials.size(), asset.materials.size());
        for (std::size_t i = 0; i < asset.materials.size(); ++i) {
            EXPECT_EQ(copy.materials[i].name, asset.materials[i].name);
            EXPECT_EQ(copy.materials[i].glsl, asset.materials[i].glsl);
        }
        for (std::size_t i = 0; i < asset.images.size(); ++i)
            EXPECT_EQ(copy.images[i].rgba, asset.images[i].rgba);
        const View view = turnedView(32, 32, {32, 32}, 0.7, 0.4);
        EXPECT_EQ(evaluate(copy, view).rgba, evaluate(asset, view).rgba);
    }
}

TEST(Container, SectionsBeginOnTexels) {
    const Bytes bytes = write(sample());
    for (std::size_t i = 0; i < 12; ++i) {
        std::uint64_t offset = 0;
        std::memcpy(&offset, &bytes[headerBytes + i * 32 + 8], sizeof offset);
        EXPECT_EQ(offset % 16, 0u);
    }
}

TEST(Container, RefusesEveryTruncation) {
    const Bytes bytes = write(sample());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        ASSERT_NE(refusal(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size))), "") << size;
}

TEST(Container, RefusesAnExtraByte) {
    Bytes bytes = write(sample());
    bytes.push_back(0);
    EXPECT_NE(refusal(bytes).find("bytes"), std::string::npos);
    std::uint64_t size = bytes.size();
    std::memcpy(&bytes[16], &size, sizeof size);
    fixChecksum(bytes);
    EXPECT_NE(refusal(bytes).find("left over"), std::string::npos);
}

TEST(Container, RefusesEveryFlippedBit) {
    Bytes bytes = write(disc());
    for (std::size_t i = 0; i < bytes.size() * 8; ++i) {
        bytes[i / 8] ^= std::uint8_t(1u << (i % 8));
        ASSERT_NE(refusal(bytes), "") << "bit " << i;
        bytes[i / 8] ^= std::uint8_t(1u << (i % 8));
    }
    EXPECT_EQ(refusal(bytes), "");
}

TEST(Container, NamesWhatIsWrongInTheHeader) {
    const auto changed = [](std::size_t offset) {
        Bytes bytes = write(disc());
        ++bytes[offset];
        return refusal(bytes);
    };
    EXPECT_EQ(changed(0), "offset 0: not a .vtm file");
    EXPECT_EQ(changed(8), "offset 8: version 2 is unknown");
    EXPECT_EQ(changed(12), "offset 12: byte order is not little-endian");
    EXPECT_EQ(changed(24), "offset 24: number of sections is wrong");
    EXPECT_EQ(changed(100), "offset 28: checksum does not match");
}

/// With the checksum put right, damage must still end in an error or in an asset that can be drawn.
TEST(Container, DamageBehindAGoodChecksumIsRefusedOrHarmless) {
    std::mt19937 random(9);
    for (const Asset& asset : {sample(), layers(), twoLevels()}) {
        const Bytes good = write(asset);
        int refused = 0;
        constexpr int rounds = 4000;
        for (int i = 0; i < rounds; ++i) {
            Bytes bytes = good;
            for (auto n = 1 + random() % 3; n > 0; --n) {
                const std::size_t place = headerBytes + random() % (bytes.size() - headerBytes);
                bytes[place] =
                    std::uint8_t(random() % 3 == 0 ? random() : bytes[place] ^ (1u << (random() % 8)));
            }
            fixChecksum(bytes);
            if (refusal(bytes) != "")
                ++refused;
            else
                evaluate(read(bytes), turnedView(6, 5, {32, 32}, 0.1, 0.3));
        }
        EXPECT_GT(refused, rounds / 10);
        EXPECT_LT(refused, rounds);
    }
}

}  // namespace
}  // namespace vtm::asset::test
