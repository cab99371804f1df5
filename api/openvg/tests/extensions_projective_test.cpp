// VG_NDS_projective_geometry against its formulas.

#include <functional>

#include "api/openvg/tests/extensions_fixture.hpp"

namespace extensions {
namespace {

using Point = std::array<double, 2>;
/// As vgLoadMatrix takes it.
using Matrix = std::array<VGfloat, 9>;

/// The floor of a room: rows come nearer to each other towards y = 32.
constexpr Matrix floorMatrix{16, 0, 0, 16, 32, 1, 0, 0, 1};

Point mapped(const Matrix& m, double x, double y) {
    const double w = double(m[2]) * x + double(m[5]) * y + double(m[8]);
    return {(double(m[0]) * x + double(m[3]) * y + double(m[6])) / w,
            (double(m[1]) * x + double(m[4]) * y + double(m[7])) / w};
}

class Projective : public Extensions {
protected:
    void SetUp() override {
        Extensions::SetUp();
        EXPECT_TRUE(has("VG_NDS_projective_geometry"));
        vgSeti(VG_RENDERING_QUALITY, VG_RENDERING_QUALITY_BETTER);
        paint_ = newPaint({1, 1, 1, 1});
        vgSetPaint(paint_, VG_FILL_PATH | VG_STROKE_PATH);
    }
    void TearDown() override {
        vgDestroyPaint(paint_);
        Extensions::TearDown();
    }

    static void load(VGMatrixMode mode, const Matrix& matrix, bool enable = true) {
        vgSeti(VG_MATRIX_MODE, mode);
        vgProjectiveMatrixNDS(enable ? VG_TRUE : VG_FALSE);
        vgLoadMatrix(matrix.data());
    }
    static Matrix matrixOf(VGMatrixMode mode) {
        Matrix m;
        vgSeti(VG_MATRIX_MODE, mode);
        vgGetMatrix(m.data());
        return m;
    }
    static void clipBy(const std::vector<VGfloat>& lines, VGint mode) {
        vgSetfv(VGParamType(VG_CLIP_LINES_NDS), VGint(lines.size()), lines.data());
        vgSeti(VGParamType(VG_CLIP_MODE_NDS), mode);
    }
    static VGPath transformed(VGPath path) {
        const VGPath result = newPath();
        vgTransformPath(result, path);
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        return result;
    }

    static Bytes drawn(VGPath path, VGbitfield modes = VG_FILL_PATH) {
        const VGfloat none[] = {0, 0, 0, 0};
        vgSetfv(VG_CLEAR_COLOR, 4, none);
        vgClear(0, 0, side, side);
        vgDrawPath(path, modes);
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        return surfaceBytes();
    }
    static double alpha(const Bytes& bytes, int x, int y) {
        return bytes[std::size_t(y * side + x) * 4 + 3] / 255.0;
    }

    /// Alpha is the share of 16 x 16 samples of each pixel that are inside.
    static void expectArea(const Bytes& bytes, const std::function<bool(double, double)>& isInside) {
        constexpr int samples = 16;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                int count = 0;
                for (int i = 0; i < samples * samples; ++i)
                    count += isInside(x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples);
                // A border shifts the samples of a row by at most one.
                ASSERT_NEAR(alpha(bytes, x, y), double(count) / (samples * samples), 1.5 / samples)
                    << x << ' ' << y;
            }
    }
    static void expectSame(const Bytes& a, const Bytes& b, int steps = 1) {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_NEAR(a[i], b[i], steps) << i / 4 % side << ' ' << i / 4 / side;
    }

