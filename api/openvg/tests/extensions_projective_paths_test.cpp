// VG_NDS_projective_geometry: rational curves, and paths transformed in perspective.

#include "api/openvg/tests/extensions_projective_fixture.hpp"

namespace extensions {
namespace {

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

// What is kept of a path serves one matrix, one set of clip lines and one state of its data.
TEST_F(ProjectiveTransforms, WhatIsDrawnAgain) {
    const VGPath path = everything(), other = everything();
    Matrix nearer = floorMatrix;
    nearer[7] += 2;
    const std::vector<VGfloat> lines{1, 0, -6, 0, -1, 20};
    load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
    const Bytes far = drawn(other);
    load(VG_MATRIX_PATH_USER_TO_SURFACE, nearer);
    const Bytes near = drawn(other);
    clipBy(lines, VG_CLIPMODE_CLIP_CLOSED_NDS);
    const Bytes cut = drawn(other);
    clipBy({}, VG_CLIPMODE_NONE_NDS);
    EXPECT_NE(far, near);
    EXPECT_NE(near, cut);
    for (int round = 0; round < 2; ++round) {
        for (int again = 0; again < 3; ++again) {
            load(VG_MATRIX_PATH_USER_TO_SURFACE, floorMatrix);
            expectSame(drawn(path), far);
        }
        load(VG_MATRIX_PATH_USER_TO_SURFACE, nearer);
        expectSame(drawn(path), near);
        clipBy(lines, VG_CLIPMODE_CLIP_CLOSED_NDS);
        expectSame(drawn(path), cut);
        expectSame(drawn(path), cut);
        clipBy({}, VG_CLIPMODE_NONE_NDS);
        expectSame(drawn(path), near);
    }
    vgClearPath(path, VG_PATH_CAPABILITY_ALL);
    EXPECT_EQ(drawn(path), Bytes(far.size(), 0));
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

}  // namespace
}  // namespace extensions
