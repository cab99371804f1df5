// VG_NDS_projective_geometry against its formulas.

#include "api/openvg/tests/extensions_projective_fixture.hpp"

namespace extensions {
namespace {

TEST_F(Projective, HasParameters) {
    EXPECT_EQ(vgGeti(VGParamType(VG_CLIP_MODE_NDS)), VG_CLIPMODE_NONE_NDS);
    EXPECT_EQ(vgGetVectorSize(VGParamType(VG_CLIP_LINES_NDS)), 0);
    const VGint maximum = vgGeti(VGParamType(VG_MAX_CLIP_LINES_NDS));
    EXPECT_GE(maximum, 6);
    for (VGint mode = VG_CLIPMODE_NONE_NDS; mode <= VG_CLIPMODE_CULL_NDS; ++mode) {
        vgSeti(VGParamType(VG_CLIP_MODE_NDS), mode);
        EXPECT_EQ(vgGeti(VGParamType(VG_CLIP_MODE_NDS)), mode);
    }
    vgSeti(VGParamType(VG_CLIP_MODE_NDS), VG_CLIPMODE_CULL_NDS + 1);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    const std::vector<VGfloat> lines(std::size_t(3 * maximum + 3), 0.5f);
    vgSetfv(VGParamType(VG_CLIP_LINES_NDS), 3 * maximum + 3, lines.data());
    EXPECT_EQ(vgGetVectorSize(VGParamType(VG_CLIP_LINES_NDS)), 3 * maximum);
    vgSetfv(VGParamType(VG_CLIP_LINES_NDS), 4, lines.data());
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgSeti(VGParamType(VG_CLIP_LINES_NDS), 1);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgSeti(VGParamType(VG_MAX_CLIP_LINES_NDS), 1);
    EXPECT_EQ(vgGeti(VGParamType(VG_MAX_CLIP_LINES_NDS)), maximum);
}

TEST_F(Projective, KeepsTheLastRowOfMatricesWhereItIsEnabled) {
    const Matrix any{1, 2, 3, 4, 5, 6, 7, 8, 9}, affine{1, 2, 0, 4, 5, 0, 7, 8, 1};
    for (const VGMatrixMode mode : {VG_MATRIX_PATH_USER_TO_SURFACE, VG_MATRIX_FILL_PAINT_TO_USER,
                                    VG_MATRIX_STROKE_PAINT_TO_USER, VG_MATRIX_GLYPH_USER_TO_SURFACE}) {
        load(mode, any, false);
        EXPECT_EQ(matrixOf(mode), affine);
        load(mode, any);
        EXPECT_EQ(matrixOf(mode), any);
        vgLoadIdentity();
        vgMultMatrix(any.data());
        EXPECT_EQ(matrixOf(mode), any);
        // Of this matrix alone.
        load(VG_MATRIX_IMAGE_USER_TO_SURFACE, any, false);
        EXPECT_EQ(matrixOf(VG_MATRIX_IMAGE_USER_TO_SURFACE), any);
        vgSeti(VG_MATRIX_MODE, mode);
        vgProjectiveMatrixNDS(VG_FALSE);
        EXPECT_EQ(matrixOf(mode), affine);
    }
}

TEST_F(Projective, DrawsPathsInPerspective) {
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    // From y = 0 to 3 the floor has its edges from (0, 0) to (12, 24), and from (16, 0) to (16, 24).
    expectArea(drawn(rectangle(0, 0, 1, 3)),
               [](double x, double y) { return y < 24 && x > y / 2 && x < 16; });
    // A circle becomes an ellipse: inside where its preimage is.
    const VGPath circle = newPath();
    vguEllipse(circle, 0.5f, 1, 1, 1);
    expectArea(drawn(circle), [](double x, double y) {
        const double v = y / (32 - y), w = 1 + v, u = x * w / 16 - v;
        return std::hypot(u - 0.5, v - 1) < 0.5;
    });
}

TEST_F(Projective, StrokesBeforeItProjects) {
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    vgSetf(VG_STROKE_LINE_WIDTH, 0.5f);
    const VGPath line = newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS}, {0.5f, 0, 0.5f, 3});
    expectSame(drawn(line, VG_STROKE_PATH), drawn(rectangle(0.25f, 0, 0.5f, 3)));
}

