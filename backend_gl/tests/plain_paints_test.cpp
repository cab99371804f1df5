#include "backend_gl/upload/plain_paints.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include "asset/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using asset::Gradient;
using asset::GradientStop;
using asset::Instruction;
using asset::Op;
using asset::Spread;
using asset::Texel;
using namespace asset::test;

GradientStop gray(float offset, std::uint16_t value, std::uint16_t alpha = 65535) {
    return {offset, {value, value, value, alpha}, 0};
}

/// Over the map's width.
Gradient across(std::size_t stops, Spread spread = Spread::Pad) {
    Gradient g;
    g.matrix = {float(1 / mapSide), 0, 0, float(1 / mapSide), 0, 0};
    g.spread = spread;
    g.stopCount = std::uint32_t(stops);
    return g;
}

Asset ofGradient(Op op, const Gradient& gradient, const std::vector<GradientStop>& stops) {
    std::vector<Texel> data;
    const std::uint32_t at = addGradient(data, gradient, stops);
    return programAsset({{op, {}, 1, at}}, data);
}

PaintWords wordsOf(const Asset& asset) { return plainPaints(asset).words.back(); }
std::uint32_t layersOf(const Asset& asset) { return wordsOf(asset)[0] >> plainTexelBits; }

TEST(PlainPaints, HardStopsAreNotPlain) {
    const auto isPlain = [](Op op, const Gradient& gradient, const std::vector<GradientStop>& stops) {
        return isPlainProgram(wordsOf(ofGradient(op, gradient, stops)));
    };
    EXPECT_TRUE(isPlain(Op::Linear, across(2), {gray(0, 0), gray(1, 65535)}));
    EXPECT_TRUE(isPlain(Op::Radial, across(3), {gray(0, 0), gray(0.3f, 65535, 100), gray(1, 0)}));
    EXPECT_FALSE(
        isPlain(Op::Linear, across(4), {gray(0, 0), gray(0.5f, 0), gray(0.5f, 65535), gray(1, 65535)}));
    EXPECT_FALSE(isPlain(Op::Linear, across(3), {gray(0, 0), gray(0, 65535), gray(1, 0)}));
    EXPECT_FALSE(isPlain(Op::Linear, across(2, Spread::Repeat), {gray(0, 0), gray(1, 65535)}));
    // Circles that nearly touch.
    Gradient cone = across(2);
    cone.fx = 0.95f;
    EXPECT_FALSE(isPlain(Op::Radial, cone, {gray(0, 0), gray(1, 65535)}));
}

TEST(PlainPaints, ColoursAreMixedIntoTablesAndWhatIsHiddenLeftOut) {
    std::vector<Texel> data;
    const std::uint32_t opaque = addGradient(data, across(2), {gray(0, 0), gray(1, 65535)});
    const std::uint32_t glass = addGradient(data, across(2), {gray(0, 0, 30000), gray(1, 65535, 40000)});
    const std::uint32_t haze = addColor(data, {0.1f, 0.1f, 0.2f, 0.5f});
    const auto layer = [](Op op, std::uint32_t at) { return Instruction{op, {}, 1, at}; };
    const Instruction solid = layer(Op::Solid, haze);
    EXPECT_EQ(layersOf(programAsset({solid, layer(Op::Linear, glass), solid, solid}, data)), 1u);
    EXPECT_EQ(layersOf(programAsset({layer(Op::Linear, glass), solid, layer(Op::Radial, glass)}, data)), 2u);
    EXPECT_EQ(layersOf(programAsset({layer(Op::Radial, glass), layer(Op::Linear, opaque)}, data)), 1u);
    EXPECT_EQ(layersOf(programAsset(
                  {layer(Op::Radial, glass), layer(Op::Linear, opaque), layer(Op::Radial, glass)}, data)),
              2u);
    // Groups are not plain.
    const Asset group =
        programAsset({layer(Op::Push, 0), layer(Op::Linear, glass), {Op::Pop, {}, 0.5f, 0}}, data);
    EXPECT_FALSE(isPlainProgram(wordsOf(group)));
}

TEST(PlainPaints, RampsBendAtTheirStops) {
    const Asset asset = ofGradient(Op::Linear, across(3), {gray(0, 0), gray(0.5f, 65535), gray(1, 65535)});
    const PlainPaints plain = plainPaints(asset);
    const auto bendAt = [&](double x) { return bendNear(plain.texels, plain.words.back(), {{x, 7}, 2, 1}); };
    const double slope = 2 / mapSide;
    EXPECT_NEAR(bendAt(16), 0, 1e-6);
    EXPECT_NEAR(bendAt(32), slope, 1e-6);
    EXPECT_NEAR(bendAt(34.4), slope, 1e-6);
    EXPECT_NEAR(bendAt(48), 0, 1e-6);
    EXPECT_NEAR(bendAt(1), slope, 1e-6);
    EXPECT_NEAR(bendAt(70), 0, 1e-6);
    // Folds, and the tip of a cone that is not round.
    const Asset folded = ofGradient(Op::Linear, across(2, Spread::Reflect), {gray(0, 0), gray(1, 65535)});
    const PlainPaints folds = plainPaints(folded);
    EXPECT_NEAR(bendNear(folds.texels, folds.words.back(), {{mapSide, 7}, 2, 1}), slope, 1e-6);
    EXPECT_NEAR(bendNear(folds.texels, folds.words.back(), {{1.5 * mapSide, 7}, 2, 1}), 0, 1e-6);
    Gradient oval = across(2);
    oval.matrix[3] *= 2;
    const Asset ovals = ofGradient(Op::Radial, oval, {gray(0, 0), gray(1, 65535)});
    const PlainPaints tip = plainPaints(ovals);
    EXPECT_NEAR(bendNear(tip.texels, tip.words.back(), {{0, 0}, 2, 1}), 2 * slope, 1e-6);
}

