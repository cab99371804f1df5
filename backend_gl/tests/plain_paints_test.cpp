#include "backend_gl/tiles/plain_paints.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
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

/// The map in one tile, with pixels of a 64th.
TileFrame wholeMap() { return {{0, 0}, mapSide, 1.0 / 64}; }
/// A square of it.
TileFrame square(double x, double y, double side) { return {{x, y}, side, 1 / side}; }

std::optional<PlainPaint> lastPaint(const Asset& asset, const TileFrame& frame = wholeMap()) {
    return plainPaint(asset, std::uint32_t(asset.paints.size() - 1), frame);
}
std::uint32_t layersOf(const Asset& asset) { return lastPaint(asset).value().layers; }

TEST(PlainPaints, HardStopsAreNotPlainWhereTheyAre) {
    const auto isPlain = [](Op op, const Gradient& gradient, const std::vector<GradientStop>& stops) {
        return lastPaint(ofGradient(op, gradient, stops)).has_value();
    };
    EXPECT_TRUE(isPlain(Op::Linear, across(2), {gray(0, 0), gray(1, 65535)}));
    EXPECT_TRUE(isPlain(Op::Radial, across(3), {gray(0, 0), gray(0.3f, 65535, 100), gray(1, 0)}));
    EXPECT_FALSE(isPlain(Op::Linear, across(3), {gray(0, 0), gray(0, 65535), gray(1, 0)}));
    // Circles that nearly touch.
    Gradient cone = across(2);
    cone.fx = 0.95f;
    EXPECT_FALSE(isPlain(Op::Radial, cone, {gray(0, 0), gray(1, 65535)}));

    const Asset halves =
        ofGradient(Op::Linear, across(4), {gray(0, 0), gray(0.5f, 0), gray(0.5f, 32768), gray(1, 65535)});
    EXPECT_FALSE(lastPaint(halves));
    EXPECT_FALSE(lastPaint(halves, square(mapSide / 2, 3, 8)));  // which is in pixels there
    EXPECT_EQ(lastPaint(halves, square(mapSide / 2 - 9, 3, 8)).value().layers, 0u);
    EXPECT_EQ(lastPaint(halves, square(mapSide / 2 + 1, 3, 8)).value().layers, 1u);
    const Asset repeated = ofGradient(Op::Linear, across(2, Spread::Repeat), {gray(0, 0), gray(1, 65535)});
    EXPECT_FALSE(lastPaint(repeated, square(mapSide - 4, 3, 8)));
    EXPECT_EQ(lastPaint(repeated, square(mapSide + 1, 3, 8)).value().layers, 1u);
}

TEST(PlainPaints, ColoursAreMixedIntoTablesAndWhatIsHiddenLeftOut) {
    std::vector<Texel> data;
    const std::uint32_t opaque = addGradient(data, across(2), {gray(0, 0), gray(1, 65535)});
    const std::uint32_t glass = addGradient(data, across(2), {gray(0, 0, 30000), gray(1, 65535, 40000)});
    const std::uint32_t haze = addColor(data, {0.1f, 0.1f, 0.2f, 0.5f});
    const std::uint32_t wall = addColor(data, {0.1f, 0.1f, 0.2f, 1});
    const auto layer = [](Op op, std::uint32_t at) { return Instruction{op, {}, 1, at}; };
    const Instruction solid = layer(Op::Solid, haze);
    EXPECT_EQ(layersOf(programAsset({solid, layer(Op::Linear, glass), solid, solid}, data)), 1u);
    EXPECT_EQ(layersOf(programAsset({layer(Op::Linear, glass), solid, layer(Op::Radial, glass)}, data)), 2u);
    EXPECT_EQ(layersOf(programAsset({layer(Op::Radial, glass), layer(Op::Linear, opaque)}, data)), 1u);
    EXPECT_EQ(layersOf(programAsset(
                  {layer(Op::Radial, glass), layer(Op::Linear, opaque), layer(Op::Radial, glass)}, data)),
              2u);
    EXPECT_EQ(layersOf(programAsset({layer(Op::Radial, glass), layer(Op::Solid, wall), solid}, data)), 0u);
}

