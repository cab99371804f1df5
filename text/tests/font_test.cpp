#include "text/font.hpp"

#include <thread>

#include <hb.h>

#include "text/tests/support.hpp"

namespace vtm::text {
namespace {

class DejaVuSans : public testing::Test {
protected:
    GlyphId glyph(char32_t character) const { return font->glyphOf(character).value(); }

    FontSet set{optionsOf(dejavu)};
    std::shared_ptr<const Font> font = set.primary(family("DejaVu Sans"));
};

TEST_F(DejaVuSans, HasItsMetrics) {
    EXPECT_EQ(font->unitsPerEm(), 2048);
    const FontMetrics& m = font->metrics();
    EXPECT_EQ(m.ascent, 1901);
    EXPECT_EQ(m.descent, 483);
    EXPECT_EQ(m.xHeight, 1120);
    EXPECT_EQ(m.capHeight, 1493);
    EXPECT_EQ(m.underlineThickness, 90);
    EXPECT_EQ(m.underlineOffset, 40);
    EXPECT_EQ(m.strikeoutThickness, 102);
    EXPECT_EQ(m.strikeoutOffset, 530);
}
TEST_F(DejaVuSans, HasGlyphsAndAdvances) {
    EXPECT_FALSE(font->glyphOf(U'\U0003fffd'));
    EXPECT_EQ(font->advanceOf(glyph(U'H')), 1540);
}
TEST_F(DejaVuSans, OutlinesAreInFontUnitsDownwards) {
    const auto path = font->outlineOf(glyph(U'I'));
    ASSERT_NE(path, nullptr);
    double top = 0, bottom = 0;
    for (const scene::Command& command : *path) {
        const auto end = scene::endOf(command);
        if (!end)
            continue;
        top = std::min(top, end->y);
        bottom = std::max(bottom, end->y);
    }
    EXPECT_EQ(top, -1493);
    EXPECT_EQ(bottom, 0);
    EXPECT_TRUE(std::holds_alternative<scene::Close>(path->back()));
}
TEST_F(DejaVuSans, BlankGlyphsHaveNoOutline) { EXPECT_EQ(font->outlineOf(glyph(U' ')), nullptr); }
TEST_F(DejaVuSans, GlyphsOutsideTheFontHaveNoOutline) { EXPECT_EQ(font->outlineOf(0xfffffff), nullptr); }
TEST_F(DejaVuSans, OutlinesAreShared) {
    EXPECT_EQ(font->outlineOf(glyph(U'a')), font->outlineOf(glyph(U'a')));
}
TEST_F(DejaVuSans, ThreadsGetTheSameOutlines) {
    std::vector<std::shared_ptr<const scene::Path>> seen(4);
    std::vector<std::thread> threads;
    for (auto& path : seen)
        threads.emplace_back([&] { path = font->outlineOf(glyph(U'g')); });
    for (std::thread& thread : threads)
        thread.join();
    for (const auto& path : seen)
        EXPECT_EQ(path, seen[0]);
}
TEST_F(DejaVuSans, HarfBuzzHas64PositionsAUnit) {
    EXPECT_EQ(hb_font_get_glyph_h_advance(font->harfbuzz(), glyph(U'H')), 1540 * 64);
}

}  // namespace
}  // namespace vtm::text
