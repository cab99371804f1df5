#include "svg/geometry/path_geometry.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

constexpr std::string_view xmlns = "<svg xmlns='http://www.w3.org/2000/svg' ";

std::pair<double, double> sizeOf(std::string_view attributes, const Options& options = {}) {
    const auto scene = loadText(std::string(xmlns) + std::string(attributes) + "/>", options).scene;
    return {scene.width, scene.height};
}
using Size = std::pair<double, double>;

Box boxOf(const scene::Item& item) { return boundingBox(*item.path, item.transform); }
std::size_t count(std::string_view body) { return itemsOf(loadBody(body)).size(); }

TEST(Root, SizeComesFromItsAttributes) { EXPECT_EQ(sizeOf("width='1in' height='50'"), Size(96, 50)); }
TEST(Root, SizeComesFromTheViewBox) { EXPECT_EQ(sizeOf("viewBox='0 0 30 40'"), Size(30, 40)); }
TEST(Root, PercentagesAreSharesOfTheViewBox) {
    EXPECT_EQ(sizeOf("viewBox='0 0 30 40' width='100%' height='50%'"), Size(30, 20));
}
TEST(Root, AMissingSideKeepsTheProportions) {
    EXPECT_EQ(sizeOf("viewBox='0 0 30 40' width='60'"), Size(60, 80));
}
TEST(Root, OptionsGiveTheDefaultSize) {
    Options options;
    options.defaultWidth = 300;
    options.defaultHeight = 150;
    EXPECT_EQ(sizeOf("", options), Size(300, 150));
    EXPECT_EQ(sizeOf("width='50%'", options), Size(150, 150));
}
TEST(Root, WithoutASizeIsAnError) {
    EXPECT_THROW(sizeOf("width='0' height='5'"), ParseError);
    EXPECT_THROW(sizeOf("width='-1' height='5'"), ParseError);
    EXPECT_THROW(sizeOf("width='1e20' height='5'"), ParseError);
    try {
        sizeOf("width='5' height='1e-38'");
        ADD_FAILURE() << "an asset cannot be so small";
    } catch (const ParseError& error) {
        EXPECT_NE(
            std::string(error.what())
                .find("<svg>: a height of 1e-38 user units cannot be drawn: it must lie in [2^-40, 1e9]"),
            std::string::npos)
            << error.what();
    }
}
TEST(Root, ViewBoxIsFitted) {
    const auto items =
        itemsOf(loadText(std::string(xmlns) + "width='100' height='50' viewBox='10 10 10 10'>"
                                              "<rect x='10' y='10' width='10' height='10'/></svg>"));
    ASSERT_EQ(items.size(), 1u);
    expectNear(boxOf(items[0]).min, {25, 0});
    expectNear(boxOf(items[0]).max, {75, 50});
}
TEST(Root, BackgroundCoversTheViewport) {
    const auto items =
        itemsOf(loadText(std::string(xmlns) + "viewBox='5 5 10 10' style='background-color:red'/>"));
    ASSERT_EQ(items.size(), 1u);
    expectNear(boxOf(items[0]).max, {10, 10});
}
TEST(Root, BackgroundIsAShorthand) {
    const auto backgrounds = [](const std::string& value) {
        return itemsOf(loadText(std::string(xmlns) + "viewBox='0 0 9 9' style='background:" + value + "'/>"));
    };
    const scene::Color red{1, 0, 0, 1};
    for (const char* value : {"red", "no-repeat red 0 0 / 5px", "none red", "rgb(255 0 0)", "url(#a), red"}) {
        const auto items = backgrounds(value);
        ASSERT_EQ(items.size(), 1u) << value;
        EXPECT_EQ(std::get<scene::Color>(items[0].paint), red) << value;
    }
    for (const char* value : {"none", "red, none", "transparent", "nonsense", "url(#a)"})
        EXPECT_TRUE(backgrounds(value).empty()) << value;
    EXPECT_EQ(backgrounds("red; background: nonsense").size(), 1u);
    EXPECT_TRUE(backgrounds("red; background: none").empty());
}

