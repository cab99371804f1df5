#include "svg/css/css.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

/// The fill of a rect in a g under the sheet.
int fillUnder(const std::string& sheet, const std::string& attributes = "") {
    return fillOf("<style>" + sheet +
                  "</style><g class='outer'><title/><rect id='r' class='a b' width='9' height='9' " +
                  attributes + "/></g>");
}

constexpr int red = 0xff0000, lime = 0x00ff00, blue = 0x0000ff, black = 0;

TEST(Css, SelectsByType) { EXPECT_EQ(fillUnder("rect { fill: lime }"), lime); }
TEST(Css, SelectsByClass) { EXPECT_EQ(fillUnder(".b { fill: lime }"), lime); }
TEST(Css, SelectsById) { EXPECT_EQ(fillUnder("#r { fill: lime }"), lime); }
TEST(Css, SelectsAll) { EXPECT_EQ(fillUnder("* { fill: lime }"), lime); }
TEST(Css, SelectsByAttribute) { EXPECT_EQ(fillUnder("[width='9'][height] { fill: lime }"), lime); }
TEST(Css, SelectsByPartsOfAttributes) {
    EXPECT_EQ(fillUnder("[class~=b] { fill: lime }"), lime);
    EXPECT_EQ(fillUnder("[class^='a '] { fill: lime }"), lime);
    EXPECT_EQ(fillUnder("[class$=b] { fill: lime }"), lime);
    EXPECT_EQ(fillUnder("[class*=' '] { fill: lime }"), lime);
    EXPECT_EQ(fillUnder("[lang|=en] { fill: lime }", "lang='en-GB'"), lime);
}
TEST(Css, SelectsDescendants) { EXPECT_EQ(fillUnder("svg .b { fill: lime }"), lime); }
TEST(Css, SelectsChildren) {
    EXPECT_EQ(fillUnder(".outer > rect { fill: lime }"), lime);
    EXPECT_EQ(fillUnder("svg > rect { fill: lime }"), black);
}
TEST(Css, SelectsSiblings) {
    EXPECT_EQ(fillUnder("title + rect { fill: lime }"), lime);
    EXPECT_EQ(fillUnder("title ~ rect { fill: lime }"), lime);
    EXPECT_EQ(fillUnder("rect + rect { fill: lime }"), black);
}
TEST(Css, SelectsFirstAndLastChildren) {
    EXPECT_EQ(fillUnder("rect:first-child { fill: lime }"), black);
    EXPECT_EQ(fillUnder("rect:last-child { fill: lime }"), lime);
}
TEST(Css, SelectsFromLists) { EXPECT_EQ(fillUnder("circle, rect { fill: lime }"), lime); }
TEST(Css, UnsupportedSelectorsVoidTheirRuleOnly) {
    EXPECT_EQ(fillUnder("rect, rect:hover { fill: red } rect { fill: lime }"), lime);
}
TEST(Css, SpecificityDecides) {
    EXPECT_EQ(fillUnder("#r { fill: lime } .a.b { fill: red } rect { fill: blue }"), lime);
}
TEST(Css, LaterRulesWinAmongEquals) { EXPECT_EQ(fillUnder(".a { fill: red } .b { fill: lime }"), lime); }
TEST(Css, RulesWinOverAttributes) { EXPECT_EQ(fillUnder("* { fill: lime }", "fill='red'"), lime); }
TEST(Css, StyleAttributesWinOverRules) {
    EXPECT_EQ(fillUnder("#r { fill: red }", "style='fill:lime'"), lime);
}
TEST(Css, ImportantWinsOverStyleAttributes) {
    EXPECT_EQ(fillUnder("rect { fill: lime !important }", "style='fill:red'"), lime);
    EXPECT_EQ(fillUnder("rect { fill: red ! important }", "style='fill:lime !important'"), lime);
}
TEST(Css, InvalidValuesGiveWayToWeakerOnes) {
    EXPECT_EQ(fillUnder("rect { fill: nonsense }", "fill='lime'"), lime);
}
TEST(Css, InheritTakesTheParentsValue) {
    EXPECT_EQ(fillUnder(".outer { fill: lime } rect { fill: red } #r { fill: inherit }"), lime);
}
TEST(Css, CommentsAreSkipped) {
    EXPECT_EQ(fillUnder("/* rect { */ rect /**/ { fill: /* red */ lime }"), lime);
}
TEST(Css, CommentsInStyleAttributesAreSkipped) {
    EXPECT_EQ(fillUnder("", "style='/* x */fill:lime/* ;y */'"), lime);
}
TEST(Css, CdataAndHtmlCommentsAreRead) {
    EXPECT_EQ(fillUnder("<![CDATA[ rect { fill: lime } ]]>"), lime);
    EXPECT_EQ(fillUnder("<![CDATA[<!-- rect { fill: lime } -->]]>"), lime);
}
TEST(Css, AtRulesAreSkipped) {
    EXPECT_EQ(fillUnder("@import 'x.css'; @media print { rect { fill: red } } rect { fill: lime }"), lime);
}
TEST(Css, SheetsOfOtherTypesAreIgnored) {
    EXPECT_EQ(
        fillOf("<style type='text/x'>rect { fill: red }</style><rect width='1' height='1' fill='lime'/>"),
        lime);
}
TEST(Css, SemicolonsInUrlsDoNotEndDeclarations) {
    const auto declarations = parseDeclarations("a: url(data:x;y,z); b: 'p;q'");
    ASSERT_EQ(declarations.size(), 2u);
    EXPECT_EQ(declarations[0].value, "url(data:x;y,z)");
}
TEST(Css, GeometryComesFromStyles) {
    const scene::Item item = itemOf("<rect style='x: 5px; width: 10%; height: 20px' width='1'/>");
    expectNear(std::get<scene::MoveTo>(item.path->front()).to, {5, 0});
    expectNear(std::get<scene::LineTo>(item.path->at(2)).to, {15, 20});
}
TEST(Css, ColorOfCurrentColorIsTheElementsOwn) {
    EXPECT_EQ(fillOf("<g color='red' fill='currentColor'><rect color='lime' width='1' height='1'/></g>"),
              lime);
}
TEST(Css, InitialResets) {
    EXPECT_EQ(fillOf("<g fill='red'><rect fill='initial' width='1' height='1'/></g>"), black);
}
TEST(Css, MatchingStopsWhereTheBudgetEnds) {
    const auto selectors = parseSelectors("a b");
    Element outer, inner;
    outer.name = "a";
    inner.name = "b";
    inner.parent = &outer;
    long plenty = 100, little = 1;
    EXPECT_TRUE(matches(selectors->front(), inner, plenty));
    EXPECT_FALSE(matches(selectors->front(), inner, little));
}
TEST(Css, ExpensiveSheetsEndWithAWarning) {
    std::string selector;
    for (int i = 0; i < 40; ++i)
        selector += "g ";
    std::string body = "<style>svg " + selector + "x rect { fill: red }</style>";
    for (int i = 0; i < 200; ++i)
        body += "<g>";
    body += "<x><rect width='1' height='1'/></x>";
    for (int i = 0; i < 200; ++i)
        body += "</g>";
    const Document loaded = loadBody(body);
    EXPECT_FALSE(loaded.warnings.empty());
}
TEST(Css, ColorsOfRulesDoNotLeakIntoSiblings) {
    const auto items =
        itemsOf(loadBody("<style>rect:first-child{fill:blue}.x{fill:red}</style>"
                         "<g><rect width='1' height='1'/><rect width='1' height='1'/></g>"));
    ASSERT_EQ(items.size(), 2u);
    EXPECT_EQ(rgbOf(items[0].paint), blue);
    EXPECT_NE(rgbOf(items[1].paint), red);
}

}  // namespace
}  // namespace vtm::svg
