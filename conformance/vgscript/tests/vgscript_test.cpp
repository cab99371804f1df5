// The language of OpenVG scripts: what passes, what is a failure of OpenVG's and what is the script's own
// fault.

#include "conformance/vgscript/vgscript.hpp"

#include <gtest/gtest.h>

namespace vtm::vgscript {

namespace {

std::string error(const std::string& text) {
    try {
        play(text, "x");
    } catch (const ScriptError& e) {
        return e.what();
    }
    return "none";
}

std::vector<std::string> failures(const std::string& text) { return play(text, "x").failures; }

TEST(Script, DrawsAPicture) {
    const Outcome outcome = play(R"(
        surface 8 4
        p = vgCreatePaint
        vgSetColor p 0x00ff00ff
        vgSetPaint p VG_FILL_PATH   # white is no paint's default
        path square "M 2 1 h 4 v 2 h -4 z"
        vgDrawPath square VG_FILL_PATH
        pixel 3 1 == 0x00ff00ff
        pixel 1 1 == 0
    )",
                                 "x");
    EXPECT_TRUE(outcome.failures.empty());
    ASSERT_EQ(outcome.picture.width, 8);
    ASSERT_EQ(outcome.picture.height, 4);
    EXPECT_EQ(outcome.picture.pixel(2, 1)[1], 1);
    EXPECT_EQ(outcome.picture.pixel(2, 1)[0], 0);
    EXPECT_EQ(outcome.picture.pixel(2, 0)[3], 0);
}

TEST(Script, ComparesResults) {
    EXPECT_TRUE(
        failures("vgGeti VG_FILL_RULE == VG_EVEN_ODD\nvgGetf VG_STROKE_LINE_WIDTH == 1.25 within 0.25")
            .empty());
    EXPECT_EQ(failures("\nvgGeti VG_FILL_RULE == VG_NON_ZERO"),
              std::vector<std::string>{"x:2: 6400, not VG_NON_ZERO"});
    EXPECT_EQ(failures("vgGeti VG_FILL_RULE != VG_EVEN_ODD").size(), 1u);
    EXPECT_EQ(failures("vgGetString VG_VERSION == \"1.1\"").size(), 0u);
    EXPECT_EQ(failures("vgGetString VG_VERSION == \"1.2\"").size(), 1u);
    EXPECT_EQ(failures("pixel 0 0 == 0x00000001").size(), 1u);
    EXPECT_EQ(failures("pixel 0 0 == 0x00000001 within 1").size(), 0u);
}

TEST(Script, ComparesMemory) {
    const std::string matrix = "vgTranslate 3 4\nvgGetMatrix m:f9\n";
    EXPECT_TRUE(failures(matrix + "m == [1 0 0  0 1 0  3 4 1]").empty());
    EXPECT_EQ(failures(matrix + "m == [1 0 0  0 1 0  3 5 1]"), std::vector<std::string>{"x:3: m[7] is 4"});
    EXPECT_TRUE(failures(matrix + "m == [1 0 0  0 1 0  3 5 1] within 1").empty());
    EXPECT_EQ(failures(matrix + "m != [1 0 0]").size(), 1u);
}

TEST(Script, WritingBeyondTheEndIsAFailure) {
    EXPECT_EQ(failures("vgGetMatrix m:f8"),
              std::vector<std::string>{"x:1: memory beyond the end of 'm' was written"});
}

TEST(Script, AnErrorThatNobodyAskedForIsAFailure) {
    EXPECT_EQ(failures("vgSeti VG_FILL_RULE 7").size(), 1u);
    EXPECT_TRUE(failures("vgSeti VG_FILL_RULE 7\nvgGetError == VG_ILLEGAL_ARGUMENT_ERROR").empty());
}

TEST(Script, FaultsNameTheirPlace) {
    EXPECT_EQ(error("\nvgNothing 1"), "x:2: 'vgNothing' is no function of OpenVG and no word of scripts");
    EXPECT_EQ(error("vgSeti VG_FILL_RULE"), "x:1: vgSeti takes 2 arguments, not 1");
    EXPECT_EQ(error("vgSeti VG_FILL_RULE 1.5"), "x:1: '1.5' is not an integer of 32 bits");
    EXPECT_EQ(error("vgSeti VG_FIL_RULE 1"),
              "x:1: 'VG_FIL_RULE' is neither a number, nor a name in VG/openvg.h, nor a variable");
    EXPECT_EQ(error("vgLoadMatrix [1 2"), "x:1: '[' without ']'");
    EXPECT_EQ(error("vgLoadMatrix 1 2]"), "x:1: ']' without '['");
    EXPECT_EQ(error("path p \"M 1 2"), "x:1: a quotation without end");
    EXPECT_EQ(error("path p \"\""), "x:1: no path data");
    EXPECT_EQ(error("a = vgFlush"), "x:1: there is no result");
    EXPECT_EQ(error("surface 0 4"), "x:1: no such surface");
    EXPECT_EQ(error("vgAppendPathData 1 1 [1] [2]"),
              "x:1: say what the list holds: b[...], h[...], w[...], i[...] or f[...]");
}

}  // namespace

}  // namespace vtm::vgscript
