#include <hb.h>

#include <algorithm>
#include <vtm/scene/scene.hpp>

#include "text/color/composite.hpp"
#include "text/color/gradients.hpp"
#include "text/tests/sfnt.hpp"
#include "text/tests/support.hpp"

namespace vtm::text {
namespace {

using scene::Color;
using scene::Point;

constexpr Color red{1, 0, 0, 1}, blue{0, 0, 1, 1}, green{0, 1, 0, 1};

// ---- A font of DejaVu Sans with a table COLR of our own ----------------------------------------------

/// Red, blue and translucent green.
Table palette() {
    Bytes cpal;
    for (const std::uint32_t number : {0, 3, 1, 3})
        append(cpal, number, 2);
    append(cpal, 14, 4);
    append(cpal, 0, 2);
    for (const std::uint32_t bgra : {0x0000ffffu, 0xff0000ffu, 0x00ff0080u})
        append(cpal, bgra, 4);
    return {HB_TAG('C', 'P', 'A', 'L'), 0, cpal};
}

class ColorFont : public testing::Test {
protected:
    ColorFont() : tables(tablesOf(bytesOf(dejavu / "DejaVuSans.ttf"))) {}

    std::shared_ptr<const Font> fontWith(const Bytes& colr) {
        tables.push_back({HB_TAG('C', 'O', 'L', 'R'), 0, colr});
        tables.push_back(palette());
        FontFace face;
        face.family = "Colors";
        set.add(face, sfntOf(tables));
        font = set.primary(family("Colors"));
        glyph = font->glyphOf(U'A').value();
        return font;
    }
    /// Version 1, where 'A' has the paint.
    static Bytes colrOf(const Bytes& paint, GlyphId id) {
        Bytes colr;
        append(colr, 1, 2);
        append(colr, 0, 2);
        append(colr, 0, 4);
        append(colr, 0, 4);
        append(colr, 0, 2);
        append(colr, 34, 4);  // base glyphs
        for (int i = 0; i < 4; ++i)
            append(colr, 0, 4);
        append(colr, 1, 4);
        append(colr, id, 2);
        append(colr, 10, 4);  // the paint, from the list's start
        colr.insert(colr.end(), paint.begin(), paint.end());
        return colr;
    }
    scene::Group groupOf(const Bytes& paint, const Color& foreground = green) {
        FontSet plain(optionsOf(dejavu));
        fontWith(colrOf(paint, plain.primary(family("DejaVu Sans"))->glyphOf(U'A').value()));
        const auto color = font->colorGlyphOf(glyph, foreground);
        EXPECT_TRUE(color && std::holds_alternative<scene::Group>(*color));
        return color ? std::get<scene::Group>(*color) : scene::Group{};
    }
    GlyphId glyphOf(char32_t character) {
        FontSet plain(optionsOf(dejavu));
        return plain.primary(family("DejaVu Sans"))->glyphOf(character).value();
    }
    /// The paint, filling the outline of a character.
    Bytes outlined(char32_t character, const Bytes& paint) {
        Bytes bytes{10};
        append(bytes, 6, 3);
        append(bytes, glyphOf(character), 2);
        bytes.insert(bytes.end(), paint.begin(), paint.end());
        return bytes;
    }
    static Bytes solid(unsigned index) {
        Bytes bytes{2};
        append(bytes, index, 2);
        append(bytes, 0x4000, 2);
        return bytes;
    }

