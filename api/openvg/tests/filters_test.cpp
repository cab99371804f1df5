// Section 12: filters against a straightforward evaluation in double precision.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

using Color = std::array<double, 4>;
/// Colours of a source at any place, with edges extended.
using Source = std::function<Color(int x, int y)>;

constexpr int width = 7, height = 5;
constexpr std::array tilings{VG_TILE_FILL, VG_TILE_PAD, VG_TILE_REPEAT, VG_TILE_REFLECT};

double decoded(double x) { return x <= 0.03928 ? x / 12.92 : std::pow((x + 0.0556) / 1.0556, 2.4); }
double encoded(double x) { return x <= 0.00304 ? 12.92 * x : 1.0556 * std::pow(x, 1 / 2.4) - 0.0556; }

class FiltersTest : public VgTest {
protected:
    FiltersTest() {
        std::mt19937 random(7);
        words.resize(width * height);
        for (std::uint32_t& word : words)
            word = std::uint32_t(random());
        src = newImage(VG_sRGBA_8888, width, height);
        vgImageSubData(src, words.data(), 4 * width, VG_sRGBA_8888, 0, 0, width, height);
        dst = newImage(VG_sRGBA_8888, width, height);
        vgSetfv(VG_TILE_FILL_COLOR, 4, fill.data());
    }

    void useFormat(bool isLinear, bool isPremultiplied) {
        linear = isLinear;
        premultiplied = isPremultiplied;
        vgSeti(VG_FILTER_FORMAT_LINEAR, isLinear);
        vgSeti(VG_FILTER_FORMAT_PREMULTIPLIED, isPremultiplied);
    }
    /// Section 12.1.
    Color normalized(Color c) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (linear)
                c[i] = decoded(c[i]);
            if (premultiplied)
                c[i] *= c[3];
        }
        return c;
    }
    Source source(VGTilingMode mode) const {
        return [this, mode](int x, int y) {
            const auto along = [&](int i, int size) {
                if (mode == VG_TILE_PAD)
                    return std::clamp(i, 0, size - 1);
                const int period = mode == VG_TILE_REFLECT ? 2 * size : size;
                const int j = ((i % period) + period) % period;
                return j < size ? j : 2 * size - 1 - j;
            };
            if (mode == VG_TILE_FILL && (x < 0 || y < 0 || x >= width || y >= height))
                return normalized({double(fill[0]), double(fill[1]), double(fill[2]), double(fill[3])});
            const Rgba c = rgbaOf(words[std::size_t(along(y, height) * width + along(x, width))]);
            return normalized({c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, c[3] / 255.0});
        };
    }
    /// As VG_sRGBA_8888.
    Rgba stored(Color c, bool isLinear, bool isPremultiplied) const {
        for (double& v : c)
            v = std::clamp(v, 0.0, 1.0);
        for (std::size_t i = 0; i < 3; ++i) {
            if (isPremultiplied)
                c[i] = c[3] > 0 ? std::min(c[i], c[3]) / c[3] : 0;
            if (isLinear)
                c[i] = encoded(c[i]);
        }
        Rgba bytes;
        for (std::size_t i = 0; i < 4; ++i)
            bytes[i] = int(std::floor(c[i] * 255 + 0.5));
        return bytes;
    }
    /// One step of 255 for halves that fall either way; what is divided by a small alpha is as much coarser.
    void expectFiltered(const std::function<Color(int x, int y)>& filtered) const {
        ASSERT_EQ(vgGetError(), VG_NO_ERROR);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                EXPECT_TRUE(isNear(texel(dst, x, y), stored(filtered(x, y), linear, premultiplied), 1))
                    << x << ' ' << y;
    }

    VGImage src, dst;
    std::vector<std::uint32_t> words;
    std::array<VGfloat, 4> fill{0.25f, 0.5f, 0.75f, 0.5f};
    bool linear = false, premultiplied = false;
};

TEST_F(FiltersTest, ColorMatrix) {
    const std::array<VGfloat, 20> m{0.5f, 0.1f, 0,    0, 0.25f, 0.7f, -0.5f, 0.1f, 0.125f, 0,
                                    1,    0,    0.1f, 0, 0,     0.8f, 0.05f, 0.1f, 0.2f,   0.1f};
    for (const bool isLinear : {false, true})
        for (const bool isPremultiplied : {false, true}) {
            useFormat(isLinear, isPremultiplied);
            vgColorMatrix(dst, src, m.data());
            expectFiltered([&](int x, int y) {
                const Color p = source(VG_TILE_PAD)(x, y);
                Color sum{};
                for (std::size_t row = 0; row < 4; ++row) {
                    sum[row] = double(m[16 + row]);
                    for (std::size_t column = 0; column < 4; ++column)
                        sum[row] += double(m[4 * column + row]) * p[column];
                }
                return sum;
            });
        }
}

