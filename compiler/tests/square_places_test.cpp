// Places in a square: the shares that they tell against areas, and the light that layers take at them.

#include "compiler/direct/square_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "compiler/direct/layer_cover.hpp"
#include "compiler/direct/square_lights.hpp"

namespace vtm::compiler {
namespace {

constexpr float onePlace = 1.0f / placesInSquare;

/// The part of square 0 right of the line through a point.
double areaRight(glm::vec2 a, double slope) {
    constexpr int rows = 2000;
    double area = 0;
    for (int i = 0; i < rows; ++i)
        area += 1 - std::clamp(a.x + ((i + 0.5) / rows - a.y) * slope, 0.0, 1.0);
    return area / rows;
}

double shareOf(const PlaceWindings& windings) {
    return double(std::ranges::count_if(windings, [](auto w) { return w != 0; })) / placesInSquare;
}

TEST(SquarePlaces, SharesBesideEdgesAreNearlyAreas) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> between(0, 1);
    constexpr int count = 2000;
    double squares = 0, most = 0;
    for (int i = 0; i < count; ++i) {
        const glm::vec2 a(between(random), between(random));
        const double slope = std::tan(std::numbers::pi * (double(between(random)) - 0.5));
        PlaceWindings windings{};
        PlacedEdge(a, float(slope)).add(windings, 0, 1);
        const double off = shareOf(windings) - areaRight(a, slope);
        squares += off * off;
        most = std::max(most, std::abs(off));
    }
    EXPECT_LE(std::sqrt(squares / count), 1.3 / 255);
    EXPECT_LE(most, 8.0 / 255);
}

TEST(SquarePlaces, SharesBesideUprightEdgesAndBetweenHeightsAreExact) {
    for (int i = 0; i <= placesInSquare; ++i) {
        const float at = float(i) * onePlace;
        PlaceWindings upright{}, level{};
        PlacedEdge({7 + at, 0}, 0).add(upright, 7, 1);
        PlaceRange(at, 1).add(level, 1);
        EXPECT_EQ(shareOf(upright), 1 - double(at)) << i;
        EXPECT_EQ(shareOf(level), 1 - double(at)) << i;
    }
}

/// What one layer leaves on one side, the other takes: nothing of what lies below shows.
TEST(SquarePlaces, LayersThatMeetAtAnEdgeLeaveNothingBetweenThem) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> between(0, 1);
    for (int i = 0; i < 200; ++i) {
        const PlacedEdge edge({9 + between(random), 3 * between(random) - 1}, 8 * between(random) - 4);
        PlaceLights lights;
        lights.fill(fullLight);
        const TakenLight left = takeLightBeside(lights, edge, 9, true, 1);
        PlaceWindings windings{};
        edge.add(windings, 9, -1);
        const TakenLight right = takeLight(lights, windings, i % 2 == 0, 1);
        EXPECT_FLOAT_EQ(left.taken + right.taken, 1);
        EXPECT_TRUE(std::ranges::all_of(lights, [](auto light) { return light == 0; }));
    }
}

TEST(SquarePlaces, LightIsTakenByItsShareWhereTheRuleSays) {
    PlaceWindings windings{};
    for (std::size_t i = 0; i < windings.size(); ++i)
        windings[i] = std::int16_t(i % 4);
    for (const bool isEvenOdd : {false, true}) {
        PlaceLights lights;
        lights.fill(fullLight);
        const TakenLight light = takeLight(lights, windings, isEvenOdd, 0.25f);
        EXPECT_NEAR(light.taken, 0.25 * (isEvenOdd ? 0.5 : 0.75), 1e-4);
        EXPECT_NEAR(float(light.most) / fullLight, 0.75, 0.25);  // its bits may be those of several places
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const bool isInside = isEvenOdd ? i % 2 == 1 : i % 4 != 0;
            EXPECT_NEAR(float(lights[i]) / fullLight, isInside ? 0.75 : 1, 1e-4);
        }
    }
}

TEST(SquarePlaces, StepsAlongRowsTellWhatEdgesDo) {
    constexpr int squares = 12;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> between(0, 1);
    for (const float steep : {2.0f, 60.0f}) {
        PlaceSteps steps(squares);
        std::vector<PlaceWindings> direct(squares);
        for (int i = 0; i < 20; ++i) {
            const glm::vec2 a(squares * between(random), between(random));
            const float slope = steep * (2 * between(random) - 1);
            const PlacedEdge edge(a, slope);
            const float top = a.x - a.y * slope;
            if (steep > 16)
                steps.addLevel(0, placesAlong, {top, 0}, {top + slope, 1}, 1);
            else
                steps.add(0, placesAlong, top + 0.5f / placesAlong * slope, slope / placesAlong, 1);
            for (int square = 0; square < squares; ++square)
                edge.add(direct[std::size_t(square)], square, 1);
        }
        // Rows are asked in their middles: steep edges lie elsewhere at a place, by half a row's slope. So
        // are columns: in each of those that a nearly level edge crosses, 16 times its slope, a place is on
        // its other side with a probability of 1 / 4 times the slope.
        double off = 0;
        steps.takeAll([&](int square, const PlaceWindings& windings) {
            for (std::size_t i = 0; i < windings.size(); ++i)
                off += windings[i] != direct[std::size_t(square)][i];
        });
        const double most = steep > 16 ? 20.0 * 16 / 4 : 20 * 0.5 * double(steep) / 16 * placesInSquare;
        EXPECT_LE(off, most);
        steps.takeAll([&](int, const PlaceWindings& windings) {
            EXPECT_TRUE(std::ranges::all_of(windings, [](auto w) { return w == 0; }));
        });
    }
}