    VGPaint paint_ = VG_INVALID_HANDLE;
};

TEST_F(Projective, HasParameters) {
    EXPECT_EQ(vgGeti(VGParamType(VG_CLIP_MODE_NDS)), VG_CLIPMODE_NONE_NDS);
    EXPECT_EQ(vgGetVectorSize(VGParamType(VG_CLIP_LINES_NDS)), 0);
    const VGint most = vgGeti(VGParamType(VG_MAX_CLIP_LINES_NDS));
    EXPECT_GE(most, 6);
    for (VGint mode = VG_CLIPMODE_NONE_NDS; mode <= VG_CLIPMODE_CULL_NDS; ++mode) {
        vgSeti(VGParamType(VG_CLIP_MODE_NDS), mode);
        EXPECT_EQ(vgGeti(VGParamType(VG_CLIP_MODE_NDS)), mode);
    }
    vgSeti(VGParamType(VG_CLIP_MODE_NDS), VG_CLIPMODE_CULL_NDS + 1);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    const std::vector<VGfloat> lines(std::size_t(3 * most + 3), 0.5f);
    vgSetfv(VGParamType(VG_CLIP_LINES_NDS), 3 * most + 3, lines.data());
    EXPECT_EQ(vgGetVectorSize(VGParamType(VG_CLIP_LINES_NDS)), 3 * most);
    vgSetfv(VGParamType(VG_CLIP_LINES_NDS), 4, lines.data());
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgSeti(VGParamType(VG_CLIP_LINES_NDS), 1);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgSeti(VGParamType(VG_MAX_CLIP_LINES_NDS), 1);
    EXPECT_EQ(vgGeti(VGParamType(VG_MAX_CLIP_LINES_NDS)), most);
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

TEST_F(Projective, HasRationalCurves) {
    // A quarter of a circle is a quadratic one with the weight of half a right angle; degree elevation makes
    // a cubic one of it (8.4a.2).
    const auto w = VGfloat(std::sqrt(0.5));
    const VGfloat c = (1 + 2 * w) / 3, k = 20 * 2 * w / (1 + 2 * w);
    const VGPath quad = newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_RQUAD_TO_ABS_NDS, VG_CLOSE_PATH},
                                {4, 4, 24, 4, 1, 24, 24, w, 4, 24, 1});
    const VGPath cubic = newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_RCUBIC_TO_REL_NDS, VG_CLOSE_PATH},
                                 {4, 4, 24, 4, 1, 0, k, c, k - 20, 20, c, -20, 20, 1});
    const auto isQuarter = [](double x, double y) { return x > 4 && y > 4 && std::hypot(x - 4, y - 4) < 20; };
    for (const VGPath path : {quad, cubic}) {
        expectArea(drawn(path), isQuarter);
        EXPECT_NEAR(vgPathLength(path, 2, 1), 10 * M_PI, 1e-3);
        VGfloat x = 0, y = 0, tx = 0, ty = 0;
        vgPointAlongPath(path, 2, 1, VGfloat(5 * M_PI), &x, &y, &tx, &ty);
        EXPECT_NEAR(x, 4 + 20 * std::sqrt(0.5), 1e-3);
        EXPECT_NEAR(y, 4 + 20 * std::sqrt(0.5), 1e-3);
        EXPECT_NEAR(tx, -std::sqrt(0.5), 1e-4);
        EXPECT_NEAR(ty, std::sqrt(0.5), 1e-4);
        VGfloat width = 0, height = 0;
        vgPathBounds(path, &x, &y, &width, &height);
        EXPECT_NEAR(width, 20, 1e-4);
        EXPECT_NEAR(height, 20, 1e-4);
        EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), 4);
    }
    EXPECT_EQ(vgGetParameteri(quad, VG_PATH_NUM_COORDS), 11);
    EXPECT_EQ(vgGetParameteri(cubic, VG_PATH_NUM_COORDS), 14);
    const VGPath between = newPath();
    EXPECT_EQ(vgInterpolatePath(between, quad, cubic, 0.5f), VG_TRUE);
    expectArea(drawn(between), isQuarter);
    // Smooth curves after them start straight ahead: their control is where they start.
    const VGPath smooth = newPath({VG_MOVE_TO_ABS, VG_RQUAD_TO_ABS_NDS, VG_SQUAD_TO_ABS},
                                  {0, 0, 1, 10, 0, 1, 10, 10, 1, 20, 20});
    EXPECT_NEAR(vgPathLength(smooth, 2, 1), 10 * std::sqrt(2.0), 1e-4);
}

TEST_F(Projective, RationalCurvesNeedAProgramThatKnowsThem) {
    const VtmSurfaceFormat format{8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE};
    VtmContext* const other = vtmCreateContext(nullptr);
    VtmSurface* const own = vtmCreateSurface(4, 4, &format);
    ASSERT_TRUE(vtmMakeCurrent(other, own));
    const VGubyte command = VG_RQUAD_TO_ABS_NDS;
    const VGfloat numbers[7] = {};
    vgAppendPathData(newPath(), 1, &command, numbers);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgSeti(VGParamType(VG_CLIP_MODE_NDS), VG_CLIPMODE_NONE_NDS);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    ASSERT_TRUE(vtmMakeCurrent(context, surface));
    vtmDestroyContext(other);
    vtmDestroySurface(own);
    const VGubyte beyond = 15 << 1;
    vgAppendPathData(newPath(), 1, &beyond, numbers);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
}

