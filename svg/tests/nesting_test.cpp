// Chains and nests 200 000 long: warnings and errors that name the place, and a flat stack.
#include <algorithm>

#include <vtm/svg/write.hpp>
#include "limits/testing.hpp"
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

using limits::testing::onSmallStack;

constexpr int links = 200'000;

/// `link` many times, each @ replaced by its number and each ~ by the next one's.
std::string chain(std::string_view link, int count = links) {
    std::string text;
    text.reserve(static_cast<std::size_t>(count) * (link.size() + 14));
    for (int i = 0; i < count; ++i)
        for (const char c : link)
            if (c == '@')
                text += std::to_string(i);
            else if (c == '~')
                text += std::to_string(i + 1);
            else
                text += c;
    return text;
}

/// The document is loaded, its scene is valid, and one of the warnings, each with a place, says so.
void expectWarning(const std::string& body, std::string_view wanted) {
    onSmallStack([&] {
        const Document loaded = loadText(document(body));
        EXPECT_NO_THROW(scene::validate(loaded.scene));
        const auto says = [&](const Warning& warning) {
            return warning.where.line > 0 && warning.message.find(wanted) != std::string::npos;
        };
        EXPECT_TRUE(std::any_of(loaded.warnings.begin(), loaded.warnings.end(), says)) << body.substr(0, 100);
    });
}

constexpr std::string_view tooDeep = "nested too deep", square = "<rect width='9' height='9' ";

TEST(Nesting, Elements) {
    onSmallStack([] { EXPECT_THROW(loadText(document(chain("<g>"))), ParseError); });
}

TEST(Nesting, Uses) { expectWarning(chain("<g id='u@'><use href='#u~'/></g>", 2000), tooDeep); }

TEST(Nesting, UsesOfUses) {
    expectWarning("<defs>" + chain("<use id='u@' href='#u~'/>") + "</defs><use href='#u0'/>", tooDeep);
}

TEST(Nesting, Clips) {
    expectWarning(chain("<clipPath id='c@' clip-path='url(#c~)'><path d='M0 0h9v9'/></clipPath>") +
                      std::string(square) + "clip-path='url(#c0)'/>",
                  tooDeep);
}

TEST(Nesting, ClippedShapes) {
    expectWarning(chain("<clipPath id='c@'><path d='M0 0h9v9' clip-path='url(#c~)'/></clipPath>") +
                      std::string(square) + "clip-path='url(#c0)'/>",
                  tooDeep);
}

TEST(Nesting, Masks) {
    expectWarning(chain("<mask id='m@' mask='url(#m~)'><path d='M0 0h9v9'/></mask>") + std::string(square) +
                      "mask='url(#m0)'/>",
                  tooDeep);
}

TEST(Nesting, MaskedShapes) {
    expectWarning(chain("<mask id='m@'><path fill='#fff' d='M0 0h9v9' mask='url(#m~)'/></mask>") +
                      std::string(square) + "mask='url(#m0)'/>",
                  tooDeep);
}

TEST(Nesting, Patterns) {
    expectWarning(
        chain("<pattern id='p@' width='1' height='1'><path d='M0 0h9v9' fill='url(#p~)'/></pattern>") +
            std::string(square) + "fill='url(#p0)'/>",
        tooDeep);
}

/// Levels inside of one pattern count for the next one.
TEST(Nesting, GroupsInPatterns) {
    std::string groups, ends;
    for (int i = 0; i < 200; ++i)
        groups += "<g opacity='.9'>", ends += "</g>";
    expectWarning(chain("<pattern id='p@' width='1' height='1'>" + groups +
                            "<path d='M0 0h9v9' fill='url(#p~)'/>" + ends + "</pattern>",
                        300) +
                      std::string(square) + "fill='url(#p0)'/>",
                  tooDeep);
}

TEST(Nesting, Markers) {
    expectWarning(chain("<marker id='k@'><path d='M0 0L9 9' marker-start='url(#k~)'/></marker>") +
                      "<path d='M0 0L9 9' marker-start='url(#k0)'/>",
                  tooDeep);
}

TEST(Nesting, GradientsAreFollowedToTheEnd) {
    onSmallStack([] {
        const std::string last = std::to_string(links);
        const auto item = itemOf(chain("<linearGradient id='g@' href='#g~'/>") + "<linearGradient id='g" +
                                 last + "'><stop stop-color='#f00'/></linearGradient>" + std::string(square) +
                                 "fill='url(#g0)'/>");
        EXPECT_EQ(std::get<scene::Color>(item.paint), (scene::Color{1, 0, 0, 1}));
    });
}

TEST(Nesting, Entities) {
    onSmallStack([] {
        const std::string entities = chain("<!ENTITY e@ '&e~;'>");
        EXPECT_THROW(loadText("<!DOCTYPE svg [" + entities + "]>" + document("&e0;")), ParseError);
    });
}

/// A selector of too many compounds is none.
TEST(Nesting, Selectors) {
    onSmallStack([] {
        const std::string many = chain("g+"), some = chain("g+", 200);
        const auto items =
            itemsOf(loadBody("<style>" + many + "path{fill:#f00}" + some + "path{fill:#00f}</style>" +
                             chain("<g/>", 300) + "<path d='M0 0h9v9'/>"));
        ASSERT_EQ(items.size(), 1u);
        EXPECT_EQ(std::get<scene::Color>(items[0].paint), (scene::Color{0, 0, 1, 1}));
    });
}

TEST(Nesting, NestedBlocksOfStyles) {
    onSmallStack([] { loadBody("<style>" + chain("a{b:(") + "</style>"); });
}

TEST(Nesting, WritingIsBounded) {
    scene::Scene scene{1, 1, {}};
    for (int i = 0; i < links; ++i) {
        scene::Group outer;
        outer.opacity = 0.5f;
        outer.children.push_back({std::move(scene.root)});
        scene.root = std::move(outer);
    }
    onSmallStack([&] { EXPECT_THROW(write(scene), WriteError); });
}

TEST(Nesting, ItemsSayWhereTheyComeFrom) {
    const auto item = itemOf("\n<g>\n  <circle r='9'/></g>");
    EXPECT_EQ(item.place.line, 3u);
    EXPECT_EQ(item.place.column, 4u);
    EXPECT_STREQ(item.place.element, "circle");
}

}  // namespace
}  // namespace vtm::svg
