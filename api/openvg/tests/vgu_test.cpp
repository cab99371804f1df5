// Section 17: shapes segment by segment, and warps.

#include <cmath>
#include <numbers>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

class VguTest : public VgTest {
protected:
    /// Appends to a path of the specification's segments, to compare.
    static void expectSame(VGPath shape, std::initializer_list<VGubyte> commands,
                           std::initializer_list<VGfloat> numbers) {
        const VGPath expected = newPath(commands, numbers);
        const VGint count = VGint(commands.size());
        ASSERT_EQ(vgGetParameteri(shape, VG_PATH_NUM_SEGMENTS), count);
        ASSERT_EQ(vgGetParameteri(shape, VG_PATH_NUM_COORDS), VGint(numbers.size()));
        for (VGint i = 0; i < count; ++i) {
            SCOPED_TRACE(i);
            EXPECT_NEAR(vgPathLength(shape, i, 1), vgPathLength(expected, i, 1), 1e-4f);
            for (const VGfloat distance : {0.0f, 0.7f, 1e6f}) {
                std::array<VGfloat, 4> a{}, b{};
                vgPointAlongPath(shape, i, 1, distance, &a[0], &a[1], &a[2], &a[3]);
                vgPointAlongPath(expected, i, 1, distance, &b[0], &b[1], &b[2], &b[3]);
                for (std::size_t k = 0; k < 4; ++k)
                    EXPECT_NEAR(a[k], b[k], 1e-4f);
            }
        }
    }
    VGPath path = newPath();
};

TEST_F(VguTest, Line) {
    EXPECT_EQ(vguLine(path, 1, 2, 3, 5), VGU_NO_ERROR);
    expectSame(path, {VG_MOVE_TO_ABS, VG_LINE_TO_ABS}, {1, 2, 3, 5});
}

TEST_F(VguTest, Polygon) {
    const std::array<VGfloat, 6> points{0, 0, 4, 1, 2, 5};
    EXPECT_EQ(vguPolygon(path, points.data(), 3, VG_FALSE), VGU_NO_ERROR);
    expectSame(path, {VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS}, {0, 0, 4, 1, 2, 5});
    vgClearPath(path, VG_PATH_CAPABILITY_ALL);
    EXPECT_EQ(vguPolygon(path, points.data(), 3, VG_TRUE), VGU_NO_ERROR);
    expectSame(path, {VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH}, {0, 0, 4, 1, 2, 5});
}

TEST_F(VguTest, Rectangles) {
    EXPECT_EQ(vguRect(path, 1, 2, 4, 3), VGU_NO_ERROR);
    expectSame(path, {VG_MOVE_TO_ABS, VG_HLINE_TO_REL, VG_VLINE_TO_REL, VG_HLINE_TO_REL, VG_CLOSE_PATH},
               {1, 2, 4, 3, -4});
    vgClearPath(path, VG_PATH_CAPABILITY_ALL);
    EXPECT_EQ(vguRoundRect(path, 1, 2, 10, 6, 4, 2), VGU_NO_ERROR);
    const std::initializer_list<VGubyte> commands{
        VG_MOVE_TO_ABS,  VG_HLINE_TO_REL,   VG_SCCWARC_TO_REL, VG_VLINE_TO_REL,   VG_SCCWARC_TO_REL,
        VG_HLINE_TO_REL, VG_SCCWARC_TO_REL, VG_VLINE_TO_REL,   VG_SCCWARC_TO_REL, VG_CLOSE_PATH};
    expectSame(path, commands,
               {3, 2, 6, 2, 1, 0, 2, 1, 4, 2, 1, 0, -2, 1, -6, 2, 1, 0, -2, -1, -4, 2, 1, 0, 2, -1});
    // Arcs wider than the sides are clamped to them.
    vgClearPath(path, VG_PATH_CAPABILITY_ALL);
    EXPECT_EQ(vguRoundRect(path, 0, 0, 4, 2, 99, 99), VGU_NO_ERROR);
    expectSame(path, commands,
               {2, 0, 0, 2, 1, 0, 2, 1, 0, 2, 1, 0, -2, 1, 0, 2, 1, 0, -2, -1, 0, 2, 1, 0, 2, -1});
}

