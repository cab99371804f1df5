#include <vtm/image/bitmap.hpp>

#include <gtest/gtest.h>

namespace vtm::image {
namespace {

TEST(Bitmap, RasterHoldsPremultipliedColour) {
    const Raster raster = toRaster({1, 1, {255, 0, 51, 51}});
    EXPECT_FLOAT_EQ(raster.rgba[0], 0.2f);
    EXPECT_FLOAT_EQ(raster.rgba[2], 0.04f);
    EXPECT_FLOAT_EQ(raster.rgba[3], 0.2f);
}

TEST(Bitmap, SurvivesTheRasterAndBack) {
    const Bitmap bitmap{2, 1, {1, 128, 255, 255, 7, 80, 200, 100}};
    EXPECT_EQ(toBitmap(toRaster(bitmap)).rgba, bitmap.rgba);
}

TEST(Bitmap, ClampsWhatLiesOutsideTheRange) {
    Raster raster(1, 1);
    raster.rgba = {2, -1, 0.5f, 1};
    EXPECT_EQ(toBitmap(raster).rgba, (std::vector<std::uint8_t>{255, 0, 128, 255}));
}

}  // namespace
}  // namespace vtm::image
