// Section 7: scissoring, masks and mask layers, clearing.

#include <cmath>
#include <limits>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

constexpr VGint greatest = std::numeric_limits<VGint>::max(), minimum = std::numeric_limits<VGint>::min();

class MasksTest : public VgTest {
protected:
    /// The mask shows as the alpha of white drawn over everything.
    int maskAt(int x, int y) {
        const VGint blend = vgGeti(VG_BLEND_MODE), masking = vgGeti(VG_MASKING),
                    scissoring = vgGeti(VG_SCISSORING);
        vgSeti(VG_SCISSORING, VG_FALSE);
        clear({0, 0, 0, 0});
        vgSeti(VG_MASKING, VG_TRUE);
        vgSeti(VG_BLEND_MODE, VG_BLEND_SRC_OVER);
        const VGPaint white = newPaint({1, 1, 1, 1});
        const VGPath all = rectangle(-1, -1, 40, 40);
        vgSetPaint(white, VG_FILL_PATH);
        vgDrawPath(all, VG_FILL_PATH);
        vgDestroyPath(all);
        vgDestroyPaint(white);
        vgSeti(VG_BLEND_MODE, blend);
        vgSeti(VG_MASKING, masking);
        vgSeti(VG_SCISSORING, scissoring);
        return pixel(x, y)[3];
    }
    void setMask(int value) {
        const VGMaskLayer layer = vgCreateMaskLayer(16, 16);
        vgFillMaskLayer(layer, 0, 0, 16, 16, VGfloat(value) / 255);
        vgMask(layer, VG_SET_MASK, 0, 0, 16, 16);
        vgDestroyMaskLayer(layer);
    }
};

TEST_F(MasksTest, BeginsAsOne) { EXPECT_EQ(maskAt(3, 3), 255); }

TEST_F(MasksTest, OperationsOfTable5) {
    const VGMaskLayer layer = vgCreateMaskLayer(16, 16);
    for (const int before : {0, 51, 128, 255})
        for (const int mask : {0, 64, 200, 255}) {
            const double m = mask / 255.0, p = before / 255.0;
            const std::array<std::pair<VGMaskOperation, double>, 6> results{
                {{VG_CLEAR_MASK, 0},
                 {VG_FILL_MASK, 1},
                 {VG_SET_MASK, m},
                 {VG_UNION_MASK, 1 - (1 - m) * (1 - p)},
                 {VG_INTERSECT_MASK, m * p},
                 {VG_SUBTRACT_MASK, p * (1 - m)}}};
            for (const auto& [operation, result] : results) {
                setMask(before);
                vgFillMaskLayer(layer, 0, 0, 16, 16, VGfloat(m));
                vgMask(layer, operation, 2, 2, 5, 5);
                EXPECT_NEAR(maskAt(2, 2), 255 * result, 1) << before << ' ' << mask << ' ' << operation;
                EXPECT_EQ(maskAt(7, 2), before) << "outside of the rectangle";
            }
        }
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(MasksTest, ImagesGiveAlphaOrRedOrGrey) {
    const auto value = [&](VGImageFormat format, Rgba color) {
        const VGImage image = newImage(format, 1, 1);
        const std::uint32_t word = wordOf(color);
        vgImageSubData(image, &word, 4, VG_sRGBA_8888, 0, 0, 1, 1);
        vgMask(image, VG_SET_MASK, 0, 0, 1, 1);
        vgDestroyImage(image);
        return maskAt(0, 0);
    };
    EXPECT_EQ(value(VG_sRGBA_8888, {10, 20, 30, 77}), 77);
    EXPECT_EQ(value(VG_A_8, {10, 20, 30, 77}), 77);
    EXPECT_EQ(value(VG_sRGBX_8888, {10, 20, 30, 77}), 10);
    EXPECT_EQ(value(VG_sL_8, {99, 99, 99, 77}), 99);
    EXPECT_EQ(value(VG_BW_1, {255, 255, 255, 255}), 255);
    EXPECT_EQ(value(VG_BW_1, {0, 0, 0, 255}), 0);
    EXPECT_EQ(value(VG_A_4, {0, 0, 0, 0x55}), 0x55);
}

TEST_F(MasksTest, RectanglesAreClippedWhateverTheirNumbers) {
    const VGMaskLayer layer = vgCreateMaskLayer(4, 4);
    vgFillMaskLayer(layer, 0, 0, 4, 4, 0);
    vgMask(layer, VG_SET_MASK, -2, 14, greatest, greatest);  // the layer ends at (2, 18)
    EXPECT_EQ(maskAt(0, 15), 0);
    EXPECT_EQ(maskAt(1, 14), 0);
    EXPECT_EQ(maskAt(2, 14), 255);
    EXPECT_EQ(maskAt(0, 13), 255);
    vgMask(layer, VG_SET_MASK, greatest, 0, greatest, 1);
    vgMask(layer, VG_SET_MASK, minimum, minimum, greatest, greatest);
    vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 12, -1, greatest, 2);
    EXPECT_EQ(maskAt(12, 0), 0);
    EXPECT_EQ(maskAt(15, 0), 0);
    EXPECT_EQ(maskAt(12, 1), 255);
    EXPECT_EQ(maskAt(11, 0), 255);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(MasksTest, LayersBeginAsOneAndCopyTheMask) {
    const VGMaskLayer layer = vgCreateMaskLayer(8, 8);
    setMask(0);
    vgMask(layer, VG_SET_MASK, 0, 0, 8, 8);
    EXPECT_EQ(maskAt(7, 7), 255);
    setMask(100);
    vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 3, 0, 13, 16);
    vgCopyMask(layer, -1, 1, 0, 0, 20, 20);  // (x, y) of the mask to (x - 1, y + 1)
    vgMask(VG_INVALID_HANDLE, VG_FILL_MASK, 0, 0, 16, 16);
    vgMask(layer, VG_SET_MASK, 0, 0, 8, 8);
    EXPECT_EQ(maskAt(0, 0), 255) << "nothing was copied there";
    EXPECT_EQ(maskAt(0, 1), 100);
    EXPECT_EQ(maskAt(1, 1), 100);
    EXPECT_EQ(maskAt(2, 1), 0);
    vgFillMaskLayer(layer, 7, 7, 1, 1, 0.2f);
    vgMask(layer, VG_SET_MASK, 0, 0, 16, 16);
    EXPECT_EQ(maskAt(7, 7), 51);
}