TEST(NestedSvg, ClipsWhatStandsOver) {
    EXPECT_TRUE(groupOf("<svg x='5' y='5' width='10' height='10'><rect width='20' height='5'/></svg>").clip);
}
TEST(NestedSvg, DoesNotClipWhatFits) {
    const scene::Item item =
        itemOf("<svg x='5' y='6' width='10' height='10'><rect width='10' height='10'/></svg>");
    expectNear(boxOf(item).min, {5, 6});
}
TEST(NestedSvg, OverflowVisibleDoesNotClip) {
    EXPECT_FALSE(std::holds_alternative<scene::Group>(
        loadBody("<svg width='10' height='10' overflow='visible'><rect width='20' height='5'/></svg>")
            .scene.root.children.at(0)
            .value));
}
TEST(NestedSvg, IsTheViewportOfPercentages) {
    expectNear(boxOf(itemOf("<svg width='50%' height='50%'><rect width='50%' height='100%'/></svg>")).max,
               {25, 50});
    expectNear(boxOf(itemOf("<svg viewBox='0 0 10 10'><rect width='50%' height='100%'/></svg>")).max,
               {50, 100});
}
TEST(NestedSvg, WithoutASizeIsNotDrawn) {
    EXPECT_EQ(count("<svg width='0' height='10'><rect width='2' height='5'/></svg>"), 0u);
}

TEST(Group, TransformsMultiply) {
    const scene::Item item = itemOf(
        "<g transform='translate(10 20)'><g transform='scale(2)'><rect transform='translate(1 1)' width='1' "
        "height='1'/></g></g>");
    expectNear(item.transform, {2, 0, 0, 2, 12, 22});
}
TEST(Group, ATransformInsideItsInverseIsTheIdentity) {
    for (const char* degrees : {"45", "30", "77.7"}) {
        const std::string turn = degrees;
        EXPECT_EQ(itemOf("<g transform='rotate(-" + turn + " 100 100)'><rect transform='rotate(" + turn +
                         " 100 100)' width='1' height='1'/></g>")
                      .transform,
                  scene::identity)
            << turn;
    }
}
TEST(Group, SmallTransformsAreNotRounding) {
    const scene::Item item = itemOf(
        "<g transform='scale(1e-9) translate(1e-9)'><rect transform='rotate(1e-9)' "
        "width='1' height='1'/></g>");
    EXPECT_EQ(item.transform[0].x, 1e-9);
    EXPECT_NEAR(item.transform[0].y, 1e-9 * 1.7453292519943295e-11, 1e-30);
    EXPECT_EQ(item.transform[2].x, 1e-9 * 1e-9);
}
TEST(Group, WithoutEffectsDissolves) {
    EXPECT_EQ(loadBody("<g><g><rect width='1' height='1'/></g><a><rect width='1' height='1'/></a></g>")
                  .scene.root.children.size(),
              2u);
}
TEST(Group, DefinitionsAreNotDrawn) {
    EXPECT_EQ(count("<defs><rect width='1' height='1'/></defs><symbol><rect width='1' height='1'/></symbol>"
                    "<pattern><rect width='1' height='1'/></pattern>"),
              0u);
}

