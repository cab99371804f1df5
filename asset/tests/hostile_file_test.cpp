// Whatever the bytes: an asset that can be drawn, or a FormatError that says where and why.

#include <functional>
#include <random>

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>
#include "asset/testing.hpp"
#include "asset/testing_files.hpp"
#include "raster/testing_views.hpp"

namespace vtm::asset::test {
namespace {

TEST(HostileFile, EveryTruncation) {
    const Bytes bytes = write(everySection());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        ASSERT_NE(refusal(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size))), "") << size;
}

/// The same with a header that says the size is right.
TEST(HostileFile, EveryTruncationThatTheHeaderConfirms) {
    const Bytes bytes = write(everySection());
    for (std::size_t size = headerBytes; size < bytes.size(); ++size) {
        Bytes cut(bytes.begin(), bytes.begin() + std::ptrdiff_t(size));
        setLongWord(cut, atFileBytes, size);
        fixChecksums(cut);
        ASSERT_NE(refusal(cut), "") << size;
    }
}

TEST(HostileFile, TrailingGarbage) {
    Bytes bytes = write(everySection());
    for (const std::size_t extra : {1, 64, 1000}) {
        Bytes longer = bytes;
        longer.resize(bytes.size() + extra);
        EXPECT_NE(refusal(longer).find("bytes instead of"), std::string::npos);
        setLongWord(longer, atFileBytes, longer.size());
        fixChecksums(longer);
        EXPECT_NE(refusal(longer).find("there are bytes after the last section"), std::string::npos);
    }
}

/// Checksums cover all bytes but padding, and padding must be zero.
TEST(HostileFile, EveryFlippedBit) {
    Bytes bytes = write(everySection());
    for (std::size_t i = 0; i < bytes.size() * 8; ++i) {
        bytes[i / 8] ^= std::uint8_t(1u << (i % 8));
        ASSERT_NE(refusal(bytes), "") << "bit " << i;
        bytes[i / 8] ^= std::uint8_t(1u << (i % 8));
    }
    EXPECT_EQ(refusal(bytes), "");
}

TEST(HostileFile, EveryInvertedByte) {
    Bytes bytes = write(everySection());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] ^= 0xFF;
        ASSERT_NE(refusal(bytes), "") << "byte " << i;
        bytes[i] ^= 0xFF;
    }
}

TEST(HostileFile, ADamagedSectionIsNamed) {
    const Bytes good = write(everySection());
    for (const SectionInfo& section : sectionsOf(good)) {
        Bytes bytes = good;
        bytes[section.offset + section.bytes() / 2] ^= 4;
        EXPECT_EQ(refusal(bytes), "offset " + std::to_string(section.offset) + ": section " + section.name +
                                      ": checksum does not match");
        int damaged = 0;
        for (const SectionInfo& found : sectionsOf(bytes)) {
            damaged += found.intact() ? 0 : 1;
            EXPECT_EQ(found.intact(), found.name != section.name);
        }
        EXPECT_EQ(damaged, 1);
    }
}

TEST(HostileFile, TheHeaderSaysWhatIsWrong) {
    const auto changed = [](std::size_t offset) {
        Bytes bytes = write(disc());
        ++bytes[offset];
        return refusal(bytes);
    };
    EXPECT_EQ(changed(0), "offset 0: not a .vtm file");
    EXPECT_EQ(changed(atVersion), "offset 8: version 3 is unknown; this reader knows 2");
    EXPECT_EQ(changed(atEndian), "offset 12: byte order is not little-endian");
    EXPECT_EQ(changed(atSections), "offset 28: checksum of header and section table does not match");
    EXPECT_EQ(changed(lineOf(3)), "offset 28: checksum of header and section table does not match");
}

TEST(HostileFile, AnOlderVersionIsRefused) {
    Bytes bytes = write(disc());
    setWord(bytes, atVersion, 1);
    fixChecksums(bytes);
    EXPECT_EQ(refusal(bytes), "offset 8: version 1 is unknown; this reader knows 2");
}

// ---- Behind good checksums -------------------------------------------------------------------------

/// One change of the table, after which the checksums are put right; the message must hold the text.
struct Breach {
    const char* message;
    std::function<void(Bytes&)> change;
};

constexpr std::size_t leaves = 4, pieces = 5;  // lines of the table

