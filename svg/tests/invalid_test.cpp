// Values that cannot be read: named in a warning, and taken for absent.

#include "svg/geometry/path_geometry.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

std::vector<std::string> warningsOf(std::string_view body) {
    std::vector<std::string> messages;
    for (const Warning& warning : loadBody(body).warnings)
        messages.push_back(warning.message);
    return messages;
}

/// The one warning about one attribute of one element of an otherwise faultless document.
void expectInvalid(const std::string& element, const std::string& attribute, const std::string& value) {
    const std::string body = "<" + element + " " + attribute + "=\"" + value + "\"/>";
    const std::vector<std::string> messages = warningsOf("<defs>" + body + "</defs>");
    ASSERT_EQ(messages.size(), 1u) << body;
    EXPECT_EQ(messages[0],
              "<" + element + ">: " + attribute + "=\"" + value + "\" is not valid; it is ignored");
}
void expectValid(const std::string& element, const std::string& attribute, const std::string& value) {
    const std::string body = "<" + element + " " + attribute + "=\"" + value + "\"/>";
    EXPECT_EQ(warningsOf("<defs>" + body + "</defs>"), std::vector<std::string>{}) << body;
}

TEST(Invalid, LengthsAreNamed) {
    for (const char* attribute : {"x", "y", "width", "height", "rx", "ry", "pathLength"})
        for (const char* value : {"abc", "1 2", "3furlongs", "", "1e", "%"})
            expectInvalid("rect", attribute, value);
    expectInvalid("circle", "cx", "none");
    expectInvalid("circle", "r", "#9");
    expectInvalid("line", "y2", "1,5");
    expectInvalid("use", "x", "left");
    expectInvalid("image", "width", "wide");
    expectInvalid("mask", "height", "1fr");
    expectInvalid("pattern", "width", "a");
    expectInvalid("rect", "rx", "-1");
    expectInvalid("path", "pathLength", "-3");
    for (const char* value : {"12", " 3.5 ", "50%", "2mm", "1em", "auto", "-3", "3vw", "+.5e1px"})
        expectValid("rect", "width", value);
}

TEST(Invalid, AttributesOfPaintServersAreNamed) {
    expectInvalid("linearGradient", "x1", "a");
    expectInvalid("linearGradient", "gradientUnits", "userspaceonuse");
    expectInvalid("linearGradient", "gradientTransform", "rotate(a)");
    expectInvalid("radialGradient", "spreadMethod", "mirror");
    expectInvalid("radialGradient", "r", "-1");
    expectInvalid("radialGradient", "fx", "center");
    expectInvalid("stop", "offset", "half");
    expectInvalid("pattern", "patternTransform", "scale(");
    expectInvalid("pattern", "viewBox", "0 0 -5 9");
    expectValid("stop", "offset", "50%");
    expectValid("radialGradient", "spreadMethod", "reflect");
    expectValid("linearGradient", "gradientTransform", "");
    expectValid("pattern", "viewBox", "0 0 0 9");
}

TEST(Invalid, AttributesOfContainersAreNamed) {
    expectInvalid("symbol", "viewBox", "0 0 10");
    expectInvalid("symbol", "viewBox", "nan nan nan nan");
    expectInvalid("symbol", "preserveAspectRatio", "xMidYMid meat");
    expectInvalid("marker", "orient", "up");
    expectInvalid("marker", "refX", "top");
    expectInvalid("marker", "markerUnits", "userSpace");
    expectInvalid("clipPath", "clipPathUnits", "box");
    expectInvalid("mask", "maskContentUnits", "user");
    expectValid("marker", "orient", "0.5turn");
    expectValid("marker", "refY", "top");
    expectValid("symbol", "preserveAspectRatio", "xMinYMax slice");
    expectValid("symbol", "preserveAspectRatio", "none meet");
}