TEST(PlainPaints, GroupsAreMixedIntoTablesWhereOneSideHasOneColour) {
    std::vector<Texel> data;
    const std::uint32_t ramp = addGradient(data, across(2), {gray(0, 0), gray(1, 65535, 40000)});
    const std::uint32_t haze = addColor(data, {0.1f, 0.1f, 0.2f, 0.5f});
    const Instruction linear{Op::Linear, {}, 1, ramp}, radial{Op::Radial, {}, 1, ramp},
        solid{Op::Solid, {}, 1, haze}, push{Op::Push, {}, 1, 0}, pop{Op::Pop, {}, 1, 0},
        half{Op::Pop, {}, 0.5f, 0}, screen{Op::Pop, asset::Blend::Screen, 1, 0},
        mask{Op::PopMaskLuminance, {}, 1, 0};
    const auto layers = [&](const std::vector<Instruction>& program) {
        const std::optional<PlainPaint> paint = lastPaint(programAsset(program, data));
        return paint ? int(paint->layers) : -1;
    };
    EXPECT_EQ(layers({linear, push, solid, half, push, solid, screen}), 1);
    EXPECT_EQ(layers({solid, push, linear, screen, push, radial, half}), 2);
    EXPECT_EQ(layers({push, linear, radial, pop}), 2);
    EXPECT_EQ(layers({push, linear, radial, half}), -1);
    EXPECT_EQ(layers({linear, push, radial, screen}), -1);
    EXPECT_EQ(layers({solid, push, solid, half, push, solid, screen, push, solid, mask}), 0);
    EXPECT_EQ(layers({linear, push, solid, push, radial, mask, pop}), 2);
    EXPECT_EQ(layers({linear, push, solid, mask}), 1);
    EXPECT_EQ(layers({linear, push, radial, mask}), -1);
    EXPECT_EQ(layers({linear, push, mask}), 0);
}

TEST(PlainPaints, RampsBendAtTheirStops) {
    const Asset asset = ofGradient(Op::Linear, across(3), {gray(0, 0), gray(0.5f, 65535), gray(1, 65535)});
    const auto bendAt = [&](double x) { return lastPaint(asset, square(x - 2, 7, 4)).value().bend; };
    const double slope = 2 / mapSide;  // by pixels of a unit
    EXPECT_NEAR(bendAt(16), 0, 1e-6);
    EXPECT_NEAR(bendAt(32), slope, 1e-6);
    EXPECT_NEAR(bendAt(34.4), slope, 0.25 * slope);  // a segment has its stop within
    EXPECT_NEAR(bendAt(48), 0, 1e-6);
    EXPECT_NEAR(bendAt(1), slope, 1e-6);
    EXPECT_NEAR(bendAt(70), 0, 1e-6);
    EXPECT_NEAR(lastPaint(asset, square(10, 7, 4)).value().change, slope, 1e-6);
    // Folds, and the tip of a cone that is not round.
    const Asset folded = ofGradient(Op::Linear, across(2, Spread::Reflect), {gray(0, 0), gray(1, 65535)});
    EXPECT_NEAR(lastPaint(folded, square(mapSide - 2, 7, 4)).value().bend, slope, 1e-6);
    EXPECT_NEAR(lastPaint(folded, square(1.5 * mapSide, 7, 4)).value().bend, 0, 1e-6);
    Gradient oval = across(2);
    oval.matrix[3] *= 2;
    const Asset ovals = ofGradient(Op::Radial, oval, {gray(0, 0), gray(1, 65535)});
    EXPECT_NEAR(lastPaint(ovals, square(-2, -2, 4)).value().bend, 2 * slope, 1e-6);
}

