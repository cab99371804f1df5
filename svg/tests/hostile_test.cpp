// Whatever the bytes: a scene that is valid, or a ParseError.

#include <random>

#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

std::string repeated(std::string_view text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i)
        result += text;
    return result;
}

void expectHarmless(std::string_view text) {
    try {
        const Document loaded = loadText(text);
        EXPECT_NO_THROW(scene::validate(loaded.scene)) << text.substr(0, 4000);
    } catch (const ParseError&) {
    }
}

/// A bit of everything.
const std::string& sample() {
    static const std::string text =
        document(R"svg(<style>.a &gt; rect { fill: #12f8 !important } [x^="1"] { opacity: .5 }</style>
<defs><linearGradient id="l" x1="10%" gradientTransform="rotate(30)"><stop offset=".2" stop-color="red"/>
<stop offset="90%" stop-opacity=".3"/></linearGradient>
<radialGradient id="r" href="#l" fx="0.9" fr="5%" spreadMethod="reflect"/>
<pattern id="p" width=".2" height=".3" viewBox="0 0 4 4"><circle r="2" fill="url(#l)"/></pattern>
<clipPath id="c" clipPathUnits="objectBoundingBox"><use href="#s"/></clipPath>
<mask id="m" mask-type="alpha"><rect width="70" height="1e2" fill="url(#r) green"/></mask>
<marker id="k" orient="auto" viewBox="0 0 2 2"><path d="M0 0L2 1 0 2z" fill="context-stroke"/></marker>
<path id="s" d="M.1.1C.2 0 1-.5.9 1A1 2 30 01.1.1z"/></defs>
<symbol id="y" viewBox="0 0 10 10" overflow="visible"><rect x="1" width="5" height="50%" rx="1"/></symbol>
<g class="a" transform="translate(5 5) skewX(3)" opacity=".9"><rect width="30" height="20" stroke="url(#p)"
stroke-width="3" stroke-dasharray="4 10% 1" clip-path="url(#c)"/></g>
<use href="#y" x="40" width="20" height="20" mask="url(#m)" style="mix-blend-mode: hue"/>
<polyline points="5,90 20,70 40,95" fill="none" stroke="hsl(20,50%,50%)" marker="url(#k)" marker-mid="url(#k)"/>
<svg x="60" y="60" width="20" height="20" viewBox="0 0 1 1" preserveAspectRatio="xMaxYMin slice"><circle r="3"/></svg>
<image width="20" height="20" href="data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg'/%3E"/>)svg");
    return text;
}

TEST(Hostile, TheSampleIsDrawnWithoutWarnings) {
    const Document loaded = loadText(sample());
    for (const Warning& warning : loaded.warnings)
        ADD_FAILURE() << warning.message;
    EXPECT_GE(itemsOf(loaded).size(), 6u);
    scene::validate(loaded.scene);
}

TEST(Hostile, EveryTruncation) {
    for (std::size_t size = 0; size < sample().size(); ++size)
        expectHarmless(std::string_view(sample()).substr(0, size));
}

TEST(Hostile, RandomBytes) {
    std::minstd_rand random(1);
    for (int round = 0; round < 3000; ++round) {
        std::string text = sample();
        for (std::size_t changes = 1 + random() % 8; changes-- > 0;)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        expectHarmless(text);
    }
}

TEST(Hostile, RandomNumbers) {
    constexpr std::string_view numbers[]{"0",     "-1",          "1e38",  "-1e38", "1e-38", "nan",
                                         "1e400", "99999999999", "-0.5%", "1e9",   ""};
    std::minstd_rand random(2);
    for (int round = 0; round < 3000; ++round) {
        std::string text;
        for (const char c : sample())
            if (c >= '0' && c <= '9' && random() % 40 == 0)
                text += numbers[random() % std::size(numbers)];
            else
                text += c;
        expectHarmless(text);
    }
}

TEST(Hostile, RandomReferences) {
    constexpr std::string_view ids[]{"#l", "#r", "#p", "#c", "#m", "#k", "#s", "#y"};
    std::minstd_rand random(3);
    for (int round = 0; round < 1000; ++round) {
        std::string text = sample();
        for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at + 1))
            if (random() % 3 == 0 && text.find_first_of("\")", at) == at + 2)
                text.replace(at, 2, ids[random() % std::size(ids)]);
        expectHarmless(text);
    }
}