Color convolved(const Source& p, int x, int y, int w, int h, int shiftX, int shiftY, double scale,
                double bias, const std::function<double(int i, int j)>& k) {
    Color sum{};
    for (int i = 0; i < w; ++i)
        for (int j = 0; j < h; ++j)
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += k(w - i - 1, h - j - 1) * p(x + i - shiftX, y + j - shiftY)[c];
    for (double& v : sum)
        v = scale * v + bias;
    return sum;
}

TEST_F(FiltersTest, Convolve) {
    const std::array<VGshort, 12> kernel{1, -2, 3, 4, 5, -1, 0, 2, 7, 1, 1, 3};
    for (const VGTilingMode mode : tilings)
        for (const bool isPremultiplied : {false, true}) {
            useFormat(isPremultiplied, isPremultiplied);
            vgConvolve(dst, src, 3, 4, 1, -2, kernel.data(), 0.04f, 0.02f, mode);
            expectFiltered([&](int x, int y) {
                return convolved(source(mode), x, y, 3, 4, 1, -2, double(0.04f), double(0.02f),
                                 [&](int i, int j) { return double(kernel[std::size_t(i * 4 + j)]); });
            });
        }
}

TEST_F(FiltersTest, SeparableConvolve) {
    const std::array<VGshort, 9> x{1, 2, -1, 0, 3, 1, 1, 0, 2};
    const std::array<VGshort, 4> y{1, 3, -1, 2};
    for (const VGTilingMode mode : tilings) {
        useFormat(mode == VG_TILE_PAD, mode == VG_TILE_REPEAT);
        vgSeparableConvolve(dst, src, 9, 4, 4, 13, x.data(), y.data(), 0.02f, 0.1f, mode);
        expectFiltered([&](int px, int py) {
            return convolved(
                source(mode), px, py, 9, 4, 4, 13, double(0.02f), double(0.1f),
                [&](int i, int j) { return double(x[std::size_t(i)]) * double(y[std::size_t(j)]); });
        });
    }
}

TEST_F(FiltersTest, GaussianBlur) {
    // The sum over all pixels that carry weight; the kernel has the sum 1.
    constexpr double sx = 1.5, sy = 0.75;
    constexpr int reach = 12;
    const auto g = [](int i, double s) { return std::exp(-i * i / (2 * s * s)); };
    double total = 0;
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
            total += g(i, sx) * g(j, sy);
    for (const VGTilingMode mode : tilings) {
        useFormat(true, mode != VG_TILE_PAD);
        vgGaussianBlur(dst, src, VGfloat(sx), VGfloat(sy), mode);
        expectFiltered([&](int x, int y) {
            return convolved(source(mode), x, y, 2 * reach + 1, 2 * reach + 1, reach, reach, 1 / total, 0,
                             [&](int i, int j) { return g(i - reach, sx) * g(j - reach, sy); });
        });
    }
}