TEST_F(MasksTest, RenderToMaskTakesCoverageWithinTheScissors) {
    setMask(0);
    const VGPath path = rectangle(2, 2, 4.5f, 4);
    vgRenderToMask(path, VG_FILL_PATH, VG_SET_MASK);
    EXPECT_EQ(maskAt(5, 3), 255);
    EXPECT_NEAR(maskAt(6, 3), 128, 3);
    EXPECT_EQ(maskAt(7, 3), 0);
    setMask(255);
    vgRenderToMask(path, VG_FILL_PATH, VG_SUBTRACT_MASK);
    EXPECT_EQ(maskAt(5, 3), 0);
    EXPECT_NEAR(maskAt(6, 3), 127, 3);
    EXPECT_EQ(maskAt(9, 3), 255);
    // Filled, then stroked: what neither covers is 0 in one of the passes.
    vgSetf(VG_STROKE_LINE_WIDTH, 2);
    setMask(255);
    vgRenderToMask(rectangle(4, 4, 6, 6), VG_FILL_PATH | VG_STROKE_PATH, VG_INTERSECT_MASK);
    EXPECT_EQ(maskAt(4, 6), 255);
    EXPECT_EQ(maskAt(3, 6), 0);
    EXPECT_EQ(maskAt(6, 6), 0);
    // Scissors cut the coverage; clearing and filling take no heed of them.
    setMask(0);
    const std::array<VGint, 4> scissor{2, 2, 2, 2};
    vgSetiv(VG_SCISSOR_RECTS, 4, scissor.data());
    vgSeti(VG_SCISSORING, VG_TRUE);
    vgRenderToMask(rectangle(0, 0, 16, 16), VG_FILL_PATH, VG_UNION_MASK);
    EXPECT_EQ(maskAt(3, 3), 255);
    EXPECT_EQ(maskAt(4, 3), 0);
    vgRenderToMask(path, VG_FILL_PATH, VG_FILL_MASK);
    EXPECT_EQ(maskAt(15, 15), 255);
    vgRenderToMask(path, VG_FILL_PATH, VG_CLEAR_MASK);
    EXPECT_EQ(maskAt(3, 3), 0);
    EXPECT_EQ(maskAt(15, 15), 0);
}

TEST_F(MasksTest, WithoutAMaskNothingIsMasked) {
    VtmSurfaceFormat format = sRGBA8888;
    format.maskBits = 0;
    useSurface(16, 16, format);
    EXPECT_EQ(vgCreateMaskLayer(4, 4), VG_INVALID_HANDLE);
    vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 0, 0, 16, 16);
    EXPECT_EQ(maskAt(3, 3), 255);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(MasksTest, AnotherSurfaceResetsTheMask) {
    setMask(0);
    VtmSurface* const other = vtmCreateSurface(16, 16, &sRGBA8888);
    EXPECT_TRUE(vtmMakeCurrent(context, other));
    EXPECT_EQ(maskAt(0, 0), 255);
    EXPECT_TRUE(vtmMakeCurrent(context, surface));
    EXPECT_EQ(maskAt(0, 0), 255);
    vtmDestroySurface(other);
}

