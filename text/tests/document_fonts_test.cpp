#include <hb.h>
#include <woff2/encode.h>
#include <zlib.h>

#include "text/font_set.hpp"
#include "text/tests/sfnt.hpp"
#include "text/tests/support.hpp"

namespace vtm::text {
namespace {

const Bytes& dejavuSans() {
    static const Bytes bytes = bytesOf(dejavu / "DejaVuSans.ttf");
    return bytes;
}

Bytes woffOf(const Bytes& sfnt) {
    const std::vector<Table> tables = tablesOf(sfnt);
    Bytes woff, data;
    append(woff, HB_TAG('w', 'O', 'F', 'F'), 4);
    append(woff, numberAt(sfnt, 0, 4), 4);
    append(woff, 0, 4);
    append(woff, std::uint32_t(tables.size()), 2);
    woff.resize(44);
    const std::size_t start = 44 + 20 * tables.size();
    for (const Table& table : tables) {
        Bytes packed(compressBound(table.bytes.size()));
        uLongf size = packed.size();
        compress(packed.data(), &size, table.bytes.data(), table.bytes.size());
        packed.resize(size);
        if (size >= table.bytes.size())
            packed = table.bytes;
        append(woff, table.tag, 4);
        append(woff, std::uint32_t(start + data.size()), 4);
        append(woff, std::uint32_t(packed.size()), 4);
        append(woff, std::uint32_t(table.bytes.size()), 4);
        append(woff, table.checksum, 4);
        data.insert(data.end(), packed.begin(), packed.end());
    }
    woff.insert(woff.end(), data.begin(), data.end());
    return woff;
}

Bytes woff2Of(const Bytes& sfnt) {
    Bytes woff(woff2::MaxWOFF2CompressedSize(sfnt.data(), sfnt.size()));
    std::size_t size = woff.size();
    woff2::WOFF2Params fast;
    fast.brotli_quality = 1;
    EXPECT_TRUE(woff2::ConvertTTFToWOFF2(sfnt.data(), sfnt.size(), woff.data(), &size, fast));
    woff.resize(size);
    return woff;
}

FontFace faceOf(const std::string& family) {
    FontFace face;
    face.family = family;
    return face;
}

class DocumentFont : public testing::Test {
protected:
    FontSet set{optionsOf("/nowhere/at/all")};

