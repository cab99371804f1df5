// Pages of text in a user's shader, against the same pages as assets drawn by the CPU.
#include <vtm/gl/text_texture.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <vtm/font/typesetter.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include "backend_gl/core/gl.hpp"
#include "backend_gl/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using asset::TextPage;
using asset::View;
using image::Raster;

constexpr double tolerance = 2.0 / 255;

font::FontMaps dejavu(const char* name) {
    std::ifstream file(std::string("/usr/share/fonts/truetype/dejavu/") + name, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    return font::FontMaps(bytes);
}

class PageCanvas {
public:
    PageCanvas()
        : canvas_(textInclude(), R"(
uniform Vtm page;
uniform mat3 toPage;
vec4 shade(vec2 pixel) {
    return vtm_sample_proj(page, toPage * vec3(pixel, 1.0) / gl_FragCoord.w);
})") {}

    Raster draw(TextTexture& texture, std::size_t index, const TextPage& page, const View& view) {
        const glm::dmat3 toPixels(glm::dvec3(view.toPixels[0], 0), glm::dvec3(view.toPixels[1], 0),
                                  glm::dvec3(view.toPixels[2], 1));
        const glm::dmat3 toSt(1 / page.width, 0, 0, 0, 1 / page.height, 0, 0, 0, 1);
        canvas_.set("toPage", toSt * glm::inverse(toPixels));
        texture.bind(canvas_.program(), "page", 0, index);
        return canvas_.draw(view.width, view.height);
    }

private:
    test::ShaderCanvas canvas_;
};

double worst(const Raster& a, const Raster& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    double difference = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        difference = std::max(difference, double(std::abs(a.rgba[i] - b.rgba[i])));
    return difference;
}

TextPage letters(font::FontMaps& font) {
    font::Typesetter setter(font, 300, 200, {1, 1, 0.9f, 1});
    setter.add(U"Heading", {20, 10, 260, 60}, {.size = 40, .color = {0.7f, 0, 0, 1}});
    std::u32string text;
    for (int i = 0; i < 20; ++i)
        text += U"AVATAR, waffles & çédille; ";
    setter.add(text, {20, 70, 260, 120}, {.size = 9});
    return setter.page();
}

TextPage cells(font::FontMaps& font) {
    font::CellText text;
    text.columns = 30;
    text.rows = 8;
    for (unsigned i = 0; i < 240; ++i) {
        text.text += char32_t(U'!' + i % 90);
        text.colors.push_back(std::uint8_t(i / 7 % 3));
    }
    text.palette = {{1, 1, 1, 1}, {0, 1, 0.3f, 1}, {1, 0.5f, 0, 0.6f}};
    text.ground = {0, 0, 0.2f, 1};
    return font::Typesetter::cells(font, text);
}

View viewOf(const TextPage& page, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double scale = 400 / page.width * std::exp2(5 * unit(random));
    return asset::test::turnedView(60, 40, {page.width * unit(random), page.height * unit(random)}, scale,
                                   6.28 * unit(random), 0.4 * unit(random), unit(random) < 0.3);
}

TEST_F(Gl, PagesShowWhatTheirAssetsDo) {
    font::FontMaps serif = dejavu("DejaVuSerif.ttf"), mono = dejavu("DejaVuSansMono.ttf");
    std::mt19937 random(3);
    PageCanvas canvas;
    for (const bool isCells : {false, true}) {
        font::FontMaps& font = isCells ? mono : serif;
        const TextPage page = isCells ? cells(font) : letters(font);
        const asset::Asset maps = font.asset(), flat = asset::pageAsset(page, maps);
        const asset::Scanner scanner(flat);
        TextTexture texture(maps, {page});
        for (int i = 0; i < 40; ++i) {
            const View view = viewOf(page, random);
            EXPECT_LE(worst(canvas.draw(texture, 0, page, view), scanner.draw(view)), tolerance)
                << i << (isCells ? " cells" : " letters");
        }
    }
}

/// Only the pixels on the page: letters that stick out end with the page in the texture, and do not in the
/// asset.
Raster onPage(Raster drawn, const TextPage& page, const View& view) {
    const glm::dmat2 toPage = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    const glm::dvec2 reach = 0.6 * (glm::abs(toPage[0]) + glm::abs(toPage[1])), size(page.width, page.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec2 p = toPage * (glm::dvec2(x + 0.5, y + 0.5) - view.toPixels[2]);
            if (glm::any(glm::lessThan(p, reach)) || glm::any(glm::greaterThan(p, size - reach)))
                std::fill_n(drawn.pixel(x, y), 4, 0.f);
        }
    return drawn;
}

/// Random texts of letters from everywhere in a font, of many sizes, colours and directions. VTM_PAGES=500
/// tries so many.
TEST_F(Gl, RandomPagesShowWhatTheirAssetsDo) {
    const char* wanted = std::getenv("VTM_PAGES");
    const unsigned count = wanted ? unsigned(std::strtoul(wanted, nullptr, 10)) : 12;
    PageCanvas canvas;
    double largest = 0;
    for (unsigned seed = 0; seed < count; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(0, 1);
        font::FontMaps font = dejavu(seed % 3 == 0 ? "DejaVuSans.ttf" : "DejaVuSerif.ttf");
        const std::vector<char32_t> all = font.characters();
        const auto color = [&](float alpha) {
            return font::Color{unit(random), unit(random), unit(random), alpha};
        };
        const double width = 50 + 500 * unit(random), height = 50 + 500 * unit(random);
        font::Typesetter setter(font, width, height, color(seed % 4 == 0 ? 0.f : 1.f));
        double y = 0;
        for (int i = 0; i < 6; ++i) {
            font::TextStyle style;
            style.size = 6 + 60 * std::pow(unit(random), 4);
            style.color = color(unit(random) < 0.3 ? unit(random) : 1);
            style.rightToLeft = unit(random) < 0.3;
            style.vertical = seed % 5 == 4;
            style.lineHeight = 1.6;
            std::u32string text;
            for (int k = 0; k < 60; ++k)
                text += k % 7 == 6           ? U' '
                        : unit(random) < 0.5 ? char32_t(U'!' + random() % 94)
                                             : all[random() % all.size()];
            const double room = style.vertical ? width : height;
            const double next = y + 0.3 * room * unit(random);
            if (style.vertical)
                setter.add(text, {y, 0, next - y, height}, style);
            else
                setter.add(text, {0, y, width, next - y}, style);
            y = next;
        }
        const TextPage page = setter.page();
        const asset::Asset maps = font.asset(), flat = asset::pageAsset(page, maps);
        const asset::Scanner scanner(flat);
        TextTexture texture(maps, {page});
        for (int i = 0; i < 6; ++i) {
            const View view = viewOf(page, random);
            const double difference = worst(onPage(canvas.draw(texture, 0, page, view), page, view),
                                            onPage(scanner.draw(view), page, view));
            // The asset's boundaries may be off, by which the table's are not.
            const double off = *flat.finestPixel * asset::finestShare * glm::length(view.toPixels[0]);
            EXPECT_LE(difference, 3.0 / 255 + off) << seed << " view " << i;
            largest = std::max(largest, difference);
        }
    }
    fmt::print("{} pages, max {:.2f}/255\n", count, 255 * largest);
}

TEST_F(Gl, PagesMayBeEmptyOrCutLetters) {
    font::FontMaps sans = dejavu("DejaVuSans.ttf");
    PageCanvas canvas;
    for (const std::u32string_view text : {U"", U"OO", U"O"}) {
        font::Typesetter setter(sans, 60, 40, {1, 1, 1, 1});
        const double left = text.size() == 1 ? -500 : -25;
        setter.add(text, {left, -20, 200, 200}, {.size = 50});
        const TextPage page = setter.page();
        TextTexture texture(sans.asset(), {page});
        const asset::Scanner scanner(asset::pageAsset(page, sans.asset()));
        for (const double scale : {0.1, 4.0, 20.0}) {
            const View view = asset::test::turnedView(60, 40, {30, 20}, scale, 0, 0, false);
            EXPECT_LE(worst(canvas.draw(texture, 0, page, view), scanner.draw(view)),
                      scale < 1 ? 0.05 : tolerance)
                << text.size() << " " << scale;
        }
    }
}

TEST_F(Gl, PagesFarAwayAreGrey) {
    font::FontMaps serif = dejavu("DejaVuSerif.ttf");
    const TextPage page = letters(serif);
    const asset::Asset maps = serif.asset();
    const asset::Scanner scanner(asset::pageAsset(page, maps));
    TextTexture texture(maps, {page});
    PageCanvas canvas;
    test::TextureCanvas flat(asset::pageAsset(page, maps));
    for (const double scale : {0.6, 0.3, 0.15, 0.05, 0.02}) {
        const View view = asset::test::turnedView(40, 40, {150, 100}, scale, 0.3, 0, false);
        const Raster truth = scanner.draw(view);
        const double difference = worst(canvas.draw(texture, 0, page, view), truth);
        EXPECT_LE(difference, std::max(tolerance, worst(flat.draw(view), truth) + 4.0 / 255)) << scale;
    }
}

TEST_F(Gl, PageTablesTakeAByteOrEightACharacter) {
    font::FontMaps serif = dejavu("DejaVuSerif.ttf"), mono = dejavu("DejaVuSansMono.ttf");
    font::CellText text;
    text.columns = 100;
    text.rows = 60;
    for (unsigned i = 0; i < 6000; ++i)
        text.text += char32_t(U'!' + i % 90);
    const TextPage terminal = font::Typesetter::cells(mono, text);
    const std::size_t symbols = terminal.symbols.size() * 48;
    EXPECT_LE(TextTexture(mono.asset(), {terminal}).bytes(0), 6000 + symbols + 200);

    font::Typesetter setter(serif, 600, 800);
    std::u32string words;
    while (words.size() < 5000)
        words += U"The quick brown fox jumps over lazy dogs. ";
    ASSERT_EQ(setter.add(words, {40, 40, 520, 740}, {.size = 10}), words.size());
    const TextPage page = setter.page();
    TextTexture texture(serif.asset(), {page});
    EXPECT_LE(texture.bytes(0), 8 * words.size() + page.symbols.size() * 48);
}

TEST_F(Gl, PagesCanBeReplaced) {
    font::FontMaps mono = dejavu("DejaVuSansMono.ttf");
    const auto pageOf = [&](const std::u32string& shown) {
        font::CellText text;
        text.columns = 10;
        text.rows = 2;
        text.text = shown;
        return font::Typesetter::cells(mono, text);
    };
    TextPage first = pageOf(U"first"), second = pageOf(U"second");
    TextTexture texture(mono.asset(), {first, second});
    PageCanvas canvas;
    const auto expectBoth = [&] {
        const asset::Asset maps = mono.asset();
        for (const std::size_t i : {0u, 1u}) {
            const TextPage& page = i == 0 ? first : second;
            const View view =
                asset::test::turnedView(90, 40, {page.width / 2, page.height / 2}, 1, 0, 0, false);
            EXPECT_LE(worst(canvas.draw(texture, i, page, view),
                            asset::Scanner(asset::pageAsset(page, maps)).draw(view)),
                      tolerance)
                << i;
        }
    };
    expectBoth();
    const asset::Asset before = mono.asset();
    first = pageOf(U"rifts");
    texture.update(0, first, mono.asset());  // the same letters
    expectBoth();
    first = pageOf(U"QUITE OTHER");  // the font grows
    texture.update(0, first, mono.asset());
    expectBoth();
    second = pageOf(U"longer than before");
    texture.update(1, second, mono.asset());
    expectBoth();
    EXPECT_THROW(texture.update(2, first, mono.asset()), std::out_of_range);
    EXPECT_THROW(texture.update(0, pageOf(U"Z@"), before), std::invalid_argument);
    expectBoth();
}

/// Seen so small that the pyramid of means is all that is drawn.
TEST_F(Gl, PagesHaveTheSameMeansWhoeverMakesThem) {
    font::FontMaps serif = dejavu("DejaVuSerif.ttf"), mono = dejavu("DejaVuSansMono.ttf");
    PageCanvas canvas;
    for (const bool isCells : {false, true}) {
        font::FontMaps& font = isCells ? mono : serif;
        const TextPage page = isCells ? cells(font) : letters(font);
        const auto shownBy = [&](Pixels pixels) {
            TextTexture texture(font.asset(), {page});
            texture.update(0, page, font.asset(), pixels);
            const View view =
                asset::test::turnedView(9, 7, {page.width / 2, page.height / 2}, 8 / page.width, 0, 0, false);
            return canvas.draw(texture, 0, page, view);
        };
        const Raster drawn = shownBy(Pixels::Shaders), computed = shownBy(Pixels::Scanned);
        EXPECT_LE(worst(drawn, computed), 1.0 / 255 + 1e-5) << isCells;
        EXPECT_GT(drawn.pixel(4, 3)[3], 0.9f);
    }
}

TEST_F(Gl, PagesStandBesidePictures) {
    font::FontMaps mono = dejavu("DejaVuSansMono.ttf");
    font::CellText text;
    text.columns = text.rows = 1;
    text.text = U"M";
    const TextPage page = font::Typesetter::cells(mono, text);
    asset::Asset square;
    square.width = square.height = 1;
    square.maps = {{0, 0, 1, asset::Entry::make(asset::Entry::Kind::Solid, 1), 0}};
    square.paints = {{}, {0, 0, 0x3F800000u, 0x3F800000u}};
    square.commands = {asset::Command{}};
    SampledTexture picture(square);
    TextTexture letter(mono.asset(), {page});
    test::ShaderCanvas canvas(textInclude({square}), R"(
uniform Vtm page, picture;
vec4 shade(vec2 pixel) {
    vec2 st = pixel / 32.0;
    vec4 below = vtm_sample(picture, st), ink = vtm_sample(page, st);
    return ink + below * (1.0 - ink.a);
})");
    picture.bind(canvas.program(), "picture", 0);
    letter.bind(canvas.program(), "page", 2, 0);
    const Raster drawn = canvas.draw(32, 32);
    const asset::Scanner scanner(asset::pageAsset(page, mono.asset()));
    View view{32, 32, {}};
    view.toPixels = {32 / page.width, 0, 0, 32 / page.height, 0, 0};
    const Raster ink = scanner.draw(view);
    for (std::size_t i = 0; i < ink.rgba.size(); i += 4) {
        EXPECT_NEAR(drawn.rgba[i + 3], 1, tolerance);
        EXPECT_NEAR(drawn.rgba[i + 2], 1 - ink.rgba[i + 3], tolerance);
    }
    // An include without pages shows that it cannot draw one.
    test::ShaderCanvas other(sampleInclude({square}), R"(
uniform Vtm page;
vec4 shade(vec2 pixel) { return vtm_sample(page, pixel / 8.0); })");
    letter.bind(other.program(), "page", 0, 0);
    const Raster magenta = other.draw(8, 8);
    EXPECT_EQ(magenta.rgba[0], 1);
    EXPECT_EQ(magenta.rgba[1], 0);
}

}  // namespace
}  // namespace vtm::gl