TEST_F(Projective, LeavesOutWhatIsBehindTheViewer) {
    // The horizon is y = 32; beyond it, and from behind, nothing is seen.
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    expectArea(drawn(rectangle(-1e6f, -50, 2e6f, 1e6f)), [](double, double y) { return y < 32; });
    // All of it is behind.
    expectArea(drawn(rectangle(0, -5, 1, 3)), [](double, double) { return false; });
}

TEST_F(Projective, DrawsNearTheViewerEvenWithoutAntialiasing) {
    vgSeti(VG_RENDERING_QUALITY, VG_RENDERING_QUALITY_NONANTIALIASED);
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    const Bytes bytes = drawn(rectangle(0, -3, 1, 6));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double cx = x + 0.5, cy = y + 0.5;
            EXPECT_EQ(alpha(bytes, x, y), cy < 24 && cx > cy / 2 && cx < 16 ? 1 : 0) << x << ' ' << y;
        }
}

TEST_F(Projective, PaintsInPerspective) {
    const VGfloat stops[] = {0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, line[] = {0, 0, 0, 3};
    vgSetParameteri(paint_, VG_PAINT_TYPE, VG_PAINT_TYPE_LINEAR_GRADIENT);
    vgSetParameterfv(paint_, VG_PAINT_COLOR_RAMP_STOPS, 10, stops);
    vgSetParameterfv(paint_, VG_PAINT_LINEAR_GRADIENT, 4, line);
    const auto expectFloor = [](const Bytes& bytes) {
        for (int y = 0; y < 24; ++y) {
            const double v = (y + 0.5) / (32 - (y + 0.5));
            EXPECT_NEAR(bytes[std::size_t(y * side + 14) * 4] / 255.0, v / 3, 2 / 255.0) << y;
        }
    };
    // Either of the two maps on the way from paint to surface may be the projective one.
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    expectFloor(drawn(rectangle(0, 0, 1, 3)));
    load(VG_MATRIX_PATH_USER_TO_SURFACE, {1, 0, 0, 0, 1, 0, 0, 0, 1}, false);
    load(VG_MATRIX_FILL_PAINT_TO_USER, floorMatrix);
    expectFloor(drawn(rectangle(0, 0, 16, 24)));
    // By the distance from a point of the floor.
    const VGfloat circle[] = {0.5f, 1, 0.5f, 1, 2};
    vgSetParameteri(paint_, VG_PAINT_TYPE, VG_PAINT_TYPE_RADIAL_GRADIENT);
    vgSetParameterfv(paint_, VG_PAINT_RADIAL_GRADIENT, 5, circle);
    const Bytes bytes = drawn(rectangle(0, 0, 16, 24));
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 16; ++x) {
            const double v = (y + 0.5) / (32 - (y + 0.5)), u = (x + 0.5) * (1 + v) / 16 - v;
            EXPECT_NEAR(bytes[std::size_t(y * side + x) * 4] / 255.0,
                        std::min(std::hypot(u - 0.5, v - 1) / 2, 1.0), 2 / 255.0);
        }
}

TEST_F(Projective, ClipsAreas) {
    // Right of x = 8 and under x + y = 30, of an affine and of a projective map.
    const std::vector<VGfloat> lines{1, 0, -8, -1, -1, 30};
    clipBy(lines, VG_CLIPMODE_CLIP_CLOSED_NDS);
    const auto isKept = [](double x, double y) { return x > 8 && x + y < 30; };
    const VGPath circle = newPath();
    vguEllipse(circle, 14, 14, 24, 24);
    expectArea(drawn(circle),
               [&](double x, double y) { return isKept(x, y) && std::hypot(x - 14, y - 14) < 12; });
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    for (const VGint mode : {VG_CLIPMODE_CLIP_CLOSED_NDS, VG_CLIPMODE_CLIP_OPEN_NDS}) {
        clipBy(lines, mode);
        expectArea(drawn(rectangle(0, 0, 1, 3)),
                   [&](double x, double y) { return isKept(x, y) && y < 24 && x > y / 2 && x < 16; });
    }
    // No lines, no clipping.
    for (VGint mode = VG_CLIPMODE_NONE_NDS; mode <= VG_CLIPMODE_CULL_NDS; ++mode) {
        clipBy({}, mode);
        expectArea(drawn(rectangle(0, 0, 1, 3)),
                   [&](double x, double y) { return y < 24 && x > y / 2 && x < 16; });
    }
}