/// An edge that is less high than a row of places, beside which the whole row lies.
TEST(SquarePlaces, NearlyLevelEdgesReachNoFurtherThanTheirEnds) {
    constexpr int squares = 9;
    PlaceSteps steps(squares);
    const glm::vec2 a(7, 0.53f), b(2, 0.54f);
    steps.addLevel(8, 9, a, b, 1);
    steps.takeAll([&](int square, const PlaceWindings& windings) {
        const auto inRow = std::span(windings).subspan(8 * placesAlong, placesAlong);
        const auto right = std::ranges::count(inRow, std::int16_t(1));
        EXPECT_EQ(std::ranges::count(windings, std::int16_t(1)), right);
        EXPECT_TRUE(square < 2   ? right == 0
                    : square < 7 ? right > 0 && right < placesAlong
                                 : right == placesAlong)
            << square;
    });
}

// ---- Light in a row of squares --------------------------------------------------------------------

SolidLayers::Layer layerOf(glm::vec4 color, std::uint32_t group = noIndex) { return {color, group, false}; }

TEST(SquareLights, ColoursAreLaidUnderThoseBefore) {
    SquareLights lights({});
    lights.begin(2);
    const PlacedEdge middle({1.5f, 0}, 0);
    lights.coverBeside(1, layerOf({0.5f, 0, 0, 0.5f}), middle, true);
    lights.cover(0, layerOf({0.25f, 0, 0, 0.25f}));
    lights.cover(1, layerOf({0, 1, 0, 1}));
    EXPECT_EQ(lights.nextOpen(0), 0);
    EXPECT_EQ(lights.nextOpen(1), 2);
    EXPECT_FALSE(lights.areClosed());
    lights.cover(0, layerOf({0, 0, 1, 1}));
    EXPECT_TRUE(lights.areClosed());
    const std::span<const glm::vec4> colors = lights.finish();
    const glm::vec4 expected[]{{0.25f, 0, 0.75f, 1}, {0.25f, 0.75f, 0, 1}};
    for (std::size_t i = 0; i < 2; ++i)
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(colors[i][c], expected[i][c], 1e-3) << i << ", " << c;
}

/// A group of opacity 1/2 with another of 1/2 in it: red on the left of the middle, blue under it, green all
/// over.
TEST(SquareLights, GroupsAreMixedByTheirOpacity) {
    SquareLights lights({{0.5f, noIndex}, {0.5f, 0}});
    lights.begin(1);
    const PlacedEdge middle({0.5f, 0}, 0);
    lights.enter(1);
    lights.coverBeside(0, layerOf({1, 0, 0, 1}), middle, true);
    lights.cover(0, layerOf({0, 0, 0.5f, 0.5f}));
    lights.enter(0);
    lights.cover(0, layerOf({0, 1, 0, 1}));
    lights.enter(noIndex);
    lights.cover(0, layerOf({1, 1, 1, 1}));
    const std::span<const glm::vec4> colors = lights.finish();
    // Left: ½ (½ red + ½ green) + ½ white. Right: ½ (¼ blue + ¾ green) + ½ white.
    const glm::vec4 left = glm::vec4(0.25f, 0.25f, 0, 0.5f) + 0.5f,
                    right = glm::vec4(0, 0.375f, 0.125f, 0.5f) + 0.5f;
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(colors[0][c], 0.5f * (left[c] + right[c]), 1e-3) << c;
}

TEST(SquareLights, WhatIsKnownToBeDarkIsForgottenWithTheGroup) {
    SquareLights lights({{0.5f, noIndex}});
    lights.begin(1);
    lights.keepDarkLeft(0, {0.25f, 0.25f});
    lights.enter(0);
    EXPECT_EQ(lights.darkLeft(0).enter, 0.25f);
    lights.keepDarkLeft(0, {0.75f, 0.75f});
    lights.keepDarkLeft(0, {0.5f, 0.5f});
    EXPECT_EQ(lights.darkLeft(0).enter, 0.75f);
    lights.enter(noIndex);
    EXPECT_EQ(lights.darkLeft(0).enter, 0.25f);
}

}  // namespace
}  // namespace vtm::compiler
