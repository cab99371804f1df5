// Materials: user GLSL in the leaves' programs, against the same functions on the CPU.
#include <cmath>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>
#include "asset/testing.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using asset::Material;
using asset::View;
using namespace asset::test;

constexpr double tolerance = 0.4 / 255;  // of GPU against evaluator: docs/testing.md

const Material checker{"checker", R"(
vec4 checker(vec2 p) {
    ivec2 cell = ivec2(floor(p / 5.0));
    return ((cell.x + cell.y) & 1) == 0 ? vec4(0.75, 0.25, 0.0, 1.0) : vec4(0.0, 0.0, 0.25, 0.5);
})"};

glm::vec4 checkerColor(glm::vec2 p) {
    const glm::ivec2 cell(int(std::floor(p.x / 5)), int(std::floor(p.y / 5)));
    return ((cell.x + cell.y) & 1) == 0 ? glm::vec4(0.75f, 0.25f, 0, 1) : glm::vec4(0, 0, 0.25f, 0.5f);
}

const Material noise{"noise", R"(
float noiseAt(ivec2 q) {
    uint h = uint(q.x) * 374761393u + uint(q.y) * 668265263u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return float(h >> 24) / 255.0;
}

vec4 noise(vec2 p) {
    vec2 corner = floor(p * 0.25), f = p * 0.25 - corner;
    ivec2 q = ivec2(corner);
    float v = mix(mix(noiseAt(q), noiseAt(q + ivec2(1, 0)), f.x),
                  mix(noiseAt(q + ivec2(0, 1)), noiseAt(q + ivec2(1, 1)), f.x), f.y);
    return vec4(v, v * 0.5, 0.0, 1.0);
})"};

float noiseAt(int x, int y) {
    std::uint32_t h = std::uint32_t(x) * 374761393u + std::uint32_t(y) * 668265263u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return float(h >> 24) / 255;
}

glm::vec4 noiseColor(glm::vec2 p) {
    const int x = int(std::floor(p.x / 4)), y = int(std::floor(p.y / 4));
    const float fx = p.x / 4 - float(x), fy = p.y / 4 - float(y);
    const auto mix = [](float a, float b, float t) { return a * (1 - t) + b * t; };
    const float v =
        mix(mix(noiseAt(x, y), noiseAt(x + 1, y), fx), mix(noiseAt(x, y + 1), noiseAt(x + 1, y + 1), fx), fy);
    return {v, v / 2, 0, 1};
}

glm::vec4 onCpu(std::uint32_t material, glm::vec2 p) {
    return material == 0 ? checkerColor(p) : noiseColor(p);
}

std::uint16_t addPaint(Asset& asset, const asset::MaterialFill& fill) {
    const std::uint32_t at = addMaterial(asset.data, fill);
    const asset::Instruction in{asset::Op::Material, {}, 1, at};
    asset.data.push_back(std::bit_cast<asset::Texel>(in));
    asset.paints.push_back({std::uint32_t(asset.data.size() - 1), 1, 0, asset::programTag});
    return std::uint16_t(asset.paints.size() - 1);
}

/// Checker left of a slanting line, turned noise right of it.
Asset twoMaterials() {
    Asset asset = emptyAsset();
    asset.materials = {checker, noise};
    const std::uint16_t left = addPaint(asset, {{1, 0, 0, 1, 0.25f, 0.25f}, 0, 0, {}});
    const std::uint16_t right = addPaint(asset, {{0.8f, 0.6f, -0.6f, 0.8f, 100, 0}, 1, 0, {}});
    asset.maps[0].root =
        addLeaf(asset, {left, right, right, left}, {line({20001, 0}, {40003, 65535}, left, right)});
    return asset;
}

double worst(const image::Raster& a, const image::Raster& b) {
    double difference = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        difference = std::max(difference, double(std::abs(a.rgba[i] - b.rgba[i])));
    return difference;
}

TEST_F(Gl, MaterialsAreSampledAtEveryPixel) {
    const Asset asset = twoMaterials();
    ASSERT_NO_THROW(asset::validate(asset));
    // A unit a pixel, and two: no pixel's centre comes near a square's border.
    for (const double zoom : {1.0, 2.0}) {
        const int side = int(64 * zoom);
        const View view{side, side, glm::dmat3x2(zoom, 0, 0, zoom, 0, 0)};
        const image::Raster drawn = renderer->render(renderer->upload(asset), view);
        EXPECT_LE(worst(drawn, asset::evaluate(asset, view, onCpu)), tolerance);
        EXPECT_GT(worst(drawn, asset::evaluate(asset, view)), 0.5);  // the fallback is transparent
    }
}

