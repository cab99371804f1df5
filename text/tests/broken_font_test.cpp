// Fonts that are cut, overwritten or made to take forever.
#include <hb.h>

#include <random>

#include "text/shape.hpp"
#include "text/tests/sfnt.hpp"
#include "text/tests/support.hpp"

namespace vtm::text {
namespace {

/// Shapes a line with the font and draws some of its glyphs. False if it was refused.
bool use(const Bytes& bytes) {
    FontSet set(optionsOf("/nowhere/at/all"));
    FontFace face;
    face.family = "Broken";
    try {
        set.add(face, bytes);
    } catch (const FontError& error) {
        EXPECT_STRNE(error.what(), "");
        return false;
    }
    Line line;
    line.text = U"fi Äg\u0301ب\U0001f600";
    line.spans.push_back({line.text.size(), family("Broken"), {}, "en"});
    for (const Cluster& cluster : shape(line, set))
        for (const Glyph& glyph : cluster.glyphs)
            glyph.font->outlineOf(glyph.id);
    const auto font = set.primary(family("Broken"));
    for (GlyphId glyph = 0; font && glyph < 300; glyph += 7) {
        font->outlineOf(glyph);
        font->advanceOf(glyph);
        font->colorGlyphOf(glyph, {});
    }
    return true;
}

std::vector<std::filesystem::path> fonts() {
    std::vector<std::filesystem::path> paths{dejavu / "DejaVuSans.ttf", dejavu / "DejaVuSansMono-Bold.ttf",
                                             dejavu / "DejaVuSerif.ttf"};
    for (const char* name : {"NotoColorEmojiCOLR.subset.ttf", "NotoColorEmojiCBDT.subset.ttf",
                             "CFF-and-SBIX.otf", "RobotoFlex.subset.ttf", "TwitterColorEmoji.subset.ttf"})
        if (std::filesystem::exists(suiteFonts() / name))
            paths.push_back(suiteFonts() / name);
    return paths;
}

TEST(BrokenFont, CutAtEveryTable) {
    for (const auto& path : fonts()) {
        const std::vector<Table> tables = tablesOf(bytesOf(path));
        for (std::size_t i = 0; i < tables.size(); ++i)
            for (const std::size_t size : {std::size_t(0), std::size_t(1), tables[i].bytes.size() / 2}) {
                std::vector<Table> cut = tables;
                cut[i].bytes.resize(std::min(size, cut[i].bytes.size()));
                use(sfntOf(cut, numberAt(bytesOf(path), 0, 4)));
            }
    }
}
TEST(BrokenFont, FilesCutWithinEveryTable) {
    for (const auto& path : fonts()) {
        const Bytes whole = bytesOf(path);
        for (std::size_t i = 0; i < numberAt(whole, 4, 2); ++i) {
            const std::size_t begin = numberAt(whole, 12 + 16 * i + 8, 4),
                              size = numberAt(whole, 12 + 16 * i + 12, 4);
            for (const std::size_t end : {begin, begin + size / 2})
                use(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(std::min(end, whole.size()))));
        }
    }
}
TEST(BrokenFont, BytesAtRandom) {
    std::mt19937 random(15);
    for (const auto& path : fonts()) {
        const std::vector<Table> tables = tablesOf(bytesOf(path));
        for (const Table& chosen : tables) {
            std::vector<Table> changed = tables;
            Bytes& bytes = changed[std::size_t(&chosen - tables.data())].bytes;
            for (int n = 0; n < 20 && !bytes.empty(); ++n)
                bytes[random() % std::min<std::size_t>(bytes.size(), 256)] = std::uint8_t(random());
            use(sfntOf(changed, numberAt(bytesOf(path), 0, 4)));
        }
    }
}

/// DejaVu Sans whose glyph n, from `first` on, is made of glyph n + 1 `copies` times; the last is empty.
Bytes tower(GlyphId first, GlyphId levels, int copies) {
    std::vector<Table> tables = tablesOf(bytesOf(dejavu / "DejaVuSans.ttf"));
    Bytes glyf, loca;
    for (GlyphId glyph = 0; glyph <= 6000; ++glyph) {
        append(loca, std::uint32_t(glyf.size()), 4);
        if (glyph < first || glyph >= first + levels)
            continue;
        append(glyf, 0xffff, 2);
        append(glyf, 0, 8 - 4);
        append(glyf, 0, 4);
        for (int i = 0; i < copies; ++i) {
            append(glyf, i + 1 < copies ? 0x22 : 0x02, 2);
            append(glyf, glyph + 1, 2);
            append(glyf, 0, 2);
        }
    }
    for (Table& table : tables) {
        if (table.tag == HB_TAG('g', 'l', 'y', 'f'))
            table.bytes = glyf;
        if (table.tag == HB_TAG('l', 'o', 'c', 'a'))
            table.bytes = loca;
    }
    return sfntOf(tables);
}

TEST(BrokenFont, CompositesOfCompositesAreBounded) {
    EXPECT_TRUE(use(tower(100, 3, 10)));
    EXPECT_FALSE(use(tower(100, 40, 10))) << "10 to the power of 40 parts";
    EXPECT_FALSE(use(tower(5, 1, 70000 * 2))) << "very many components";
}

}  // namespace
}  // namespace vtm::text
