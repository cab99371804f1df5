#include "raster/src/row_paint.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "asset/testing.hpp"

namespace vtm::asset::test {
namespace {

using glm::dvec2;
using glm::vec2;
using glm::vec4;

class RandomRows {
public:
    explicit RandomRows(unsigned seed) : random_(seed) {}

    float number(float from, float to) { return std::uniform_real_distribution<float>(from, to)(random_); }
    int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
    unsigned below(unsigned count) { return std::uniform_int_distribution<unsigned>(0, count - 1)(random_); }

    std::vector<GradientStop> stops(bool areOpaque) {
        std::vector<float> offsets(2 + below(4));
        for (float& offset : offsets)
            offset = std::round(number(0, 1) * 8) / 8;  // some at one place
        std::ranges::sort(offsets);
        std::vector<GradientStop> stops;
        for (const float offset : offsets) {
            const auto channel = [&] { return std::uint16_t(below(65536)); };
            stops.push_back(
                {offset, {channel(), channel(), channel(), areOpaque ? std::uint16_t(65535) : channel()}, 0});
        }
        return stops;
    }
    /// Along 5 to 150 pixels.
    Gradient gradient(bool isRadial) {
        const float size = std::exp(number(1.5f, 5)), angle = number(0, 7), squeeze = number(0.3f, 1);
        Gradient gradient;
        gradient.matrix = {std::cos(angle) / size,  std::sin(angle) / size * squeeze,
                           -std::sin(angle) / size, std::cos(angle) / size * squeeze,
                           number(-0.5f, 0.5f),     number(-0.5f, 0.5f)};
        if (isRadial) {
            gradient.fx = number(-0.5f, 0.5f);
            gradient.fy = number(-0.5f, 0.5f);
            gradient.fr = number(0, 0.1f);
        }
        return gradient;
    }

private:
    std::mt19937 random_;
};

/// A program of gradients and solid colours.
struct RowCase {
    Asset asset;
    std::uint32_t paint;

