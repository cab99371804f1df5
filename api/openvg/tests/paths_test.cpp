// Section 8: path data, capabilities, transformation, interpolation, measures.

#include <cmath>
#include <numbers>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

struct Bounds {
    VGfloat x, y, width, height;
    friend bool operator==(const Bounds&, const Bounds&) = default;
};
Bounds boundsOf(VGPath path) {
    Bounds b{};
    vgPathBounds(path, &b.x, &b.y, &b.width, &b.height);
    return b;
}
void expectBounds(VGPath path, Bounds expected, VGfloat tolerance = 1e-5f) {
    const Bounds b = boundsOf(path);
    EXPECT_NEAR(b.x, expected.x, tolerance);
    EXPECT_NEAR(b.y, expected.y, tolerance);
    EXPECT_NEAR(b.width, expected.width, tolerance);
    EXPECT_NEAR(b.height, expected.height, tolerance);
}
VGfloat lengthOf(VGPath path) { return vgPathLength(path, 0, vgGetParameteri(path, VG_PATH_NUM_SEGMENTS)); }

struct PointAndTangent {
    VGfloat x, y, tx, ty;
};
PointAndTangent along(VGPath path, VGfloat distance, VGint first = 0, VGint count = 0) {
    PointAndTangent p{};
    vgPointAlongPath(path, first, count != 0 ? count : vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), distance,
                     &p.x, &p.y, &p.tx, &p.ty);
    return p;
}
void expectPoint(const PointAndTangent& p, PointAndTangent expected, VGfloat tolerance = 1e-4f) {
    EXPECT_NEAR(p.x, expected.x, tolerance);
    EXPECT_NEAR(p.y, expected.y, tolerance);
    EXPECT_NEAR(p.tx, expected.tx, tolerance);
    EXPECT_NEAR(p.ty, expected.ty, tolerance);
}

using PathsTest = VgTest;

TEST_F(PathsTest, EveryDatatypeIsScaledAndBiased) {
    // Section 8.5.3: coordinate = scale * number + bias.
    const std::array<VGubyte, 2> commands{VG_MOVE_TO_ABS, VG_LINE_TO_ABS};
    const auto check = [&](VGPathDatatype type, const void* data) {
        const VGPath path = newPath(type, 0.5f, -3);
        vgAppendPathData(path, 2, commands.data(), data);
        expectBounds(path, {-53, 47, 100, 13.5f});
    };
    const std::array<VGbyte, 4> bytes{-100, 100, 100, 127};
    check(VG_PATH_DATATYPE_S_8, bytes.data());
    const std::array<VGshort, 4> shorts{-100, 100, 100, 127};
    check(VG_PATH_DATATYPE_S_16, shorts.data());
    const std::array<VGint, 4> integers{-100, 100, 100, 127};
    check(VG_PATH_DATATYPE_S_32, integers.data());
    const std::array<VGfloat, 4> floats{-100, 100, 100, 127};
    check(VG_PATH_DATATYPE_F, floats.data());
}

TEST_F(PathsTest, AppendedPathsAreRoundedAndSaturated) {
    // Sections 8.6.5 and 8.6.2: coordinates are put into the destination's format.
    const VGPath from = newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS}, {-1000, 2.4f, 10.6f, 1000});
    const VGPath to = newPath(VG_PATH_DATATYPE_S_8, 2, 0);
    vgAppendPath(to, from);
    expectBounds(to, {-256, 2, 266, 252});
    EXPECT_EQ(vgGetParameteri(to, VG_PATH_NUM_COORDS), 4);
    vgAppendPath(from, from);
    EXPECT_EQ(vgGetParameteri(from, VG_PATH_NUM_SEGMENTS), 4);
}

