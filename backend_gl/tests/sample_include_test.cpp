// The include's text: every permutation compiles, here and by the reference compiler, and it shares no name
// with anybody.
#include "backend_gl/texture/sample_include.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include <vtm/gl/sampled_texture.hpp>
#include "asset/testing.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "tests/test_folder.hpp"

namespace vtm::gl {
namespace {

using asset::Material;
using namespace asset::test;

const std::vector<Material> stripes{{"stripes", "vec4 stripes(vec2 p) { return vec4(fract(p.x)); }"}};
constexpr const char* oneTexture = "uniform Vtm sign;\nvec4 shade(vec2 p) { return vtm_sample(sign, p); }\n";
constexpr const char* fiveTextures = R"(
uniform Vtm a, b, c, d, e;
vec4 shade(vec2 p) {
    return vtm_sample(a, p) + vtm_sample(b, p) + vtm_sample(c, p) + vtm_sample(d, p) + vtm_sample_grad(e, p, p, p);
}
)";

/// On this driver a sample of them, which has each feature with and without each other; all are validated
/// below.
TEST_F(Gl, EveryPermutationOfTheIncludeCompiles) {
    const unsigned step = std::getenv("VTM_TEST_ALL") ? 1 : 5;
    for (unsigned flags = 0; flags < Features::combinations; flags += step)
        EXPECT_NO_THROW(test::ShaderCanvas(sampleText(Features(flags), {flags % 3, flags % 16 == 5}, stripes),
                                           oneTexture))
            << flags;
    // Three samplers each: 15 of the 16 that WebGL 2 guarantees.
    EXPECT_NO_THROW(test::ShaderCanvas(
        sampleText(Features(Features::combinations - 1), {asset::maxMapDepth - 1, true}, stripes),
        fiveTextures));
}

/// glslangValidator knows nothing beyond GLSL ES 3.00, so what it accepts WebGL 2 accepts.
TEST(SampleInclude, EveryPermutationIsValid) {
    if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "glslangValidator is not installed (Debian: glslang-tools)";
    const TestFolder folder;
    for (unsigned flags = 0; flags < Features::combinations; ++flags)
        std::ofstream(folder / fmt::format("{:02}.frag", flags))
            << "#version 300 es\n"
            << sampleText(Features(flags), {flags % 3, flags % 16 == 5}, stripes) << fiveTextures
            << "out vec4 color;\nvoid main() { color = shade(gl_FragCoord.xy); }\n";
    const std::string log = (folder / "log").string();
    const int status = std::system(
        fmt::format("cd '{}' && glslangValidator *.frag > log 2>&1", folder.path().string()).c_str());
    std::ifstream text(log);
    EXPECT_EQ(status, 0) << std::string(std::istreambuf_iterator<char>(text), {}).substr(0, 2000);
}

TEST_F(Gl, TheIncludeLeavesAllNamesToTheUser) {
    // As functions, structures, constants and macros, whichever they are in our own shaders.
    EXPECT_NO_THROW(test::ShaderCanvas(
        sampleText(Features(Features::combinations - 1), {asset::maxMapDepth - 1, true}, stripes), R"(
#define LINEAR 7
#define ASSET 9
#define FEATURES 3
struct Frame { float a; };
struct Curve { float b; };
struct Footprint { float c; };
const float leafExtent = 1.0, chordCount = 2.0, turnsPerPixel = 3.0;
uniform sampler2D texels, images;
uniform vec4 sections;
float low(float x) { return x; }
float seg(float x) { return x; }
float over(float x) { return x; }
float texelAt(float x) { return x; }
float paintColor(float x) { return x; }
float runProgram(float x) { return x; }
float prefiltered(float x) { return x; }
float materialColor(float x) { return x; }
uniform Vtm sign;
vec4 shade(vec2 p) { return vtm_sample(sign, p) + low(p.x) + sections; })"));
}

TEST_F(Gl, UsersLinesAreCountedFromTheirOwnText) {
    try {
        test::ShaderCanvas(sampleText({}, {}, {}), "vec4 shade(vec2 p) {\n    return vec4(missing);\n}");
        ADD_FAILURE();
    } catch (const GlError& error) {
        EXPECT_NE(std::string(error.what()).find("0:2("), std::string::npos) << error.what();
    }
}

TEST(SampleInclude, SharesMaterialsByNameAndText) {
    asset::Asset one = everyPaint(), other = one;
    ASSERT_FALSE(one.materials.empty());
    EXPECT_EQ(sampleInclude({one, other}), sampleInclude({one}));
    other.materials[0].glsl += " ";
    EXPECT_THROW(sampleInclude({one, other}), GlError);
    EXPECT_NE(materialKey(one.materials[0]), materialKey(other.materials[0]));
}

TEST(Prefixed, NamesThatADeclarationMakes) {
    EXPECT_EQ(
        prefixed("const int few = 3;  // few\nfloat twice(float x) { return 2.0 * x; }\n\n"
                 "struct Pair { float a, b; };\n#define SIX 6\n"
                 "float vtm_all(Pair p, float t) { float y = twice(p.a) + float(few); return y * SIX; }\n"),
        "const int vtm_few = 3;\nfloat vtm_twice(float x) { return 2.0 * x; }\n"
        "struct vtm_Pair { float a, b; };\n#define VTM_SIX 6\n"
        "float vtm_all(vtm_Pair p, float t) { float y = vtm_twice(p.a) + float(vtm_few); return y * "
        "VTM_SIX; }\n");
    EXPECT_EQ(prefixed("const int idle = 3;\nconst int few = 4;\nint three() { return few; }\n"),
              "const int vtm_few = 4;\nint vtm_three() { return vtm_few; }\n");
}

}  // namespace
}  // namespace vtm::gl
