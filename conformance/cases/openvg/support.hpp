/// \file
/// A current OpenVG context for a case, random affine matrices, and the bounds of all cases.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <VG/vgu.h>
#include <vtm/vg.h>

#include <vtm/scene/affine.hpp>

namespace vtm::cases::openvg {

/// Pixels along each side of the surface.
inline constexpr int side = 96;

/// In 1/255 of coverage. A path's border lies within 1/64 pixel of the true one (docs/architecture.md), which
/// along a pixel's whole side is 4, or 4 · √2 along its diagonal; half a step is rounding. Strokes are the
/// outline of an outline: as much again.
inline constexpr double fillBound = 4 * 1.4143 + 0.5, strokeBound = 2 * fillBound;

/// In 1/255 of a channel: half a step of rounding, and as much for single precision on the way.
inline constexpr double paintBound = 1;

class VgCase : public ::testing::Test {
protected:
    VgCase() {
        // Linear and premultiplied: white on nothing has its coverage as alpha.
        const VtmSurfaceFormat format{8, 8, 8, 8, 0, 0, VG_TRUE, VG_TRUE};
        context_ = vtmCreateContext(nullptr);
        surface_ = vtmCreateSurface(side, side, &format);
        EXPECT_TRUE(vtmMakeCurrent(context_, surface_));
    }
    ~VgCase() override {
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroySurface(surface_);
        vtmDestroyContext(context_);
    }

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

    /// Turned, sheared, half of them mirrored; the middle of a unit square lands near that of the surface.
    scene::Affine randomView(double size) {
        const double angle = uniform(0, 6.2831853), skew = uniform(-0.3, 0.3);
        const double sx = size * uniform(0.5, 1.1), sy = size * uniform(0.5, 1.1) * (random_() % 2 ? -1 : 1);
        const glm::dvec2 x = sx * glm::dvec2(std::cos(angle), std::sin(angle)),
                         y = sy * glm::dvec2(-std::sin(angle + skew), std::cos(angle + skew));
        const glm::dvec2 middle(side / 2.0 + uniform(-3, 3), side / 2.0 + uniform(-3, 3));
        return rounded({x, y, middle - 0.5 * (x + y)});
    }
    /// As OpenVG gets it, and back: both sides see the same numbers.
    static scene::Affine rounded(scene::Affine m) {
        for (int i = 0; i < 3; ++i)
            m[i] = glm::dvec2(glm::vec2(m[i]));
        return m;
    }
    static void load(VGMatrixMode mode, const scene::Affine& m) {
        const std::array<VGfloat, 9> values{VGfloat(m[0].x), VGfloat(m[0].y), 0,
                                            VGfloat(m[1].x), VGfloat(m[1].y), 0,
                                            VGfloat(m[2].x), VGfloat(m[2].y), 1};
        vgSeti(VG_MATRIX_MODE, mode);
        vgLoadMatrix(values.data());
    }
    /// Words of VG_sRGBA_8888_PRE or another, rows from y = 0 on.
    static std::vector<std::uint32_t> pixels(VGImageFormat format) {
        std::vector<std::uint32_t> words(side * side);
        vgReadPixels(words.data(), 4 * side, format, 0, 0, side, side);
        return words;
    }
    static void clear() { vgClear(0, 0, side, side); }
    static void usePaint(VGPaint paint) {
        vgSetPaint(paint, VG_FILL_PATH | VG_STROKE_PATH);
        vgDestroyPaint(paint);
    }
    static VGPaint white() {
        const VGPaint paint = vgCreatePaint();
        vgSetColor(paint, 0xffffffff);
        return paint;
    }

    std::mt19937 random_{2025};  // fixed, so that a failure can be repeated

private:
    VtmContext* context_;
    VtmSurface* surface_;
};

}  // namespace vtm::cases::openvg
