#include <vtm/svg/write.hpp>

#include <gtest/gtest.h>

#include <vtm/svg/load.hpp>

namespace vtm::svg {
namespace {

scene::Scene read(const std::string& text) {
    return load({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}).scene;
}

/// Read, written and read again.
void expectSame(const std::string& body) {
    const scene::Scene once =
        read("<svg xmlns='http://www.w3.org/2000/svg' width='30' height='20'>" + body + "</svg>");
    ASSERT_FALSE(once.root.children.empty());
    EXPECT_EQ(dump(read(write(once))), dump(once)) << write(once);
}

TEST(Write, PathsOfAllCommands) {
    expectSame("<path d='M1.25 2L3 0.1Q5 6 7 8C1 2 3 4 5.5 6.125A3 4 90 1 0 9 10ZL3 3' fill='#123456'/>");
}

TEST(Write, FillRulesAndOpacities) {
    expectSame("<path d='M1 1H9V9H1Z' fill='#abcdef' fill-opacity='0.5' fill-rule='evenodd'/>");
    expectSame("<g opacity='0.25'><path d='M1 1H9V9Z'/><path d='M2 1H9V9Z' fill='red'/></g>");
}

TEST(Write, Strokes) {
    expectSame(
        "<path d='M1 1H9V9' fill='none' stroke='#080' stroke-width='0.75' stroke-linecap='round' "
        "stroke-linejoin='bevel' stroke-dasharray='3 1 2 1' stroke-dashoffset='0.5'/>");
    expectSame(
        "<path d='M1 1H9V9' fill='none' stroke='#080' stroke-linejoin='miter-clip' stroke-miterlimit='7'/>");
}

TEST(Write, Transforms) { expectSame("<path d='M1 1H9V9Z' transform='matrix(1 2 3 0.5 -1 4)'/>"); }

TEST(Write, RefusesWhatItDoesNotWrite) {
    const std::string head = "<svg xmlns='http://www.w3.org/2000/svg' width='30' height='20'>";
    EXPECT_THROW(
        write(read(head + "<linearGradient id='a'><stop stop-color='red'/><stop offset='1'/></linearGradient>"
                          "<rect width='5' height='5' fill='url(#a)'/></svg>")),
        WriteError);
    EXPECT_THROW(write(read(head + "<clipPath id='c'><circle r='3'/></clipPath>"
                                   "<g clip-path='url(#c)'><rect width='5' height='5'/></g></svg>")),
                 WriteError);
}

}  // namespace
}  // namespace vtm::svg
