/// \file
/// What the tests of VG_NDS_projective_geometry share.
#pragma once

#include <functional>

#include "api/openvg/tests/extensions_fixture.hpp"

namespace extensions {

using Point = std::array<double, 2>;
/// As vgLoadMatrix takes it.
using Matrix = std::array<VGfloat, 9>;

/// The floor of a room: rows come nearer to each other towards y = 32.
inline constexpr Matrix floorMatrix{16, 0, 0, 16, 32, 1, 0, 0, 1};

inline Point mapped(const Matrix& m, double x, double y) {
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

}  // namespace extensions