TEST_F(PathsTest, RelativeAndSmoothCommands) {
    // Table 6. The same outline, absolute and relative.
    const VGPath absolute = newPath(
        {VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_HLINE_TO_ABS, VG_VLINE_TO_ABS, VG_QUAD_TO_ABS, VG_SQUAD_TO_ABS,
         VG_CUBIC_TO_ABS, VG_SCUBIC_TO_ABS, VG_SCCWARC_TO_ABS, VG_CLOSE_PATH},
        {1, 2, 4, 6, 9, -3, 11, 0, 12, 4, 15, 9, 16, 10, 17, 12, 20, 13, 22, 16, 24, 10, 5, 5, 30, 28, 12});
    const VGPath relative =
        newPath({VG_MOVE_TO_REL, VG_LINE_TO_REL, VG_HLINE_TO_REL, VG_VLINE_TO_REL, VG_QUAD_TO_REL,
                 VG_SQUAD_TO_REL, VG_CUBIC_TO_REL, VG_SCUBIC_TO_REL, VG_SCCWARC_TO_REL, VG_CLOSE_PATH},
                {1, 2, 3, 4, 5, -9, 2, 3, 3, 7, 3, 5, 1, 1, 2, 3, 5, 4, 2, 3, 4, -3, 5, 5, 30, 4, 2});
    const VGPath explicitly =
        newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_QUAD_TO_ABS,
                 VG_QUAD_TO_ABS, VG_CUBIC_TO_ABS, VG_CUBIC_TO_ABS, VG_SCCWARC_TO_ABS, VG_LINE_TO_ABS},
                {1,  2,  4,  6,  9,  6,  9,  -3, 11, 0,  12, 4, 13, 8,  15, 9, 16, 10,
                 17, 12, 20, 13, 23, 14, 22, 16, 24, 10, 5,  5, 30, 28, 12, 1, 2});
    for (VGint i = 0; i < 10; ++i) {
        SCOPED_TRACE(i);
        EXPECT_NEAR(vgPathLength(absolute, i, 1), vgPathLength(explicitly, i, 1), 1e-4f);
        EXPECT_NEAR(vgPathLength(relative, i, 1), vgPathLength(explicitly, i, 1), 1e-4f);
        if (i == 0)
            continue;
        const PointAndTangent expected = along(explicitly, 1.5f, i, 1);
        expectPoint(along(absolute, 1.5f, i, 1), expected);
        expectPoint(along(relative, 1.5f, i, 1), expected);
    }
    // The length of the arc: an eighth part check by its chord and radius.
    const double chord = std::hypot(4, 2);
    EXPECT_NEAR(vgPathLength(absolute, 8, 1), 2 * 5 * std::asin(chord / 10), 1e-4);
}

TEST_F(PathsTest, CapabilitiesCanOnlyBeTakenAway) {
    const VGPath path = newPath();
    EXPECT_EQ(vgGetPathCapabilities(path), VGbitfield(VG_PATH_CAPABILITY_ALL));
    vgRemovePathCapabilities(path, VG_PATH_CAPABILITY_MODIFY | 1u << 20);
    EXPECT_EQ(vgGetPathCapabilities(path), VGbitfield(VG_PATH_CAPABILITY_ALL & ~VG_PATH_CAPABILITY_MODIFY));
    append(path, {VG_MOVE_TO_ABS}, {3, 4});
    vgClearPath(path, VG_PATH_CAPABILITY_MODIFY | 1u << 20);
    EXPECT_EQ(vgGetPathCapabilities(path), VGbitfield(VG_PATH_CAPABILITY_MODIFY));
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), 0);
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_COORDS), 0);
}

TEST_F(PathsTest, ModifiedCoordinatesAreDrawn) {
    const VGPath path =
        newPath({VG_MOVE_TO_ABS, VG_HLINE_TO_ABS, VG_VLINE_TO_ABS, VG_CLOSE_PATH}, {1, 1, 5, 5});
    vgDrawPath(path, VG_FILL_PATH);
    const std::array<VGfloat, 2> data{9, 9};
    vgModifyPathCoords(path, 1, 3, data.data());
    expectBounds(path, {1, 1, 8, 8});
    clear({0, 0, 0, 0});
    vgDrawPath(path, VG_FILL_PATH);
    EXPECT_EQ(pixel(8, 3)[3], 255);
}

TEST_F(PathsTest, TransformKeepsKinds) {
    // Section 8.6.8: axis-parallel lines become lines, relative commands stay relative.
    vgTranslate(10, 20);
    vgScale(2, 3);
    vgRotate(90);
    const VGPath from = newPath({VG_MOVE_TO_ABS, VG_HLINE_TO_REL, VG_VLINE_TO_ABS, VG_SCCWARC_TO_REL},
                                {1, 2, 3, 5, 1, 1, 0, 2, 0});
    const VGPath to = newPath();
    vgTransformPath(to, from);
    EXPECT_EQ(vgGetParameteri(to, VG_PATH_NUM_SEGMENTS), 4);
    EXPECT_EQ(vgGetParameteri(to, VG_PATH_NUM_COORDS), 2 + 2 + 2 + 5);
    Bounds b{};
    vgPathTransformedBounds(from, &b.x, &b.y, &b.width, &b.height);
    expectBounds(to, b, 1e-3f);
    // By hand: (x, y) to (10 - 2 y, 20 + 3 x).
    vgLoadIdentity();
    expectPoint(along(to, 0), {6, 23, 0, 1});
    EXPECT_NEAR(vgPathLength(to, 1, 1), 9, 1e-4f);
    EXPECT_NEAR(vgPathLength(to, 2, 1), 6, 1e-4f);
    expectBounds(to, {0, 23, 6, 15}, 1e-3f);
}

