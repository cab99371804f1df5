#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

constexpr std::string_view stops =
    "<stop stop-color='red'/><stop offset='1' stop-color='blue' stop-opacity='.5'/>";
constexpr std::string_view target = "<rect x='10' y='20' width='40' height='80' fill='url(#p)'/>";

scene::Paint paintOf(const std::string& servers, std::string_view shape = target) {
    return itemOf(servers + std::string(shape)).paint;
}
scene::LinearGradient linear(const std::string& attributes, std::string_view content = stops) {
    const auto paint =
        paintOf("<linearGradient id='p' " + attributes + ">" + std::string(content) + "</linearGradient>");
    const auto* gradient = std::get_if<scene::LinearGradient>(&paint);
    EXPECT_TRUE(gradient);
    return gradient ? *gradient : scene::LinearGradient{};
}
scene::RadialGradient radial(const std::string& attributes) {
    const auto paint =
        paintOf("<radialGradient id='p' " + attributes + ">" + std::string(stops) + "</radialGradient>");
    const auto* gradient = std::get_if<scene::RadialGradient>(&paint);
    EXPECT_TRUE(gradient);
    return gradient ? *gradient : scene::RadialGradient{};
}
std::size_t count(std::string_view body) { return itemsOf(loadBody(body)).size(); }

TEST(Paint, DefaultIsBlackWithoutAStroke) { EXPECT_EQ(fillOf("<rect width='9' height='9'/>"), 0); }
TEST(Paint, NoneIsNotDrawn) { EXPECT_EQ(count("<rect width='9' height='9' fill='none'/>"), 0u); }
TEST(Paint, OpacitiesReachTheItem) {
    EXPECT_FLOAT_EQ(itemOf("<rect width='9' height='9' fill-opacity='0.25'/>").opacity, 0.25f);
    EXPECT_FLOAT_EQ(itemOf("<path d='M0 0H5' stroke='red' stroke-opacity='30%'/>").opacity, 0.3f);
    EXPECT_FLOAT_EQ(itemOf("<rect width='9' height='9' fill-opacity='7'/>").opacity, 1);
}
TEST(Paint, ColoursOfLinearLightStayInRange) {
    for (const char* color : {"red", "lime", "blue", "yellow", "white"})
        for (const scene::GradientStop& stop :
             linear("color-interpolation='linearRGB'",
                    std::string("<stop/><stop offset='1' stop-color='") + color + "'/>")
                 .stops)
            for (const float channel : {stop.color.r, stop.color.g, stop.color.b}) {
                EXPECT_GE(channel, 0) << color;
                EXPECT_LE(channel, 1) << color;
            }
}
TEST(Paint, MissingServersFallBack) {
    EXPECT_EQ(fillOf("<rect width='9' height='9' fill='url(#no) lime'/>"), 0x00ff00);
    EXPECT_EQ(fillOf("<rect width='9' height='9' color='lime' fill='url(#no) currentColor'/>"), 0x00ff00);
    EXPECT_EQ(count("<rect width='9' height='9' fill='url(#no) none'/>"), 0u);
    EXPECT_EQ(count("<rect width='9' height='9' fill='url(#no)'/>"), 0u);
}
TEST(Paint, PatternsThatPaintNothingFallBack) {
    const std::string content = "<rect width='9' height='9' fill='red'/>";
    for (const std::string& pattern :
         {"<pattern id='p'>" + content + "</pattern>",
          "<pattern id='p' width='0' height='5' patternUnits='userSpaceOnUse'>" + content + "</pattern>",
          std::string("<pattern id='p' width='5' height='5' patternUnits='userSpaceOnUse'/>"),
          "<pattern id='p' width='1' height='1' viewBox='0 0 0 9'>" + content + "</pattern>",
          "<pattern id='p' width='1' height='1' patternTransform='scale(0)'>" + content + "</pattern>"}) {
        EXPECT_EQ(fillOf(pattern + "<rect width='9' height='9' fill='url(#p) lime'/>"), 0x00ff00) << pattern;
        EXPECT_EQ(count(pattern + "<rect width='9' height='9' fill='url(#p)'/>"), 0u) << pattern;
    }
}
TEST(Paint, UrlsMayBeQuoted) {
    EXPECT_TRUE(std::holds_alternative<scene::LinearGradient>(
        paintOf("<linearGradient id='p'>" + std::string(stops) + "</linearGradient>",
                "<rect width='9' height='9' fill=\"url( '#p' )\"/>")));
}

