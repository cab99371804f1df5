// Edges of one colour by rows of eight and one by one, beside the formula in doubles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "api/openvg/draw/edge_mixer.hpp"

namespace vtm::openvg::testing {
namespace {

double decodedExactly(double v) { return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.0556) / 1.0556, 2.4); }
double encodedExactly(double v) { return v <= 0.00304 ? 12.92 * v : 1.0556 * std::pow(v, 1 / 2.4) - 0.0556; }

/// In bytes, of a premultiplied source over an opaque byte.
double mixedExactly(bool isLinear, double source, double alpha, int byte, double share) {
    const double before = byte / 255.0, after = source + (1 - alpha) * before;
    if (isLinear)
        return 255 * (before + share * (after - before));
    const double a = decodedExactly(before), b = decodedExactly(after);
    return 255 * encodedExactly(a + share * (b - a));
}

constexpr int width = 64, height = 16;  ///< every byte has a pixel

/// In each channel every byte; opaque.
std::vector<std::uint8_t> ground(bool isGrey) {
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < width * height; ++i)
        for (const int factor : {1, isGrey ? 1 : 3, isGrey ? 1 : 7, 0})
            pixels.push_back(std::uint8_t(factor == 0 ? 255 : i * factor));
    return pixels;
}

std::vector<EdgePixel> edges(unsigned share) {
    std::vector<EdgePixel> all;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            all.push_back({std::uint8_t(x), std::uint8_t(y), std::uint16_t(share)});
    return all;
}

constexpr std::array shares{1u, 20u, 1000u, 9000u, 32768u, 50000u, 64000u, 65000u, 65500u, 65535u};
constexpr std::array<Color, 7> inks{Color{0, 0, 0, 1},
                                    Color{1, 1, 1, 1},
                                    Color{0.9f, 0.1f, 0.4f, 1},
                                    Color{0.02f, 0.01f, 0.03f, 1},
                                    Color{0, 0, 0, 0.5f},
                                    Color{0.05f, 0.2f, 0.25f, 0.25f},
                                    Color{0.9f, 0.9f, 0.9f, 0.9f}};

void expectMixed(const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& after,
                 bool isLinear, const Color& ink, unsigned share, const char* what) {
    double worst = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const std::size_t c = i % 4;
        const double exact =
            c == 3 ? 255
                   : mixedExactly(isLinear, double(ink[int(c)]), double(ink.a), before[i], share / 65536.0);
        worst = std::max(worst, std::abs(after[i] - exact));
    }
    EXPECT_LT(worst, 0.9) << what << ", ink " << ink.r << " " << ink.g << " " << ink.b << " " << ink.a
                          << (isLinear ? ", linear" : "") << ", share " << share;
}

template <class Mix>
void expectAllMixed(const char* what, Mix&& mix) {
    for (const bool isLinear : {false, true})
        for (const bool isGrey : {false, true})
            for (const Color& ink : inks)
                for (const unsigned share : shares) {
                    const std::vector<std::uint8_t> before = ground(isGrey);
                    std::vector<std::uint8_t> after = before;
                    mix(after.data(), isLinear, ink, share);
                    expectMixed(before, after, isLinear, ink, share, what);
                }
}

TEST(Edges, OneByOne) {
    expectAllMixed("one by one", [](std::uint8_t* pixels, bool isLinear, const Color& ink, unsigned share) {
        const auto mix = [&](const auto& mixer) {
            for (int i = 0; i < width * height; ++i)
                mixer(pixels + 4 * i, share);
        };
        if (isLinear)
            mix(LinearMixer(ink));
        else if (ink.a == 1)
            mix(OpaqueMixer(ink));
        else
            mix(TranslucentMixer(ink));
    });
}

TEST(Edges, EightAtATime) {
    std::uint8_t pixel[4]{255, 255, 255, 255};
    const EdgePixel edge{0, 0, 1};
    if (wide::mixEdges(pixel, 4, {&edge, 1}, EdgeColor(inks[0], false, true)) == 0)
        GTEST_SKIP() << "no AVX2";
    expectAllMixed(
        "eight at a time", [](std::uint8_t* pixels, bool isLinear, const Color& ink, unsigned share) {
            const std::vector<EdgePixel> all = edges(share);
            EXPECT_EQ(wide::mixEdges(pixels, 4 * width, all, EdgeColor(ink, isLinear, true)), all.size());
        });
}

// What is not a whole eight at the end, and what is not opaque.
TEST(Edges, SomePixels) {
    const EdgeColor color(inks[2], false, true);
    std::vector<EdgePixel> all = edges(30000);
    std::vector<std::uint8_t> whole = ground(false);
    if (wide::mixEdges(whole.data(), 4 * width, all, color) == 0)
        GTEST_SKIP() << "no AVX2";
    for (std::size_t count = 0; count < 20; ++count) {
        const std::vector<std::uint8_t> before = ground(false);
        std::vector<std::uint8_t> some = before;
        EXPECT_EQ(wide::mixEdges(some.data(), 4 * width, std::span(all).first(count), color), count);
        EXPECT_EQ(std::memcmp(some.data(), whole.data(), 4 * count), 0);
        EXPECT_EQ(std::memcmp(some.data() + 4 * count, before.data() + 4 * count, before.size() - 4 * count),
                  0);
    }
    std::vector<std::uint8_t> pixels = ground(false);
    pixels[4 * 21 + 3] = 254;
    const std::vector<std::uint8_t> before = pixels;
    EXPECT_EQ(wide::mixEdges(pixels.data(), 4 * width, all, color), 16u);
    EXPECT_EQ(std::memcmp(pixels.data() + 4 * 16, before.data() + 4 * 16, before.size() - 4 * 16), 0);
    EXPECT_EQ(wide::mixEdges(pixels.data(), 4 * width, all, EdgeColor(inks[2], false, false)), all.size());
    EXPECT_EQ(pixels[4 * 21 + 3], 254);
}

}  // namespace
}  // namespace vtm::openvg::testing