    /// The outline of `g` is that of DejaVu Sans.
    void expectDejaVu(const std::shared_ptr<const Font>& font) {
        ASSERT_NE(font, nullptr);
        FontSet known(optionsOf(dejavu));
        const auto expected = known.primary(family("DejaVu Sans"));
        const auto path = font->outlineOf(font->glyphOf(U'g').value());
        ASSERT_NE(path, nullptr);
        EXPECT_EQ(path->size(), expected->outlineOf(expected->glyphOf(U'g').value())->size());
        EXPECT_EQ(font->advanceOf(font->glyphOf(U'g').value()), 1300);
    }
};

TEST_F(DocumentFont, OfTrueType) {
    set.add(faceOf("Mine"), dejavuSans());
    EXPECT_TRUE(set.hasFamily("mine"));
    expectDejaVu(set.primary(family("Mine")));
}
TEST_F(DocumentFont, OfWoff) {
    set.add(faceOf("Mine"), woffOf(dejavuSans()));
    expectDejaVu(set.primary(family("Mine")));
}
TEST_F(DocumentFont, OfWoff2) {
    set.add(faceOf("Mine"), woff2Of(dejavuSans()));
    expectDejaVu(set.primary(family("Mine")));
}
TEST_F(DocumentFont, OfACollection) {
    Bytes collection;
    append(collection, HB_TAG('t', 't', 'c', 'f'), 4);
    append(collection, 0x00010000, 4);
    append(collection, 1, 4);
    append(collection, 16, 4);
    std::vector<Table> tables = tablesOf(dejavuSans());
    Bytes font = text::sfntOf(tables);
    for (std::size_t i = 0; i < tables.size(); ++i) {  // offsets count from the collection's start
        Bytes moved;
        append(moved, numberAt(font, 12 + 16 * i + 8, 4) + 16, 4);
        std::copy(moved.begin(), moved.end(), font.begin() + std::ptrdiff_t(12 + 16 * i + 8));
    }
    collection.insert(collection.end(), font.begin(), font.end());
    set.add(faceOf("Mine"), collection);
    expectDejaVu(set.primary(family("Mine")));
}
TEST_F(DocumentFont, TakesThePlaceOfAnInstalledFamily) {
    FontSet installed(optionsOf(dejavu));
    const auto before = installed.primary(family("DejaVu Sans"));
    installed.add(faceOf("dejavu sans"), bytesOf(dejavu / "DejaVuSansMono.ttf"));
    const auto after = installed.primary(family("DejaVu Sans"));
    EXPECT_NE(before, after);
    EXPECT_EQ(after->advanceOf(after->glyphOf(U'i').value()), 1233);
}
TEST_F(DocumentFont, IsChosenByItsRulesWeights) {
    FontFace light = faceOf("Mine"), bold = faceOf("Mine");
    light.maxWeight = 500;
    bold.minWeight = bold.maxWeight = 800;
    set.add(light, dejavuSans());
    set.add(bold, bytesOf(dejavu / "DejaVuSans-Bold.ttf"));
    const auto advance = [&](double weight) {
        const auto font = set.primary(family("Mine", weight));
        return font->advanceOf(font->glyphOf(U'g').value());
    };
    EXPECT_EQ(advance(300), 1300);
    EXPECT_EQ(advance(500), 1300);
    EXPECT_EQ(advance(501), 1466) << "the weight in DejaVu's own tables does not count";
}
TEST_F(DocumentFont, StandsForTheCharactersOfItsRuleOnly) {
    FontFace digits = faceOf("Mine"), letters = faceOf("Mine");
    digits.characters = {{U'0', U'9'}};
    letters.characters = {{U' ', U' '}, {U'a', U'z'}};
    set.add(letters, dejavuSans());
    set.add(digits, bytesOf(dejavu / "DejaVuSansMono.ttf"));
    const FontQuery mine = family("Mine");
    EXPECT_EQ(set.primary(mine), set.covering(mine, U"x")) << "the primary font is that of the space";
    EXPECT_NE(set.covering(mine, U"1"), set.covering(mine, U"x"));
    EXPECT_EQ(set.covering(mine, U"A"), nullptr);
}
TEST_F(DocumentFont, LaterRulesWin) {
    set.add(faceOf("Mine"), dejavuSans());
    set.add(faceOf("Mine"), bytesOf(dejavu / "DejaVuSans-Bold.ttf"));
    const auto font = set.primary(family("Mine"));
    EXPECT_EQ(font->advanceOf(font->glyphOf(U'g').value()), 1466);
}

/// What add() says of the bytes; empty if it takes them.
std::string complaint(const Bytes& bytes) {
    FontSet set(optionsOf("/nowhere/at/all"));
    try {
        set.add(faceOf("Mine"), bytes);
    } catch (const FontError& error) {
        return error.what();
    }
    return "";
}

TEST(BrokenDocumentFont, IsNamed) {
    EXPECT_EQ(complaint({}), "neither OpenType nor WOFF");
    EXPECT_EQ(complaint({'P', 'K', 3, 4, 0, 0}), "neither OpenType nor WOFF");
    EXPECT_EQ(complaint({0, 1, 0, 0}), "the font has no glyphs");
    EXPECT_EQ(complaint({'w', 'O', 'F', 'F', 0}), "WOFF ends in its header");
    EXPECT_EQ(complaint({'w', 'O', 'F', '2', 0}), "WOFF2 cannot be decompressed");
}
TEST(BrokenDocumentFont, WoffIsBounded) {
    Bytes bomb = woffOf(dejavuSans());
    for (int i = 0; i < 4; ++i)
        bomb[44 + 12 + std::size_t(i)] = 0xff;  // the first table's size
    EXPECT_EQ(complaint(bomb).substr(0, 10), "WOFF holds");
}
TEST(BrokenDocumentFont, TablesOutsideOfWoffAreFound) {
    Bytes cut = woffOf(dejavuSans());
    cut.resize(cut.size() / 2);
    EXPECT_EQ(complaint(cut), "a table of WOFF lies outside the file");
}
TEST(BrokenDocumentFont, Woff2IsBounded) {
    std::vector<Table> tables = tablesOf(dejavuSans());
    tables.push_back({HB_TAG('z', 'e', 'r', 'o'), 0, Bytes(150u << 20)});
    const Bytes bomb = woff2Of(text::sfntOf(tables));
    EXPECT_LT(bomb.size(), 2u << 20);
    EXPECT_NE(complaint(bomb), "");
}
TEST(BrokenDocumentFont, EveryTruncationOfWoff2IsFound) {
    const Bytes whole = woff2Of(dejavuSans());
    for (std::size_t size = 1; size < whole.size(); size += 1 + size / 3)
        EXPECT_NE(complaint(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size))), "") << size;
}

}  // namespace
}  // namespace vtm::text