TEST(Paint, UrlsWithSpacesMustBeQuoted) {
    const std::string gradient = "<linearGradient id='a (1)'>" + std::string(stops) + "</linearGradient>";
    EXPECT_TRUE(std::holds_alternative<scene::LinearGradient>(
        paintOf(gradient, "<rect width='9' height='9' fill='url(\"#a (1)\")'/>")));
    EXPECT_EQ(rgbOf(paintOf(gradient, "<g fill='lime'><rect width='9' height='9' fill='url(#a (1))'/></g>")),
              0x00ff00);
    EXPECT_EQ(fillOf("<g fill='lime'><rect width='9' height='9' fill='url(#a b)'/></g>"), 0x00ff00);
}

TEST(Gradient, BoxUnitsMapTheBox) {
    const auto gradient = linear("");
    expectNear(gradient.start, {0, 0});
    expectNear(gradient.end, {1, 0});
    expectNear(gradient.transform, {40, 0, 0, 80, 10, 20});
}
TEST(Gradient, UserUnitsTakePercentagesOfTheViewport) {
    const auto gradient = linear("gradientUnits='userSpaceOnUse' x1='10%' y2='50'");
    expectNear(gradient.start, {10, 0});
    expectNear(gradient.end, {100, 50});
}
TEST(Gradient, TransformComesFirst) {
    expectNear(linear("gradientTransform='translate(0.5)'").transform, {40, 0, 0, 80, 30, 20});
}
TEST(Gradient, StopsCarryColourAndOpacity) {
    const auto gradient = linear("");
    ASSERT_EQ(gradient.stops.size(), 2u);
    EXPECT_EQ(gradient.stops[0].color, (scene::Color{1, 0, 0, 1}));
    EXPECT_EQ(gradient.stops[1].color, (scene::Color{0, 0, 1, 0.5f}));
}
TEST(Gradient, OffsetsAreClampedAndNeverDecrease) {
    const auto gradient =
        linear("", "<stop offset='-1'/><stop offset='60%'/><stop offset='0.2'/><stop offset='9'/>");
    ASSERT_EQ(gradient.stops.size(), 4u);
    EXPECT_EQ(gradient.stops[0].offset, 0);
    EXPECT_EQ(gradient.stops[1].offset, 0.6f);
    EXPECT_EQ(gradient.stops[2].offset, 0.6f);
    EXPECT_EQ(gradient.stops[3].offset, 1);
}
TEST(Gradient, SpreadIsKept) {
    EXPECT_EQ(linear("spreadMethod='reflect'").spread, scene::Spread::Reflect);
    EXPECT_EQ(linear("spreadMethod='repeat'").spread, scene::Spread::Repeat);
    EXPECT_EQ(linear("spreadMethod='nonsense'").spread, scene::Spread::Pad);
}
TEST(Gradient, AttributesAndStopsComeFromTheTemplate) {
    const auto paint = paintOf(
        "<linearGradient id='p' xlink:href='#t' x2='0.5'/><linearGradient id='t' x1='0.25' x2='0.75' "
        "spreadMethod='repeat'>" +
        std::string(stops) + "</linearGradient>");
    const auto& gradient = std::get<scene::LinearGradient>(paint);
    expectNear(gradient.start, {0.25, 0});
    expectNear(gradient.end, {0.5, 0});
    EXPECT_EQ(gradient.spread, scene::Spread::Repeat);
    EXPECT_EQ(gradient.stops.size(), 2u);
}
TEST(Gradient, TemplatesInACircleEnd) {
    EXPECT_EQ(
        count("<linearGradient id='p' href='#q'/><linearGradient id='q' href='#p'/>" + std::string(target)),
        0u);
}
TEST(Gradient, OneStopIsAColour) {
    EXPECT_EQ(rgbOf(paintOf("<linearGradient id='p'><stop stop-color='lime'/></linearGradient>")), 0x00ff00);
}
TEST(Gradient, WithoutALineIsTheLastColour) {
    EXPECT_EQ(rgbOf(paintOf("<linearGradient id='p' x2='0'>" + std::string(stops) + "</linearGradient>")),
              0x0000ff);
}
TEST(Gradient, WithoutARadiusIsTheLastColour) {
    EXPECT_EQ(rgbOf(paintOf("<radialGradient id='p' r='0'>" + std::string(stops) + "</radialGradient>")),
              0x0000ff);
}
TEST(Gradient, BoxUnitsNeedABox) {
    const std::string server = "<linearGradient id='p'>" + std::string(stops) + "</linearGradient>";
    EXPECT_EQ(count(server + "<path d='M 0 0 H 10' stroke='url(#p)'/>"), 0u);
    EXPECT_EQ(rgbOf(paintOf(server, "<path d='M 0 0 H 10' stroke='url(#p) lime'/>")), 0x00ff00);
}
TEST(Gradient, FocusDefaultsToTheCentre) {
    const auto gradient = radial("cx='0.25'");
    expectNear(gradient.focus, {0.25, 0.5});
    EXPECT_EQ(gradient.radius, 0.5);
}
TEST(Gradient, FocusMayLieOutside) {
    const auto gradient = radial("fx='3' fr='0.7'");
    expectNear(gradient.focus, {3, 0.5});
    EXPECT_EQ(gradient.focalRadius, 0.7);
}
TEST(Gradient, StopsTakeCurrentColor) {
    const auto gradient = linear("color='lime'", "<stop stop-color='currentColor'/><stop offset='1'/>");
    EXPECT_EQ(gradient.stops[0].color, (scene::Color{0, 1, 0, 1}));
}