/// A paint is put behind what a tile has.
TEST(PlainPaints, LayersFindTheirTablesWhereverTheyStand) {
    const Asset asset = ofGradient(Op::Radial, across(3), {gray(0, 0), gray(0.3f, 65535, 100), gray(1, 0)});
    const PlainPaint paint = lastPaint(asset).value();
    std::vector<Texel> alone, behind(7);
    const PaintWords first = append(paint, alone), second = append(paint, behind);
    EXPECT_EQ(second[0] - first[0], 7u);
    EXPECT_EQ(behind[7][3] - alone[0][3], 7u);
    EXPECT_TRUE(std::equal(alone.begin() + 1, alone.end(), behind.begin() + 8));
}

/// Some layers that lie anywhere on the map, in a leaf's two regions.
class RandomPrograms {
public:
    RandomPrograms(unsigned seed, bool groups) : random_(seed), groups_(groups) {}

    Asset halves() {
        Asset asset = oneLeaf({5, 6, 6, 5}, {line({20000, 0}, {50000, 65535}, 5, 6)});
        for (int side = 0; side < 2; ++side) {
            std::vector<Instruction> program;
            for (int i = 0; i < 1 + int(random_() % 3); ++i) {
                program.push_back(layer(asset.data));
                if (groups_ && random_() % 2 == 0)
                    addGroup(program, asset.data);
            }
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

    /// Blended or masking what is below.
    void addGroup(std::vector<Instruction>& program, std::vector<Texel>& data) {
        program.push_back({Op::Push, {}, 1, 0});
        for (int i = 0; i < 1 + int(random_() % 2); ++i)
            program.push_back(layer(data));
        if (const unsigned kind = unsigned(random_() % 6); kind < 3)
            program.push_back({Op(unsigned(Op::PopMaskLuminance) + kind), {}, 1, 0});
        else
            program.push_back({Op::Pop, asset::Blend(random_() % (unsigned(asset::Blend::Luminosity) + 1)),
                               random_() % 2 == 0 ? 1 : share(), 0});
    }

    std::mt19937 random_;
    const bool groups_;
};

/// Whether tables serve or not, as close to the evaluator as all other paints (renderer_test.cpp).
class PlainPictures : public Gl {
protected:
    /// Returns the largest difference.
    double worstOf(const Asset& drawing, unsigned seed) {
        EXPECT_NO_THROW(asset::validate(drawing));
        const Texture texture = renderer->upload(drawing);
        std::mt19937 random(seed);
        double worst = 0;
        for (int i = 0; i < 4; ++i) {
            const asset::View view = randomView(random);
            const image::Raster drawn = renderer->render(texture, view),
                                exact = asset::evaluateAsShaders(drawing, view);
            const image::Raster scanned = asset::Scanner(drawing).draw(view);  // cells that are handed over
            for (std::size_t k = 0; k < drawn.rgba.size(); ++k)
                worst = std::max(worst, std::min(std::abs(double(drawn.rgba[k]) - double(exact.rgba[k])),
                                                 std::abs(double(drawn.rgba[k]) - double(scanned.rgba[k]))));
        }
        return worst;
    }
};

TEST_F(PlainPictures, AreThoseOfTheEvaluator) {
    int plain = 0;
    for (unsigned seed = 0; seed < 120; ++seed) {
        const Asset drawing = RandomPrograms(seed, false).halves();
        plain += lastPaint(drawing, square(0, 0, mapSide / 16)) ? 1 : 0;
        EXPECT_LE(worstOf(drawing, seed), 0.4 / 255) << seed;
    }
    EXPECT_GT(plain, 80);
}

/// A table holds blended colours and so their means, the evaluator blends means of ramps.
TEST_F(PlainPictures, OfGroupsAreThoseOfTheEvaluator) {
    int plain = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Asset drawing = RandomPrograms(seed, true).halves();
        plain += lastPaint(drawing, square(0, 0, mapSide / 16)) ? 1 : 0;
        EXPECT_LE(worstOf(drawing, seed), 1.0 / 255) << seed;
    }
    EXPECT_GT(plain, 80);
}

}  // namespace
}  // namespace vtm::gl