void move(Bytes& file, std::size_t section, std::int64_t by) {
    const std::size_t at = lineOf(section) + atOffset;
    setLongWord(file, at, longWord(file, at) + std::uint64_t(by));
}

const std::vector<Breach> breaches{
    {"number of sections is too large", [](Bytes& f) { setWord(f, atSections, 0xFFFFFFFF); }},
    {"section picture: is missing",
     [](Bytes& f) {
         f.resize(64);
         setWord(f, atSections, 0);
         setLongWord(f, atFileBytes, 64);
         std::fill(f.begin() + headerBytes, f.end(), std::uint8_t(0));
     }},
    {"offset 64: section picture: kinds do not ascend", [](Bytes& f) { setWord(f, lineOf(1) + atKind, 0); }},
    {"section leaves: kinds do not ascend", [](Bytes& f) { setWord(f, lineOf(3) + atKind, 4); }},
    {"section data: is missing",  // the kinds of the lines behind it move up
     [](Bytes& f) {
         f = withSection(f, 0x80000001u, 4, 1);
         for (std::uint32_t kind = 8; kind <= 10; ++kind)
             setWord(f, lineOf(kind - 1) + atKind, kind);
     }},
    {"section 0x14: kind is unknown", [](Bytes& f) { f = withSection(f, 20, 4, 1); }},
    {"section 0x7fffffff: kind is unknown", [](Bytes& f) { f = withSection(f, 0x7FFFFFFF, 4, 1); }},
    {"section leaves: unused word is not zero", [](Bytes& f) { setWord(f, lineOf(leaves) + atUnused, 1); }},
    {"section leaves: records have no size", [](Bytes& f) { setWord(f, lineOf(leaves) + atRecordBytes, 0); }},
    {"section leaves: size of its records is 8, not 16",
     [](Bytes& f) {
         setWord(f, lineOf(leaves) + atRecordBytes, 8);
         setLongWord(f, lineOf(leaves) + atCount, longWord(f, lineOf(leaves) + atCount) * 2);
     }},
    {"section pieces: does not begin where the section before ends", [](Bytes& f) { move(f, pieces, -64); }},
    {"section pieces: does not begin where the section before ends", [](Bytes& f) { move(f, pieces, 64); }},
    {"section pieces: does not begin where the section before ends", [](Bytes& f) { move(f, pieces, 16); }},
    {"section pieces: does not begin where the section before ends",
     [](Bytes& f) { setLongWord(f, lineOf(pieces) + atOffset, ~0ull - 63); }},
    {"section pieces: reaches beyond the end of the file",
     [](Bytes& f) { setLongWord(f, lineOf(pieces) + atCount, 1ull << 40); }},
    {"section pieces: reaches beyond the end of the file",
     [](Bytes& f) { setLongWord(f, lineOf(pieces) + atCount, 1ull << 60); }},  // * 16 is 0
    {"section pieces: reaches beyond the end of the file",
     [](Bytes& f) { setLongWord(f, lineOf(pieces) + atCount, ~0ull); }},
    {"section paints: does not begin where the section before ends",
     [](Bytes& f) { setLongWord(f, lineOf(pieces) + atCount, longWord(f, lineOf(pieces) + atCount) + 4); }},
    {"padding is not zero",
     [](Bytes& f) { setLongWord(f, lineOf(pieces) + atCount, longWord(f, lineOf(pieces) + atCount) - 1); }},
    {"section prefilter: is empty and should be left out", [](Bytes& f) { f = withSection(f, 10, 4, 0); }},
    {"prefilter[0]: there are texels without a size", [](Bytes& f) { f = withSection(f, 10, 4, 1); }},
};

TEST(HostileFile, TheTableIsCheckedBehindGoodChecksums) {
    const Bytes good = write(disc());
    for (const Breach& breach : breaches) {
        Bytes bytes = good;
        breach.change(bytes);
        fixChecksums(bytes);
        EXPECT_NE(refusal(bytes).find(breach.message), std::string::npos)
            << breach.message << "\nbut was: " << refusal(bytes);
    }
}

/// With the checksums put right, damage must still end in an error or in an asset that can be drawn.
TEST(HostileFile, DamageBehindGoodChecksumsIsRefusedOrHarmless) {
    std::mt19937 random(9);
    for (const Asset& asset : {everySection(), layers(), twoLevels(), placedMaps(), filtered()}) {
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
            fixChecksums(bytes);
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