TEST_F(Projective, ClippingKeepsWindingNumbers) {
    // Two turns round a square, one of them through what is clipped away and back.
    const VGPath path =
        newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH,
                 VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH},
                {2, 2, 28, 2, 28, 28, 2, 28, 10, 10, 20, 10, 40, 20, 10, 20});
    vgSeti(VG_FILL_RULE, VG_EVEN_ODD);
    const Bytes whole = drawn(path);
    clipBy({-1, 0, 16}, VG_CLIPMODE_CLIP_CLOSED_NDS);
    const Bytes clipped = drawn(path);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            EXPECT_NEAR(alpha(clipped, x, y), x < 16 ? alpha(whole, x, y) : 0, 2 / 255.0) << x << ' ' << y;
}

TEST_F(Projective, CullsWholePaths) {
    const VGPath path = rectangle(4, 4, 8, 8);
    clipBy({1, 0, -4}, VG_CLIPMODE_CULL_NDS);
    const auto isRectangle = [](double x, double y) { return x > 4 && x < 12 && y > 4 && y < 12; };
    expectArea(drawn(path), isRectangle);
    clipBy({1, 0, -4, -1, 0, 11.5f}, VG_CLIPMODE_CULL_NDS);
    expectArea(drawn(path), [](double, double) { return false; });
    EXPECT_EQ(vgGetParameteri(transformed(path), VG_PATH_NUM_SEGMENTS), 0);
}

class ProjectiveImages : public Projective {
protected:
    void SetUp() override {
        Projective::SetUp();
        const Bytes white(4 * 4 * 4, 255);
        image_ = image(sRGBA, 4, 4, white);
    }
    static Bytes drawnImage(VGImage image) {
        const VGfloat none[] = {0, 0, 0, 0};
        vgSetfv(VG_CLEAR_COLOR, 4, none);
        vgClear(0, 0, side, side);
        vgDrawImage(image);
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        return surfaceBytes();
    }
    /// 4 pixels for one unit of the floor's width, and one of its depth.
    static constexpr Matrix imageMatrix{4, 0, 0, 12, 24, 0.75f, 0, 0, 1};
    VGImage image_ = VG_INVALID_HANDLE;
};

TEST_F(ProjectiveImages, KeepTheirModeWhereItIsEnabled) {
    const VGfloat red[] = {1, 0, 0, 1};
    vgSetParameterfv(paint_, VG_PAINT_COLOR, 4, red);
    for (const VGint mode : {VG_DRAW_IMAGE_MULTIPLY, VG_DRAW_IMAGE_STENCIL})
        for (const bool isEnabled : {false, true}) {
            vgSeti(VG_IMAGE_MODE, mode);
            load(VG_MATRIX_IMAGE_USER_TO_SURFACE, imageMatrix, isEnabled);
            const Bytes bytes = drawnImage(image_);
            const std::size_t middle = (8 * side + 12) * 4;
            EXPECT_EQ(bytes[middle], 255);
            EXPECT_EQ(bytes[middle + 1], isEnabled ? 0 : 255) << mode;
        }
}

TEST_F(ProjectiveImages, MultiplyPaintInPerspective) {
    const VGfloat stops[] = {0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, line[] = {0, 0, 0, 4};
    vgSetParameteri(paint_, VG_PAINT_TYPE, VG_PAINT_TYPE_LINEAR_GRADIENT);
    vgSetParameterfv(paint_, VG_PAINT_COLOR_RAMP_STOPS, 10, stops);
    vgSetParameterfv(paint_, VG_PAINT_LINEAR_GRADIENT, 4, line);
    vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_MULTIPLY);
    load(VG_MATRIX_IMAGE_USER_TO_SURFACE, imageMatrix);
    const Bytes bytes = drawnImage(image_);
    for (int y = 0; y < 20; ++y) {
        const double v = (y + 0.5) / (32 - (y + 0.5)) * 4 / 3;
        EXPECT_NEAR(bytes[std::size_t(y * side + 14) * 4] / 255.0, v / 4, 2 / 255.0) << y;
    }
}

TEST_F(ProjectiveImages, AreClipped) {
    load(VG_MATRIX_IMAGE_USER_TO_SURFACE, imageMatrix);
    const auto isImage = [](double x, double y) { return y < 24 && x > y / 2 && x < 16; };
    expectArea(drawnImage(image_), isImage);
    clipBy({1, 0, -6, -1, -1, 30}, VG_CLIPMODE_CLIP_OPEN_NDS);
    expectArea(drawnImage(image_), [&](double x, double y) { return isImage(x, y) && x > 6 && x + y < 30; });
    clipBy({1, 0, -6, -1, -1, 30}, VG_CLIPMODE_CULL_NDS);
    expectArea(drawnImage(image_), [](double, double) { return false; });
}