constexpr std::string_view tileContent = "<rect width='2' height='2' fill='lime'/>";

scene::Pattern pattern(const std::string& attributes) {
    const auto paint =
        paintOf("<pattern id='p' " + attributes + ">" + std::string(tileContent) + "</pattern>");
    const auto* made = std::get_if<scene::Pattern>(&paint);
    EXPECT_TRUE(made);
    return made ? *made : scene::Pattern{};
}

TEST(Pattern, UserUnitsPlaceTheTile) {
    const auto made = pattern("patternUnits='userSpaceOnUse' x='3' y='4' width='5' height='6'");
    expectNear(scene::apply(made.transform, made.min), {3, 4});
    expectNear(scene::apply(made.transform, made.max), {8, 10});
    ASSERT_EQ(made.content->children.size(), 1u);
}
TEST(Pattern, BoxUnitsAreSharesOfTheBox) {
    const auto made = pattern("width='0.5' height='0.25'");
    expectNear(scene::apply(made.transform, made.min), {10, 20});
    expectNear(scene::apply(made.transform, made.max), {30, 40});
}
TEST(Pattern, ViewBoxScalesTheContent) {
    const auto made = pattern("patternUnits='userSpaceOnUse' width='10' height='10' viewBox='0 0 2 2'");
    expectNear(made.max - made.min, {2, 2});
    expectNear(made.transform, {5, 0, 0, 5, 0, 0});
}
TEST(Pattern, BoxContentUnitsScaleTheContent) {
    const auto made = pattern("width='0.5' height='0.5' patternContentUnits='objectBoundingBox'");
    expectNear(made.transform, {40, 0, 0, 80, 10, 20});
    expectNear(made.max - made.min, {0.5, 0.5});
}
TEST(Pattern, TransformIsApplied) {
    expectNear(
        pattern("patternUnits='userSpaceOnUse' width='1' height='1' patternTransform='scale(3)'").transform,
        {3, 0, 0, 3, 0, 0});
}
TEST(Pattern, ContentIsShared) {
    const auto items = itemsOf(
        loadBody("<pattern id='p' patternUnits='userSpaceOnUse' width='5' height='5'>" +
                 std::string(tileContent) + "</pattern>" + std::string(target) + std::string(target)));
    ASSERT_EQ(items.size(), 2u);
    EXPECT_EQ(std::get<scene::Pattern>(items[0].paint).content,
              std::get<scene::Pattern>(items[1].paint).content);
}
TEST(Pattern, WithoutASizeOrContentPaintsNothing) {
    EXPECT_EQ(count("<pattern id='p' width='0' height='1'>" + std::string(tileContent) + "</pattern>" +
                    std::string(target)),
              0u);
    EXPECT_EQ(count("<pattern id='p' width='1' height='1'/>" + std::string(target)), 0u);
}
TEST(Pattern, InACircleFallsBack) {
    const auto made = paintOf(
        "<pattern id='p' width='1' height='1'><rect width='9' height='9' fill='url(#p) lime'/></pattern>");
    const auto& content = std::get<scene::Pattern>(made).content->children;
    ASSERT_EQ(content.size(), 1u);
    EXPECT_EQ(rgbOf(std::get<scene::Item>(content[0].value).paint), 0x00ff00);
}

TEST(ContextPaint, IsThatOfTheUse) {
    EXPECT_EQ(fillOf("<defs><rect id='r' width='9' height='9' fill='context-stroke' stroke='none'/></defs>"
                     "<use href='#r' fill='red' stroke='lime'/>"),
              0x00ff00);
}
TEST(ContextPaint, GradientsLieInTheUsesSpace) {
    const auto paint =
        paintOf("<linearGradient id='p'>" + std::string(stops) + "</linearGradient>",
                "<defs><g id='g'><rect width='10' height='10' fill='context-fill' transform='scale(2)'/>"
                "<rect x='20' width='20' height='40' fill='none'/></g></defs>"
                "<use href='#g' fill='url(#p)'/>");
    expectNear(std::get<scene::LinearGradient>(paint).transform, {20, 0, 0, 20, 0, 0});
}
TEST(ContextPaint, WithoutAContextIsNone) {
    EXPECT_EQ(count("<rect width='9' height='9' fill='context-fill'/>"), 0u);
}

}  // namespace
}  // namespace vtm::svg
