// Section 13, and section 10.8: blend modes on all surfaces, colour transformation, image modes.

#include <algorithm>
#include <cmath>

#include "api/openvg/tests/fixture.hpp"

namespace vtm::openvg::testing {

namespace {

using Color = std::array<double, 4>;

/// Tables 15 and 16 and section 13.5, colours and results without premultiplied alpha.
Color blended(VGint mode, const Color& s, const Color& d) {
    const double sa = s[3], da = d[3];
    double alpha = sa + da * (1 - sa);
    Color result{};
    const auto colors = [&](auto&& premultiplied) {
        for (std::size_t c = 0; c < 3; ++c)
            result[c] = alpha > 0 ? std::min(premultiplied(sa * s[c], da * d[c]) / alpha, 1.0) : 0;
    };
    const auto porterDuff = [&](double fs, double fd) {
        alpha = sa * fs + da * fd;
        colors([&](double a, double b) { return a * fs + b * fd; });
    };
    const auto over = [&](double a, double b) { return a + b * (1 - sa); };
    const auto under = [&](double a, double b) { return b + a * (1 - da); };
    switch (mode) {
        case VG_BLEND_SRC:
            porterDuff(1, 0);
            break;
        case VG_BLEND_SRC_OVER:
            porterDuff(1, 1 - sa);
            break;
        case VG_BLEND_DST_OVER:
            porterDuff(1 - da, 1);
            break;
        case VG_BLEND_SRC_IN:
            porterDuff(da, 0);
            break;
        case VG_BLEND_DST_IN:
            porterDuff(0, sa);
            break;
        case VG_BLEND_MULTIPLY:
            colors([&](double a, double b) { return a * (1 - da) + b * (1 - sa) + a * b; });
            break;
        case VG_BLEND_SCREEN:
            colors([](double a, double b) { return a + b - a * b; });
            break;
        case VG_BLEND_DARKEN:
            colors([&](double a, double b) { return std::min(over(a, b), under(a, b)); });
            break;
        case VG_BLEND_LIGHTEN:
            colors([&](double a, double b) { return std::max(over(a, b), under(a, b)); });
            break;
        default:
            alpha = std::min(sa + da, 1.0);
            colors([](double a, double b) { return a + b; });
            break;
    }
    result[3] = alpha;
    return result;
}

Color unitOf(Rgba c) { return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, c[3] / 255.0}; }
Rgba bytesOf(const Color& c) {
    Rgba bytes;
    for (std::size_t i = 0; i < 4; ++i)
        bytes[i] = int(std::floor(std::clamp(c[i], 0.0, 1.0) * 255 + 0.5));
    return bytes;
}
std::array<VGfloat, 4> floatsOf(Rgba c) {
    return {VGfloat(c[0]) / 255, VGfloat(c[1]) / 255, VGfloat(c[2]) / 255, VGfloat(c[3]) / 255};
}

const std::vector<Rgba> colors{{255, 255, 255, 255}, {0, 0, 0, 0},      {200, 100, 50, 255},
                               {30, 60, 90, 128},    {255, 0, 128, 64}, {0, 255, 0, 200}};

class BlendingTest : public VgTest {
protected:
    BlendingTest() { vgSetPaint(paint, VG_FILL_PATH); }
    void drawPixel(Rgba color) {
        const std::array<VGfloat, 4> c = floatsOf(color);
        vgSetParameterfv(paint, VG_PAINT_COLOR, 4, c.data());
        vgDrawPath(square, VG_FILL_PATH);
    }
    /// Every mode with every pair of colours, read and written as `format`, which has the surface's numbers.
    void checkModes(VGImageFormat format, bool hasAlpha, int levels) {
        for (VGint mode = VG_BLEND_SRC; mode <= VG_BLEND_ADDITIVE; ++mode)
            for (const Rgba& source : colors)
                for (const Rgba& destination : colors) {
                    setPixel(0, 0, destination, format);
                    Color d = unitOf(pixel(0, 0, format));
                    if (!hasAlpha)
                        d[3] = 1;
                    vgSeti(VG_BLEND_MODE, mode);
                    drawPixel(source);
                    Color expected = blended(mode, unitOf(source), d);
                    // Where alpha is not stored, what is left of a colour is multiplied by it.
                    if (!hasAlpha)
                        for (std::size_t c = 0; c < 3; ++c)
                            expected[c] = expected[3] > 0 ? expected[c] : 0;
                    Rgba result = pixel(0, 0, format), wanted = bytesOf(expected);
                    if (!hasAlpha)
                        result[3] = wanted[3] = 255;
                    EXPECT_TRUE(isNear(result, wanted, 255 / levels / 2 + 1))
                        << "mode " << mode << ", " << ::testing::PrintToString(source) << " on "
                        << ::testing::PrintToString(destination);
                }
        EXPECT_EQ(vgGetError(), VG_NO_ERROR);
    }

