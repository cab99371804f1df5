// Texts of trees that are refused: what is wrong, and where.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "api/tests/tree_support.hpp"

namespace vtm {
namespace {

std::string errorOf(const std::string& text) {
    try {
        readText(text);
    } catch (const TreeError& error) {
        return error.what();
    }
    return "";
}

TEST(TreeError, NamesFilePlaceAndCause) {
    EXPECT_EQ(errorOf("vtmtree 1\nsize 8 8\ndraw rod"),
              "t.vtmtree:3:6: expected a VTM; 'rod' is not defined above");
    EXPECT_EQ(errorOf("vtmtree 1\nsize 8 8\n// \xc3\xa4\n\tshape a = \"M0 0 \xc3\xa4\""),
              "t.vtmtree:4:18: the path data is not complete or not valid from here on");
    EXPECT_EQ(errorOf("vtmtree 1 size 8 8 draw red opacity 2"), "t.vtmtree:1:37: 2 is not in [0, 1]");
    EXPECT_EQ(errorOf("vtmtree 1 size 8 8 draw linear(1 1, 1 1) { 0 red 1 blue }"),
              "t.vtmtree:1:25: gradient vector is not finite or has no length");
}

struct Refused {
    const char *text, *cause;
};

TEST(TreeError, EveryMistakeHasACause) {
    const Refused all[] = {
        {"draw", "expected a VTM, found the end of the file"},
        {"", "expected a definition (shape, clip, image, vtm) or 'draw', found the end of the file"},
        {"draw red draw blue",
         "expected the end of the file, since 'draw' is the last statement, found 'draw'"},
        {"draw { red", "expected a VTM or '}', found the end of the file"},
        {"draw }", "expected a VTM, found '}'"},
        {"draw \x01", "expected a VTM, found the byte 0x01"},
        {"draw \xff", "expected a VTM, found the byte 0xff"},
        {"shape a = \"M0 0", "the string is not closed"},
        {"shape a = \"M0 0\\", "the string is not closed"},
        {"shape a = \"L0 0\"", "the path data is not complete or not valid from here on"},
        {"shape a = b",
         "expected a shape (path data in quotes, rect, circle or a name); 'b' is not defined above"},
        {"vtm a = a", "expected a VTM; 'a' is not defined above"},
        {"vtm a = red vtm a = red", "'a' is defined twice"},
        {"vtm a = red draw select a red",
         "expected a shape (path data in quotes, rect, circle or a name); 'a' is a VTM"},
        {"shape a = rect(0 0 1 1) draw a", "expected a VTM; 'a' is a shape"},
        {"vtm red = blue", "'red' is a colour and cannot be a name"},
        {"vtm else = blue", "'else' is a word of the format and cannot be a name"},
        {"vtm 9 = blue", "expected a name, found '9'"},
        {"shape a = rect(0 0 1)", "expected a number, found ')'"},
        {"shape a = rect(0 0 1 1e31)", "the number is beyond 1e30"},
        {"shape a = rect(0 0 1 nan)", "expected a number, found 'nan'"},
        {"shape a = rect(0 0 1 1) stroke 0", "stroke width is 0, not > 0"},
        {"shape a = rect(0 0 1 1) stroke 1 dash(0)", "dash lengths add up to 0"},
        {"shape a = rect(0 0 1 1) stroke 1 cap red", "expected butt, round, square, found 'red'"},
        {"shape a = rect(0 0 1 1) stroke 1 evenodd", "a stroke has no fill rule"},
        {"shape a = rect(0 0 1 1) stroke 1 stroke 1", "the shape is a stroke already"},
        {"shape a = rect(0 0 1 1) placed scale(2) stroke 1",
         "the shape is placed already; 'stroke' stands before 'placed'"},
        {"shape a = rect(0 0 1 1) placed turn(2)",
         "expected matrix(), translate(), scale(), rotate(), skewX() or skewY(), found 'turn'"},
        {"shape a = rect(0 0 1 1) placed scale(2", "the transform cannot be read"},
        {"shape a = rect(0 0 1 1) placed scale(2) translate(9e29)", "the transform has a number beyond 1e30"},
        {"shape a = rect(0 0 1 1) placed scale(1e40)", "the transform has a number beyond 1e30"},
        {"clip a = { rect(0 0 1 1) stroke 1 }", "clips are made of filled shapes, not of strokes"},
        {"draw layer mask red", "expected luminance, alpha, linear-luminance, found 'red'"},
        {"draw layer opacity 1 blend normal opacity 1 red", "'opacity' is given twice"},
        {"shape a = rect(0 0 1 1) stroke 1 dash(1) dash(2)", "'dash' is given twice"},
        {"draw #12", "the colour cannot be read"},
        {"draw rgb(1 2)", "the colour cannot be read"},
        {"draw linear(0 0, 1 0) { 0 red }", "gradient has 1 stops, not 2 or more"},
        {"draw linear(0 0, 1 0) { 0.5 red 0.25 blue }", "gradient offset 0.25 follows 0.5"},
        {"draw radial(0 0 1) focus(0 0 1) { 0 red 1 blue }", "gradient's circles are the same"},
        {"draw pattern(0 0, 0 1) {}", "pattern tile is empty or not finite"},
        {"draw image \"a.png\"", "the image cannot be read: is not a file that may be read"},
        {"draw material gl_a red \"\"", "material name 'gl_a' is not a plain identifier"},
        {"draw { material a red \"\" material a red \" \" }",
         "the material 'a' has another text than before"},
        {"draw material a red \"\\n\"", "after \\ comes \" or \\"},
    };
    for (const Refused& each : all) {
        const std::string error = errorOf(std::string("vtmtree 1 size 8 8 ") + each.text);
        EXPECT_EQ(error.substr(std::min(error.size(), error.find(": ") + 2)), each.cause) << each.text;
    }
    EXPECT_EQ(errorOf("vtmtree 2"), "t.vtmtree:1:9: the version of the format is not 1");
    EXPECT_EQ(errorOf("vtmtree 1 size 8 0"), "t.vtmtree:1:16: height is 0, not in [2^-40, 2^40]");
    EXPECT_EQ(errorOf(""), "t.vtmtree:1:1: expected 'vtmtree', found the end of the file");
}

std::string repeated(const std::string& text, std::size_t count) {
    std::string all;
    for (std::size_t i = 0; i < count; ++i)
        all += text;
    return all;
}

TEST(TreeError, NestingIsLimited) {
    const std::string head = "vtmtree 1 size 8 8 draw ";
    for (const std::string open :
         {"{", "select rect(0 0 1 1) ", "layer opacity 0 ", "select rect(0 0 1 1) {} else ",
          "pattern(0 0 1 1) {", "layer mask alpha {"}) {
        EXPECT_NE(errorOf(head + repeated(open, 100'000)).find("nested more than 256 levels deep"),
                  std::string::npos)
            << open;
    }
    EXPECT_NE(errorOf(head + "layer clip " + repeated("{} within ", 100'000)).find("nested more than 256"),
              std::string::npos);
    EXPECT_EQ(errorOf(head + repeated("{", 255) + repeated("}", 255)), "");
}

/// Each doubles the one before.
std::string doubling(const std::string& first, const std::string& step, int count) {
    std::string text = "vtmtree 1 size 8 8 " + first;
    for (int i = 1; i < count; ++i)
        text += fmt::format(fmt::runtime(step), fmt::arg("next", i), fmt::arg("last", i - 1));
    return text;
}

TEST(TreeError, NamesThatMultiplyAreLimited) {
    const std::string more = "the picture has more than 1000000 parts";
    const Refused bombs[] = {
        {"vtm a0 = red ", "vtm a{next} = {{ a{last} a{last} }} "},
        {"vtm a0 = red ", "vtm a{next} = {{ a{last} a{last} placed scale(2) }} "},
        {"vtm a0 = red ", "vtm a{next} = select rect(0 0 1 1) a{last} else a{last} "},
        {"vtm a0 = red ", "vtm a{next} = pattern(0 0 1 1) {{ a{last} a{last} }} "},
        {"vtm a0 = red ", "vtm a{next} = layer mask alpha a{last} a{last} "},
        {"clip a0 = { rect(0 0 1 1) } ",
         "clip a{next} = {{ rect(0 0 1 1) within a{last} rect(0 0 1 1) within a{last} }} "},
    };
    for (const Refused& bomb : bombs)
        EXPECT_NE(errorOf(doubling(bomb.text, bomb.cause, 60)).find(more), std::string::npos) << bomb.cause;
    // Definitions that nothing uses, each with a copy of the content.
    EXPECT_NE(errorOf(doubling("vtm a = {" + repeated("red ", 1000) + "} ",
                               "vtm b{next} = pattern(0 0 1 {next}) {{ a }} ", 2000))
                  .find(more),
              std::string::npos);
}

TEST(TreeError, NestingOfNamesIsThatOfScenes) {
    const std::string text =
        doubling("vtm a0 = red ",
                 "vtm a{next} = select rect(0 0 1 1) {{ select rect(0 0 1 1) {{}} else a{last} }} ", 2000);
    EXPECT_NE(errorOf(text + "draw a1999").find("levels deep"), std::string::npos);
    EXPECT_EQ(errorOf(text + "draw a100"), "");
}

}  // namespace
}  // namespace vtm
