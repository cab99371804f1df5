#include <charconv>
#include <numbers>
#include <random>
#include <string>
#include <string_view>

#include "svg/css/color.hpp"
#include "svg/css/length.hpp"
#include "svg/geometry/transform.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

int rgb(std::string_view text) {
    const auto color = parseColor(text);
    return color ? rgbOf(scene::Paint(*color)) : -1;
}
float alpha(std::string_view text) { return parseColor(text).value_or(scene::Color{0, 0, 0, -1}).a; }

TEST(Number, ReadsEveryForm) {
    for (const auto& [text, value] : std::initializer_list<std::pair<std::string_view, double>>{
             {"1", 1}, {"+2.5", 2.5}, {"-.5", -0.5}, {"1e3", 1000}, {"1E-2", 0.01}, {"00.10", 0.1}})
        EXPECT_DOUBLE_EQ(Cursor(text).number().value_or(99), value) << text;
}
TEST(Number, LeavesUnitsAlone) {
    Cursor cursor("1em");
    EXPECT_EQ(cursor.number(), 1);
    EXPECT_EQ(cursor.rest(), "em");
}
TEST(Number, RefusesWhatIsNone) {
    for (const std::string_view text : {"", "-", "e5", ".", "inf", "nan", "-inf", "+-1"})
        EXPECT_FALSE(Cursor(text).number()) << text;
}
TEST(Number, ClampsGiants) {
    EXPECT_EQ(Cursor("1e999").number(), maxNumber);
    EXPECT_EQ(Cursor("-1e99").number(), -maxNumber);
    EXPECT_EQ(Cursor("1e-999").number(), 0);
}

/// Short ones are read without std::from_chars, to the same bits and the same place.
TEST(Number, IsRoundedToNearest) {
    std::mt19937 random(5);
    constexpr std::string_view parts = "0123456789012345678901234567890123456789...eE+-";
    for (int i = 0; i < 200000; ++i) {
        std::string text(1, char('0' + random() % 10));
        for (std::size_t length = random() % 24; length > 0; --length)
            text += parts[random() % parts.size()];
        text += i % 2 ? " " : "";
        double value = 0;
        const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || value > maxNumber)
            continue;
        Cursor cursor(text);
        ASSERT_EQ(cursor.number(), value) << text;
        ASSERT_EQ(cursor.rest(), std::string_view(last, text.data() + text.size())) << text;
    }
}

TEST(Color, Names) {
    EXPECT_EQ(rgb("CornflowerBlue"), 0x6495ed);
    EXPECT_EQ(rgb(" yellowgreen "), 0x9acd32);
    EXPECT_EQ(rgb("nocolor"), -1);
    EXPECT_EQ(alpha("transparent"), 0);
}
TEST(Color, Hexadecimal) {
    EXPECT_EQ(rgb("#1aF"), 0x11aaff);
    EXPECT_EQ(rgb("#12abEF"), 0x12abef);
    EXPECT_FLOAT_EQ(alpha("#0003"), 0.2f);
    EXPECT_FLOAT_EQ(alpha("#00000033"), 0.2f);
    EXPECT_EQ(rgb("#12345"), -1);
    EXPECT_EQ(rgb("#ggg"), -1);
}
TEST(Color, Rgb) {
    EXPECT_EQ(rgb("rgb(255, 0 , 16)"), 0xff0010);
    EXPECT_EQ(rgb("RGB(100%, 0%, 20%)"), 0xff0033);
    EXPECT_EQ(rgb("rgb(300, -5, 0)"), 0xff0000);
    EXPECT_EQ(rgb("rgb(1 2 3)"), 0x010203);
    EXPECT_FLOAT_EQ(alpha("rgb(1 2 3 / 50%)"), 0.5f);
    EXPECT_FLOAT_EQ(alpha("rgba(1, 2, 3, .25)"), 0.25f);
    EXPECT_EQ(rgb("rgb(1, 2)"), -1);
    EXPECT_EQ(rgb("rgb(1, 2%, 3)"), -1);
}
TEST(Color, Hsl) {
    EXPECT_EQ(rgb("hsl(120, 100%, 25%)"), 0x008000);
    EXPECT_EQ(rgb("hsl(-240, 100%, 50%)"), 0x00ff00);
    EXPECT_EQ(rgb("hsl(0.5turn 100% 50%)"), 0x00ffff);
    EXPECT_FLOAT_EQ(alpha("hsla(0, 0%, 0%, 0.5)"), 0.5f);
}
TEST(Color, IccColorsBehindAreIgnored) { EXPECT_EQ(rgb("#010203 icc-color(x, 1, 2)"), 0x010203); }

