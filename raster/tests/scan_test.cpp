// The scanner against the evaluator, which sums leaf by leaf.

#include <vtm/raster/scan.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <glm/common.hpp>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/prefilter.hpp>
#include "asset/testing.hpp"
#include "raster/testing_views.hpp"

namespace vtm::asset::test {
namespace {

double worst(const image::Raster& a, const image::Raster& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        worst = std::max(worst, std::abs(double(a.rgba[i]) - double(b.rgba[i])));
    return worst;
}

/// Of their differences.
double squares(const image::Raster& a, const image::Raster& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        sum += (double(a.rgba[i]) - double(b.rgba[i])) * (double(a.rgba[i]) - double(b.rgba[i]));
    return sum;
}

/// Both are exact but for the roundings of single precision.
constexpr double straight = 0.25 / 255;
/// The evaluator's four chords are off by 1.1/255 at most (docs/coverage.md), the scanner's by a third.
constexpr double curved = 1.5 / 255;

void expectSame(const Asset& asset, double tolerance, int views = 40) {
    ASSERT_NO_THROW(validate(asset));
    const Scanner scanner(asset);
    std::mt19937 random(3);
    for (int i = 0; i < views; ++i) {
        const View view = randomView(random);
        ASSERT_LE(worst(scanner.draw(view), evaluate(asset, view)), tolerance) << "view " << i;
    }
}

TEST(Scan, HalfPlane) { expectSame(halfPlane(), straight); }
TEST(Scan, Wedge) { expectSame(wedge(), straight); }
TEST(Scan, Strip) { expectSame(strip(), straight); }
TEST(Scan, ThreeRegions) { expectSame(threeRegions(), straight); }
TEST(Scan, TwoLevelTree) { expectSame(twoLevels(), straight); }
TEST(Scan, Arcs) { expectSame(disc(), curved); }
/// Of a part of a pixel in which a steep paint turns the scanner knows the area and its first moments, the
/// evaluator what lies in each quarter. Either is off by about a sixteenth of what the quarters differ by:
/// by everything, or where pixels are drawn finer by maxQuarterRange at most (raster/src/rough.hpp).
constexpr double part = 1.0 / 16, finePart = 12.0 / 255 / 16;
/// It has a material, so that no pixel is drawn finer.
TEST(Scan, EveryPaint) { expectSame(everyPaint(), part); }

TEST(Scan, EveryBlendMode) {
    for (unsigned mode = 0; mode <= unsigned(Blend::PlusLighter); ++mode)
        expectSame(blendAsset(Blend(mode)), straight + finePart, 4);
}

/// The mean over each pixel of a picture 16 times as large.
image::Raster meanOfFiner(const Scanner& scanner, View view) {
    constexpr int side = 16;
    image::Raster mean(view.width, view.height);
    view.width *= side;
    view.height *= side;
    for (int i = 0; i < 3; ++i)
        view.toPixels[i] *= side;
    const image::Raster finer = scanner.draw(view);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            for (int c = 0; c < 4; ++c)
                mean.pixel(x / side, y / side)[c] += finer.pixel(x, y)[c] / float(side * side);
    return mean;
}

/// Moments tell more of a part than quarters do.
TEST(Scan, IsNearerToTheMeanThanTheEvaluator) {
    for (const Asset& asset : {everyPaint(), blendAsset(Blend::Normal), blendAsset(Blend::ColorDodge),
                               blendAsset(Blend::Luminosity)}) {
        const Scanner scanner(asset);
        double scanned = 0, evaluated = 0;
        std::mt19937 random(3);
        for (int i = 0; i < 8; ++i) {
            const View view = randomView(random);
            const image::Raster mean = meanOfFiner(scanner, view);
            scanned += squares(scanner.draw(view), mean);
            evaluated += squares(evaluate(asset, view), mean);
        }
        EXPECT_LT(scanned, evaluated);
    }
}

TEST(Scan, BytesAreTheRasterRounded) {
    const Scanner scanner(disc());
    std::mt19937 random(7);
    for (int i = 0; i < 10; ++i) {
        const View view = randomView(random);
        const image::Raster raster = scanner.draw(view);
        const std::size_t rowBytes = std::size_t(view.width) * 4 + 12;
        std::vector<std::uint8_t> bytes(rowBytes * std::size_t(view.height), 77);
        scanner.draw(view, {bytes.data(), rowBytes});
        for (int y = 0; y < view.height; ++y) {
            const std::uint8_t* row = &bytes[std::size_t(y) * rowBytes];
            for (int x = 0; x < view.width * 4; ++x)
                ASSERT_EQ(int(row[x]), int(raster.pixel(0, y)[x] * 255.0f + 0.5f)) << x << ' ' << y;
            for (std::size_t x = std::size_t(view.width) * 4; x < rowBytes; ++x)
                ASSERT_EQ(row[x], 77);
        }
    }
}

TEST(Scan, RunsAreTheRaster) {
    for (const Asset& asset : {disc(), everyPaint()}) {
        const Scanner scanner(asset);
        std::mt19937 random(5);
        for (int i = 0; i < 10; ++i) {
            const View view = randomView(random);
            const image::Raster raster = scanner.draw(view);
            int row = 0, column = 0;
            scanner.scan(view, [&](int y, const ColorRun& run) {
                if (y != row) {
                    ASSERT_EQ(column, view.width);
                    ASSERT_EQ(y, row + 1);
                    row = y;
                    column = 0;
                }
                ASSERT_EQ(run.first, column);
                column = run.end;
                for (int x = run.first; x < run.end; ++x)
                    for (int c = 0; c < 4; ++c)
                        ASSERT_EQ(raster.pixel(x, y)[c], glm::clamp(run.color[c], 0.0f, 1.0f));
            });
            EXPECT_EQ(row, view.height - 1);
            EXPECT_EQ(column, view.width);
        }
    }
}

/// Half a pixel of a colour is half its light; what is whole is the colour decoded, translucent or not.
TEST(Scan, SumsOfLight) {
    const auto decoded = [](float c) {
        return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    };
    for (const Asset& asset : {halfPlane(), everyPaint()}) {
        const Scanner encoded(asset), light(asset, Sums::Light);
        // A pixel is far smaller than any region here, so most hold one colour.
        const View view{200, 200, {200 / asset.width, 0, 0, 200 / asset.height, 0, 0}};
        const image::Raster colors = encoded.draw(view), sums = light.draw(view);
        int whole = 0;
        for (int y = 1; y < 199; ++y)
            for (int x = 1; x < 199; ++x) {
                const float* c = colors.pixel(x, y);
                const auto isSame = [&](const float* other) { return std::equal(c, c + 4, other); };
                if (c[3] <= 0 || !isSame(colors.pixel(x - 1, y)) || !isSame(colors.pixel(x + 1, y)) ||
                    !isSame(colors.pixel(x, y - 1)) || !isSame(colors.pixel(x, y + 1)))
                    continue;
                ++whole;
                for (int i = 0; i < 3; ++i)
                    ASSERT_NEAR(sums.pixel(x, y)[i], c[3] * decoded(c[i] / c[3]), 1e-4) << x << ' ' << y;
                ASSERT_NEAR(sums.pixel(x, y)[3], c[3], 1e-5);
            }
        EXPECT_GT(whole, 2000);
    }
    // Across the border of two colours light is mixed as coverage is.
    const Asset halves = halfPlane();
    const View one{1, 1, {1 / halves.width, 0, 0, 1 / halves.height, 0, 0}};
    const View many{256, 256, {256 / halves.width, 0, 0, 256 / halves.height, 0, 0}};
    const Scanner light(halves, Sums::Light);
    const image::Raster pixel = light.draw(one), pixels = light.draw(many);
    for (std::size_t c = 0; c < 4; ++c) {
        double sum = 0;
        for (std::size_t i = c; i < pixels.rgba.size(); i += 4)
            sum += double(pixels.rgba[i]);
        EXPECT_NEAR(double(pixel.rgba[c]), sum / (256 * 256), 1e-3);
    }
}

/// Of a valid file numbers are finite, no more: what overflows on the way is some colour.
TEST(Scan, NumbersAtTheEndsOfSinglePrecisionMakeColours) {
    const float maximum = std::numeric_limits<float>::max();
    std::mt19937 random(11);
    for (int i = 0; i < 60; ++i) {
        Asset asset = everyPaint();
        // Of gradients and fills the first six numbers are their matrices.
        for (const Paint& paint : asset.paints)
            for (std::uint32_t k = 0; isProgram(paint) && k < paint[1]; ++k)
                if (const auto in = std::bit_cast<Instruction>(asset.data[paint[0] + k]); in.op > Op::Solid)
                    for (std::size_t m = 0; m < 6; ++m) {
                        constexpr float scales[] = {1, -1, 1e-30f, 1e-8f, -1e-20f, 0};
                        asset.data[in.argument + m / 4][m % 4] =
                            std::bit_cast<std::uint32_t>(maximum * scales[random() % 6]);
                    }
        ASSERT_NO_THROW(validate(asset));
        const View view = randomView(random);
        const Scanner scanner(asset);
        const image::Raster scanned = scanner.draw(view);
        for (const image::Raster& raster : {evaluate(asset, view), scanned})
            for (const float value : raster.rgba)
                ASSERT_TRUE(value >= 0 && value <= 1) << value << " in picture " << i;
        std::vector<std::uint8_t> bytes(scanned.rgba.size());
        scanner.draw(view, {bytes.data(), std::size_t(view.width) * 4});
        for (std::size_t k = 0; k < bytes.size(); ++k)
            ASSERT_EQ(int(bytes[k]), int(scanned.rgba[k] * 255.0f + 0.5f)) << k << " in picture " << i;
        buildPrefilter(asset, PyramidSize{4, 4}, 1);
    }
}

/// What one picture leaves behind is nothing to the next, whatever its size.
TEST(Scan, PicturesOfManySizesOneAfterTheOther) {
    const Scanner scanner(everyPaint());
    std::mt19937 random(9);
    for (int i = 0; i < 20; ++i) {
        View view = randomView(random);
        view.width = 1 + int(random() % 200);
        view.height = 1 + int(random() % 70);
        ASSERT_EQ(scanner.draw(view).rgba, Scanner(everyPaint()).draw(view).rgba);
    }
}

TEST(Scan, SeveralThreadsAtOnce) {
    const Scanner scanner(everyPaint());
    const View view = turnedView(120, 90, {32, 32}, 1.5, 0.4);
    const image::Raster expected = scanner.draw(view);
    std::vector<image::Raster> drawn(6);
    std::vector<std::thread> threads;
    for (image::Raster& raster : drawn)
        threads.emplace_back([&] { raster = scanner.draw(view); });
    for (std::thread& thread : threads)
        thread.join();
    for (const image::Raster& raster : drawn)
        EXPECT_EQ(raster.rgba, expected.rgba);
}

TEST(Scan, OneThreadAndManyGiveTheSameBytes) {
    for (const Asset& asset : {everyPaint(), twoLevels(), disc()}) {
        const Scanner scanner(asset);
        const View view = turnedView(700, 500, {32, 32}, 9, 0.4);
        const auto drawn = [&](int threads) {
            std::vector<std::uint8_t> bytes(std::size_t(view.width) * std::size_t(view.height) * 4);
            tbb::task_arena(threads).execute([&] {
                scanner.draw(view, {bytes.data(), std::size_t(view.width) * 4});
            });
            return bytes;
        };
        const std::vector<std::uint8_t> expected = drawn(1);
        for (const int threads : {2, 3, 8})
            EXPECT_EQ(drawn(threads), expected) << threads;
    }
}

/// A band shows the same whether its task draws it alone or after all above it, for which rows of gradients
/// were prepared: where the map ends within a band, fewer pixels are cut than ask for rows.
TEST(Scan, BandsDoNotDependOnThoseBefore) {
    constexpr double zoom = 8;  // the map has 512 pixels a side
    const Scanner scanner(stripedHalves(12 / zoom));
    for (int top = 0; top < 16; ++top) {
        const View view{520, 528, {zoom, 0, 0, zoom, 4, top}};
        const auto drawn = [&](int threads) {
            image::Raster raster;
            tbb::task_arena(threads).execute([&] { raster = scanner.draw(view); });
            return raster.rgba;
        };
        EXPECT_TRUE(drawn(1) == drawn(16)) << top;
    }
}

TEST(Scan, NothingToDraw) {
    Asset empty = emptyAsset();
    empty.commands.clear();
    EXPECT_EQ(Scanner(empty).draw({3, 2, {}}).rgba, std::vector<float>(24));
    const Scanner scanner(halfPlane());
    EXPECT_EQ(scanner.draw({4, 4, glm::dmat3x2(1, 1, 2, 2, 0, 0)}).rgba, std::vector<float>(64));
    EXPECT_TRUE(scanner.draw({0, 5, {}}).rgba.empty());
}

TEST(Scan, RefusesWhatItCannotDraw) {
    EXPECT_THROW(Scanner{layers()}, std::invalid_argument);
    EXPECT_THROW(Scanner(halfPlane()).draw({maxViewSide + 1, 1, {}}), std::length_error);
}

}  // namespace
}  // namespace vtm::asset::test
