// Text by the items that it becomes. Pictures of text are the business of conformance/suites/svg_text.

#include <filesystem>

#include "svg/geometry/path_geometry.hpp"
#include "svg/geometry/path_measure.hpp"
#include "svg/tests/support.hpp"
#include "svg/text/content.hpp"

namespace vtm::svg {
namespace {

/// DejaVu, of which the tests know some numbers: 2048 units an em, advances of "i" 569 and "H" 1540.
constexpr const char* fontDirectory = "/usr/share/fonts/truetype/dejavu";
constexpr double unitsPerEm = 2048, advanceOfI = 569, advanceOfH = 1540;

class Text : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(fontDirectory))
            GTEST_SKIP() << "the DejaVu fonts are absent (fonts-dejavu-core)";
    }

    static Document load(const std::string& body) {
        Options options;
        options.fonts.directories = {fontDirectory};
        options.fonts.systemFonts = false;
        return loadText(document("<g font-family='DejaVu Sans' font-size='20.48'>" + body + "</g>"), options);
    }
    static std::vector<scene::Item> items(const std::string& body) { return itemsOf(load(body)); }
    /// Where the glyphs' origins are.
    static std::vector<double> starts(const std::string& body) {
        std::vector<double> found;
        for (const scene::Item& item : items(body))
            found.push_back(item.transform[2].x);
        return found;
    }
    static void expectNear(const std::vector<double>& actual, const std::vector<double>& expected) {
        ASSERT_EQ(actual.size(), expected.size());
        for (std::size_t i = 0; i < actual.size(); ++i)
            EXPECT_NEAR(actual[i], expected[i], 1e-9) << i;
    }
};