TEST(Length, UnitsBecomeUserUnits) {
    Units units;
    units.fontSize = 20;
    units.rootFontSize = 10;
    units.root = {200, 400};
    for (const auto& [text, value] :
         std::initializer_list<std::pair<std::string_view, double>>{{"7", 7},
                                                                    {"7px", 7},
                                                                    {"1in", 96},
                                                                    {"72pt", 96},
                                                                    {"6pc", 96},
                                                                    {"2.54cm", 96},
                                                                    {"25.4mm", 96},
                                                                    {"2em", 40},
                                                                    {"2ex", 20},
                                                                    {"2rem", 20},
                                                                    {"5vw", 10},
                                                                    {"5vh", 20},
                                                                    {"5vmin", 10},
                                                                    {"5vmax", 20}})
        EXPECT_NEAR(parseLength(text, units).value_or(Length{-1}).value, value, 1e-9) << text;
    EXPECT_FALSE(parseLength("1 px", units));
    EXPECT_FALSE(parseLength("1parsec", units));
}
TEST(Length, PercentagesReferToTheirAxis) {
    const Viewport viewport{300, 400};
    EXPECT_DOUBLE_EQ(resolve({50, true}, Axis::X, viewport), 150);
    EXPECT_DOUBLE_EQ(resolve({50, true}, Axis::Y, viewport), 200);
    EXPECT_DOUBLE_EQ(resolve({50, true}, Axis::Diagonal, viewport), 250 / std::numbers::sqrt2);
}

scene::Affine transform(std::string_view text) {
    return parseTransform(text, {}, {200, 100}).value_or(scene::Affine(0));
}

TEST(Transform, ReadsTheFunctionsOfSvg) {
    expectNear(transform("matrix(1,2 3 4-5-6)"), {1, 2, 3, 4, -5, -6});
    expectNear(transform("translate(3)"), {1, 0, 0, 1, 3, 0});
    expectNear(transform("scale(2)"), {2, 0, 0, 2, 0, 0});
    expectNear(transform("rotate(90)"), {0, 1, -1, 0, 0, 0});
    expectNear(transform("rotate(90, 10, 0)"), {0, 1, -1, 0, 10, -10});
    expectNear(transform("skewX(45)"), {1, 0, 1, 1, 0, 0});
    expectNear(transform("skewY(45)"), {1, 1, 0, 1, 0, 0});
}
TEST(Transform, ReadsTheFunctionsOfCss) {
    expectNear(transform("translate(10px, 50%)"), {1, 0, 0, 1, 10, 50});
    expectNear(transform("rotate(0.25turn)"), {0, 1, -1, 0, 0, 0});
    expectNear(transform("translateX(1px) scaleY(3)"), {1, 0, 0, 3, 1, 0});
}
TEST(Transform, AppliesTheLastFunctionFirst) {
    expectNear(transform("translate(10 0),scale(2)  rotate(90)"), {0, 2, -2, 0, 10, 0});
}
TEST(Transform, NoneAndNothingAreTheIdentity) {
    expectNear(transform("none"), scene::identity);
    expectNear(transform("  "), scene::identity);
}
TEST(Transform, MalformedListsAreNone) {
    for (const std::string_view text : {"translate(1", "scale()", "matrix(1 2 3)", "fly(1)", "scale(1) x"})
        EXPECT_FALSE(parseTransform(text, {}, {})) << text;
}
TEST(Transform, OriginTakesKeywordsInAnyOrder) {
    const auto origin = parseTransformOrigin("top 30px", {});
    ASSERT_TRUE(origin);
    EXPECT_DOUBLE_EQ(origin->x.value, 30);
    EXPECT_TRUE(origin->y.percent);
    EXPECT_DOUBLE_EQ(origin->y.value, 0);
}
TEST(Transform, OriginMovesTheCentre) {
    const scene::Item item =
        itemOf("<rect width='4' height='4' transform='rotate(90)' transform-origin='10 0'/>");
    expectNear(item.transform, {0, 1, -1, 0, 10, -10});
}
TEST(Transform, StyleWinsOverTheAttribute) {
    expectNear(
        itemOf("<rect width='4' height='4' transform='scale(2)' style='transform: scale(3)'/>").transform,
        {3, 0, 0, 3, 0, 0});
}

TEST(ViewBox, NeedsFourNumbersAndASize) {
    EXPECT_TRUE(parseViewBox("0,0 10 , 20"));
    EXPECT_FALSE(parseViewBox("0 0 10"));
    EXPECT_FALSE(parseViewBox("0 0 0 10"));
}
TEST(ViewBox, MeetCentresByDefault) {
    expectNear(scene::fittedMap({10, 10, 100, 50}, parseAspectRatio(""), {0, 0, 100, 100}),
               {1, 0, 0, 1, -10, 15});
}
TEST(ViewBox, SliceFills) {
    expectNear(scene::fittedMap({0, 0, 100, 50}, parseAspectRatio("xMaxYMin slice"), {0, 0, 100, 100}),
               {2, 0, 0, 2, -100, 0});
}
TEST(ViewBox, NoneStretches) {
    expectNear(scene::fittedMap({0, 0, 100, 50}, parseAspectRatio("none"), {5, 0, 100, 100}),
               {1, 0, 0, 2, 5, 0});
}