TEST(Invalid, PresentationAttributesAreNamed) {
    for (const auto& [attribute, value] :
         std::initializer_list<std::pair<const char*, const char*>>{{"fill", "octarine"},
                                                                    {"fill", "#12345"},
                                                                    {"stroke", "rgb(1, 2)"},
                                                                    {"stroke-width", "-1"},
                                                                    {"stroke-width", "thick"},
                                                                    {"opacity", "x"},
                                                                    {"fill-opacity", "1 1"},
                                                                    {"transform", "spin(9)"},
                                                                    {"transform", "rotate(a)"},
                                                                    {"fill-rule", "odd"},
                                                                    {"stroke-linecap", "flat"},
                                                                    {"stroke-linejoin", "sharp"},
                                                                    {"stroke-miterlimit", "0.5"},
                                                                    {"stroke-dasharray", "5 -1"},
                                                                    {"clip-path", "circle(-1px)"},
                                                                    {"visibility", "gone"},
                                                                    {"paint-order", "fill fill"}})
        expectInvalid("path", attribute, value);
    for (const auto& [attribute, value] :
         std::initializer_list<std::pair<const char*, const char*>>{{"fill", "currentColor"},
                                                                    {"fill", "url(#none) red"},
                                                                    {"color", "currentColor"},
                                                                    {"color", "inherit"},
                                                                    {"stroke", "revert"},
                                                                    {"opacity", "50%"},
                                                                    {"opacity", "7"},
                                                                    {"transform", ""},
                                                                    {"transform", "none"},
                                                                    {"stroke-dasharray", "none"}})
        expectValid("path", attribute, value);
}

/// Whose value may be none, as `auto` is.
TEST(Invalid, PropertiesThatMayBeNoneAreNamed) {
    const auto warnings = [](const std::string& property, const std::string& value) {
        return warningsOf("<text style='" + property + ": " + value + "'/>");
    };
    for (const char* property :
         {"overflow", "transform-origin", "font-kerning", "font-size-adjust", "white-space", "inline-size",
          "text-decoration", "text-decoration-thickness", "text-underline-offset"})
        for (const char* value : {"foo", "/", "underline,overline"})
            EXPECT_EQ(warnings(property, value),
                      std::vector<std::string>{"<text>: " + std::string(property) + "=\"" + value +
                                               "\" is not valid; it is ignored"});
    EXPECT_TRUE(warnings("inline-size", "auto").empty());
    EXPECT_TRUE(warnings("font-size-adjust", "none").empty());
    EXPECT_TRUE(warnings("text-decoration-thickness", "from-font").empty());
}

TEST(Invalid, DeclarationsAreNamedOnceWhereTheyStand) {
    EXPECT_EQ(
        warningsOf("<rect style='fill: octarine; stroke-width: 1px; unknown: 5' width='9' height='9'/>"),
        std::vector<std::string>{R"(<rect>: fill="octarine" is not valid; it is ignored)"});
    EXPECT_EQ(warningsOf("<style>rect { opacity: much } g { width: a }</style>"
                         "<rect width='9' height='9'/><rect width='5' height='9'/>"),
              (std::vector<std::string>{R"(<style>: opacity="much" is not valid; it is ignored)",
                                        R"(<style>: width="a" is not valid; it is ignored)"}));
}

TEST(Invalid, WhatMeansSomethingElseIsLeftAlone) {
    EXPECT_TRUE(warningsOf("<title opacity='no'>t</title><metadata fill='no'/>").empty());
}

TEST(Invalid, RulesThatAreIgnoredAreNamed) {
    EXPECT_EQ(warningsOf("<style>rect::after { fill: red } @page { x: y } @media print { g { fill: red } } "
                         "rect:hover { fill: red } @media screen { a:b { fill: red } }</style>"),
              (std::vector<std::string>{R"(<style>: the rule "rect::after" is ignored)",
                                        R"(<style>: the rule "@page" is ignored)",
                                        R"(<style>: the rule "a:b" is ignored)"}));
}

TEST(Invalid, WhatActsOnlyInBrowsersIsNamed) {
    EXPECT_EQ(
        warningsOf("<rect width='9' height='9'><animate fill='freeze' attributeName='x'/></rect>"
                   "<script/><foreignObject/>"),
        (std::vector<std::string>{"<animate>: animation is ignored; what it changes keeps its base value",
                                  "<script>: scripts are ignored",
                                  "<foreignObject>: holds what is not SVG; it is left out"}));
}