TEST_F(PathsTest, InterpolationBlendsLikeSegments) {
    // Section 8.6.9: quadratic curves are raised, all arcs are of one kind, amounts may leave [0, 1].
    const VGPath a = newPath({VG_MOVE_TO_ABS, VG_HLINE_TO_ABS, VG_QUAD_TO_ABS, VG_SCWARC_TO_ABS},
                             {0, 0, 4, 5, 1, 6, 2, 1, 2, 0, 8, 2});
    const VGPath b = newPath({VG_MOVE_TO_REL, VG_LINE_TO_REL, VG_CUBIC_TO_REL, VG_LCCWARC_TO_ABS},
                             {2, 2, 4, 0, 0, 0, 1, 1, 2, 2, 3, 2, 0, 12, 6});
    for (const VGfloat amount : {0.0f, 0.25f, 0.5f, 1.0f, 2.0f, -1.0f}) {
        const VGPath to = newPath();
        EXPECT_EQ(vgInterpolatePath(to, a, b, amount), VG_TRUE);
        EXPECT_EQ(vgGetParameteri(to, VG_PATH_NUM_COORDS), 2 + 2 + 6 + 5);
        const PointAndTangent start = along(to, 0, 1, 1), end = along(to, 1000, 1, 1);
        EXPECT_NEAR(start.x, 2 * amount, 1e-4f);
        EXPECT_NEAR(end.x, 4 + 2 * amount, 1e-4f);
        EXPECT_NEAR(along(to, 1000, 3, 1).y, 2 + 4 * amount, 1e-3f);
    }
    const VGPath to = newPath();
    EXPECT_EQ(vgInterpolatePath(to, a, newPath({VG_MOVE_TO_ABS}, {0, 0}), 0.5f), VG_FALSE);
    const VGPath other =
        newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS}, {0, 0, 1, 1, 2, 2, 3, 3});
    EXPECT_EQ(vgInterpolatePath(to, a, other, 0.5f), VG_FALSE);
    EXPECT_EQ(vgGetParameteri(to, VG_PATH_NUM_SEGMENTS), 0) << "nothing is appended";
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(PathsTest, LengthsOfKnownCurves) {
    // y = x² from 0 to 1: sqrt(5) / 2 + asinh(2) / 4.
    EXPECT_NEAR(lengthOf(newPath({VG_MOVE_TO_ABS, VG_QUAD_TO_ABS}, {0, 0, 0.5f, 0, 1, 1})),
                std::sqrt(5.0) / 2 + std::asinh(2.0) / 4, 1e-5);
    EXPECT_NEAR(lengthOf(newPath({VG_MOVE_TO_ABS, VG_CUBIC_TO_ABS}, {0, 0, 1, 1, 2, 2, 3, 3})),
                3 * std::sqrt(2.0), 1e-5);
    const VGPath circle = newPath();
    vguEllipse(circle, 3, 4, 10, 10);
    EXPECT_NEAR(lengthOf(circle), 10 * std::numbers::pi, 1e-4);
    // Moves have none, closing has that of its line.
    const VGPath triangle =
        newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH, VG_MOVE_TO_ABS},
                {0, 0, 3, 0, 3, 4, 100, 100});
    EXPECT_NEAR(lengthOf(triangle), 12, 1e-5);
    EXPECT_EQ(vgPathLength(triangle, 4, 1), 0);
    EXPECT_NEAR(vgPathLength(triangle, 1, 2), 7, 1e-5);
    // Radii that do not reach are grown (section 8.4): half a circle about the middle.
    EXPECT_NEAR(lengthOf(newPath({VG_MOVE_TO_ABS, VG_SCCWARC_TO_ABS}, {0, 0, 1, 1, 0, 10, 0})),
                5 * std::numbers::pi, 1e-4);
    EXPECT_NEAR(lengthOf(newPath({VG_MOVE_TO_ABS, VG_LCWARC_TO_ABS}, {0, 0, 0, 5, 0, 3, 4})), 5, 1e-5)
        << "radius 0: a line";
}