TEST_F(VguTest, EllipsesAndArcs) {
    EXPECT_EQ(vguEllipse(path, 5, 6, 8, 4), VGU_NO_ERROR);
    expectSame(path, {VG_MOVE_TO_ABS, VG_SCCWARC_TO_REL, VG_SCCWARC_TO_REL, VG_CLOSE_PATH},
               {9, 6, 4, 2, 0, -8, 0, 4, 2, 0, 8, 0});
    const auto half = VGfloat(std::sqrt(0.5));
    const auto arc = [&](VGfloat start, VGfloat extent, VGUArcType type) {
        path = newPath();
        EXPECT_EQ(vguArc(path, 5, 6, 8, 4, start, extent, type), VGU_NO_ERROR);
    };
    arc(0, 45, VGU_ARC_OPEN);
    expectSame(path, {VG_MOVE_TO_ABS, VG_SCCWARC_TO_ABS}, {9, 6, 4, 2, 0, 5 + 4 * half, 6 + 2 * half});
    arc(90, -225, VGU_ARC_CHORD);
    expectSame(path, {VG_MOVE_TO_ABS, VG_SCWARC_TO_ABS, VG_SCWARC_TO_ABS, VG_CLOSE_PATH},
               {5, 8, 4, 2, 0, 5, 4, 4, 2, 0, 5 - 4 * half, 6 - 2 * half});
    arc(0, 270, VGU_ARC_PIE);
    expectSame(path, {VG_MOVE_TO_ABS, VG_SCCWARC_TO_ABS, VG_SCCWARC_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH},
               {9, 6, 4, 2, 0, 1, 6, 4, 2, 0, 5, 4, 5, 6});
    // Angles beyond all measure are taken within a turn, and end.
    arc(4e18f, 1e30f, VGU_ARC_OPEN);
    EXPECT_LE(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), 3000);
}

TEST_F(VguTest, Errors) {
    const VGPath incapable = vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, 0);
    const std::array<VGfloat, 2> point{};
    EXPECT_EQ(vguLine(VG_INVALID_HANDLE, 0, 0, 1, 1), VGU_BAD_HANDLE_ERROR);
    EXPECT_EQ(vguPolygon(incapable, point.data(), 1, VG_TRUE), VGU_PATH_CAPABILITY_ERROR);
    EXPECT_EQ(vguPolygon(path, nullptr, 1, VG_TRUE), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguPolygon(path, point.data(), 0, VG_TRUE), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguRect(path, 0, 0, 0, 1), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguRect(path, 0, 0, 1, std::nanf("")), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguRoundRect(path, 0, 0, 1, -1, 1, 1), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguEllipse(path, 0, 0, 0, 1), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguArc(path, 0, 0, 1, 1, 0, 1, VGUArcType(0)), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguArc(path, 0, 0, -1, 1, 0, 1, VGU_ARC_PIE), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vgGetParameteri(path, VG_PATH_NUM_SEGMENTS), 0);
    std::array<VGfloat, 9> m{};
    EXPECT_EQ(vguComputeWarpSquareToQuad(0, 0, 1, 0, 0, 1, 1, 1, nullptr), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguComputeWarpQuadToSquare(0, 0, 1, 1, 2, 2, 3, 3, m.data()), VGU_BAD_WARP_ERROR);
    EXPECT_EQ(vguComputeWarpQuadToQuad(0, 0, 1, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, m.data()),
              VGU_BAD_WARP_ERROR);
    EXPECT_EQ(vguComputeWarpQuadToQuad(0, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1, nullptr),
              VGU_ILLEGAL_ARGUMENT_ERROR);
}

std::array<double, 2> mapped(const std::array<VGfloat, 9>& m, double x, double y) {
    const auto row = [&](std::size_t r) { return m[r] * x + m[3 + r] * y + m[6 + r]; };
    return {row(0) / row(2), row(1) / row(2)};
}

TEST_F(VguTest, WarpsTakeCornersToCorners) {
    // Section 17.2: (0, 0), (1, 0), (0, 1), (1, 1) belong to the corners in this order.
    const std::array<VGfloat, 8> d{1, 2, 9, 1, 2, 8, 7, 6}, s{-3, 0, 4, -1, -2, 5, 6, 7};
    std::array<VGfloat, 9> m{};
    const auto check = [&](std::array<double, 2> p, double x, double y) {
        EXPECT_NEAR(p[0], x, 1e-4);
        EXPECT_NEAR(p[1], y, 1e-4);
    };
    EXPECT_EQ(vguComputeWarpSquareToQuad(d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], m.data()),
              VGU_NO_ERROR);
    for (int i = 0; i < 4; ++i)
        check(mapped(m, i % 2, i / 2), d[std::size_t(2 * i)], d[std::size_t(2 * i + 1)]);
    EXPECT_EQ(vguComputeWarpQuadToSquare(s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], m.data()),
              VGU_NO_ERROR);
    for (int i = 0; i < 4; ++i)
        check(mapped(m, s[std::size_t(2 * i)], s[std::size_t(2 * i + 1)]), i % 2, i / 2);
    EXPECT_EQ(vguComputeWarpQuadToQuad(d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], s[0], s[1], s[2], s[3],
                                       s[4], s[5], s[6], s[7], m.data()),
              VGU_NO_ERROR);
    for (std::size_t i = 0; i < 8; i += 2)
        check(mapped(m, s[i], s[i + 1]), d[i], d[i + 1]);
    // An affine map stays one.
    EXPECT_EQ(vguComputeWarpSquareToQuad(1, 1, 3, 1, 1, 4, 3, 4, m.data()), VGU_NO_ERROR);
    EXPECT_EQ(m, (std::array<VGfloat, 9>{2, 0, 0, 0, 3, 0, 1, 1, 1}));
}

}  // namespace

}  // namespace vtm::openvg::testing