TEST(Hostile, DeepNestingIsAnError) {
    EXPECT_THROW(loadBody(repeated("<g>", 100000) + repeated("</g>", 100000)), ParseError);
    EXPECT_THROW(loadBody(repeated("<g>", 1000000)), ParseError);
}

TEST(Hostile, NestingWithinTheLimitIsFine) {
    EXPECT_EQ(itemsOf(loadBody(repeated("<g>", 250) + "<rect width='1' height='1'/>" + repeated("</g>", 250)))
                  .size(),
              1u);
}

/// Each level uses the one before `fan` times.
std::string laughs(int levels, int fan, const std::string& leaf) {
    std::string body = "<defs><g id='u0'>" + leaf + "</g>";
    for (int i = 1; i < levels; ++i)
        body += "<g id='u" + std::to_string(i) + "'>" +
                repeated("<use href='#u" + std::to_string(i - 1) + "'/>", fan) + "</g>";
    return body + "</defs><use href='#u" + std::to_string(levels - 1) + "'/>";
}

TEST(Hostile, UseBombsEndWithAWarning) {
    const Document loaded = loadBody(laughs(30, 10, ""));
    ASSERT_FALSE(loaded.warnings.empty());
    EXPECT_NE(loaded.warnings.front().message.find("the rest is left out"), std::string::npos);
}

TEST(Hostile, UseBombsDrawNoMoreThanTheLimit) {
    const Document loaded = loadBody(laughs(30, 10, "<rect width='1' height='1'/>"));
    const std::size_t drawn = itemsOf(loaded).size();
    EXPECT_LE(drawn, Limits::maxNodes);
    EXPECT_GT(drawn, Limits::maxNodes / 10);
}

TEST(Hostile, LongUseChainsEndWithAWarning) {
    EXPECT_FALSE(loadBody(laughs(2000, 1, "<rect width='1' height='1'/>")).warnings.empty());
}

/// Each server's content is painted with the one before, which is referred to `fan` times.
std::string chained(std::string_view tag, std::string_view property, int levels) {
    std::string body;
    for (int i = 0; i < levels; ++i) {
        const std::string child = "<rect width='1' height='1' " + std::string(property) + "='url(#b" +
                                  std::to_string(i - 1) + ")'/>";
        body += "<" + std::string(tag) + " id='b" + std::to_string(i) + "' width='1' height='1'>" +
                repeated(child, 10) + "</" + std::string(tag) + ">";
    }
    return body + "<rect width='9' height='9' " + std::string(property) + "='url(#b" +
           std::to_string(levels - 1) + ")'/>";
}

TEST(Hostile, MaskBombsEnd) { expectHarmless(document(chained("mask", "mask", 20))); }
TEST(Hostile, ClipBombsEnd) { expectHarmless(document(chained("clipPath", "clip-path", 20))); }
TEST(Hostile, PatternBombsEnd) { expectHarmless(document(chained("pattern", "fill", 20))); }
TEST(Hostile, MarkerBombsEnd) {
    std::string body;
    for (int i = 0; i < 20; ++i)
        body += "<marker id='b" + std::to_string(i) + "' overflow='visible'>" +
                repeated("<path fill='none' d='M0 0H1V1' marker-mid='url(#b" + std::to_string(i - 1) + ")'/>",
                         10) +
                "</marker>";
    expectHarmless(document(body + "<path d='M0 0H1V1' marker-mid='url(#b19)'/>"));
}

TEST(Hostile, LongTemplateChainsEnd) {
    std::string body;
    for (int i = 0; i < 5000; ++i)
        body += "<linearGradient id='b" + std::to_string(i) + "' href='#b" + std::to_string(i + 1) + "'/>";
    expectHarmless(document(body + "<rect width='9' height='9' fill='url(#b0)'/>"));
}

TEST(Hostile, WarningsAreLimited) {
    const Document loaded = loadBody(repeated("<foreignObject/>", 5000));
    EXPECT_EQ(loaded.warnings.size(), 1000u);
    EXPECT_EQ(loaded.warnings.back().message, "more warnings are left out");
}

}  // namespace
}  // namespace vtm::svg