TEST(Invalid, WhatClipsNothingIsNamed) {
    EXPECT_EQ(warningsOf("<g id='g'/><clipPath id='c'><g/><use href='#g'/></clipPath>"
                         "<rect width='9' height='9' clip-path='url(#c)'/>"),
              (std::vector<std::string>{"<g>: clips nothing in a clipPath; it is left out",
                                        "<use>: refers to no shape and no text; it is left out"}));
}

TEST(Invalid, PathsAndPointsSayWhere) {
    const auto messageOf = [](std::string_view body) {
        const std::vector<std::string> messages = warningsOf(body);
        EXPECT_EQ(messages.size(), 1u) << body;
        return messages.empty() ? "" : messages[0];
    };
    EXPECT_EQ(messageOf("<path d='M 0 0 L 9 9 X 4 4'/>"),
              R"(<path>: d is malformed at "X 4 4"; it is read up to there)");
    EXPECT_EQ(messageOf("<path d='M 0 0 L 9 9 5 a'/>"),
              R"(<path>: d is malformed at "a"; it is read up to there)");
    EXPECT_EQ(messageOf("<path d='M 0 0 L 9'/>"), "<path>: d ends too early; it is read up to there");
    EXPECT_EQ(messageOf("<path d='L 9 9'/>"), R"(<path>: d is malformed at "L 9 9"; it is read up to there)");
    EXPECT_EQ(messageOf("<polygon points='0 0 5 5 9'/>"),
              "<polygon>: points ends too early; it is read up to there");
    EXPECT_EQ(messageOf("<polygon points='0 0 5 5 9 b 7 7'/>"),
              R"(<polygon>: points is malformed at "9 b 7 7"; it is read up to there)");
}

TEST(Invalid, LongValuesAreCutBetweenCharacters) {
    std::string value(39, ' ');
    value[0] = 'a';
    value[5] = '\n';
    const std::string shown = "a" + std::string(38, ' ');
    EXPECT_EQ(warningsOf("<rect x='" + value + "äb'/>").front(),
              "<rect>: x=\"" + shown + "…\" is not valid; it is ignored");
}

TEST(Invalid, ThePictureIsAsIfTheyWereAbsent) {
    const scene::Item item = itemOf(
        "<g fill='blue' stroke-width='3'><rect width='9' height='9' x='a' rx='b' fill='octarine' "
        "stroke='red' "
        "stroke-width='-1' opacity='x' transform='spin(9)' fill-opacity='0'/></g>");
    EXPECT_EQ(item.transform, scene::identity);
    EXPECT_EQ(std::get<scene::StrokeStyle>(item.geometry).width, 3);
    EXPECT_EQ(item.path->size(), scene::rectangle({0, 0}, {9, 9}).size());
    expectNear(boundingBox(*item.path, item.transform).max, {9, 9});
    EXPECT_EQ(item.opacity, 1);
    // A declaration that is not valid gives way to the attribute.
    const scene::Item wide = itemOf("<rect width='9' height='9' style='width: a'/>");
    expectNear(boundingBox(*wide.path, wide.transform).max, {9, 9});
}

TEST(Invalid, AnEmptyViewBoxDrawsNothing) {
    const Document loaded = loadText(
        "<svg xmlns='http://www.w3.org/2000/svg' width='64' height='32' viewBox='0 0 0 9'>"
        "<rect width='9' height='9'/></svg>");
    EXPECT_EQ(loaded.scene.width, 64);
    EXPECT_EQ(loaded.scene.height, 32);
    EXPECT_TRUE(itemsOf(loaded).empty());
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.warnings[0].message, R"(<svg>: viewBox="0 0 0 9" is empty; nothing of it is drawn)");
    EXPECT_EQ(loaded.warnings[0].where.line, 1);
}

}  // namespace
}  // namespace vtm::svg