TEST_F(FiltersTest, KernelsAreNoLongerThanTheirLimit) {
    const VGint size = vgGeti(VG_MAX_SEPARABLE_KERNEL_SIZE);
    const std::vector<VGshort> ones(std::size_t(size), 1);
    const VGfloat scale = 1.0f / VGfloat(size * size);
    vgSeparableConvolve(dst, src, size, size, 1 << 30, -(1 << 30), ones.data(), ones.data(), scale, 0,
                        VG_TILE_FILL);
    EXPECT_TRUE(isNear(texel(dst, 0, 0), {64, 128, 191, 128}, 1)) << "nothing but the fill colour";
    vgGaussianBlur(dst, src, vgGetf(VG_MAX_GAUSSIAN_STD_DEVIATION), 1e-30f, VG_TILE_REPEAT);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(FiltersTest, Lookups) {
    std::array<std::array<VGubyte, 256>, 4> tables;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < 256; ++i)
            tables[c][i] = VGubyte(255 - i * (c + 1) / 5);
    vgLookup(dst, src, tables[0].data(), tables[1].data(), tables[2].data(), tables[3].data(), VG_FALSE,
             VG_FALSE);
    for (int x = 0; x < width; ++x) {
        const Rgba in = rgbaOf(words[std::size_t(x)]);
        Rgba out;
        for (std::size_t c = 0; c < 4; ++c)
            out[c] = tables[c][std::size_t(in[c])];
        EXPECT_EQ(texel(dst, x, 0), out);
    }
    std::array<VGuint, 256> entries;
    for (std::size_t i = 0; i < 256; ++i)
        entries[i] = VGuint(i * 0x01020304u) | 0xff;
    const std::array<std::pair<VGImageChannel, std::size_t>, 4> channels{
        {{VG_RED, 0}, {VG_GREEN, 1}, {VG_BLUE, 2}, {VG_ALPHA, 3}}};
    for (const auto& [channel, c] : channels) {
        vgLookupSingle(dst, src, entries.data(), channel, VG_FALSE, VG_FALSE);
        for (int x = 0; x < width; ++x)
            EXPECT_EQ(texel(dst, x, 0), rgbaOf(entries[std::size_t(rgbaOf(words[std::size_t(x)])[c])]));
    }
    // Outputs may be linear and premultiplied: 0x40 of alpha 0x80.
    entries.fill(0x40404080);
    vgLookupSingle(dst, src, entries.data(), VG_RED, VG_TRUE, VG_TRUE);
    const int v = int(std::floor(255 * encoded(64.0 / 128) + 0.5));
    EXPECT_TRUE(isNear(texel(dst, 0, 0), {v, v, v, 128}, 1));
    // Sources of one channel: that one counts.
    const VGImage alpha = newImage(VG_A_8, 1, 1);
    const std::uint8_t byte = 9;
    vgImageSubData(alpha, &byte, 1, VG_A_8, 0, 0, 1, 1);
    for (std::size_t i = 0; i < 256; ++i)
        entries[i] = VGuint(i << 24) | 0xff;
    vgLookupSingle(dst, alpha, entries.data(), VG_RED, VG_FALSE, VG_FALSE);
    EXPECT_EQ(texel(dst, 0, 0), (Rgba{9, 0, 0, 255}));
}

TEST_F(FiltersTest, ChannelMasksAndAreas) {
    // Section 12.2, and section 12: only the common area is written.
    const std::array<VGfloat, 20> constant{0, 0, 0, 0, 0, 0, 0,    0,    0,    0,
                                           0, 0, 0, 0, 0, 0, 0.2f, 0.4f, 0.6f, 0.8f};
    const VGImage small = newImage({{1, 2, 3, 4}, {5, 6, 7, 8}});
    vgSeti(VG_FILTER_CHANNEL_MASK, VG_RED | VG_ALPHA | 1 << 10);
    vgColorMatrix(small, src, constant.data());
    EXPECT_EQ(texel(small, 0, 0), (Rgba{51, 2, 3, 204}));
    EXPECT_EQ(texel(small, 1, 0), (Rgba{51, 6, 7, 204}));
    vgSeti(VG_FILTER_CHANNEL_MASK, 0);
    vgColorMatrix(small, src, constant.data());
    EXPECT_EQ(texel(small, 0, 0), (Rgba{51, 2, 3, 204}));
    vgSeti(VG_FILTER_CHANNEL_MASK, VG_GREEN);
    const VGImage premultiplied_ = newImage({{64, 64, 64, 128}}, VG_sRGBA_8888_PRE);
    vgColorMatrix(premultiplied_, src, constant.data());
    EXPECT_TRUE(isNear(texel(premultiplied_, 0, 0, VG_sRGBA_8888_PRE), {64, 51, 64, 128}, 1));
    vgSeti(VG_FILTER_CHANNEL_MASK, 0);
    const VGImage grey = newImage(VG_sL_8, 1, 1);
    vgColorMatrix(grey, src, constant.data());
    EXPECT_NE(texel(grey, 0, 0)[0], 0) << "the mask is ignored for grey";
    vgSeti(VG_FILTER_CHANNEL_MASK, VG_RED | VG_GREEN | VG_BLUE | VG_ALPHA);
    vgColorMatrix(dst, small, constant.data());
    EXPECT_EQ(texel(dst, 1, 0), (Rgba{51, 102, 153, 204}));
    EXPECT_EQ(texel(dst, 2, 0), (Rgba{0, 0, 0, 0}));
    EXPECT_EQ(texel(dst, 0, 1), (Rgba{0, 0, 0, 0}));
}

}  // namespace

}  // namespace vtm::openvg::testing
