// The certified error, measured: how far drawn boundaries lie from true outlines, and true ones from drawn
// ones, as a share of the tolerance.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <vtm/compiler/compile.hpp>
#include "conformance/cases/distances.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/generate/generate.hpp"

namespace vtm::cases {
namespace {

void expectWithinProof(const Distances& found, double proven) {
    EXPECT_LE(proven, 1);
    EXPECT_LE(found.fromDrawn, proven);
    EXPECT_LE(found.fromTrue, proven);
}

/// Compiled as `vtm compile` does.
Distances expectNearTruth(const std::filesystem::path& file, int drawn, int truths) {
    const compiler::Options options;
    const scene::Scene scene = loadScene(file);
    const compiler::Result result = compiler::compile(scene, options);
    EXPECT_TRUE(result.unproven.empty());
    const double unit = options.tolerance * std::max(scene.width, scene.height);
    const Distances found = measure(scene, result.asset, unit, 1, drawn, truths);
    expectWithinProof(found, result.provenError / options.tolerance);
    testing::Test::RecordProperty(file.stem().string() + "_from_drawn", std::to_string(found.fromDrawn));
    testing::Test::RecordProperty(file.stem().string() + "_from_true", std::to_string(found.fromTrue));
    return found;
}

TEST(Distance, OfTheExamplesIsBelowTheTolerance) {
    constexpr int points = 30;
    int drawn = 0, truths = 0;
    for (const auto& entry : std::filesystem::directory_iterator(examplesDirectory()))
        if (entry.path().extension() == ".svg") {
            SCOPED_TRACE(entry.path());
            const Distances found = expectNearTruth(entry.path(), points, points);
            drawn += found.drawn, truths += found.truths;
        }
    EXPECT_GE(drawn, 2 * points);
    EXPECT_GE(truths, points / 2);
}

TEST(Distance, OfTheCorpusIsBelowTheTolerance) {
    const auto corpus = sharedDirectory() / "corpus";
    if (!std::filesystem::exists(corpus))
        GTEST_SKIP() << corpus << " is absent";
    constexpr int drawn = 2000, truths = 150;
    for (const char* name : {"tiger", "caesar", "flag_mx", "world"}) {
        SCOPED_TRACE(name);
        const Distances found = expectNearTruth(corpus / (std::string(name) + ".svg"), drawn, truths);
        EXPECT_GE(found.drawn, drawn / 2);
        EXPECT_GE(found.truths, truths / 5);
    }
}

TEST(Distance, OfRandomScenesIsBelowTheTolerance) {
    constexpr std::uint64_t scenes = 80;
    constexpr int points = 8;
    Distances worst;
    for (std::uint64_t seed = 0; seed < scenes; ++seed) {
        SCOPED_TRACE(seed);
        const scene::Scene scene = generate::randomScene(seed);
        const double tolerance = std::ldexp(1.0, seed % 2 == 0 ? -16 : -11);
        const compiler::Result result = compiler::compile(scene, {.tolerance = tolerance});
        const Distances found = measure(scene, result.asset, tolerance * std::max(scene.width, scene.height),
                                        seed, points, points);
        expectWithinProof(found, result.provenError / tolerance);
        worst.fromDrawn = std::max(worst.fromDrawn, found.fromDrawn);
        worst.fromTrue = std::max(worst.fromTrue, found.fromTrue);
        worst.drawn += found.drawn, worst.truths += found.truths;
    }
    EXPECT_GE(worst.drawn, int(scenes));
    EXPECT_GE(worst.truths, int(scenes));
    RecordProperty("from_drawn", std::to_string(worst.fromDrawn));
    RecordProperty("from_true", std::to_string(worst.fromTrue));
}

/// The measurement measures: a picture that is moved by a number of tolerances is found to be.
TEST(Distance, IsMeasured) {
    scene::Scene scene{64, 64, {}};
    scene::Item item;
    item.path = std::make_shared<scene::Path>(scene::Path{scene::MoveTo{{20, 32}},
                                                          scene::CubicTo{{20, 10}, {46, 10}, {46, 32}},
                                                          scene::CubicTo{{46, 54}, {20, 54}, {20, 32}}});
    item.geometry = scene::FillRule::NonZero;
    item.paint = scene::Color{1, 0, 0, 1};
    scene.root.children.push_back({item});
    const double tolerance = compiler::Options().tolerance * 64;
    asset::Asset asset = compiler::compile(scene).asset;
    for (const double moved : {0.5, 1.5}) {
        asset.maps[0].x = moved * tolerance;
        const Distances found = measure(scene, asset, tolerance, 1, 100, 100);
        EXPECT_NEAR(found.fromDrawn, moved, 0.35);
        EXPECT_NEAR(found.fromTrue, moved, 0.35);
        EXPECT_GE(found.truths, 50);
    }
}

}  // namespace
}  // namespace vtm::cases