    VGPaint paint = vgCreatePaint();
    VGPath square = rectangle(0, 0, 1, 1);
};

TEST_F(BlendingTest, ModesOnNonLinearSurfaces) { checkModes(VG_sRGBA_8888, true, 255); }

TEST_F(BlendingTest, ModesOnFewerBits) {
    useSurface(4, 4, {4, 4, 4, 4, 0, 0, VG_FALSE, VG_FALSE});
    checkModes(VG_sRGBA_8888, true, 15);
}

TEST_F(BlendingTest, ModesOnPremultipliedSurfaces) {
    // Numbers of small alphas are coarse: compared as they are stored.
    VtmSurfaceFormat format = sRGBA8888;
    format.premultiplied = VG_TRUE;
    useSurface(4, 4, format);
    for (VGint mode = VG_BLEND_SRC; mode <= VG_BLEND_ADDITIVE; ++mode)
        for (const Rgba& source : colors)
            for (const Rgba& destination : colors) {
                setPixel(0, 0, destination);
                const Rgba stored = pixel(0, 0, VG_sRGBA_8888_PRE);
                Color d = unitOf(stored);
                for (std::size_t c = 0; c < 3; ++c)
                    d[c] = d[3] > 0 ? d[c] / d[3] : 0;
                vgSeti(VG_BLEND_MODE, mode);
                drawPixel(source);
                Color expected = blended(mode, unitOf(source), d);
                for (std::size_t c = 0; c < 3; ++c)
                    expected[c] *= expected[3];
                EXPECT_TRUE(isNear(pixel(0, 0, VG_sRGBA_8888_PRE), bytesOf(expected), 1)) << mode;
            }
}

TEST_F(BlendingTest, ModesOnLinearSurfaces) {
    // Paints are sRGB: the surface blends their light.
    useSurface(4, 4, {8, 8, 8, 8, 0, 0, VG_TRUE, VG_FALSE});
    const auto decoded = [](double x) {
        return x <= 0.03928 ? x / 12.92 : std::pow((x + 0.0556) / 1.0556, 2.4);
    };
    for (VGint mode = VG_BLEND_SRC; mode <= VG_BLEND_ADDITIVE; ++mode)
        for (const Rgba& source : colors)
            for (const Rgba& destination : colors) {
                setPixel(0, 0, destination, VG_lRGBA_8888);
                vgSeti(VG_BLEND_MODE, mode);
                drawPixel(source);
                Color s = unitOf(source);
                for (std::size_t c = 0; c < 3; ++c)
                    s[c] = decoded(s[c]);
                EXPECT_TRUE(
                    isNear(pixel(0, 0, VG_lRGBA_8888), bytesOf(blended(mode, s, unitOf(destination))), 1))
                    << mode;
            }
}

TEST_F(BlendingTest, SurfacesWithoutAlphaCountAsOpaque) {
    VtmSurfaceFormat format = sRGBA8888;
    format.alphaBits = 0;
    useSurface(4, 4, format);
    checkModes(VG_sRGBX_8888, false, 255);
    useSurface(4, 4, {5, 6, 5, 0, 0, 0, VG_FALSE, VG_FALSE});
    checkModes(VG_sRGBX_8888, false, 31);
}

TEST_F(BlendingTest, AlphaSurfaces) {
    useSurface(4, 4, {0, 0, 0, 8, 0, 0, VG_FALSE, VG_FALSE});
    for (VGint mode = VG_BLEND_SRC; mode <= VG_BLEND_ADDITIVE; ++mode)
        for (const Rgba& source : colors) {
            setPixel(0, 0, {0, 0, 0, 77});
            vgSeti(VG_BLEND_MODE, mode);
            drawPixel(source);
            EXPECT_NEAR(pixel(0, 0)[3], 255 * blended(mode, unitOf(source), {1, 1, 1, 77 / 255.0})[3], 1)
                << mode;
        }
}

TEST_F(BlendingTest, CoverageMixesLight) {
    // Section 2.8: half of a pixel that is white on black has half the light.
    setPixel(0, 0, {0, 0, 0, 255});
    vgTranslate(0.5f, 0);
    drawPixel({255, 255, 255, 255});
    const Rgba light = pixel(0, 0, VG_lRGBA_8888);
    EXPECT_TRUE(isNear(light, {128, 128, 128, 255}, 2));
}

// ---- Section 13.1 ---------------------------------------------------------------------------------

TEST_F(BlendingTest, ColorTransformation) {
    vgSeti(VG_BLEND_MODE, VG_BLEND_SRC);
    const Rgba source{200, 100, 50, 128};
    const auto check = [&](std::array<VGfloat, 8> values) {
        vgSetfv(VG_COLOR_TRANSFORM_VALUES, 8, values.data());
        vgSeti(VG_COLOR_TRANSFORM, VG_TRUE);
        drawPixel(source);
        Color expected{};
        for (std::size_t c = 0; c < 4; ++c)
            expected[c] = std::clamp(unitOf(source)[c] * std::clamp(double(values[c]), -127.0, 127.0) +
                                         std::clamp(double(values[4 + c]), -1.0, 1.0),
                                     0.0, 1.0);
        EXPECT_TRUE(isNear(pixel(0, 0), bytesOf(expected), 1));
        vgSeti(VG_COLOR_TRANSFORM, VG_FALSE);
        drawPixel(source);
        EXPECT_TRUE(isNear(pixel(0, 0), source, 1));
    };
    check({1, 1, 1, 1, 0, 0, 0, 0});
    check({0.5f, 2, -1, 1, 0.1f, 0, 0.9f, 0.25f});
    check({1e9f, -1e9f, 0, 1, 0, 5, -5, 0});
    check({1, 1, 1, 0.5f, 0, 0, 0, 0.5f});
}

// ---- Section 10.8 ---------------------------------------------------------------------------------

TEST_F(BlendingTest, MultipliedImages) {
    vgSeti(VG_BLEND_MODE, VG_BLEND_SRC);
    vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_MULTIPLY);
    for (const Rgba& p : colors)
        for (const Rgba& i : colors) {
            const std::array<VGfloat, 4> c = floatsOf(p);
            vgSetParameterfv(paint, VG_PAINT_COLOR, 4, c.data());
            const VGImage image = newImage({i});
            vgDrawImage(image);
            vgDestroyImage(image);
            Color product{};
            for (std::size_t k = 0; k < 4; ++k)
                product[k] = unitOf(p)[k] * unitOf(i)[k];
            if (product[3] == 0)
                product = {};
            EXPECT_TRUE(isNear(pixel(0, 0), bytesOf(product), 1));
        }
}