TEST(Use, PlacesItsTarget) {
    const scene::Item item = itemOf(
        "<defs><rect id='r' x='1' width='2' height='2' transform='scale(3)'/></defs>"
        "<use xlink:href='#r' x='10' y='5' transform='scale(2)'/>");
    expectNear(item.transform, {6, 0, 0, 6, 20, 10});
}
TEST(Use, HrefWithoutANamespaceWins) {
    EXPECT_EQ(fillOf("<defs><rect id='a' fill='red' width='2' height='2'/><rect id='b' fill='lime' width='2' "
                     "height='2'/></defs><use xlink:href='#a' href='#b'/>"),
              0x00ff00);
}
TEST(Use, ContentInheritsFromTheUse) {
    EXPECT_EQ(
        fillOf(
            "<g fill='red'><defs><rect id='r' width='2' height='2'/></defs></g><use href='#r' fill='lime'/>"),
        0x00ff00);
}
TEST(Use, InstancesShareTheirPath) {
    const auto items =
        itemsOf(loadBody("<defs><path id='r' d='M0 0H5V5'/></defs><use href='#r'/><use href='#r' x='9'/>"));
    ASSERT_EQ(items.size(), 2u);
    EXPECT_EQ(items[0].path, items[1].path);
}
TEST(Use, RulesSeeTheTargetsOwnPlace) {
    EXPECT_EQ(
        fillOf("<style>defs rect { fill: lime } .u rect { fill: red }</style><defs><rect id='r' width='2' "
               "height='2'/></defs><g class='u'><use href='#r'/></g>"),
        0x00ff00);
}
TEST(Use, SymbolTakesTheUsesSize) {
    const scene::Item item = itemOf(
        "<symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10'/></symbol>"
        "<use href='#s' x='1' y='2' width='20' height='20'/>");
    expectNear(boxOf(item).min, {1, 2});
    expectNear(boxOf(item).max, {21, 22});
}
TEST(Use, SvgKeepsItsOwnSizeWhereTheUseHasNone) {
    const scene::Item item = itemOf(
        "<defs><svg id='s' x='3' width='10' height='10'><rect width='100%' height='100%'/>"
        "</svg></defs><use href='#s' y='2'/>");
    expectNear(boxOf(item).min, {3, 2});
    expectNear(boxOf(item).max, {13, 12});
}
TEST(Use, FirstOfEqualIdsIsMeant) {
    EXPECT_EQ(fillOf("<defs><rect id='r' fill='lime' width='2' height='2'/><rect id='r' fill='red' width='2' "
                     "height='2'/></defs><use href='#r'/>"),
              0x00ff00);
}
TEST(Use, ToNothingIsAWarning) {
    const Document loaded = loadBody("<use href='#missing'/>");
    EXPECT_TRUE(loaded.scene.root.children.empty());
    EXPECT_EQ(loaded.warnings.size(), 1u);
}
TEST(Use, InACircleIsAWarning) {
    EXPECT_FALSE(loadBody("<g id='a'><use href='#a'/><rect width='1' height='1'/></g>").warnings.empty());
    EXPECT_FALSE(loadBody("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>").warnings.empty());
}

TEST(Switch, DrawsTheFirstChildThatFits) {
    EXPECT_EQ(fillOf("<switch><rect systemLanguage='ru' width='1' height='1' fill='red'/>"
                     "<rect systemLanguage='de, en-US' width='1' height='1' fill='lime'/>"
                     "<rect width='1' height='1' fill='blue'/></switch>"),
              0x00ff00);
}
TEST(Switch, ExtensionsAreNotKnown) {
    EXPECT_EQ(count("<rect requiredExtensions='urn:x' width='1' height='1'/>"), 0u);
}
TEST(Switch, LanguageComesFromTheOptions) {
    Options options;
    options.language = "ru";
    const auto items = itemsOf(loadText(document("<rect systemLanguage='ru-RU' width='1' height='1'/>"
                                                 "<rect systemLanguage='en' width='1' height='1'/>"),
                                        options));
    EXPECT_EQ(items.size(), 1u);
}

TEST(Switch, PassesOverForeignObjectsWhereElseIsToBeDrawn) {
    const Document loaded = loadBody(
        "<switch><foreignObject requiredFeatures='f#Extensibility'/>"
        "<rect width='1' height='1'/></switch>");
    EXPECT_EQ(itemsOf(loaded).size(), 1u);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loadBody("<switch><foreignObject/><foreignObject/></switch>").warnings.size(), 1u);
}

TEST(Unsupported, ElementsAreNamed) {
    const Document loaded = loadBody("<foreignObject/>");
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_NE(loaded.warnings[0].message.find("<foreignObject>"), std::string::npos);
}
TEST(Unsupported, ElementsWithAMissingFilterAreNotDrawn) {
    EXPECT_EQ(count("<rect width='1' height='1' filter='url(#f)'/>"), 0u);
}

}  // namespace
}  // namespace vtm::svg