TEST(Values, ColorsOfOtherSpaces) {
    for (const char* red :
         {"hwb(0 0% 0%)", "hwb(0deg 0% 0% / 1)", "lab(54.2905 80.8049 69.8910)",
          "lab(54.2905% 64.64% 55.91%)", "lch(54.2905 106.8372 40.8576)", "oklab(0.62796 0.22486 0.12585)",
          "oklch(0.62796 0.25768 29.2339)", "oklch(62.796% 0.25768 29.2339deg)", "color(srgb 1 0 0)",
          "color(srgb 100% 0% none)", "color(display-p3 0.9175 0.2003 0.1386)", "color(a98-rgb 0.85859 0 0)",
          "color(prophoto-rgb 0.70225 0.27572 0.10355)", "color(rec2020 0.79198 0.23098 0.07376)",
          "color(xyz 0.41239 0.21264 0.01933)", "color(xyz-d50 0.43607 0.22249 0.01392)",
          "color(srgb-linear 1 0 0)", "color-mix(in srgb, red, red)", "color-mix(in oklab, red 30%, red)"})
        EXPECT_EQ(rgb(red), 0xff0000) << red;
    EXPECT_EQ(rgb("hwb(120 50% 50%)"), 0x808080);
    EXPECT_EQ(rgb("hwb(90 20% 30%)"), 0x73b333);
    EXPECT_EQ(rgb("lab(100 0 0)"), 0xffffff);
    EXPECT_EQ(rgb("color(srgb-linear 0.2142 0.2142 0.2142)"), 0x808080);
    EXPECT_EQ(rgb("color(display-p3 0 1 0)"), 0x00ff00) << "cut to sRGB";
    EXPECT_EQ(rgb("color-mix(in srgb, red 25%, blue)"), 0x4000bf);
    EXPECT_EQ(rgb("color-mix(in srgb-linear, red, blue)"), 0xbc00bc);
    EXPECT_EQ(rgb("color-mix(in oklab, white, black)"), 0x636363);
    EXPECT_FLOAT_EQ(parseColor("color-mix(in srgb, red 20%, lime 40%)")->a, 0.6f);
    EXPECT_EQ(rgb("color-mix(in srgb, color-mix(in srgb, red, red), 0% blue)"), 0xff0000);
    EXPECT_FLOAT_EQ(parseColor("oklch(0.5 0.1 20 / 40%)")->a, 0.4f);
    for (const char* wrong : {"hwb(0, 0%, 0%)", "lab(50 0)", "lab(50 0 0 0)", "color(nowhere 0 0 0)",
                              "color(srgb 1 0)", "color-mix(red, blue)", "color-mix(in srgb, red)",
                              "color-mix(in srgb, red 0%, blue 0%)", "color-mix(in srgb, red 120%, blue)"})
        EXPECT_EQ(rgb(wrong), -1) << wrong;
}

TEST(Values, MathIsDone) {
    Units units;
    units.fontSize = 10;
    const auto of = [&](std::string_view text, double whole = 200) {
        const auto length = parseLength(text, units);
        return length ? length->of(whole) : -1e9;
    };
    EXPECT_DOUBLE_EQ(of("calc(2px + 3em)"), 32);
    EXPECT_DOUBLE_EQ(of("calc(50% - 10px)"), 90);
    EXPECT_DOUBLE_EQ(of("calc(2 * (3px + 1em) / 4)"), 6.5);
    EXPECT_DOUBLE_EQ(of("calc( 100%/4 )"), 50);
    EXPECT_DOUBLE_EQ(of("CALC(1px*2*3)"), 6);
    EXPECT_DOUBLE_EQ(of("calc(2 * 3)"), 6);
    EXPECT_DOUBLE_EQ(of("min(3px, 1em, 2px + 0.5px)"), 2.5);
    EXPECT_DOUBLE_EQ(of("max(10%, 30%)"), 60);
    EXPECT_DOUBLE_EQ(of("clamp(5px, 1px, 9px)"), 5);
    EXPECT_DOUBLE_EQ(of("calc(min(1px, 2px) + calc(3px))"), 4);
    EXPECT_DOUBLE_EQ(*parseFraction("calc(1 / 4)"), 0.25);
    EXPECT_DOUBLE_EQ(*parseFraction("calc(10% + 5%)"), 0.15);
    for (const char* wrong :
         {"calc()", "calc(1px", "calc(1px+2px)", "calc(1px + 2)", "calc(1px * 2px)", "calc(2 / 1px)",
          "calc(1px / 0)", "min(10%, 3px)", "clamp(1px, 2px)", "calc(1px,2px)", "calc(1px) 2", "calc(foo)"})
        EXPECT_FALSE(parseLength(wrong, units)) << wrong;
    std::string deep;
    for (int i = 0; i < 5000; ++i)
        deep += "calc(";
    EXPECT_FALSE(parseLength(deep + "1px", units));
    EXPECT_FALSE(parseFraction("calc(1px)"));
}

}  // namespace
}  // namespace vtm::svg