TEST_F(BlendingTest, StenciledImages) {
    vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_STENCIL);
    for (const Rgba& p : colors)
        for (const Rgba& i : colors)
            for (const Rgba& d : colors) {
                setPixel(0, 0, d);
                const std::array<VGfloat, 4> c = floatsOf(p);
                vgSetParameterfv(paint, VG_PAINT_COLOR, 4, c.data());
                const VGImage image = newImage({i});
                vgDrawImage(image);
                vgDestroyImage(image);
                // The equations for VG_BLEND_SRC_OVER.
                const Color pc = unitOf(p), ic = unitOf(i), dc = unitOf(d);
                const double a = ic[3] * pc[3], alpha = a + dc[3] * (1 - a);
                Color expected{0, 0, 0, alpha};
                for (std::size_t k = 0; k < 3 && alpha > 0; ++k)
                    expected[k] = (a * ic[k] * pc[k] + dc[3] * dc[k] * (1 - a * ic[k])) / alpha;
                EXPECT_TRUE(isNear(pixel(0, 0), bytesOf(expected), 1));
            }
}

TEST_F(BlendingTest, ProjectiveImagesAreDrawnAsTheyAre) {
    vgSeti(VG_IMAGE_MODE, VG_DRAW_IMAGE_MULTIPLY);
    const std::array<VGfloat, 9> projective{4, 0, 0, 0, 4, 0, 0, 0, 2};
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgLoadMatrix(projective.data());
    const VGImage image = newImage({{10, 20, 30, 255}});
    vgDrawImage(image);
    EXPECT_EQ(pixel(0, 0), (Rgba{10, 20, 30, 255}));
    EXPECT_EQ(pixel(1, 1), (Rgba{10, 20, 30, 255}));
    EXPECT_EQ(pixel(2, 1), (Rgba{0, 0, 0, 0}));
    // A corner at or beyond infinity: nothing (section 10.8).
    clear({0, 0, 0, 0});
    const std::array<VGfloat, 9> beyond{4, 0, -1, 0, 4, 0, 0, 0, 1};
    vgLoadMatrix(beyond.data());
    vgDrawImage(image);
    EXPECT_EQ(pixel(0, 0), (Rgba{0, 0, 0, 0}));
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);
}

}  // namespace

}  // namespace vtm::openvg::testing
