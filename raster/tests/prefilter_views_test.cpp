// Minified views of our drawings through the prefilter, against the exact mean over each pixel.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/matrix.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/raster/prefilter.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/svg/load.hpp>
#include "raster/testing_prefilter.hpp"

namespace vtm::asset::test {
namespace {

using glm::dvec2;

/// The picture, `pixels` long, turned and moved off the grid of its texels at random.
struct Minified {
    View view;
    glm::dmat2 toPicture;  ///< of distances
    glm::mat2 footprint;   ///< a pixel in shares of the picture

    Minified(const Asset& asset, int pixels, std::mt19937& random) {
        std::uniform_real_distribution<double> unit(0, 1);
        const double zoom = pixels / std::max(asset.width, asset.height);
        const double angle = 2 * std::numbers::pi * unit(random);
        const dvec2 x = zoom * dvec2(std::cos(angle), std::sin(angle)), y(-x.y, x.x);
        const int side = pixels * 3 / 2;
        const dvec2 middle = dvec2(side * 0.5) + dvec2(unit(random), unit(random));
        view = {side, side, glm::dmat3x2(x, y, middle - x * asset.width * 0.5 - y * asset.height * 0.5)};
        toPicture = glm::inverse(glm::dmat2(x, y));
        const dvec2 share(1 / asset.width, 1 / asset.height);
        footprint = glm::mat2(glm::vec2(toPicture[0] * share), glm::vec2(toPicture[1] * share));
    }

    glm::vec2 st(const Asset& asset, int x, int y) const {
        const dvec2 point = toPicture * (dvec2(x + 0.5, y + 0.5) - view.toPixels[2]);
        return glm::vec2(point / dvec2(asset.width, asset.height));
    }
};

constexpr int views = 4;

/// The mean over each pixel, paints that vary included: of the pixels of a picture four times as large.
image::Raster meanOf(const Asset& asset, const View& view) {
    constexpr int finer = 4;
    const image::Raster fine =
        Scanner(asset).draw({view.width * finer, view.height * finer, view.toPixels * double(finer)});
    image::Raster mean(view.width, view.height);
    for (int y = 0; y < fine.height; ++y)
        for (int x = 0; x < fine.width; ++x)
            for (int c = 0; c < 4; ++c)
                mean.pixel(x / finer, y / finer)[c] += fine.pixel(x, y)[c] / (finer * finer);
    return mean;
}

/// Root of the mean square difference, in 255ths, over all channels of the pixels whose centre lies in the
/// picture. `draw(minified, st, exact)` gives a pixel's colour.
template <class Draw>
double rms(const Asset& asset, int pixels, Draw&& draw) {
    std::mt19937 random(5);
    double squares = 0, count = 0;
    for (int i = 0; i < views; ++i) {
        const Minified minified(asset, pixels, random);
        const image::Raster exact = meanOf(asset, minified.view);
        for (int y = 0; y < exact.height; ++y)
            for (int x = 0; x < exact.width; ++x) {
                const glm::vec2 st = minified.st(asset, x, y);
                if (st.x < 0 || st.y < 0 || st.x > 1 || st.y > 1)
                    continue;
                const float* e = exact.pixel(x, y);
                const glm::vec4 truth(e[0], e[1], e[2], e[3]);
                const glm::vec4 difference = draw(minified, st, truth) - truth;
                squares += glm::dot(difference, difference) * 255.0 * 255.0;
                count += 4;
            }
    }
    return std::sqrt(squares / count);
}

double rms(const Asset& asset, int pixels, Minification filter) {
    return rms(asset, pixels, [&](const Minified& minified, glm::vec2 st, glm::vec4) {
        return samplePrefilter(asset, st, minified.footprint, filter);
    });
}

class PrefilterViews : public testing::TestWithParam<const char*> {
protected:
    PrefilterViews() {
        const std::string path = std::string(VTM_SOURCE_DIR "/examples/") + GetParam() + ".svg";
        asset_ = compiler::compile(svg::load(image::readFile(path)).scene).asset;
    }
    Asset asset_;
};

/// rms in 255ths that the best filter may have, where the pyramid has the levels it asks for, in pictures of
/// at least as many pixels (the smaller they are, the more neighbouring pixels differ).
constexpr double bound = 2;
constexpr double boundFrom = 31;

TEST_P(PrefilterViews, FourByFourTapsAreCloseToExact) {
    asset_.prefilter = buildPrefilter(asset_, PyramidSize{512, 512});  // what 4 × 4 taps want at 128 pixels
    for (const int pixels : {128, 64, 32}) {
        const double one = rms(asset_, pixels, Minification::Trilinear);
        const double two = rms(asset_, pixels, Minification::Taps2);
        const double four = rms(asset_, pixels, Minification::Taps4);
        std::printf("%-12s %4d pixels: rms %6.2f trilinear, %5.2f with 2 x 2 taps, %5.2f with 4 x 4\n",
                    GetParam(), pixels, one, two, four);
        EXPECT_LT(two, one);
        EXPECT_LT(four, two);
        EXPECT_LE(four, bound) << pixels;
    }
}

/// As a renderer uses it: the tree, faded over to the prefilter.
double fadeRms(const Asset& asset, int pixels) {
    return rms(asset, pixels, [&](const Minified& minified, glm::vec2 st, glm::vec4 truth) {
        return glm::mix(truth, samplePrefilter(asset, st, minified.footprint),
                        prefilterShare(asset, minified.footprint));
    });
}

/// The size that is chosen loses nothing: down to the sizes that `bound` is for the fade keeps it, and in
/// icons, where a pixel's neighbours differ most, it is as good as from a base with more levels than are
/// used.
TEST_P(PrefilterViews, TheFadeIsCloseToExactAtEverySize) {
    asset_.prefilter = buildPrefilter(asset_);
    Asset finer = asset_;
    const PyramidSize size = asset_.prefilter.size;
    finer.prefilter = buildPrefilter(asset_, PyramidSize{size.width * 4, size.height * 4});
    const std::uint32_t base = std::max(size.width, size.height);
    for (double pixels = base; pixels >= 8; pixels /= std::numbers::sqrt2) {
        const double error = fadeRms(asset_, int(pixels)), fromFiner = fadeRms(finer, int(pixels));
        std::printf("%-12s base %u, %4d pixels: rms %5.2f, %5.2f from a finer base\n", GetParam(), base,
                    int(pixels), error, fromFiner);
        if (pixels >= boundFrom) {
            EXPECT_LE(error, bound) << pixels;
        }
        EXPECT_LE(error, fromFiner + 0.1) << pixels;
    }
}

INSTANTIATE_TEST_SUITE_P(Examples, PrefilterViews,
                         testing::Values("lighthouse", "rose_window", "gauge", "planet", "blend"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace vtm::asset::test