TEST_F(Gl, MaterialsTurnWithThePicture) {
    Asset asset = twoMaterials();
    asset.materials[0] = {"waves",
                          "vec4 waves(vec2 p) { return vec4(0.5 + 0.5 * sin(p.x), 0.0, 0.0, 1.0); }"};
    const auto smooth = [](std::uint32_t material, glm::vec2 p) {
        return material == 0 ? glm::vec4(0.5f + 0.5f * std::sin(p.x), 0, 0, 1) : noiseColor(p);
    };
    const Texture texture = renderer->upload(asset);
    std::mt19937 random(5);
    for (int i = 0; i < 20; ++i) {
        const View view = randomView(random);
        ASSERT_LE(worst(renderer->render(texture, view), asset::evaluate(asset, view, smooth)), tolerance)
            << i;
    }
}

TEST_F(Gl, MaterialsFillMasksOfCompatMode) {
    Asset asset = layers();
    asset.materials = {noise};
    const std::uint16_t paint = addPaint(asset, {{1, 0, 0, 1, 0, 0}, 0, 0, {}});
    for (asset::Command& command : asset.commands)
        if (command.kind == asset::Command::Kind::FillMask)
            command.paint = paint;
    const View view{64, 64};
    const auto noiseOnly = [](std::uint32_t, glm::vec2 p) { return noiseColor(p); };
    const image::Raster drawn = renderer->render(renderer->upload(asset), view);
    EXPECT_LE(worst(drawn, asset::evaluate(asset, view, noiseOnly)), tolerance);
    EXPECT_GT(worst(drawn, image::Raster(64, 64)), 0.1);
}

TEST_F(Gl, AMaterialsErrorNamesItAndItsLine) {
    const auto complaint = [](Asset asset, const std::string& text) -> std::string {
        asset.materials[1] = {"noise", text};
        try {
            renderer->upload(asset);
        } catch (const GlError& error) {
            return error.what();
        }
        return "";
    };
    const Asset asset = twoMaterials();
    EXPECT_TRUE(complaint(asset, "vec4 noise(vec2 p) {\n    return vec4(0.0);\n}\n").empty());
    EXPECT_TRUE(complaint(asset, "\n\nvec4 noise(vec2 p) {\n    return vec4(missing);\n}\n")
                    .starts_with("material 'noise', line 4: "));
    // Names that are taken, and a missing entry point.
    const std::string twice =
        "vec4 noise(vec2 p) { return vec4(0.0); }\nvec4 over(vec4 a, vec4 b) { return a; }";
    for (const std::string& text : {twice, std::string("float other() { return 0.0; }"), checker.glsl})
        EXPECT_NE(complaint(asset, text).find("noise"), std::string::npos) << text;
}

TEST_F(Gl, MaterialsAreCompiledOncePerList) {
    Programs programs;
    const unsigned first = programs.materialSet(std::vector{checker}),
                   second = programs.materialSet(std::vector{checker, noise});
    EXPECT_NE(first, second);
    EXPECT_NE(first, programs.materialSet({}));
    EXPECT_EQ(first, programs.materialSet(std::vector{checker}));
    const Features features(Features::Material);
    const Program& program = programs.fill(features, first);
    EXPECT_EQ(&program, &programs.fill(features, first));
    EXPECT_NE(&program, &programs.fill(features, second));
}

TEST(Materials, PlacesAreFoundInTheLogsOfSeveralDrivers) {
    const std::vector<Material> two{{"a", ""}, {"b", ""}};
    for (const std::string log : {"30001:7(12): error: `x' undeclared", "ERROR: 30001:7: 'x' : undeclared",
                                  "program: 30001(7) : error C1503: undefined variable"})
        EXPECT_EQ(blamedOnMaterial(two, log), "material 'b', line 7: " + log);
    for (const std::string elsewhere : {"0:30001(3): error", "30002:7(12): error"}) {
        EXPECT_EQ(blamedOnMaterial(two, elsewhere), "materials 'a', 'b': " + elsewhere);
        EXPECT_EQ(blamedOnMaterial({}, elsewhere), elsewhere);
    }
}

}  // namespace
}  // namespace vtm::gl
