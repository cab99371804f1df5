#include "conformance/compare/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace vtm::compare {
namespace {

/// A disc of a colour on white, off centre so that no symmetry hides a shift.
image::Raster disc(float red, double centerX = 14.3) {
    image::Raster picture(32, 32);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool inside = std::hypot(x + 0.5 - centerX, y + 0.5 - 17.1) < 9;
            float* p = picture.pixel(x, y);
            p[0] = inside ? red : 1;
            p[1] = p[2] = inside ? 0.2f : 1;
            p[3] = 1;
        }
    }
    return picture;
}

/// 10 × 25 pixels, 1000 channel values, all zero.
image::Raster thousandChannels() { return image::Raster(10, 25); }

constexpr float unit = 1.0f / 255;
constexpr double rounding = 1e-4;  // floats hold 255ths to about 1e-5

TEST(Compare, EqualPicturesDoNotDiffer) {
    const Difference d = compare(disc(0.8f), disc(0.8f));
    EXPECT_EQ(d.max, 0);
    EXPECT_EQ(d.mean, 0);
    EXPECT_EQ(d.rms, 0);
    EXPECT_EQ(d.p999, 0);
    EXPECT_EQ(d.over, 0u);
}

TEST(Compare, BlankPictureIsToldApart) {
    const Difference d = compare(disc(0.8f), image::Raster(32, 32));
    EXPECT_NEAR(d.max, 255, rounding);
    EXPECT_EQ(d.over, 32u * 32u);
    EXPECT_GT(d.mean, 150);
}

TEST(Compare, ShiftByOnePixelIsToldApart) {
    const Difference d = compare(disc(0.8f), disc(0.8f, 15.3));
    EXPECT_NEAR(d.max, 0.8 * 255, rounding);
    EXPECT_GT(d.over, 20u);
    EXPECT_LT(d.over, 60u);
}

TEST(Compare, RecolouringIsToldApart) {
    const Difference d = compare(disc(0.8f), disc(0.8f + 4 * unit));
    EXPECT_NEAR(d.max, 4, rounding);
    EXPECT_NEAR(double(d.over), M_PI * 81, 10);
    EXPECT_EQ(compare(disc(0.8f), disc(0.8f + 4 * unit), 5).over, 0u);
}

TEST(Compare, NeighbouringPictureIsToldApart) {
    image::Raster neighbour = disc(0.8f);
    neighbour.pixel(5, 29)[2] = 1 - 3 * unit;
    const Difference d = compare(disc(0.8f), neighbour);
    EXPECT_EQ(d.over, 1u);
    EXPECT_NEAR(d.max, 3, rounding);
    EXPECT_EQ(d.worstX, 5);
    EXPECT_EQ(d.worstY, 29);
}

TEST(Compare, MeanAndRmsOfKnownDifferences) {
    image::Raster b = thousandChannels();
    b.rgba[0] = 3 * unit;
    b.rgba[999] = 4 * unit;
    const Difference d = compare(thousandChannels(), b);
    EXPECT_NEAR(d.mean, 7.0 / 1000, 1e-6);
    EXPECT_NEAR(d.rms, std::sqrt(25.0 / 1000), 1e-6);
    EXPECT_EQ(d.over, 2u);
}

TEST(Compare, PercentileLeavesOutOneInAThousand) {
    image::Raster b = thousandChannels();
    b.rgba[17] = 9 * unit;
    EXPECT_EQ(compare(thousandChannels(), b).p999, 0);
    b.rgba[600] = 5 * unit;
    EXPECT_NEAR(compare(thousandChannels(), b).p999, 5, rounding);
}

TEST(Compare, ThresholdItselfIsNotOver) {
    image::Raster b = thousandChannels();
    b.rgba[0] = 0.5f;
    EXPECT_EQ(compare(thousandChannels(), b, 127.5).over, 0u);
    EXPECT_EQ(compare(thousandChannels(), b, 127.4).over, 1u);
}

TEST(Compare, NotANumberIsNeverEqual) {
    image::Raster b = thousandChannels();
    b.rgba[8] = std::numeric_limits<float>::quiet_NaN();
    const Difference d = compare(thousandChannels(), b);
    EXPECT_TRUE(std::isinf(d.max));
    EXPECT_EQ(d.over, 1u);
    EXPECT_EQ(d.worstX, 2);
}

TEST(Compare, EmptyPicturesDoNotDiffer) { EXPECT_EQ(compare({}, {}).mean, 0); }

TEST(Compare, DifferentSizesAreAnError) {
    EXPECT_THROW(compare(image::Raster(3, 4), image::Raster(4, 3)), std::invalid_argument);
    EXPECT_THROW(differencePicture(image::Raster(3, 4), image::Raster(4, 3)), std::invalid_argument);
}

TEST(DifferencePicture, AmplifiesClampsAndIsOpaque) {
    image::Raster b(2, 1);
    b.rgba = {3 * unit, 0, 1, 0, 0, 0, 0, 2 * unit};
    const image::Bitmap picture = differencePicture(image::Raster(2, 1), b, 8);
    const std::vector<std::uint8_t> expected{24, 0, 255, 255, 16, 16, 16, 255};
    EXPECT_EQ(picture.rgba, expected);
}

}  // namespace
}  // namespace vtm::compare
