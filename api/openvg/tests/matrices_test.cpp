// Section 6.6: matrices.

#include <cmath>
#include <numbers>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

using Matrix = std::array<VGfloat, 9>;  // sx, shy, w0, shx, sy, w1, tx, ty, w2
constexpr Matrix identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

Matrix current() {
    Matrix m{};
    vgGetMatrix(m.data());
    return m;
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix m{};
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t k = 0; k < 3; ++k)
                m[3 * column + row] += a[3 * k + row] * b[3 * column + k];
    return m;
}

void expectNear(const Matrix& a, const Matrix& b) {
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(a[i], b[i], 1e-5f * (1 + std::abs(b[i]))) << "number " << i;
}

using MatricesTest = VgTest;

TEST_F(MatricesTest, EachModeHasItsOwn) {
    for (VGint mode = VG_MATRIX_PATH_USER_TO_SURFACE; mode <= VG_MATRIX_GLYPH_USER_TO_SURFACE; ++mode) {
        vgSeti(VG_MATRIX_MODE, mode);
        EXPECT_EQ(current(), identity);
        vgTranslate(VGfloat(mode), 0);
    }
    for (VGint mode = VG_MATRIX_PATH_USER_TO_SURFACE; mode <= VG_MATRIX_GLYPH_USER_TO_SURFACE; ++mode) {
        vgSeti(VG_MATRIX_MODE, mode);
        EXPECT_EQ(current()[6], VGfloat(mode));
        vgLoadIdentity();
        EXPECT_EQ(current(), identity);
    }
}

TEST_F(MatricesTest, OnlyThatOfImagesIsProjective) {
    const Matrix projective{1, 2, 0.5f, 3, 4, 0.25f, 5, 6, 2}, affine{1, 2, 0, 3, 4, 0, 5, 6, 1};
    for (VGint mode = VG_MATRIX_PATH_USER_TO_SURFACE; mode <= VG_MATRIX_GLYPH_USER_TO_SURFACE; ++mode) {
        const Matrix& kept = mode == VG_MATRIX_IMAGE_USER_TO_SURFACE ? projective : affine;
        vgSeti(VG_MATRIX_MODE, mode);
        vgLoadMatrix(projective.data());
        EXPECT_EQ(current(), kept);
        vgMultMatrix(projective.data());
        expectNear(current(), product(kept, kept));
    }
}

TEST_F(MatricesTest, OperationsMultiplyFromTheRight) {
    Matrix expected{2, 1, 0, -1, 3, 0, 5, 7, 1};
    vgLoadMatrix(expected.data());
    const auto check = [&](const Matrix& factor) {
        expected = product(expected, factor);
        expectNear(current(), expected);
    };
    vgTranslate(3, -4);
    check({1, 0, 0, 0, 1, 0, 3, -4, 1});
    vgScale(2, 0.5f);
    check({2, 0, 0, 0, 0.5f, 0, 0, 0, 1});
    vgShear(0.25f, -0.75f);
    check({1, -0.75f, 0, 0.25f, 1, 0, 0, 0, 1});
    vgRotate(30);
    const auto c = VGfloat(std::cos(std::numbers::pi / 6)), s = VGfloat(std::sin(std::numbers::pi / 6));
    check({c, s, 0, -s, c, 0, 0, 0, 1});
    const Matrix other{1, 2, 0, 3, 4, 0, 5, 6, 1};
    vgMultMatrix(other.data());
    check(other);
}

TEST_F(MatricesTest, DegenerateOnesDrawNothing) {
    // Sections 8.8 and 10.8: what is not invertible draws nothing, and is no error.
    clear({0, 0, 0, 1});
    const VGPath path = rectangle(0, 0, 16, 16);
    vgScale(0, 1);
    vgDrawPath(path, VG_FILL_PATH | VG_STROKE_PATH);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgScale(1, 0);
    vgDrawImage(newImage({{255, 255, 255, 255}}));
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
    for (int x = 0; x < 16; ++x)
        EXPECT_EQ(pixel(x, 0), (Rgba{0, 0, 0, 255}));
}

TEST_F(MatricesTest, SurfaceCoordinatesHaveYUp) {
    // Section 6.4: (0, 0) is the lower left corner, which vtmReadSurface has in its last row.
    const VGPaint white = newPaint({1, 1, 1, 1});
    vgSetPaint(white, VG_FILL_PATH);
    vgDrawPath(rectangle(0, 0, 1, 1), VG_FILL_PATH);
    EXPECT_EQ(pixel(0, 0), (Rgba{255, 255, 255, 255}));
    EXPECT_EQ(pixel(0, 1), (Rgba{0, 0, 0, 0}));
    std::vector<std::uint8_t> bytes(16 * 16 * 4);
    vtmReadSurface(surface, bytes.data(), 16 * 4);
    EXPECT_EQ(bytes[15 * 16 * 4], 255);
    EXPECT_EQ(bytes[14 * 16 * 4], 0);
}

}  // namespace

}  // namespace vtm::openvg::testing