// ---- Sections 7.1 and 7.3 -------------------------------------------------------------------------

class ScissorTest : public VgTest {
protected:
    static void scissor(std::vector<VGint> rectangles) {
        vgSetiv(VG_SCISSOR_RECTS, VGint(rectangles.size()), rectangles.data());
        vgSeti(VG_SCISSORING, VG_TRUE);
    }
    /// Pixels that a clear of everything turns white.
    int cleared() {
        const VGint scissoring = vgGeti(VG_SCISSORING);
        vgSeti(VG_SCISSORING, VG_FALSE);
        clear({0, 0, 0, 1});
        vgSeti(VG_SCISSORING, scissoring);
        clear({1, 1, 1, 1});
        int count = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                count += pixel(x, y)[0] == 255;
        return count;
    }
};

TEST_F(ScissorTest, DrawsInTheUnionOfRectangles) {
    EXPECT_EQ(cleared(), 256);
    scissor({});
    EXPECT_EQ(cleared(), 0) << "no rectangle lets nothing through";
    scissor({1, 1, 4, 4, 3, 3, 4, 4});
    EXPECT_EQ(cleared(), 16 + 16 - 4);
    scissor({1, 1, 0, 4, 2, 2, -1, 5, 3, 3, 1, 1});
    EXPECT_EQ(cleared(), 1) << "sides of 0 or less are empty";
    scissor({-5, -5, greatest, greatest});
    EXPECT_EQ(cleared(), 256);
    scissor({minimum, 0, greatest, 1, greatest, 0, greatest, 1});
    EXPECT_EQ(cleared(), 0);
    scissor({14, 15, greatest, greatest});
    EXPECT_EQ(cleared(), 2);
    vgSeti(VG_SCISSORING, VG_FALSE);
    EXPECT_EQ(cleared(), 256);
}

TEST_F(ScissorTest, HoldsForPathsImagesAndPixels) {
    scissor({4, 4, 2, 1, 8, 4, 1, 1});
    const VGPaint white = newPaint({1, 1, 1, 1});
    vgSetPaint(white, VG_FILL_PATH);
    const Rgba on{255, 255, 255, 255}, off{0, 0, 0, 0};
    const auto check = [&] {
        EXPECT_EQ(pixel(3, 4), off);
        EXPECT_EQ(pixel(4, 4), on);
        EXPECT_EQ(pixel(5, 4), on);
        EXPECT_EQ(pixel(6, 4), off);
        EXPECT_EQ(pixel(8, 4), on);
        EXPECT_EQ(pixel(4, 5), off);
        clear({0, 0, 0, 0});
    };
    vgDrawPath(rectangle(0, 0, 16, 16), VG_FILL_PATH);
    check();
    const VGImage image = newImage(VG_sRGBA_8888, 16, 16);
    const std::array<VGfloat, 4> color{1, 1, 1, 1};
    vgSetfv(VG_CLEAR_COLOR, 4, color.data());
    vgClearImage(image, 0, 0, 16, 16);
    vgDrawImage(image);
    check();
    vgSetPixels(0, 0, image, 0, 0, 16, 16);
    check();
    const std::vector<std::uint32_t> words(256, 0xffffffff);
    vgWritePixels(words.data(), 64, VG_sRGBA_8888, 0, 0, 16, 16);
    check();
}

TEST_F(ScissorTest, ClearIsNotMaskedAndTakesAnyRectangle) {
    vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 0, 0, 16, 16);
    vgSeti(VG_MASKING, VG_TRUE);
    const std::array<VGfloat, 4> color{0.2f, 2, -1, 1};
    vgSetfv(VG_CLEAR_COLOR, 4, color.data());
    vgClear(-3, 15, 5, greatest);
    EXPECT_EQ(pixel(1, 15), (Rgba{51, 255, 0, 255}));
    EXPECT_EQ(pixel(2, 15), (Rgba{0, 0, 0, 0}));
    EXPECT_EQ(pixel(1, 14), (Rgba{0, 0, 0, 0}));
    vgClear(greatest, minimum, greatest, greatest);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

}  // namespace

}  // namespace vtm::openvg::testing
