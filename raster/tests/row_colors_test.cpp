#include "raster/src/row_colors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "raster/src/scan_stores.hpp"

namespace vtm::asset::test {
namespace {

/// From one colour in [0, 1]⁴ to another, bent by what stays in there.
RowColors randomColors(std::mt19937& random, int count, int degree) {
    std::uniform_real_distribution<float> any(0, 1);
    const auto color = [&] { return Float4{any(random), any(random), any(random), any(random)}; };
    const Float4 first = color(), last = color();
    const float steps = float(std::max(count - 1, 1));
    RowColors colors{first, (last - first) / steps, Float4{}, degree};
    if (degree == 2) {  // c (1 - x) + d x, each of them a line from one to the other
        const Float4 other = color();
        colors.slope = 2 * (other - first) / steps;
        colors.bend = (first - 2 * other + last) / (steps * steps);
    }
    return colors;
}

TEST(RowColors, BytesAreTheNearestOfEachPixel) {
    std::mt19937 random(1);
    for (int i = 0; i < 4000; ++i) {
        const int count = 1 + int(random() % (i % 10 == 0 ? 3000 : 40)), degree = 1 + i % 2;
        const RowColors colors = randomColors(random, count, degree);
        constexpr std::uint8_t untouched = 77;
        std::vector<std::uint8_t> bytes(4 * std::size_t(count) + 8, untouched);
        const ByteStore store(ByteTarget{bytes.data(), bytes.size()}, count + 2);
        store(0, 1, count + 1, colors);
        for (int x = 0; x < count; ++x)
            for (int c = 0; c < 4; ++c) {
                const float exact = 255 * colors.at(float(x))[c];
                ASSERT_LE(std::abs(float(bytes[4 * std::size_t(x + 1) + std::size_t(c)]) - exact), 0.51f)
                    << "case " << i << ", pixel " << x << " of " << count << ", channel " << c;
            }
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(bytes[k], untouched);
            EXPECT_EQ(bytes[bytes.size() - 1 - k], untouched);
        }
    }
}

TEST(RowColors, WhatRoundingLeavesBeyondIsCut) {
    const RowColors colors{Float4{1.001f, -0.001f, 1, 0}, Float4{1e-4f, -1e-4f, 0, 0}, Float4{}, 1};
    std::uint8_t bytes[4 * 9];
    ByteStore(ByteTarget{bytes, sizeof bytes}, 9)(0, 0, 9, colors);
    for (std::size_t x = 0; x < 9; ++x)
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_EQ(bytes[4 * x + c], c % 2 == 0 ? 255 : 0);
}

}  // namespace
}  // namespace vtm::asset::test