/// A path of every kind of segment, seen on the floor.
class ProjectiveTransforms : public Projective {
protected:
    static VGPath everything() {
        return newPath({VG_MOVE_TO_ABS, VG_HLINE_TO_REL, VG_QUAD_TO_ABS, VG_CUBIC_TO_REL, VG_LCCWARC_TO_ABS,
                        VG_RQUAD_TO_ABS_NDS, VG_RCUBIC_TO_REL_NDS, VG_VLINE_TO_ABS, VG_CLOSE_PATH},
                       {0,    0,    0.6f, 0.9f, 0.1f, 0.9f,  0.5f, 0.1f, 0.1f,  0.2f, 0.3f, 0,
                        0.6f, 0.3f, 0.2f, 10,   0.6f, 1.4f,  1,    0.9f, 1.6f,  2,    0.6f, 1.8f,
                        1,    1,    0,    0.2f, 0.5f, -0.2f, 0.3f, 3,    -0.3f, 0.2f, 1,    2.5f});
    }
    static constexpr Matrix identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

TEST_F(ProjectiveTransforms, WhatIsDrawn) {
    const VGPath path = everything();
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    const Bytes expected = drawn(path);
    EXPECT_GT(std::count(expected.begin(), expected.end(), 255), 100);
    const VGPath flat = transformed(path);
    VGfloat box[4];
    vgPathTransformedBounds(path, &box[0], &box[1], &box[2], &box[3]);
    load(VG_MATRIX_PATH_USER_TO_SURFACE, identity);
    expectSame(drawn(flat), expected, 2);
    VGfloat flatBox[4];
    vgPathBounds(flat, &flatBox[0], &flatBox[1], &flatBox[2], &flatBox[3]);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(box[i], flatBox[i], 1e-3);
}

TEST_F(ProjectiveTransforms, WhatAnAffineMapDrawsKeepsWeights) {
    const Matrix skewed{9, 3, 0, -2, 11, 0, 12, 1, 1};
    const VGPath path = everything();
    load(VG_MATRIX_PATH_USER_TO_SURFACE, skewed, false);
    const Bytes expected = drawn(path);
    const VGPath flat = transformed(path);
    EXPECT_EQ(vgGetParameteri(flat, VG_PATH_NUM_SEGMENTS), 9);
    load(VG_MATRIX_PATH_USER_TO_SURFACE, identity);
    expectSame(drawn(flat), expected, 2);
}

TEST_F(ProjectiveTransforms, WhatIsClippedAsAnArea) {
    const VGPath path = everything();
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    const std::vector<VGfloat> lines{1, 0, -6, 0, -1, 20};
    clipBy(lines, VG_CLIPMODE_CLIP_CLOSED_NDS);
    const Bytes expected = drawn(path);
    const VGPath flat = transformed(path);
    clipBy({}, VG_CLIPMODE_NONE_NDS);
    load(VG_MATRIX_PATH_USER_TO_SURFACE, identity);
    expectSame(drawn(flat), expected, 2);
}

TEST_F(ProjectiveTransforms, WhatIsClippedAsALine) {
    // A zigzag across x = 16; nothing joins the pieces.
    const VGPath zigzag = newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS},
                                  {4, 4, 28, 4, 28, 20, 4, 20});
    clipBy({-1, 0, 16}, VG_CLIPMODE_CLIP_OPEN_NDS);
    VGPath cut = transformed(zigzag);
    EXPECT_EQ(vgGetParameteri(cut, VG_PATH_NUM_SEGMENTS), 4);  // two moves, two lines
    EXPECT_NEAR(vgPathLength(cut, 0, 4), 24, 1e-5);
    // A closed one goes on through its start: one line.
    const VGPath closed = rectangle(4, 4, 24, 16);
    cut = transformed(closed);
    EXPECT_EQ(vgGetParameteri(cut, VG_PATH_NUM_SEGMENTS), 4);  // a move, three lines
    EXPECT_NEAR(vgPathLength(cut, 0, 4), 12 + 16 + 12, 1e-5);
    // What lies on one side stays as it is, or goes.
    const VGPath inside = rectangle(4, 4, 8, 16), outside = rectangle(17, 4, 8, 16);
    EXPECT_EQ(vgGetParameteri(transformed(inside), VG_PATH_NUM_SEGMENTS),
              vgGetParameteri(inside, VG_PATH_NUM_SEGMENTS));
    EXPECT_EQ(vgGetParameteri(transformed(outside), VG_PATH_NUM_SEGMENTS), 0);
    // Curves of any degree are cut where they meet the line.
    const VGPath arch = newPath({VG_MOVE_TO_ABS, VG_CUBIC_TO_ABS}, {4, 4, 40, 4, 40, 20, 4, 20});
    cut = transformed(arch);
    EXPECT_EQ(vgGetParameteri(cut, VG_PATH_NUM_SEGMENTS), 4);
    VGfloat x = 0, y = 0, width = 0, height = 0;
    vgPathBounds(cut, &x, &y, &width, &height);
    EXPECT_NEAR(x + width, 16, 1e-4);
    EXPECT_NEAR(height, 16, 1e-4);
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