TEST_F(Text, StandsAtItsPositionByItsAdvances) {
    expectNear(starts("<text x='5'>Hi</text>"), {5, 5 + advanceOfH / 100});
    expectNear(starts("<text x='5 50'>Hi</text>"), {5, 50});
    expectNear(starts("<text x='5' dx='1 2'>Hi</text>"), {6, 8 + advanceOfH / 100});
}
TEST_F(Text, IsAnchored) {
    expectNear(starts("<text x='50' text-anchor='end'>i</text>"), {50 - advanceOfI / 100});
    expectNear(starts("<text x='50' text-anchor='middle'>i</text>"), {50 - advanceOfI / 200});
    expectNear(starts("<text direction='rtl' x='50'>i</text>"), {50 - advanceOfI / 100});
}
TEST_F(Text, GoesOnWhereTheLastChunkEnded) {
    const double alef = starts("<text>\u05d0\u05d0</text>")[1], bet = starts("<text>\u05d1\u05d1</text>")[1],
                 gimel = starts("<text>\u05d2\u05d2</text>")[1];
    // In a line to the right the second chunk begins with its leftmost letter, which is its last.
    expectNear(starts("<text x='50' y='5 20'>\u05d0\u05d1\u05d2</text>"), {50, 50 + alef, 50 + alef + gimel});
    expectNear(starts("<text x='50' y='5 20' dx='0 0 3'>\u05d0\u05d1\u05d2</text>"),
               {50, 53 + alef, 50 + alef + gimel});
    // In a line to the left chunks go on to the left.
    expectNear(starts("<text x='50' y='5 20' direction='rtl'>\u05d0\u05d1\u05d2</text>"),
               {50 - alef, 50 - alef - bet - gimel, 50 - alef - bet});
    expectNear(
        starts("<text x='50' y='5 20' direction='rtl'>HiH</text>"),
        {50 - advanceOfH / 100, 50 - 2 * advanceOfH / 100 - advanceOfI / 100, 50 - 2 * advanceOfH / 100});
}
TEST_F(Text, LeavesMarksWithTheirBases) {
    expectNear(starts("<text x='5 50'>i\u0301H</text>"), starts("<text x='5 50'>\u00edH</text>"));
    expectNear(starts("<text x='5 50 70'>i\u0301H</text>"), starts("<text x='5 70'>\u00edH</text>"));
}
TEST_F(Text, SharesTheOutlinesOfItsGlyphs) {
    const auto found = items("<text>ii</text><text font-size='40'>i</text>");
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].path, found[1].path);
    EXPECT_EQ(found[0].path, found[2].path);
}
TEST_F(Text, KnowsTheElementAndTheCharacterOfEachGlyph) {
    const auto found = items("<text> H <tspan>i</tspan></text>");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_STREQ(found[0].place.element, "text");
    EXPECT_EQ(found[0].place.character, 1u);
    EXPECT_STREQ(found[1].place.element, "tspan");
    EXPECT_EQ(found[1].place.character, 3u);
}
TEST_F(Text, CollapsesWhiteSpace) {
    expectNear(starts("<text>  i\n  <tspan> </tspan> i </text>"), starts("<text>i i</text>"));
    EXPECT_EQ(starts("<text xml:space='preserve'> i</text>")[0],
              starts("<text style='white-space:pre'> i</text>")[0]);
    EXPECT_GT(starts("<text xml:space='preserve'> i</text>")[0], 0);
}
TEST_F(Text, HasTheLengthThatIsAskedFor) {
    expectNear(starts("<text textLength='100'>HH</text>"), {0, 100 - advanceOfH / 100});
    const auto stretched = items("<text textLength='100' lengthAdjust='spacingAndGlyphs'>HH</text>");
    ASSERT_EQ(stretched.size(), 2u);
    EXPECT_NEAR(stretched[1].transform[2].x, 50, 1e-9);
    EXPECT_NEAR(stretched[0].transform[0].x * unitsPerEm / 20.48, 50 / (advanceOfH / 100), 1e-9);
}
TEST_F(Text, SpacesLettersButTheLast) {
    expectNear(starts("<text x='50' letter-spacing='10' text-anchor='end'>ii</text>"),
               {40 - 2 * advanceOfI / 100, 50 - advanceOfI / 100});
}
TEST_F(Text, RunsAlongPaths) {
    const auto found =
        items("<path id='p' d='M 0 0 V 100' fill='none'/><text><textPath href='#p'>i</textPath></text>");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].transform[2].x, 0, 1e-9);
    EXPECT_NEAR(found[0].transform[2].y, 0, 1e-9);
    EXPECT_NEAR(found[0].transform[0].x, 0, 1e-9);
    EXPECT_NEAR(found[0].transform[0].y, .01, 1e-9);
}
TEST_F(Text, EndsWithItsPath) {
    EXPECT_EQ(
        items("<path id='p' d='M 0 0 H 12' fill='none'/><text><textPath href='#p'>iiiiii</textPath></text>")
            .size(),
        2u);
}
TEST_F(Text, HasLinesOfItsOwnPaint) {
    const auto found =
        items("<text fill='red' text-decoration='underline'>i<tspan fill='blue'>i</tspan></text>");
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(std::get<scene::Color>(found[0].paint), (scene::Color{1, 0, 0, 1}));
    EXPECT_NEAR(boundingBox(*found[0].path, found[0].transform).width(), 2 * advanceOfI / 100, 1e-9);
}
TEST_F(Text, ClipsAndIsMeasured) {
    EXPECT_EQ(
        items("<clipPath id='c'><text>i</text></clipPath><rect width='9' height='9' clip-path='url(#c)'/>")
            .size(),
        1u);
    const auto filled = items(
        "<linearGradient id='g'><stop/><stop offset='1' stop-color='red'/></linearGradient>"
        "<text x='7' fill='url(#g)'>H</text>");
    ASSERT_EQ(filled.size(), 1u);
    const auto& gradient = std::get<scene::LinearGradient>(filled[0].paint);
    const auto start = scene::apply(gradient.transform, gradient.start),
               end = scene::apply(gradient.transform, gradient.end);
    EXPECT_NEAR(start.x, 7, 1e-9);
    EXPECT_NEAR(end.x, 7 + advanceOfH / 100, 1e-9);
}
TEST_F(Text, OfAClipIsCheckedLikeDrawnText) {
    const Document loaded = load(
        "<clipPath id='c'><text x='1e20'>i</text><text font-family='None'>i</text></clipPath>"
        "<rect width='9' height='9' clip-path='url(#c)'/>");
    ASSERT_EQ(loaded.warnings.size(), 2u);
    EXPECT_EQ(loaded.warnings[0].kind, Warning::Kind::Limit);
    EXPECT_EQ(loaded.warnings[1].kind, Warning::Kind::Font);
}
TEST_F(Text, NamesFamiliesThatAreNotThereOnce) {
    const Document loaded = load("<text font-family='None'>a</text><text font-family='None'>b</text>");
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.warnings[0].kind, Warning::Kind::Font);
    EXPECT_EQ(load("<text font-family='None, sans-serif'>a</text>").warnings.size(), 0u);
}