TEST(PlainPaints, ProgramsAreTheSameWhereverTheyStand) {
    const auto radial = [](float middle) {
        return ofGradient(Op::Radial, across(3), {gray(0, 0), gray(middle, 65535, 40000), gray(1, 0)});
    };
    Asset twice = radial(0.5f);
    twice.paints[1] = twice.paints.back();  // whose layers come first
    const PlainPaints one = plainPaints(radial(0.5f)), moved = plainPaints(twice),
                      other = plainPaints(radial(0.51f));
    const std::size_t paint = one.words.size() - 1;
    EXPECT_NE(one.words[paint], moved.words[paint]);
    EXPECT_TRUE(isSame(one, moved, paint));
    EXPECT_FALSE(isSame(one, moved, 1));
    EXPECT_FALSE(isSame(one, other, paint));
    EXPECT_TRUE(isSame(one, other, 1));
}

/// Some layers that lie anywhere on the map, in a leaf's two regions.
class RandomPrograms {
public:
    explicit RandomPrograms(unsigned seed) : random_(seed) {}

    Asset halves() {
        Asset asset = oneLeaf({5, 6, 6, 5}, {line({20000, 0}, {50000, 65535}, 5, 6)});
        for (int side = 0; side < 2; ++side) {
            std::vector<Instruction> program;
            for (int i = 0; i < 1 + int(random_() % 3); ++i)
                program.push_back(layer(asset.data));
            const auto first = std::uint32_t(asset.data.size());
            for (const Instruction& in : program)
                asset.data.push_back(std::bit_cast<Texel>(in));
            asset.paints.push_back({first, std::uint32_t(program.size()), 0, asset::programTag});
        }
        return asset;
    }

private:
    float share() { return std::uniform_real_distribution<float>(0, 1)(random_); }
    Instruction layer(std::vector<Texel>& data) {
        if (random_() % 4 == 0)
            return {Op::Solid, {}, share(), addColor(data, {0.2f, 0.1f, 0.4f, 0.5f})};
        Gradient g = across(2 + random_() % 3, random_() % 3 == 0 ? Spread::Reflect : Spread::Pad);
        const float turn = 6.28f * share(), scale = (0.5f + 2 * share()) / float(mapSide);
        g.matrix = {scale * std::cos(turn), scale * std::sin(turn), -scale * std::sin(turn),
                    scale * std::cos(turn), share() - 0.5f,         share() - 0.5f};
        if (g.spread == Spread::Pad && random_() % 2 == 0) {
            g.fx = 0.4f * share();
            g.fy = -0.4f * share();
            g.fr = 0.3f * share();
        }
        std::vector<GradientStop> stops;
        for (std::uint32_t i = 0; i < g.stopCount; ++i)
            stops.push_back({(float(i) + share()) / float(g.stopCount),
                             {std::uint16_t(random_()), std::uint16_t(random_()), std::uint16_t(random_()),
                              std::uint16_t(random_() % 2 == 0 ? 65535 : random_())},
                             0});
        return {random_() % 2 == 0 ? Op::Linear : Op::Radial,
                {},
                1 - 0.5f * share(),
                addGradient(data, g, stops)};
    }

    std::mt19937 random_;
};

/// Whether tables serve or not, as close to the evaluator as all other paints (renderer_test.cpp).
TEST_F(Gl, PlainPaintsAreThoseOfTheEvaluator) {
    int plain = 0;
    for (unsigned seed = 0; seed < 120; ++seed) {
        SCOPED_TRACE(seed);
        const Asset drawing = RandomPrograms(seed).halves();
        ASSERT_NO_THROW(asset::validate(drawing));
        plain += isPlainProgram(wordsOf(drawing)) ? 1 : 0;
        const Texture texture = renderer->upload(drawing);
        std::mt19937 random(seed);
        for (int i = 0; i < 4; ++i) {
            const asset::View view = randomView(random);
            const image::Raster drawn = renderer->render(texture, view),
                                exact = asset::evaluateAsShaders(drawing, view);
            const image::Raster scanned = asset::Scanner(drawing).draw(view);  // cells that are handed over
            double worst = 0;
            for (std::size_t k = 0; k < drawn.rgba.size(); ++k)
                worst = std::max(worst, std::min(std::abs(double(drawn.rgba[k]) - double(exact.rgba[k])),
                                                 std::abs(double(drawn.rgba[k]) - double(scanned.rgba[k]))));
            EXPECT_LE(worst, 0.4 / 255) << "view " << i;
        }
    }
    EXPECT_GT(plain, 80);
}

}  // namespace
}  // namespace vtm::gl
