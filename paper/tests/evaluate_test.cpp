// Paper mode, evaluation: a test a row of the paper's table (docs/paper.md).

#include "paper/evaluate.hpp"
#include "paper/model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <vtm/asset/container.hpp>

namespace vtm::paper {
namespace {

using glm::dmat2;
using glm::dvec2;

// ---- Assets to look at --------------------------------------------------------------------------

/// Cell coordinates of a point of the cell itself.
dvec2 inMargin(dvec2 p) { return (p + cellMargin) / (1 + 2 * cellMargin); }

/// A piece between two points of the cell itself, in [-1/8, 9/8].
Piece piece(dvec2 a, dvec2 b, double slopeA = 0, double slopeB = 0) {
    const auto stored = [](dvec2 p) {
        const dvec2 q = inMargin(p) * cellExtent;
        return std::array{std::uint16_t(std::lround(q.x)), std::uint16_t(std::lround(q.y))};
    };
    const auto slope = [](double m) { return std::int16_t(std::lround(m * slopeScale)); };
    return {stored(a), stored(b), slope(slopeA), slope(slopeB)};
}

/// Inside is y > height: left of the chord for y up.
Cell above(double height) { return {{piece({0, height}, {1, height}), {}}, 1, {}}; }

Mip uniformMip(unsigned sizeLog2, std::uint8_t value) {
    std::size_t texels = 0;
    for (unsigned k = 0; k <= sizeLog2; ++k)
        texels += std::size_t(1) << (2 * k);
    return {sizeLog2, std::vector<std::uint8_t>(texels, value)};
}

/// One cell on the square [0, side]².
Mask maskOf(const Cell& cell, double side) {
    return {0, 0, side, asset::Entry::make(asset::Entry::Kind::Leaf, 0), {}, {cell}, uniformMip(6, 128)};
}

/// The left half of the square [0, side]².
Mask leftHalf(double side) { return maskOf({{piece({0.5, 0}, {0.5, 1}), {}}, 1, {}}, side); }

asset::Paint solid(float r, float g, float b, float a) {
    return {std::bit_cast<std::uint32_t>(r), std::bit_cast<std::uint32_t>(g), std::bit_cast<std::uint32_t>(b),
            std::bit_cast<std::uint32_t>(a)};
}

/// Paints 1 to 4: red, green, blue, white at half.
Asset assetOf(std::vector<Mask> masks, std::vector<Node> nodes) {
    Asset asset{100, 100, std::move(masks), std::move(nodes), noIndex, {}};
    asset.root = std::uint32_t(asset.nodes.size() - 1);
    asset.palette.paints = {
        {}, solid(1, 0, 0, 1), solid(0, 1, 0, 1), solid(0, 0, 1, 1), solid(0.5f, 0.5f, 0.5f, 0.5f)};
    validate(asset);
    return asset;
}

Side paint(std::uint32_t index) { return {index, noIndex, false}; }
Side rest(std::uint32_t node) { return {0, node, false}; }

/// Four pixels a unit: magnified enough that no mip is looked at.
const Footprint sharp(dmat2(4));

double coverage(const Mask& mask, dvec2 point, const Footprint& pixel = sharp) {
    Cost cost;
    return maskCoverage(mask, point, pixel, cost);
}

// ---- Row 1 --------------------------------------------------------------------------------------

/// A point of the curve itself.
dvec2 onCurve(dvec2 a, dvec2 b, double mA, double mB, double s) {
    const dvec2 chord = b - a;
    const double t = mA * s * (1 - s) * (1 - s) - mB * s * s * (1 - s);
    return inMargin(a + s * chord + t * dvec2(-chord.y, chord.x));
}

TEST(PaperRow1, TheHermiteFunctionIsZeroOnItsCurve) {
    const dvec2 a(0.1, 0.2), b(0.9, 0.6);
    const Piece p = piece(a, b, 0.4, -0.3);
    for (double s = 0; s <= 1; s += 0.125) {
        const dvec2 q = onCurve(a, b, 0.4, -0.3, s);
        EXPECT_NEAR(implicitValue(p, q).value, 0, 1e-4) << s;
        EXPECT_GT(implicitValue(p, q + dvec2(-0.004, 0.008)).value, 0) << "left of A to B";
    }
}

TEST(PaperRow1, SlopesBelongToTheirOwnEnds) {
    // As printed, cA s²(1-s) + cB s(1-s)² has slope cB at A.
    const dvec2 a(0, 0.5), b(1, 0.5);
    const Piece p = piece(a, b, 1, 0.25);
    const auto slopeAt = [&](dvec2 q) {
        const dvec2 g = implicitValue(p, inMargin(q)).gradient;
        return -g.x / g.y;
    };
    EXPECT_NEAR(slopeAt(a), 1, 1e-3);
    EXPECT_NEAR(slopeAt(b), 0.25, 1e-3);
}

TEST(PaperRow1, BeyondItsEndsTheTangentsGoOn) {
    const dvec2 a(0.4, 0.5), b(0.6, 0.5);
    const Piece p = piece(a, b, 1, 1);
    for (const double step : {0.1, 0.4}) {
        EXPECT_NEAR(implicitValue(p, inMargin(a - dvec2(step, step))).value, 0, 2e-3);
        EXPECT_NEAR(implicitValue(p, inMargin(b + dvec2(step, step))).value, 0, 2e-3);
    }
}

TEST(PaperRow1, GradientsAreThoseOfTheFunction) {
    const Piece p = piece({0.2, 0.1}, {0.7, 0.9}, 0.7, 0.2);
    constexpr double step = 1e-6;
    for (const dvec2 q : {dvec2(0.1, 0.1), dvec2(0.5, 0.5), dvec2(0.3, 0.7), dvec2(0.9, 0.95)}) {
        const Value f = implicitValue(p, q);
        EXPECT_NEAR(f.gradient.x, (implicitValue(p, q + dvec2(step, 0)).value - f.value) / step, 1e-4);
        EXPECT_NEAR(f.gradient.y, (implicitValue(p, q + dvec2(0, step)).value - f.value) / step, 1e-4);
    }
}

TEST(PaperRow1, ReversingExchangesTheSides) {
    const Piece p = piece({0.2, 0.1}, {0.7, 0.9}, 0.7, -0.2), r = reversed(p);
    for (const dvec2 q : {dvec2(0.1, 0.1), dvec2(0.5, 0.5), dvec2(0.3, 0.7), dvec2(0.9, 0.95)})
        EXPECT_NEAR(implicitValue(p, q).value, -implicitValue(r, q).value, 1e-12);
}

// ---- Row 2 --------------------------------------------------------------------------------------

TEST(PaperRow2, OneOperatorBitMakesIntersectionsAndUnions) {
    Cell corner{{piece({0, 0.5}, {1, 0.5}), piece({0.5, 1}, {0.5, 0})}, 2, Operator::Intersection};
    const auto inside = [&](dvec2 p) { return signedDistance(corner, inMargin(p), dmat2(1)) < 0; };
    const dvec2 both(0.75, 0.75), first(0.25, 0.75), second(0.75, 0.25), neither(0.25, 0.25);
    EXPECT_TRUE(inside(both));
    EXPECT_FALSE(inside(first) || inside(second) || inside(neither));
    corner.combine = Operator::Union;
    EXPECT_TRUE(inside(both) && inside(first) && inside(second));
    EXPECT_FALSE(inside(neither));
}

// ---- Row 4 --------------------------------------------------------------------------------------

TEST(PaperRow4, OnlyTheNeededSideIsEvaluated) {
    const Asset asset = assetOf({leftHalf(100)}, {{0, 1, paint(1), paint(2)}});
    for (const auto& [x, paints, red] :
         {std::tuple(20.0, 1u, 1.0f), std::tuple(80.0, 1u, 0.0f), std::tuple(50.0625, 2u, 0.25f)}) {
        const Sample s = sample(asset, {x, 50}, sharp);
        EXPECT_EQ(s.cost.paints, paints) << x;
        EXPECT_NEAR(s.color.r, red, 0.01) << x;
        EXPECT_NEAR(s.color.g, 1 - red, 0.01) << x;
    }
}

TEST(PaperRow4, OpacityIsAConstantMix) {
    const Asset asset = assetOf({}, {{noIndex, 0.25f, paint(1), paint(2)}});
    const glm::vec4 color = sample(asset, {1, 1}, sharp).color;
    EXPECT_FLOAT_EQ(color.r, 0.25f);
    EXPECT_FLOAT_EQ(color.g, 0.75f);
}

// ---- Row 5 --------------------------------------------------------------------------------------

TEST(PaperRow5, ThreeMapsChooseAmongFourPaints) {
    const Asset asset =
        assetOf({leftHalf(100), maskOf(above(0.5), 100), maskOf(above(0.25), 100)},
                {{1, 1, paint(1), paint(2)}, {2, 1, paint(3), paint(4)}, {0, 1, rest(0), rest(1)}});
    const auto at = [&](double x, double y) { return sample(asset, {x, y}, sharp).color; };
    EXPECT_EQ(at(20, 80), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(at(20, 20), glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(at(80, 80), glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(at(80, 10), glm::vec4(0.5));
    EXPECT_EQ(sample(asset, {20, 80}, sharp).cost.nodes, 2u) << "the other side is not walked";
}

TEST(PaperRow5, WhatBothSidesShareIsWalkedOnce) {
    // 40 layers whose edge runs through the pixel: a tree would have 2^40 leaves.
    std::vector<Node> nodes{{noIndex, 1, paint(1), {}}};
    for (std::uint32_t i = 0; i < 40; ++i)
        nodes.push_back({0, 1, {4, i, false}, rest(i)});
    const Sample s = sample(assetOf({leftHalf(100)}, nodes), {50, 50}, sharp);
    EXPECT_EQ(s.cost.nodes, 41u);
    // Each lets 3/4 through and adds a quarter of white.
    EXPECT_NEAR(s.color.r, 1, 1e-5);
    EXPECT_NEAR(s.color.g, 1 - std::pow(0.75, 40), 1e-3);
    EXPECT_NEAR(s.color.a, 1, 1e-5);
}

// ---- Row 6 --------------------------------------------------------------------------------------

TEST(PaperRow6, CoverageIsHalfMinusTheDistanceInPixels) {
    Mask mask = maskOf({{piece({0.2, 0.1}, {0.8, 0.9}), {}}, 1, {}}, 100);
    mask.mip = uniformMip(0, 128);  // out of the way
    const dvec2 a(20, 10), along = glm::normalize(dvec2(60, 80)), across(-along.y, along.x);
    const double turn = 0.7;
    const dmat2 views[] = {dmat2(1), dmat2(3, 0, 0, 3),
                           dmat2(std::cos(turn), std::sin(turn), -std::sin(turn), std::cos(turn)) * 2.0,
                           dmat2(2, 0, 1, 3), dmat2(-1.5, 0, 0.25, 2)};
    for (const dmat2& view : views)
        for (const double away : {-0.3, -0.1, 0.0, 0.2}) {
            // The normal as it stands on the line in the picture of pixels.
            const dvec2 lineOnScreen = glm::normalize(view * along);
            const dvec2 step = view * across * away;
            const double pixels = std::abs(step.x * lineOnScreen.y - step.y * lineOnScreen.x);
            EXPECT_NEAR(coverage(mask, a + 40.0 * along + across * away, Footprint(view)),
                        std::clamp(0.5 + std::copysign(pixels, away), 0.0, 1.0), 5e-3);
        }
}

// ---- Row 7 --------------------------------------------------------------------------------------

TEST(PaperRow7, TheMipTakesOverWithinOneLevel) {
    // The mip says 3/4 everywhere; its level 1 has 64 texels on the square.
    Mask mask = leftHalf(64);
    mask.mip = uniformMip(6, 191);
    const auto at = [&](double pixel) { return coverage(mask, {16, 32}, Footprint(dmat2(1 / pixel))); };
    EXPECT_EQ(at(0.5), 1) << "analytic alone";
    EXPECT_NEAR(at(std::sqrt(0.5)), (1 + 191.0 / 255) / 2, 1e-9) << "half and half";
    EXPECT_NEAR(at(1), 191.0 / 255, 1e-9) << "the mip alone";
    EXPECT_NEAR(at(5), 191.0 / 255, 1e-9);
}

TEST(PaperRow7, TheLongerAxisDecides) {
    Mask mask = leftHalf(64);
    mask.mip = uniformMip(6, 0);
    EXPECT_EQ(coverage(mask, {16, 32}, Footprint(dmat2(4, 0, 0, 4))), 1);
    EXPECT_EQ(coverage(mask, {16, 32}, Footprint(dmat2(4, 0, 0, 0.25))), 0);
}

TEST(PaperRow7, PixelsLargerThanTheMaskShareItsArea) {
    // The mean over all places of a mask below a pixel: its area in pixels.
    Mask mask = leftHalf(10);
    for (const double pixel : {10.0, 16.0, 40.0}) {
        double sum = 0;
        constexpr int places = 40;
        for (int y = -2 * places; y < 2 * places; ++y)
            for (int x = -2 * places; x < 2 * places; ++x)
                sum += coverage(mask, dvec2(5) + pixel * dvec2(x + 0.5, y + 0.5) / double(places),
                                Footprint(dmat2(1 / pixel)));
        EXPECT_NEAR(sum / (places * places), 128.0 / 255 * 100 / (pixel * pixel), 1e-3) << pixel;
    }
}

// ---- Rows 8, 9, 10 ------------------------------------------------------------------------------

/// Two levels: child 6 (column 2, row 1) of the root is a node, whose child 9 (column 1, row 2) is
/// a cell; all else is empty.
Mask deepMask() {
    Mask mask = maskOf(above(0.5), 160);
    mask.nodes.resize(2);
    mask.root = asset::Entry::make(asset::Entry::Kind::Node, 0);
    mask.nodes[0].children[6] = asset::Entry::make(asset::Entry::Kind::Node, 1);
    mask.nodes[1].children[9] = asset::Entry::make(asset::Entry::Kind::Leaf, 0);
    return mask;
}

TEST(PaperRow8, TheTreeHasFourByFourChildren) {
    const Mask mask = deepMask();
    // The cell spans [90, 100] x [60, 70].
    EXPECT_TRUE(classify(mask, {95, 66}));
    EXPECT_FALSE(classify(mask, {95, 64}));
    EXPECT_FALSE(classify(mask, {89, 66}));
    EXPECT_FALSE(classify(mask, {101, 66}));
    EXPECT_FALSE(classify(mask, {95, 71}));
}

TEST(PaperRow9, CellsWithoutBoundaryAreLeftEarly) {
    const Mask mask = deepMask();
    Cost cost;
    maskCoverage(mask, {30, 30}, Footprint(dmat2(4)), cost);
    EXPECT_EQ(cost.indirections, 1u);
    EXPECT_EQ(cost.cells, 0u);
    cost = {};
    maskCoverage(mask, {-50, 30}, Footprint(dmat2(4)), cost);
    EXPECT_EQ(cost.indirections, 0u) << "outside of the square";
}

TEST(PaperRow10, ALookupTouchesALevelACellAndTheMip) {
    const Mask mask = deepMask();
    Cost cost;
    maskCoverage(mask, {95, 65}, Footprint(dmat2(4)), cost);
    EXPECT_EQ(cost.indirections, 2u);
    EXPECT_EQ(cost.cells, 1u);
    EXPECT_EQ(cost.mips, 0u) << "magnified: row 6 needs no texture";
    cost = {};
    maskCoverage(mask, {95, 65}, Footprint(dmat2(0.6)), cost);
    EXPECT_EQ(cost.cells, 1u);
    EXPECT_EQ(cost.mips, 1u) << "between the analytic level and the first stored one";
}

// ---- Row 14 -------------------------------------------------------------------------------------

TEST(PaperRow14, TheOutsideIsTransparentOrNotWritten) {
    const Side discard{0, noIndex, true};
    const Asset clear = assetOf({leftHalf(100)}, {{0, 1, paint(1), {}}});
    const Asset dropped = assetOf({leftHalf(100)}, {{0, 1, paint(1), discard}});
    EXPECT_EQ(sample(clear, {80, 50}, sharp).color, glm::vec4(0));
    EXPECT_FALSE(sample(clear, {80, 50}, sharp).discarded);
    EXPECT_TRUE(sample(dropped, {80, 50}, sharp).discarded);
    const Sample edge = sample(dropped, {50, 50}, sharp);
    EXPECT_FALSE(edge.discarded);
    EXPECT_NEAR(edge.color.a, 0.5, 1e-3);
}

// ---- What is refused ----------------------------------------------------------------------------

void refuses(const Asset& asset, const std::string& what) {
    try {
        validate(asset);
        ADD_FAILURE() << "accepted: " << what;
    } catch (const asset::FormatError& error) {
        EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
}

TEST(Asset, BadIndicesAreNamed) {
    const Asset good = assetOf({deepMask()}, {{0, 1, paint(1), {}}, {0, 1, paint(2), rest(0)}});
    Asset bad = good;
    bad.nodes[1].outside.rest = 1;
    refuses(bad, "node 1: its rest is not an earlier node");
    bad = good;
    bad.root = 2;
    refuses(bad, "no such root");
    bad = good;
    bad.nodes[0].mask = 1;
    refuses(bad, "node 0: no such mask");
    bad = good;
    bad.nodes[0].inside.paint = 5;
    refuses(bad, "node 0: no such paint");
    bad = good;
    bad.masks[0].nodes[1].children[3] = asset::Entry::make(asset::Entry::Kind::Node, 1);
    refuses(bad, "mask 0, node 1: no such node below");
    bad = good;
    bad.masks[0].cells[0].count = 3;
    refuses(bad, "mask 0, cell 0: must have one or two pieces");
    bad = good;
    bad.masks[0].mip.texels.pop_back();
    refuses(bad, "mask 0: the mip has the wrong size");
}

TEST(Asset, TooManyWaitingNodesAreRefused) {
    // A comb: each node of the upper row leaves one of the lower row waiting.
    Asset asset;
    asset.palette.paints = {{}};
    const std::uint32_t leaves = maxPending + 2;
    for (std::uint32_t i = 0; i < leaves; ++i)
        asset.nodes.push_back({noIndex, 0.5f, {}, {}});
    for (std::uint32_t i = 0; i < leaves; ++i)
        asset.nodes.push_back({noIndex, 0.5f, rest(i), rest(leaves + i - 1)});
    asset.root = 2 * leaves - 1;
    refuses(asset, "more than 16 nodes are pending");
}

}  // namespace
}  // namespace vtm::paper