TEST_F(Text, NamesCharactersThatNoFontHas) {
    const Document loaded = load("<text>a\xe4\xb8\xad\xe6\x96\x87</text>");
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.warnings[0].message, "<text>: no font has the character U+4E2D and 1 other");
}
TEST_F(Text, IsBrokenIntoLines) {
    const auto found = items("<text x='5' y='20' style='inline-size:12px'>ii ii</text>");
    ASSERT_EQ(found.size(), 4u);
    EXPECT_NEAR(found[2].transform[2].x, 5, 1e-9);
    EXPECT_NEAR(found[2].transform[2].y, 20 + 1.25 * 20.48, 1e-9);
}
TEST_F(Text, FlowsInInkscapesFrames) {
    const Document loaded = load(
        "<flowRoot xml:space='preserve'><flowRegion><rect x='7' y='3' width='12' height='60'/></flowRegion>"
        "<flowPara>ii ii</flowPara><flowPara>i</flowPara></flowRoot>");
    const auto found = itemsOf(loaded);
    ASSERT_EQ(found.size(), 4u) << "the third line does not fit";
    EXPECT_NEAR(found[0].transform[2].x, 7, 1e-9);
    EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(TextContent, ReadsUtf8) {
    std::vector<RawCharacter> raw;
    appendCharacters("a\xc3\xa4\xe4\xb8\xad\xf0\x9f\x98\x80\xff\xe4\xb8", 0, WhiteSpace::Preserve, true, raw);
    std::u32string read;
    for (const RawCharacter& character : raw)
        read += character.code;
    EXPECT_EQ(read, U"aä中😀\ufffd\ufffd\ufffd");
}

TEST(PathMeasure, GoesAlongEveryKindOfSegment) {
    const scene::Path path{scene::MoveTo{{0, 0}}, scene::LineTo{{10, 0}},
                           scene::ArcTo{{5, 5}, 0, false, true, {10, 10}}, scene::MoveTo{{20, 20}},
                           scene::CubicTo{{20, 22}, {20, 28}, {20, 30}}};
    const PathMeasure measure(path);
    const double arc = 5 * std::numbers::pi;
    EXPECT_NEAR(measure.length(), 20 + arc, 1e-7);
    EXPECT_NEAR(glm::distance(measure.at(10 + arc / 2).at, {15, 5}), 0, 1e-6);
    EXPECT_NEAR(glm::distance(measure.at(10 + arc + 5).at, {20, 25}), 0, 1e-6);
    EXPECT_NEAR(glm::distance(measure.at(-3).at, {-3, 0}), 0, 1e-9);
    EXPECT_NEAR(glm::distance(measure.at(measure.length() + 3).at, {20, 33}), 0, 1e-6);
}

}  // namespace
}  // namespace vtm::svg