TEST_F(PathsTest, PointsAlong) {
    const VGPath path =
        newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_MOVE_TO_ABS, VG_VLINE_TO_ABS}, {0, 0, 10, 0, 20, 0, 5});
    expectPoint(along(path, -5), {0, 0, 1, 0});
    expectPoint(along(path, 4), {4, 0, 1, 0});
    expectPoint(along(path, 12), {20, 2, 0, 1});
    expectPoint(along(path, 1000), {20, 5, 0, 1});
    const VGPath arc = newPath({VG_MOVE_TO_ABS, VG_SCCWARC_TO_ABS}, {5, 0, 5, 5, 0, 0, 5});
    const auto half = VGfloat(std::sqrt(0.5));
    expectPoint(along(arc, VGfloat(5 * std::numbers::pi / 4)), {5 * half, 5 * half, -half, half});
    // Outputs that are not wanted may be left out.
    VGfloat x = -1, y = -1;
    vgPointAlongPath(path, 0, 4, 4, &x, &y, nullptr, nullptr);
    EXPECT_EQ(x, 4);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

TEST_F(PathsTest, BoundsAreTight) {
    // Section 8.6.12. Extremes: of the parabola at t = 1/2, of the cubic at t = 1/2 too, of the circle all
    // around.
    expectBounds(newPath({VG_MOVE_TO_ABS, VG_QUAD_TO_ABS}, {0, 0, 2, 4, 4, 0}), {0, 0, 4, 2});
    expectBounds(newPath({VG_MOVE_TO_ABS, VG_CUBIC_TO_ABS}, {0, 0, 0, 4, 4, 4, 4, 0}), {0, 0, 4, 3});
    const VGPath circle = newPath();
    vguEllipse(circle, 3, 4, 10, 6);
    expectBounds(circle, {-2, 1, 10, 6});
    expectBounds(newPath({VG_MOVE_TO_ABS, VG_SCCWARC_TO_ABS}, {5, 0, 5, 5, 0, 0, 5}), {0, 0, 5, 5});
    const Bounds none = boundsOf(newPath());
    EXPECT_EQ(none.width, -1);
    EXPECT_EQ(none.height, -1);
    expectBounds(newPath({VG_MOVE_TO_ABS}, {7, 8}), {7, 8, 0, 0});
    vgRotate(45);
    Bounds b{};
    vgPathTransformedBounds(rectangle(-1, -1, 2, 2), &b.x, &b.y, &b.width, &b.height);
    EXPECT_NEAR(b.x, -std::sqrt(2.0f), 1e-5f);
    EXPECT_NEAR(b.height, 2 * std::sqrt(2.0f), 1e-5f);
}

TEST_F(PathsTest, DoubleOnlySoOften) {
    const VGPath path = newPath({VG_MOVE_TO_ABS, VG_HLINE_TO_REL}, {0, 0, 1});
    VGErrorCode error = VG_NO_ERROR;
    VGint before = 0;
    for (int i = 0; i < 30 && error == VG_NO_ERROR; ++i) {
        before = vgGetParameteri(path, VG_PATH_NUM_SEGMENTS);
        vgAppendPath(path, path);
        error = vgGetError();
    }
    EXPECT_EQ(error, VG_OUT_OF_MEMORY_ERROR);
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), before);
    EXPECT_EQ(before, 1 << 20);
    EXPECT_VG_ERROR(VG_OUT_OF_MEMORY_ERROR, vgTransformPath(path, path));
    EXPECT_VG_ERROR(VG_OUT_OF_MEMORY_ERROR, vgInterpolatePath(path, path, path, 0.5f));
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), before);
    vgDestroyPath(path);
}

TEST_F(PathsTest, OfDashesOnlyThoseInViewCount) {
    // 50 000 dashes, of which the view shows one and a gap.
    clear({0, 0, 0, 1});
    vgSetPaint(newPaint({1, 1, 1, 1}), VG_STROKE_PATH);
    const VGPath path = newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS}, {-25000, 0.5f, 25000, 0.5f});
    const std::array<VGfloat, 2> dashes{0.5f, 0.5f};
    vgSetfv(VG_STROKE_DASH_PATTERN, 2, dashes.data());
    vgSetf(VG_STROKE_LINE_WIDTH, 0.5f);
    vgScale(16, 16);
    vgDrawPath(path, VG_STROKE_PATH);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(pixel(x, y)[0], x < 8 && y >= 4 && y < 12 ? 255 : 0) << x << ' ' << y;
}

