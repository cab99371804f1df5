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

/// A pixel's numbers in bytes, alpha last, of a premultiplied source over a pixel.
std::array<double, 4> mixedExactly(const ColorSpace& space, const Color& source, const std::uint8_t* pixel,
                                   double share) {
    const double below = pixel[3] / 255.0, kept = 1 - double(source.a),
                 above = double(source.a) + kept * below, alpha = below + share * (above - below);
    std::array<double, 4> result{0, 0, 0, 255 * alpha};
    if (alpha == 0)
        return result;
    for (int c = 0; c < 3; ++c) {
        const double byte = pixel[c] / 255.0, before = space.premultiplied ? byte : byte * below,
                     after = double(source[c]) + kept * before;
        double value = before + share * (after - before);
        if (!space.linear) {
            const auto light = [](double v, double a) { return a > 0 ? a * decodedExactly(v / a) : 0; };
            const double a = light(before, below), b = light(after, above);
            value = alpha * encodedExactly((a + share * (b - a)) / alpha);
        }
        result[std::size_t(c)] = 255 * (space.premultiplied ? value : value / alpha);
    }
    return result;
}

constexpr int width = 64, height = 16;  ///< every byte has a pixel

enum class Ground { grey, colors, translucent };

/// In each channel every byte; opaque, or of many alphas, some of them 0.
std::vector<std::uint8_t> groundOf(Ground kind, bool isPremultiplied = false) {
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < width * height; ++i) {
        const int alpha = kind == Ground::translucent ? i * 13 % 256 : 255;
        for (const int factor : {1, 3, 7}) {
            const int byte = i * (kind == Ground::grey ? 1 : factor) % 256;
            pixels.push_back(std::uint8_t(isPremultiplied ? byte * alpha / 255 : byte));
        }
        pixels.push_back(std::uint8_t(alpha));
    }
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
                 const ColorSpace& space, const Color& ink, unsigned share) {
    double worst = 0;
    for (std::size_t i = 0; i < before.size(); i += 4) {
        const std::array<double, 4> exact = mixedExactly(space, ink, before.data() + i, share / 65536.0);
        for (std::size_t c = 0; c < 4; ++c)
            worst = std::max(worst, std::abs(after[i + c] - exact[c]));
        for (std::size_t c = 0; space.premultiplied && c < 3; ++c)
            EXPECT_LE(after[i + c], after[i + 3]);
    }
    EXPECT_LT(worst, 0.9) << "ink " << ink.r << " " << ink.g << " " << ink.b << " " << ink.a
                          << (space.linear ? ", linear" : "")
                          << (space.premultiplied ? ", premultiplied" : "") << ", share " << share;
}

TEST(Edges, OneByOne) {
    for (const ColorSpace space : {ColorSpace{false, true}, ColorSpace{true, true}})
        for (const Ground kind : {Ground::grey, Ground::colors})
            for (const Color& ink : inks)
                for (const unsigned share : shares) {
                    const std::vector<std::uint8_t> before = groundOf(kind);
                    std::vector<std::uint8_t> after = before;
                    const auto mix = [&](const auto& mixer) {
                        for (std::size_t i = 0; i < after.size(); i += 4)
                            mixer(after.data() + i, share);
                    };
                    if (space.linear)
                        mix(LinearMixer(ink));
                    else if (ink.a == 1)
                        mix(OpaqueMixer(ink));
                    else
                        mix(TranslucentMixer(ink));
                    expectMixed(before, after, space, ink, share);
                }
}

TEST(Edges, EightAtATime) {
    if (!wide::mixEdges(nullptr, 0, {}, EdgeColor()))
        GTEST_SKIP() << "no AVX2";
    for (const bool isLinear : {false, true})
        for (const bool isPremultiplied : {false, true})
            for (const Ground kind : {Ground::grey, Ground::colors, Ground::translucent})
                for (const Color& ink : inks)
                    for (const unsigned share : shares) {
                        const ColorSpace space{isLinear, isPremultiplied};
                        const std::vector<std::uint8_t> before = groundOf(kind, isPremultiplied);
                        std::vector<std::uint8_t> after = before;
                        wide::mixEdges(after.data(), 4 * width, edges(share), EdgeColor(ink, space, true));
                        expectMixed(before, after, space, ink, share);
                    }
}

// What is not a whole eight at the end, and a fourth byte that is no alpha.
TEST(Edges, SomePixels) {
    if (!wide::mixEdges(nullptr, 0, {}, EdgeColor()))
        GTEST_SKIP() << "no AVX2";
    const EdgeColor color(inks[2], {false, true}, true), withoutAlpha(inks[2], {}, false);
    const std::vector<EdgePixel> all = edges(30000);
    std::vector<std::uint8_t> whole = groundOf(Ground::colors);
    wide::mixEdges(whole.data(), 4 * width, all, color);
    for (std::size_t count = 0; count < 20; ++count) {
        const std::vector<std::uint8_t> before = groundOf(Ground::colors);
        std::vector<std::uint8_t> some = before;
        wide::mixEdges(some.data(), 4 * width, std::span(all).first(count), color);
        EXPECT_EQ(std::memcmp(some.data(), whole.data(), 4 * count), 0);
        EXPECT_EQ(std::memcmp(some.data() + 4 * count, before.data() + 4 * count, before.size() - 4 * count),
                  0);
    }
    std::vector<std::uint8_t> pixels = groundOf(Ground::translucent);
    const std::vector<std::uint8_t> before = pixels;
    wide::mixEdges(pixels.data(), 4 * width, all, withoutAlpha);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        EXPECT_EQ(pixels[i], i % 4 == 3 ? before[i] : whole[i]);
}

}  // namespace
}  // namespace vtm::openvg::testing
