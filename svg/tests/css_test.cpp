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
TEST(Css, SelectsByClassesAndMore) {
    EXPECT_EQ(fillUnder(".b.a { fill: lime }"), lime);
    EXPECT_EQ(fillUnder(".b.c { fill: lime }"), black);
    EXPECT_EQ(fillUnder("rect.b { fill: lime }"), lime);
    EXPECT_EQ(fillUnder("circle.b { fill: lime }"), black);
    EXPECT_EQ(fillUnder(".b#r { fill: lime }"), lime);
    EXPECT_EQ(fillUnder(":is(.b) { fill: lime }"), lime);
}
TEST(Css, NamesMayBeOfClassesTypesAndIdsAtOnce) {
    const auto fill = [](const std::string& sheet) {
        return fillOf("<style>" + sheet +
                      "</style><rect id='rect' class='\nrect\trect x ' width='9' height='9'/>");
    };
    EXPECT_EQ(fill(".rect { fill: lime }"), lime);
    EXPECT_EQ(fill("rect { fill: red } .rect { fill: lime }"), lime);
    EXPECT_EQ(fill("#rect { fill: lime } .rect { fill: red } rect { fill: blue }"), lime);
    EXPECT_EQ(fill(".x { fill: red } .rect { fill: lime }"), lime) << "the later one";
    EXPECT_EQ(fill(".rect { fill: lime !important } .x { fill: red }"), lime);
}
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
TEST(Css, SelectsByPlaceAmongSiblings) {
    // Which of seven elements, rects but for a circle in the middle, are lime.
    const auto chosen = [](const std::string& selector) {
        std::string body = "<style>" + selector + " { fill: lime }</style><g>";
        for (int i = 1; i <= 7; ++i)
            body += i == 4 ? "<circle r='1'/>" : "<rect width='1' height='1'/>";
        std::string result;
        for (const scene::Item& item : itemsOf(loadBody(body + "</g>")))
            result += rgbOf(item.paint) == lime ? 'x' : '.';
        return result;
    };
    EXPECT_EQ(chosen("g > :nth-child(odd)"), "x.x.x.x");
    EXPECT_EQ(chosen("g > :nth-child( 2n )"), ".x.x.x.");
    EXPECT_EQ(chosen("g > :nth-child(3n + 2)"), ".x..x..");
    EXPECT_EQ(chosen("g > :nth-child(-n+3)"), "xxx....");
    EXPECT_EQ(chosen("g > :nth-child(n+6)"), ".....xx");
    EXPECT_EQ(chosen("g > :nth-child(4)"), "...x...");
    EXPECT_EQ(chosen("g > :nth-child(-2n-1)"), ".......");
    EXPECT_EQ(chosen("g > :nth-last-child(2)"), ".....x.");
    EXPECT_EQ(chosen("rect:nth-of-type(4)"), "....x..");
    EXPECT_EQ(chosen("rect:nth-last-of-type(4)"), "..x....");
    EXPECT_EQ(chosen("rect:first-of-type"), "x......");
    EXPECT_EQ(chosen("g > :last-of-type"), "...x..x");
    EXPECT_EQ(chosen(":only-of-type:not(g):not(svg)"), "...x...");
    EXPECT_EQ(chosen("g > :only-child"), ".......");
    EXPECT_EQ(chosen("g > :not(rect, :nth-child(2))"), "...x...");
    EXPECT_EQ(chosen("g > :is(circle, :first-child)"), "x..x...");
    EXPECT_EQ(chosen("g > :nth-child(2n+)"), ".......") << "invalid";
    EXPECT_EQ(chosen(":root > g > circle:empty"), "...x...");
    EXPECT_EQ(chosen("rect, :unknown"), ".......");
    EXPECT_EQ(chosen("rect, :hover"), "xxx.xxx");
    EXPECT_EQ(chosen("rect::before, circle"), ".......");
}
TEST(Css, SelectsByLanguage) {
    EXPECT_EQ(fillOf("<style>rect:lang(de) { fill: lime }</style><g xml:lang='de-AT'><rect width='1' "
                     "height='1'/></g>"),
              lime);
    EXPECT_EQ(
        fillOf("<style>rect:lang(de) { fill: lime }</style><g lang='den'><rect width='1' height='1'/></g>"),
        black);
}
TEST(Css, ListsCountAsTheirMostSpecific) {
    EXPECT_EQ(fillUnder(":is(#x, rect) { fill: lime } .a.b { fill: red }"), lime);
    EXPECT_EQ(fillUnder(":not(#x) { fill: lime } .a.b { fill: red }"), lime);
    EXPECT_EQ(fillUnder(":where(#r) { fill: red } rect { fill: lime }"), lime);
}
TEST(Css, NestedListsAreBounded) {
    std::string selector = "rect";
    for (int i = 0; i < 3000; ++i)
        selector = ":not(" + selector + ")";
    EXPECT_EQ(fillUnder(selector + " { fill: red } rect { fill: lime }"), lime);
}
TEST(Css, MediaAreThoseOfALightScreen) {
    const auto holds = [](const std::string& query) {
        return fillUnder("@media " + query + " { rect { fill: lime } }") == lime;
    };
    for (const char* query :
         {"screen", "all", "", "print, screen", "only screen", "not print", "(prefers-color-scheme: light)",
          "screen and (prefers-color-scheme:light)", "not all and (prefers-color-scheme: dark)", "(color)",
          "(prefers-reduced-motion: no-preference)"})
        EXPECT_TRUE(holds(query)) << query;
    for (const char* query :
         {"print", "(prefers-color-scheme: dark)", "screen and (prefers-color-scheme: dark)", "not screen",
          "(min-width: 100px)", "not all and (min-width: 100px)", "screen and", "(prefers-reduced-motion)",
          "("})
        EXPECT_FALSE(holds(query)) << query;
    EXPECT_EQ(
        fillOf("<style media='print'>rect{fill:red}</style><style media='screen'>rect{fill:lime}</style>"
               "<rect width='1' height='1'/>"),
        lime);
}
TEST(Css, SupportsIsAskedFor) {
    const auto holds = [](const std::string& condition) {
        return fillUnder("@supports " + condition + " { rect { fill: lime } }") == lime;
    };
    for (const char* condition :
         {"(fill: red)", "not (fill: nonsense)", "(fill: red) and (stroke: blue)",
          "(x: nonsense) or (fill: red)", "selector(a > b)", "((fill: red) and (not (no: 1)))"})
        EXPECT_TRUE(holds(condition)) << condition;
    for (const char* condition :
         {"(fill: nonsense)", "not (fill: red)", "(no: 1)", "selector(:unknown)", "fill: red", "("})
        EXPECT_FALSE(holds(condition)) << condition;
}
TEST(Css, VariablesAreInheritedAndReplaced) {
    EXPECT_EQ(fillUnder(":root { --main: lime } rect { fill: var(--main) }"), lime);
    EXPECT_EQ(fillUnder(":root { --main: red } .outer { --main: lime } rect { fill: var( --main ) }"), lime);
    EXPECT_EQ(fillUnder("rect { fill: var(--none, lime) }"), lime);
    EXPECT_EQ(fillUnder("rect { fill: var(--none, var(--other, rgb(0, 255, 0))) }"), lime);
    EXPECT_EQ(fillUnder(":root { --g: 255 } rect { fill: rgb(0, var(--g), 0) }"), lime);
    EXPECT_EQ(fillUnder("", "style='--c: lime; fill: var(--c)'"), lime);
    EXPECT_EQ(fillUnder(".outer { --c: lime }", "fill='var(--c)'"), lime);
    EXPECT_EQ(fillUnder(":root { --a: var(--b); --b: lime } rect { fill: var(--a) }"), lime);
    EXPECT_EQ(fillUnder("rect { --c: red !important; fill: var(--c) } #r { --c: lime }"), red);
}
TEST(Css, VariablesThatCannotBeHadCountAsUnset) {
    EXPECT_EQ(fillUnder(".outer { fill: lime } rect { fill: red; fill: var(--none) }"), lime);
    EXPECT_EQ(fillUnder(".outer { fill: lime } rect { --a: var(--b); --b: var(--a); fill: var(--a) }"), lime);
    EXPECT_EQ(fillUnder(".outer { fill: lime } rect { --a: 3px; fill: var(--a) }"), lime);
    std::string sheet = ".outer { fill: lime; --v0: ; ";
    for (int i = 1; i < 60; ++i)
        sheet += "--v" + std::to_string(i) + ": var(--v" + std::to_string(i - 1) + ") var(--v" +
                 std::to_string(i - 1) + "); ";
    EXPECT_EQ(fillUnder(sheet + "} rect { fill: var(--v25) }"), lime) << "too long to replace";
}
TEST(Css, SelectsFromLists) { EXPECT_EQ(fillUnder("circle, rect { fill: lime }"), lime); }
TEST(Css, UnsupportedSelectorsVoidTheirRuleOnly) {
    EXPECT_EQ(fillUnder("rect, rect:unknown { fill: red } g rect { fill: lime }"), lime);
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