    std::vector<Table> tables;
    FontSet set{optionsOf("/nowhere/at/all")};
    std::shared_ptr<const Font> font;
    GlyphId glyph = 0;
};

const scene::Item& itemOf(const scene::Group& group, std::size_t i) {
    return std::get<scene::Item>(group.children.at(i).value);
}
Color colorOf(const scene::Group& group, std::size_t i) { return std::get<Color>(itemOf(group, i).paint); }

TEST_F(ColorFont, LayersOfVersion0AreStacked) {
    Bytes colr;
    append(colr, 0, 2);
    append(colr, 1, 2);
    append(colr, 14, 4);
    append(colr, 20, 4);
    append(colr, 3, 2);
    append(colr, glyphOf(U'A'), 2);
    append(colr, 0, 2);
    append(colr, 3, 2);
    for (const auto& [character, index] : {std::pair(U'I', 0u), {U'O', 2u}, {U'B', 0xffffu}}) {
        append(colr, glyphOf(character), 2);
        append(colr, index, 2);
    }
    fontWith(colr);
    const auto color = font->colorGlyphOf(glyph, blue);
    ASSERT_TRUE(color);
    const auto& group = std::get<scene::Group>(*color);
    ASSERT_EQ(group.children.size(), 3u);
    EXPECT_EQ(colorOf(group, 0), red);
    EXPECT_EQ(colorOf(group, 1), (Color{0, 1, 0, 128 / 255.0f}));
    EXPECT_EQ(colorOf(group, 2), blue) << "index 0xFFFF is the text's colour";
    EXPECT_EQ(itemOf(group, 0).path, font->outlineOf(glyphOf(U'I')));
    EXPECT_FALSE(font->colorGlyphOf(glyphOf(U'I'), blue)) << "other glyphs have no colours";
}
TEST_F(ColorFont, SolidPaintsFillOutlines) {
    const scene::Group group = groupOf(outlined(U'O', solid(1)));
    ASSERT_EQ(group.children.size(), 1u);
    EXPECT_EQ(colorOf(group, 0), blue);
    EXPECT_EQ(itemOf(group, 0).path, font->outlineOf(glyphOf(U'O')));
}
TEST_F(ColorFont, TranslationsMoveDownWhereFontsMoveUp) {
    Bytes paint{14};
    append(paint, 8, 3);
    append(paint, 100, 2);
    append(paint, 200, 2);
    const Bytes child = outlined(U'O', solid(0));
    paint.insert(paint.end(), child.begin(), child.end());
    EXPECT_EQ(itemOf(groupOf(paint), 0).transform, scene::translation(100, -200));
}
TEST_F(ColorFont, RotationsAreCounterclockwise) {
    Bytes paint{24};
    append(paint, 6, 3);
    append(paint, 0x2000, 2);  // half of a half turn
    const Bytes child = outlined(U'O', solid(0));
    paint.insert(paint.end(), child.begin(), child.end());
    const Point up = scene::apply(itemOf(groupOf(paint), 0).transform, {1, 0});
    EXPECT_NEAR(up.x, 0, 1e-9);
    EXPECT_NEAR(up.y, -1, 1e-9);
}
TEST_F(ColorFont, NestedOutlinesCut) {
    const scene::Group group = groupOf(outlined(U'O', outlined(U'I', solid(0))));
    const auto& cut = std::get<scene::Group>(group.children.at(0).value);
    ASSERT_TRUE(cut.clip);
    EXPECT_EQ(cut.clip->shapes.at(0).path, font->outlineOf(glyphOf(U'O')));
    EXPECT_EQ(itemOf(cut, 0).path, font->outlineOf(glyphOf(U'I')));
}
TEST_F(ColorFont, TheTransformOfTheTextAppliesToAll) {
    Bytes paint = outlined(U'O', solid(0));
    groupOf(paint);
    const auto moved = font->colorGlyphOf(glyph, green, scene::translation(7, 8));
    EXPECT_EQ(itemOf(std::get<scene::Group>(*moved), 0).transform, scene::translation(7, 8));
}
TEST_F(ColorFont, GraphsWithoutEndAreRefused) {
    Bytes paint{32};  // a composite of itself with itself
    append(paint, 8, 3);
    append(paint, 3, 1);
    append(paint, 8, 3);
    Bytes translate{14};
    append(translate, 8, 3);
    append(translate, 0, 4);
    const Bytes back{32, 0xff, 0xff, 0xf8, 3, 0xff, 0xff, 0xf8};
    paint.insert(paint.end(), translate.begin(), translate.end());
    paint.insert(paint.end(), back.begin(), back.end());
    fontWith(colrOf(paint, glyphOf(U'A')));
    font->colorGlyphOf(glyph, green);  // comes to an end
    Bytes self{11};
    append(self, glyphOf(U'A'), 2);
    FontSet other(optionsOf("/nowhere/at/all"));
    FontFace face;
    face.family = "Self";
    tables.resize(tables.size() - 2);
    tables.push_back({HB_TAG('C', 'O', 'L', 'R'), 0, colrOf(self, glyphOf(U'A'))});
    tables.push_back(palette());
    other.add(face, sfntOf(tables));
    const auto group = other.primary(family("Self"))->colorGlyphOf(glyph, green);
    ASSERT_TRUE(group);
    EXPECT_TRUE(std::get<scene::Group>(*group).children.empty());
}

// ---- Gradients ---------------------------------------------------------------------------------------

const ColorLine twoColors{{{0, red}, {1, blue}}, scene::Spread::Pad};

TEST(Gradient, LinearIsTurnedSoThatParallelsOfP2AreOneColor) {
    const auto paint = linearGradient(twoColors, {0, 0}, {10, 0}, {10, 10});
    const auto& gradient = std::get<scene::LinearGradient>(paint.value());
    EXPECT_EQ(gradient.start, Point(0, 0));
    EXPECT_EQ(gradient.end, Point(5, -5));
    EXPECT_FALSE(linearGradient(twoColors, {0, 0}, {10, 0}, {20, 0})) << "parallel: paints nothing";
    EXPECT_FALSE(linearGradient(twoColors, {0, 0}, {0, 0}, {0, 20}));
}
TEST(Gradient, StopsOutsideOfTheUnitIntervalMoveTheEnds) {
    const ColorLine line{{{-1, red}, {0.5, green}, {2, blue}}, scene::Spread::Reflect};
    const auto gradient =
        std::get<scene::LinearGradient>(linearGradient(line, {0, 0}, {10, 0}, {0, 10}).value());
    EXPECT_EQ(gradient.start, Point(-10, 0));
    EXPECT_EQ(gradient.end, Point(20, 0));
    EXPECT_EQ(gradient.stops[1].offset, 0.5f);
    EXPECT_EQ(gradient.spread, scene::Spread::Reflect);
}
TEST(Gradient, RadialFromTheLargerCircleIsReversed) {
    const auto gradient =
        std::get<scene::RadialGradient>(radialGradient(twoColors, {{0, 0}, 10}, {{1, 0}, 2}).value());
    EXPECT_EQ(gradient.radius, 10);
    EXPECT_EQ(gradient.focalRadius, 2);
    EXPECT_EQ(gradient.stops.front().color, blue);
}
TEST(Gradient, CirclesBesideEachOtherAreDiscsInOrder) {
    EXPECT_FALSE(radialGradient(twoColors, {{0, 0}, 1}, {{10, 0}, 2}));
    const auto discs = coneGradient(twoColors, {{0, 0}, 1}, {{10, 0}, 2}, {{-5, -5}, {15, 5}});
    ASSERT_FALSE(discs.empty());
    EXPECT_EQ(discs.front().color, red);
    EXPECT_EQ(discs.back().color, blue);
}
TEST(Gradient, SweepHasItsColorsByAngle) {
    const auto sectors = sweepGradient(twoColors, {0, 0}, 0, 360, {{-1, -1}, {1, 1}});
    ASSERT_EQ(sectors.size(), 360u);
    EXPECT_NEAR(sectors[90].color.b, 0.25, 0.01);
    const Point end = scene::endOf(sectors[89].path[2]).value();
    EXPECT_NEAR(end.x, 0, 1e-9);
    EXPECT_GT(end.y, 1) << "a quarter clockwise is down";
}

// ---- Composites --------------------------------------------------------------------------------------

TEST(Composite, EveryModeGivesAValidScene) {
    const auto square = std::make_shared<const scene::Path>(scene::rectangle({1, 1}, {9, 9}));
    scene::Item item;
    item.path = square;
    item.geometry = scene::FillRule::NonZero;
    item.paint = red;
    for (int mode = 0; mode <= int(CompositeMode::Luminosity) + 1; ++mode) {
        scene::Scene scene;
        scene.width = scene.height = 10;
        scene.root.children =
            composited(static_cast<CompositeMode>(mode), scene::NodeList{{scene::Node{item}}},
                       scene::NodeList{{scene::Node{item}}}, item);
        EXPECT_NO_THROW(scene::validate(scene)) << mode;
        EXPECT_EQ(scene.root.children.empty(), mode == 0 || mode > int(CompositeMode::Luminosity)) << mode;
    }
}

// ---- The suite's fonts -------------------------------------------------------------------------------

class SuiteColors : public SuiteFonts {
protected:
    std::optional<Font::ColorGlyph> color(const std::string& name, char32_t character) {
        FontSet set(optionsOf(suiteFonts()));
        const auto font = set.primary(family(name));
        return font->colorGlyphOf(font->glyphOf(character).value(), green);
    }
};

TEST_F(SuiteColors, OfVersion1) {
    const auto glyph = color("Noto Color Emoji COLR", U'\U0001f41d');
    ASSERT_TRUE(glyph);
    const auto& box = std::get<scene::Group>(std::get<scene::Group>(*glyph).children.at(0).value);
    EXPECT_TRUE(box.clip);
    EXPECT_GT(box.children.size(), 10u);
}
TEST_F(SuiteColors, OfBitmaps) {
    const auto glyph = color("Noto Color Emoji", U'\U0001f600');
    ASSERT_TRUE(glyph);
    const scene::Item& item = itemOf(std::get<scene::Group>(*glyph), 0);
    EXPECT_EQ(std::get<scene::ImagePaint>(item.paint).bitmap->width, 136);
}
TEST_F(SuiteColors, OfTheLargestBitmapPlacedFromTheOutline) {
    const auto glyph = color("CFF Outlines and SBIX", U'A');
    ASSERT_TRUE(glyph);
    const scene::Item& item = itemOf(std::get<scene::Group>(*glyph), 0);
    EXPECT_EQ(std::get<scene::ImagePaint>(item.paint).bitmap->width, 512);
    EXPECT_GT(boundsOf(*item.path, scene::identity).max.y, 100) << "below the baseline, as the outline is";
}
TEST_F(SuiteColors, OfSvg) {
    const auto glyph = color("Twitter Color Emoji", U'\U0001f600');
    ASSERT_TRUE(glyph);
    const auto& document = std::get<SvgGlyph>(*glyph).document;
    EXPECT_NE(std::string(document.begin(), document.end()).find("<svg"), std::string::npos);
}
TEST_F(SuiteColors, AreScenes) {
    for (const char32_t character : U"\U0001f313\U0001f41d\U0001f436\U0001f973") {
        if (character == 0)
            continue;
        scene::Scene scene;
        scene.width = scene.height = 1024;
        scene.root = std::get<scene::Group>(color("Noto Color Emoji COLR", character).value());
        EXPECT_NO_THROW(scene::validate(scene));
    }
}

}  // namespace
}  // namespace vtm::text