    RowCase(RandomRows& random, unsigned gradients, Spread spread = Spread::Pad) {
        std::vector<Texel> data;
        std::vector<Instruction> program;
        const auto solid = [&] {
            const float alpha = random.number(0, 1);
            program.push_back({Op::Solid, Blend::Normal, random.number(0.5f, 1), std::uint32_t(data.size())});
            data.push_back(
                std::bit_cast<Texel>(alpha * vec4(random.number(0, 1), random.number(0, 1), 0.5f, 1)));
        };
        if (random.below(2) == 0)
            solid();
        for (unsigned i = 0; i < gradients; ++i) {
            const bool isRadial = random.below(2) == 0;
            const std::vector<GradientStop> stops = random.stops(i == 0 && random.below(2) == 0);
            Gradient gradient = random.gradient(isRadial);
            gradient.spread = spread;
            gradient.stopCount = std::uint32_t(stops.size());
            program.push_back({isRadial ? Op::Radial : Op::Linear, Blend::Normal, random.number(0.5f, 1),
                               std::uint32_t(data.size())});
            addGradient(data, gradient, stops);
            if (random.below(3) == 0)
                solid();
        }
        asset = programAsset(program, data);
        paint = asset.maps[0].root.payload();
    }
};

/// Mean of the colours at 32 × 32 points.
vec4 meanAt(const Paints& paints, std::uint32_t paint, vec2 middle) {
    constexpr int side = 32;
    glm::dvec4 sum(0);
    for (int i = 0; i < side * side; ++i)
        sum += paints.color(paint, {middle + (vec2(i % side, i / side) + 0.5f) / float(side) - 0.5f});
    return sum / double(side * side);
}

float difference(const vec4& a, const Float4& b) { return largest(float4(a) - b); }

/// The view: pixels whose middles are whole numbers of the picture, about its origin.
const PixelMiddles wholePixels{dvec2(-150, -60), dvec2(1, 0), dvec2(0, 1), 301, 121};
vec2 middleOf(RowPaint::Pixel pixel) { return vec2(wholePixels.first) + vec2(pixel.x, pixel.row); }

/// Compares colours with means; returns the share of pixels that have one.
double knownShare(unsigned seed, Spread spread) {
    RandomRows random(seed);
    constexpr int cases = 600, perCase = 8;
    int known = 0;
    for (int i = 0; i < cases; ++i) {
        const RowCase one(random, 1, spread);
        const Paints paints(one.asset);
        RowPaint rows;
        rows.prepare(paints, one.paint, wholePixels);
        for (int k = 0; k < perCase; ++k) {
            const RowPaint::Pixel pixel{random.whole(110, 190), random.whole(20, 100)};
            Float4 color;
            if (!rows.at(pixel, color))
                continue;
            ++known;
            EXPECT_LE(difference(meanAt(paints, one.paint, middleOf(pixel)), color), 0.2f / 255)
                << "case " << i << ", pixel " << pixel.x << ", " << pixel.row;
        }
    }
    return double(known) / (cases * perCase);
}

TEST(RowPaint, ColoursAreTheMeansOverPixels) { EXPECT_GT(knownShare(1, Spread::Pad), 0.9); }
TEST(RowPaint, RepeatedRampsAreKnownBesideTheirJumps) { EXPECT_GT(knownShare(2, Spread::Repeat), 0.35); }
TEST(RowPaint, ReflectedRampsAreKnown) { EXPECT_GT(knownShare(3, Spread::Reflect), 0.35); }

/// Visits pixels of a row and compares each with what it is alone. Returns how many are left to others.
int expectRow(RowPaint& rows, int row, int first, int end) {
    int next = first, left = 0;
    const auto expectPixel = [&](int x, Float4 color, float tolerance) {
        EXPECT_EQ(x, next++);
        Float4 alone;
        ASSERT_TRUE(rows.at({x, row}, alone)) << x << ", " << row;
        EXPECT_LE(largest(color - alone), tolerance) << x << ", " << row;
    };
    constexpr float rounding = 2e-5f, sampled = 1.0f / 8192 + rounding;
    rows.visit(
        row, first, end,
        [&](int from, int to, const RowColors& colors) {
            for (int x = from; x < to; ++x)
                expectPixel(x, colors.at(float(x - from)), colors.degree == 2 ? sampled : rounding);
        },
        [&](int from, std::span<const Float4> colors) {
            EXPECT_LE(colors.size(), longestRow);
            for (const Float4& color : colors)
                expectPixel(from++, color, rounding);
        },
        [&](int from, int to) {
            EXPECT_EQ(from, next);
            left += to - from;
            next = to;
        });
    EXPECT_EQ(next, end);
    return left;
}

TEST(RowPaint, RowsHaveTheColoursOfTheirPixels) {
    RandomRows random(2);
    int visited = 0, left = 0;
    for (int i = 0; i < 3000; ++i) {
        const Spread spread = std::array{Spread::Pad, Spread::Repeat, Spread::Reflect}[std::size_t(i % 3)];
        const RowCase one(random, 1 + random.below(i % 10 == 0 ? 8 : 3), spread);
        const Paints paints(one.asset);
        RowPaint rows;
        rows.prepare(paints, one.paint, wholePixels);
        if (!rows.isReady())
            continue;
        const int first = random.whole(0, 50), end = 300;
        const int leftOfRow = expectRow(rows, random.whole(0, 120), first, end);
        if (spread == Spread::Pad) {
            EXPECT_LT(leftOfRow, end - first);
        }
        visited += end - first;
        left += leftOfRow;
    }
    EXPECT_LT(left, visited / 4);
}

TEST(RowPaint, FourPixelsAreWhatEachIsAlone) {
    RandomRows random(4);
    int known = 0, other = 0;
    for (int i = 0; i < 2000; ++i) {
        const RowCase one(random, 1 + random.below(4), std::array{Spread::Pad, Spread::Reflect}[i % 2]);
        const Paints paints(one.asset);
        RowPaint rows;
        rows.prepare(paints, one.paint, wholePixels);
        RowGradient::Pixels pixels;
        for (RowPaint::Pixel& pixel : pixels)
            pixel = {random.whole(0, 300), random.whole(0, 120)};
        RowGradient::Colors colors;
        const unsigned bits = rows.at(pixels, colors);
        for (unsigned k = 0; k < 4; ++k) {
            Float4 alone;
            const bool isKnown = rows.at(pixels[k], alone);
            other += int(isKnown != ((bits >> k & 1) != 0));  // where rounding takes it beyond a segment
            if (!isKnown || (bits >> k & 1) == 0)
                continue;
            ++known;
            EXPECT_LE(largest(colors[k] - alone), 1e-4f) << i << ": " << pixels[k].x << ", " << pixels[k].row;
        }
    }
    EXPECT_GT(known, 4000);
    EXPECT_LE(other, 8);
}

/// Whether anything is known of a gradient over the pixels of a row.
bool knowsAny(Gradient gradient, const std::vector<GradientStop>& stops, const PixelMiddles& pixels) {
    gradient.stopCount = std::uint32_t(stops.size());
    std::vector<Texel> data;
    addGradient(data, gradient, stops);
    const Asset asset = programAsset({{Op::Linear, Blend::Normal, 1, 0}}, data);
    const Paints paints(asset);
    RowPaint rows;
    rows.prepare(paints, asset.maps[0].root.payload(), pixels);
    Float4 color;
    bool any = false;
    for (int x = 0; x < pixels.width; ++x)
        any |= rows.at({x, 0}, color);
    return any;
}

TEST(RowPaint, JumpsAndManyStopsInAPixelAreLeft) {
    const std::array<std::uint16_t, 4> red{65535, 0, 0, 65535}, green{0, 65535, 0, 65535};
    Gradient gradient;
    gradient.matrix = {0.01f, 0, 0, 0.01f, 0.45f, 0};
    const PixelMiddles aboutMiddle{dvec2(0), dvec2(1, 0), dvec2(0, 1), 10, 1};
    EXPECT_TRUE(knowsAny(gradient, {{0, red, 0}, {1, green, 0}}, aboutMiddle));
    std::vector<GradientStop> comb;
    for (int i = 0; i <= 50; ++i)
        comb.push_back({0.4f + 0.004f * float(i), i % 2 == 0 ? red : green, 0});
    EXPECT_FALSE(knowsAny(gradient, comb, aboutMiddle));
    const PixelMiddles onJump{dvec2(5, 0), dvec2(0.02, 0), dvec2(1, 0), 10, 1};
    EXPECT_FALSE(knowsAny(gradient, {{0, red, 0}, {0.5f, red, 0}, {0.5f, green, 0}}, onJump));
}

TEST(RowPaint, PeriodsOfFewPixelsOrInGreatNumberAreLeft) {
    const std::array<std::uint16_t, 4> red{65535, 0, 0, 65535}, green{0, 65535, 0, 65535};
    Gradient gradient;
    gradient.spread = Spread::Reflect;
    const auto knows = [&](float period, int width) {
        gradient.matrix = {1 / period, 0, 0, 1 / period, 0, 0};
        return knowsAny(gradient, {{0, red, 0}, {1, green, 0}},
                        {dvec2(0), dvec2(1, 0), dvec2(0, 1), width, 10});
    };
    EXPECT_TRUE(knows(20, 100));
    EXPECT_FALSE(knows(12, 100));
    EXPECT_FALSE(knows(20, 20000));
}

TEST(RowPaint, PixelsBeyondSinglePrecisionEnd) {
    const std::array<std::uint16_t, 4> red{65535, 0, 0, 65535}, green{0, 65535, 0, 65535};
    for (const double far : {1e300, -1e300}) {
        const PixelMiddles pixels{dvec2(far, 0), dvec2(1, 0), dvec2(0, 1), 10, 1};
        EXPECT_TRUE(knowsAny({}, {{0, red, 0}, {1, green, 0}}, pixels));
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(knowsAny({}, {{0, red, 0}, {1, green, 0}}, {dvec2(0), dvec2(nan, 0), dvec2(0, 1), 10, 1}));
}

}  // namespace
}  // namespace vtm::asset::test