TEST_F(PathsTest, HaveNotTooManyDashes) {
    const VGPath path = newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS}, {0, 8, 16, 8});
    const std::array<VGfloat, 2> few{1e-3f, 1e-3f}, many{1e-5f, 1e-5f};
    vgSetPaint(newPaint({1, 1, 1, 1}), VG_STROKE_PATH);
    vgSetf(VG_STROKE_LINE_WIDTH, 4);
    vgSetfv(VG_STROKE_DASH_PATTERN, 2, many.data());
    EXPECT_VG_ERROR(VG_OUT_OF_MEMORY_ERROR, vgDrawPath(path, VG_STROKE_PATH));
    vgSetfv(VG_STROKE_DASH_PATTERN, 2, few.data());
    EXPECT_VG_ERROR(VG_NO_ERROR, vgDrawPath(path, VG_STROKE_PATH));
    EXPECT_NEAR(pixel(8, 8)[3], 128, 4);
}

TEST_F(PathsTest, WildMatricesEnd) {
    // A shear by 1e28 makes of two pixels of the path more than doubles can tell apart.
    const VGPath path = newPath({VG_MOVE_TO_ABS, VG_CUBIC_TO_ABS, VG_CUBIC_TO_ABS, VG_CLOSE_PATH},
                                {0, 40, -2.5f, 31.25f, -1.25f, 46.25f, -1.25f, -1.25f, -1.25f, -48.75f,
                                 40957.5f, 48.75f, -1.25f, 51.25f});
    const VGfloat matrix[] = {0.25f, 1.2f, 0, -2.9e26f, 1.46e28f, 0, 1.5f, -1.1f, 1};
    vgLoadMatrix(matrix);
    EXPECT_VG_ERROR(VG_NO_ERROR, vgDrawPath(path, VG_FILL_PATH));
}

TEST_F(PathsTest, WildNumbersEnd) {
    // Section 3.3: no number may stop the program.
    const VGfloat huge = 3e38f, nan = std::nanf(""), inf = std::numeric_limits<VGfloat>::infinity();
    vgSetf(VG_STROKE_LINE_WIDTH, 3);
    const std::array<VGfloat, 2> dashes{1e-6f, 1e-6f};
    for (const VGfloat v : {huge, -huge, nan, inf, -inf, 1e-40f}) {
        const VGPath path =
            newPath({VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_QUAD_TO_REL, VG_SCCWARC_TO_ABS, VG_CUBIC_TO_ABS},
                    {0, 0, v, 4, v, -v, 8, v, v, 5, v, 3, v, v, 1, 2, v, 9, 9, 9});
        for (const VGint quality : {VG_RENDERING_QUALITY_NONANTIALIASED, VG_RENDERING_QUALITY_BETTER}) {
            vgSeti(VG_RENDERING_QUALITY, quality);
            vgSetfv(VG_STROKE_DASH_PATTERN, 0, nullptr);
            vgDrawPath(path, VG_FILL_PATH | VG_STROKE_PATH);
            vgSetfv(VG_STROKE_DASH_PATTERN, 2, dashes.data());
            vgDrawPath(path, VG_STROKE_PATH);
        }
        boundsOf(path);
        lengthOf(path);
        along(path, v);
        vguArc(newPath(), v, v, 1, 1, v, v, VGU_ARC_PIE);
    }
    // Scales and biases that are no numbers.
    for (const auto& [scale, bias] : {std::pair(inf, 0.0f), std::pair(1.0f, nan), std::pair(-inf, inf)}) {
        const VGPath path = newPath(VG_PATH_DATATYPE_F, scale, bias);
        append(path, {VG_MOVE_TO_ABS, VG_QUAD_TO_ABS, VG_CUBIC_TO_ABS}, {0, 1, 2, 0, 3, 4, 0, 5, 6, 0, 7, 8});
        vgDrawPath(path, VG_FILL_PATH | VG_STROKE_PATH);
        EXPECT_FALSE(std::isnan(boundsOf(path).x));
    }
    // All of a path too small for its width.
    for (const VGfloat v : {1e-40f, 1e-37f, 1e-20f}) {
        vgSetfv(VG_STROKE_DASH_PATTERN, 0, nullptr);
        vgDrawPath(
            newPath({VG_MOVE_TO_ABS, VG_QUAD_TO_ABS, VG_CUBIC_TO_ABS, VG_SCCWARC_TO_ABS, VG_LCWARC_TO_ABS},
                    {v,      0, 3 * v, v, 9 * v, 2 * v, v, v, -v, 8 * v, 7 * v,
                     -5 * v, v, 2 * v, 9, v,     v,     v, v, 0,  9 * v, 0}),
            VG_STROKE_PATH);
    }
    EXPECT_NE(vgGetError(), VG_BAD_HANDLE_ERROR);
}

}  // namespace

}  // namespace vtm::openvg::testing