TEST_F(ProjectiveImages, BehindTheViewerAreSeenWhereTheyAreClipped) {
    // The image begins two units nearer, which is behind: nothing is seen (section 10.8) until a line cuts it
    // off.
    load(VG_MATRIX_IMAGE_USER_TO_SURFACE, {4, 0, 0, 12, 24, 0.75f, -24, -48, -0.5f});
    expectArea(drawnImage(image_), [](double, double) { return false; });
    clipBy({0, 1, -8}, VG_CLIPMODE_CLIP_CLOSED_NDS);
    expectArea(drawnImage(image_),
               [](double x, double y) { return y > 8 && y < 19.2 && x > y / 2 && x < 16; });
}

TEST_F(Projective, TransformsClipLines) {
    const Matrix m{2, 1, 0.5f, 0, 3, 0.25f, 5, -1, 4};
    // A line through the image of two points is the image of the line through the points.
    const VGfloat line[] = {3, -2, 1};  // through (1, 2) and (3, 5)
    VGfloat out[3], back[3];
    ASSERT_EQ(
        vguTransformClipLineNDS(line[0], line[1], line[2], m.data(), VG_FALSE, &out[0], &out[1], &out[2]),
        VGU_NO_ERROR);
    for (const auto& [x, y] : {Point{1, 2}, {3, 5}}) {
        const Point p = mapped(m, x, y);
        EXPECT_NEAR(double(out[0]) * p[0] + double(out[1]) * p[1] + double(out[2]), 0, 1e-5);
    }
    ASSERT_EQ(
        vguTransformClipLineNDS(out[0], out[1], out[2], m.data(), VG_TRUE, &back[0], &back[1], &back[2]),
        VGU_NO_ERROR);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(back[i], line[i], 1e-5);
    const Matrix flat{1, 0, 0, 2, 0, 0, 3, 0, 0};
    EXPECT_EQ(vguTransformClipLineNDS(1, 2, 3, flat.data(), VG_FALSE, &out[0], &out[1], &out[2]),
              VGU_BAD_WARP_ERROR);
    EXPECT_EQ(vguTransformClipLineNDS(1, 2, 3, flat.data(), VG_TRUE, &out[0], &out[1], &out[2]),
              VGU_NO_ERROR);
    EXPECT_EQ(vguTransformClipLineNDS(1, 2, 3, nullptr, VG_TRUE, &out[0], &out[1], &out[2]),
              VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguTransformClipLineNDS(1, 2, 3, m.data(), VG_TRUE, nullptr, &out[1], &out[2]),
              VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguTransformClipLineNDS(1, 2, 3, reinterpret_cast<const VGfloat*>(1), VG_TRUE, &out[0], &out[1],
                                      &out[2]),
              VGU_ILLEGAL_ARGUMENT_ERROR);
}

TEST_F(Projective, SurvivesWhatIsNoNumber) {
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    for (const VGfloat bad : {NAN, INFINITY, -INFINITY, 1e38f, 0.0f}) {
        clipBy({bad, 1, bad, 1, bad, -bad}, VG_CLIPMODE_CLIP_CLOSED_NDS);
        const VGPath path =
            newPath({VG_MOVE_TO_ABS, VG_RQUAD_TO_ABS_NDS, VG_RCUBIC_TO_ABS_NDS, VG_CLOSE_PATH},
                    {0, 0, bad, 1, 2, bad, 3, bad, -1, 1, 2, 1, bad, 3, 3, 0, 1, 1, -2});
        drawn(path, VG_FILL_PATH | VG_STROKE_PATH);
        transformed(path);
        clipBy({}, VG_CLIPMODE_NONE_NDS);
        drawn(path, VG_FILL_PATH | VG_STROKE_PATH);
        vgPathLength(path, 0, 4);
        Matrix broken = floorMatrix;
        broken[5] = bad;
        load(VG_MATRIX_PATH_USER_TO_SURFACE, broken);
        drawn(rectangle(0, 0, 1, 2));
        load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    }
}

}  // namespace
}  // namespace extensions
