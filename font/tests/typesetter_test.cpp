// Pages as assets, against the same text as SVG drawn by the reference.
#include <vtm/font/typesetter.hpp>

#include <cmath>
#include <stdexcept>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/svg/load.hpp>
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"
#include "font/tests/support.hpp"

namespace vtm::font {
namespace {

scene::Scene sceneOf(const std::string& svg, const std::filesystem::path& folder) {
    svg::Options options;
    options.fonts.directories = {folder.string()};
    options.fonts.systemFonts = false;
    const Bytes bytes(svg.begin(), svg.end());
    return svg::load(bytes, options).scene;
}

double differenceOf(const asset::TextPage& page, const asset::Asset& font, const scene::Scene& scene,
                    const asset::View& view) {
    const asset::Asset asset = asset::read(asset::write(asset::pageAsset(page, font)));
    const image::Raster drawn = asset::Scanner(asset).draw(view);
    const image::Raster truth = reference::render(scene, {view.width, view.height, view.toPixels});
    EXPECT_LE(compare::compare(drawn, asset::evaluate(asset, view)).max, 1);
    return compare::compare(drawn, truth).max;
}

TEST(Typesetter, SetsLinesAsSvgDoes) {
    FontMaps font(fileOf(dejavu / "DejaVuSerif.ttf"));
    Typesetter setter(font, 300, 100);
    const TextStyle style{.size = 20};
    const std::u32string text = U"AVATAR To fluffy\nWaffle “quoted” Tête-à-tête";
    EXPECT_EQ(setter.add(text, {10, 5, 280, 90}, style), text.size());
    const double baseline = 5 + font.ascent() * 20;
    const scene::Scene scene = sceneOf(
        fmt::format("<svg xmlns='http://www.w3.org/2000/svg' width='300' height='100'>"
                    "<g font-family='DejaVu Serif' font-size='20'><text x='10' y='{}'>AVATAR To fluffy</text>"
                    "<text x='10' y='{}'>Waffle “quoted” Tête-à-tête</text></g></svg>",
                    baseline, baseline + 24),
        dejavu);
    const asset::TextPage page = setter.page();
    for (const double angle : {0.0, 0.4, 2.0})
        EXPECT_LE(differenceOf(page, font.asset(), scene, viewOver(0, 0, 300, 100, 400, angle)), 4);
    EXPECT_LE(differenceOf(page, font.asset(), scene, viewOver(10, 5, 30, 30, 400)), 4);
    EXPECT_LE(differenceOf(page, font.asset(), scene, viewOver(0, 0, 300, 100, 60)), 4);
}

/// Letters that join overlap; counted twice, they would be dark where they do.
TEST(Typesetter, JoinedLettersAreOneOutline) {
    if (!std::filesystem::exists(amiri))
        GTEST_SKIP() << "the font Amiri is not installed";
    FontMaps font(fileOf(amiri));
    Typesetter setter(font, 200, 60);
    const TextStyle style{.size = 30, .align = Align::End, .rightToLeft = true, .language = "ar"};
    const std::u32string text = U"السلام عليكم بِسْمِ";
    EXPECT_EQ(setter.add(text, {10, 0, 180, 60}, style), text.size());
    const scene::Scene scene = sceneOf(
        fmt::format("<svg xmlns='http://www.w3.org/2000/svg' width='200' height='60'><text direction='rtl' "
                    "text-anchor='end' x='10' y='{}' font-family='Amiri' font-size='30' xml:lang='ar'>"
                    "السلام عليكم بِسْمِ</text></svg>",
                    font.ascent() * 30),
        amiri.parent_path());
    EXPECT_LE(differenceOf(setter.page(), font.asset(), scene, viewOver(0, 0, 200, 60, 800)), 4);
}

TEST(Typesetter, SetsVerticalText) {
    FontMaps font(fileOf(dejavu / "DejaVuSans.ttf"));
    Typesetter setter(font, 60, 200);
    const TextStyle style{.size = 20, .vertical = true};
    EXPECT_EQ(setter.add(U"Vert.\nTwo", {0, 0, 60, 200}, style), 9u);
    const asset::TextPage page = setter.page();
    for (const asset::PageGlyph& glyph : page.glyphs) {
        const asset::PageSymbol& symbol = page.symbols[glyph.symbol];
        EXPECT_NEAR(symbol.linear[0].y, 20, 1e-9);  // sideways
        EXPECT_GT(glyph.origin.x, 0);
        EXPECT_LT(glyph.origin.x, 60);
    }
    const scene::Scene scene = sceneOf(
        "<svg xmlns='http://www.w3.org/2000/svg' width='60' height='200'><text writing-mode='vertical-rl' "
        "font-family='DejaVu Sans' font-size='20' x='30' y='0'>Vert.</text></svg>",
        dejavu);
    FontMaps again(fileOf(dejavu / "DejaVuSans.ttf"));
    Typesetter one(again, 60, 200);
    const double half = 10 * (again.ascent() + again.descent());
    one.add(U"Vert.", {30 - half, 0, 2 * half, 200}, style);
    EXPECT_LE(differenceOf(one.page(), again.asset(), scene, viewOver(0, 0, 60, 200, 120)), 4);
}

TEST(Typesetter, BreaksLinesAndTellsWhatDoesNotFit) {
    FontMaps font(fileOf(dejavu / "DejaVuSerif.ttf"));
    std::u32string text;
    for (int i = 0; i < 300; ++i)
        text += U"several words in a row, ";
    std::size_t set = 0, pages = 0;
    while (set < text.size()) {
        Typesetter setter(font, 200, 200);
        const std::size_t count =
            setter.add(std::u32string_view(text).substr(set), {10, 10, 180, 180}, {.size = 12});
        ASSERT_GT(count, 0u);
        EXPECT_TRUE(set + count == text.size() || text[set + count - 1] == U' ');
        for (const asset::PageGlyph& glyph : setter.page().glyphs) {
            EXPECT_GE(glyph.origin.x, 10 - 1);
            EXPECT_LE(glyph.origin.x, 190);
            EXPECT_LE(glyph.origin.y, 190);
        }
        set += count;
        ++pages;
    }
    EXPECT_GT(pages, 3u);
    Typesetter setter(font, 200, 200);
    EXPECT_EQ(setter.add(U"", {0, 0, 100, 100}), 0u);
    EXPECT_EQ(setter.add(U"x", {0, 0, 100, 3}), 0u);
    EXPECT_EQ(setter.add(U"unbreakablylongword", {0, 0, 10, 100}), 19u);
    EXPECT_EQ(setter.add(U"\n\n", {0, 0, 100, 100}), 2u);
}

TEST(Typesetter, AlignsLines) {
    FontMaps font(fileOf(dejavu / "DejaVuSerif.ttf"));
    const auto firstX = [&](Align align, bool rightToLeft) {
        Typesetter setter(font, 200, 100);
        setter.add(U"word", {10, 0, 180, 100}, {.size = 20, .align = align, .rightToLeft = rightToLeft});
        return setter.page().glyphs.front().origin.x;
    };
    const double start = firstX(Align::Start, false), end = firstX(Align::End, false);
    EXPECT_LT(start, 25);  // where the outline of the w begins
    EXPECT_GT(end, 120);
    EXPECT_NEAR(firstX(Align::Center, false), 0.5 * (start + end), 1e-9);
    EXPECT_EQ(firstX(Align::Start, true), end);
    EXPECT_EQ(firstX(Align::End, true), start);
}

TEST(Typesetter, CellsAreBytes) {
    FontMaps font(fileOf(dejavu / "DejaVuSansMono.ttf"));
    CellText text;
    text.columns = 20;
    text.rows = 3;
    text.text = U"Cells: iéj! {}[]    second row          ";
    text.size = 10;
    const asset::TextPage page = Typesetter::cells(font, text);
    ASSERT_TRUE(page.cells);
    EXPECT_EQ(page.cells->symbols.size(), 60u);
    EXPECT_NE(page.symbols[page.cells->symbols[7]].next, 0);  // the dot of the i
    const double baseline = font.ascent() * 10, height = page.cells->size.y;
    const scene::Scene scene = sceneOf(
        fmt::format(
            "<svg xmlns='http://www.w3.org/2000/svg' width='{}' height='{}'>"
            "<g font-family='DejaVu Sans Mono' font-size='10' xml:space='preserve'><text y='{}'>Cells: iéj! "
            "{{}}[]</text><text y='{}'>second row</text></g></svg>",
            page.width, page.height, baseline, baseline + height),
        dejavu);
    for (const int pixels : {60, 240, 700})
        EXPECT_LE(differenceOf(page, font.asset(), scene, viewOver(0, 0, page.width, page.height, pixels)),
                  4);
}

/// Lines of boxes reach beyond their cells; counted twice there, they would be too bright.
TEST(Typesetter, LinesOfBoxesAreEven) {
    FontMaps font(fileOf(dejavu / "DejaVuSansMono.ttf"));
    CellText text;
    text.columns = 8;
    text.rows = 4;
    text.text = U"┌──┬──┐ │  │  │ ├──┼──┤ └──┴──┘ ";
    text.palette = {{0.4f, 0.5f, 0.3f, 1}};
    text.ground = {0.1f, 0, 0.05f, 1};
    const asset::TextPage page = Typesetter::cells(font, text);
    const asset::Asset asset = asset::pageAsset(page, font.asset());
    const asset::View view = viewOver(0, 0, page.width, page.height, 800, 0.02);
    const image::Raster drawn = asset::Scanner(asset).draw(view);
    double brightest = 0;
    for (std::size_t i = 0; i < drawn.rgba.size(); i += 4)
        brightest = std::max(brightest, double(drawn.rgba[i + 1]));
    EXPECT_NEAR(brightest, 0.5, 1.5 / 255);
    // The middle of a line is ink all along.
    const double y = page.height / 8;
    for (double x = page.width * 0.1; x < page.width * 0.8; x += page.width / 500) {
        const glm::dvec2 p = view.toPixels * glm::dvec3(x, y, 1);
        double ink = 0;
        for (int dy = -12; dy <= 12; ++dy)
            ink = std::max(ink, double(drawn.pixel(int(p.x), int(p.y) + dy)[1]));
        EXPECT_NEAR(ink, 0.5, 2.0 / 255) << x;
    }
}

TEST(Typesetter, GroundLiesBelowTranslucentText) {
    FontMaps font(fileOf(dejavu / "DejaVuSans.ttf"));
    Typesetter setter(font, 80, 40, {0.2f, 0.4f, 0.9f, 1});
    setter.add(U"Ink", {5, 5, 70, 35}, {.size = 25, .color = {1, 0.5f, 0, 0.5f}});
    const scene::Scene scene = sceneOf(
        fmt::format(
            "<svg xmlns='http://www.w3.org/2000/svg' width='80' height='40'><rect width='80' height='40' "
            "fill='rgb(20% 40% 90%)'/><text x='5' y='{}' font-family='DejaVu Sans' font-size='25' "
            "fill='rgb(100% 50% 0%)' opacity='.5'>Ink</text></svg>",
            5 + 25 * font.ascent()),
        dejavu);
    for (const double angle : {0.0, 1.0})
        EXPECT_LE(differenceOf(setter.page(), font.asset(), scene, viewOver(0, 0, 80, 40, 200, angle)), 4);
    EXPECT_LE(differenceOf(setter.page(), font.asset(), scene, viewOver(-20, -20, 120, 80, 200, 0.3)), 4);
}

TEST(Typesetter, LettersAreCutByThePagesEdge) {
    FontMaps font(fileOf(dejavu / "DejaVuSans.ttf"));
    Typesetter setter(font, 60, 40, {1, 1, 1, 1});
    setter.add(U"OO", {-25, -20, 200, 200}, {.size = 50, .color = {0, 0, 0.5f, 1}});
    const scene::Scene scene = sceneOf(
        fmt::format(
            "<svg xmlns='http://www.w3.org/2000/svg' width='60' height='40'><rect width='60' height='40' "
            "fill='white'/><text x='-25' y='{}' font-family='DejaVu Sans' font-size='50' "
            "fill='#000080'>OO</text></svg>",
            -20 + 50 * font.ascent()),
        dejavu);
    const asset::TextPage page = setter.page();
    EXPECT_EQ(page.glyphs.size(), 2u);
    EXPECT_LE(differenceOf(page, font.asset(), scene, viewOver(0, 0, 60, 40, 240)), 4);
    Typesetter far(font, 60, 40);
    far.add(U"O", {-500, 0, 200, 200}, {.size = 50});
    EXPECT_TRUE(asset::pageAsset(far.page(), font.asset()).instances.empty());
    EXPECT_TRUE(asset::pageAsset(Typesetter(font, 60, 40).page(), font.asset()).instances.empty());
}

TEST(Typesetter, RefusesNonsense) {
    FontMaps font(fileOf(dejavu / "DejaVuSans.ttf"));
    EXPECT_THROW(Typesetter(font, 0, 10), std::invalid_argument);
    EXPECT_THROW(Typesetter(font, 10, std::nan("")), std::invalid_argument);
    Typesetter setter(font, 10, 10);
    EXPECT_THROW(setter.add(U"x", {0, 0, 10, 10}, {.size = 0}), std::invalid_argument);
    EXPECT_THROW(setter.add(U"x", {0, 0, 10, 10}, {.lineHeight = -1}), std::invalid_argument);
    EXPECT_THROW(setter.add(U"x", {0, 0, HUGE_VAL, 10}), std::invalid_argument);
    EXPECT_THROW(setter.add(U"x", {0, 0, 10, 10}, {.features = {{"x", 1}}}), std::invalid_argument);
    CellText cells;
    EXPECT_THROW(Typesetter::cells(font, cells), std::invalid_argument);
    cells.columns = cells.rows = 20;
    cells.text = latin(font, 300);
    EXPECT_THROW(Typesetter::cells(font, cells), LimitError);
    cells.text = U"x";
    cells.colors = {0};
    EXPECT_THROW(Typesetter::cells(font, cells), std::invalid_argument);
}

TEST(TextPage, ValidationNamesTheRecord) {
    FontMaps font(fileOf(dejavu / "DejaVuSansMono.ttf"));
    CellText text;
    text.columns = 4;
    text.rows = 1;
    text.text = U"ijk";
    const asset::TextPage good = Typesetter::cells(font, text);
    const asset::Asset maps = font.asset();
    const auto refusal = [&](const auto& change) -> std::string {
        asset::TextPage page = good;
        change(page);
        try {
            asset::validate(page, maps);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    using Page = asset::TextPage;
    EXPECT_EQ(refusal([](Page&) {}), "");
    EXPECT_EQ(refusal([](Page& p) { p.width = 0; }), "text page: page[0]: size is out of range");
    EXPECT_EQ(refusal([](Page& p) { p.ground[2] = 2; }), "text page: page[0]: ground is out of range");
    EXPECT_EQ(refusal([](Page& p) { p.symbols[1].map = 99; }),
              "text page: symbols[1]: refers to a missing map");
    EXPECT_EQ(refusal([](Page& p) { p.symbols[1].linear = glm::dmat2(0); }),
              "text page: symbols[1]: matrix is singular");
    EXPECT_EQ(refusal([](Page& p) { p.symbols[2].next = 2; }),
              "text page: symbols[2]: the next one does not follow it");
    EXPECT_EQ(refusal([](Page& p) { p.cells->symbols[1] = 200; }),
              "text page: cells[1]: refers to a missing symbol");
    EXPECT_EQ(refusal([](Page& p) {
                  p.cells->colors = {0, 0, 0, 9};
              }),
              "text page: cells[3]: refers to a missing colour");
    EXPECT_EQ(refusal([](Page& p) { p.cells->columns = 5; }),
              "text page: cells[4]: symbols must be one a cell");
    EXPECT_EQ(refusal([](Page& p) { p.glyphs.resize(1); }), "text page: cells[0]: stand beside glyphs");
}

TEST(Utf8, MalformedBytesAreReplaced) {
    EXPECT_EQ(fromUtf8("aé€\U0001F600"), U"aé€\U0001F600");
    EXPECT_EQ(fromUtf8("\xC3"), U"\uFFFD");
    EXPECT_EQ(fromUtf8("\xE0\x80\x80"), U"\uFFFD\uFFFD\uFFFD");    // longer than it must be
    EXPECT_EQ(fromUtf8("\xED\xA0\x80x"), U"\uFFFD\uFFFD\uFFFDx");  // a surrogate
    EXPECT_EQ(fromUtf8("\xF4\x90\x80\x80"), U"\uFFFD\uFFFD\uFFFD\uFFFD");
}

}  // namespace
}  // namespace vtm::font
