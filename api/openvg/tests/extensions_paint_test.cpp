// VG_NDS_paint_generation against its formulas.

#include "api/openvg/tests/extensions_fixture.hpp"

namespace extensions {
namespace {

constexpr auto imageModeOfMatrix = VGint(VG_DRAW_IMAGE_COLOR_MATRIX_NDS);

using Matrix = std::array<float, 20>;

constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
/// Mixes all channels, and leaves [0, 1] for some colours.
constexpr Matrix mixing{0.5f, 0.25f, 0,    0.1f, 0.25f, -0.5f, 0.75f, 0,    0.125f, 0.5f,
                        0.5f, -0.2f, 0.2f, 0,    0,     0.9f,  0.1f,  0.2f, 0,      0.05f};

class PaintGeneration : public Extensions {
protected:
    void SetUp() override {
        Extensions::SetUp();
        paint_ = vgCreatePaint();
        vgSetPaint(paint_, VG_FILL_PATH);
        vgSeti(VG_BLEND_MODE, VG_BLEND_SRC);
    }
    void TearDown() override {
        vgDestroyPaint(paint_);
        Extensions::TearDown();
    }

    void set(const Matrix& matrix, bool isLinear) {
        vgSetParameterfv(paint_, VG_COLOR_MATRIX_NDS, 20, matrix.data());
        vgSetParameteri(paint_, VG_PAINT_COLOR_TRANSFORM_LINEAR_NDS, isLinear);
    }

    /// Section 9.5: of an sRGB colour, to one, without premultiplied alpha.
    static Color transformed(Color c, const Matrix& m, bool isLinear) {
        if (isLinear)
            c = linear(c);
        Color result;
        for (std::size_t r = 0; r < 4; ++r)
            result[r] = std::clamp(double(m[r]) * c[0] + double(m[4 + r]) * c[1] + double(m[8 + r]) * c[2] +
                                       double(m[12 + r]) * c[3] + double(m[16 + r]),
                                   0.0, 1.0);
        return isLinear ? nonlinear(result) : result;
    }

    /// A pixel of the surface is an sRGB colour. Two roundings of colours between spaces may differ by a bit.
    static void expectPixel(const Bytes& bytes, int x, int y, const Color& color, double slack = 0.02) {
        const Color stored = premultiplied(color);
        for (std::size_t c = 0; c < 4; ++c)
            expectByte(stored[c], bytes[std::size_t(y * side + x) * 4 + c], slack);
    }

    VGPaint paint_ = VG_INVALID_HANDLE;
};

TEST_F(PaintGeneration, HasParameters) {
    EXPECT_TRUE(has("VG_NDS_paint_generation"));
    EXPECT_EQ(vgGetParameteri(paint_, VG_PAINT_COLOR_RAMP_LINEAR_NDS), VG_FALSE);
    EXPECT_EQ(vgGetParameteri(paint_, VG_PAINT_COLOR_TRANSFORM_LINEAR_NDS), VG_FALSE);
    ASSERT_EQ(vgGetParameterVectorSize(paint_, VG_COLOR_MATRIX_NDS), 20);
    Matrix matrix;
    vgGetParameterfv(paint_, VG_COLOR_MATRIX_NDS, 20, matrix.data());
    EXPECT_EQ(matrix, identity);

    set(mixing, true);
    vgSetParameteri(paint_, VG_PAINT_COLOR_RAMP_LINEAR_NDS, VG_TRUE);
    vgGetParameterfv(paint_, VG_COLOR_MATRIX_NDS, 20, matrix.data());
    EXPECT_EQ(matrix, mixing);
    EXPECT_EQ(vgGetParameteri(paint_, VG_PAINT_COLOR_RAMP_LINEAR_NDS), VG_TRUE);
    EXPECT_EQ(vgGetParameteri(paint_, VG_PAINT_COLOR_TRANSFORM_LINEAR_NDS), VG_TRUE);

    vgSetParameterfv(paint_, VG_COLOR_MATRIX_NDS, 19, identity.data());
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgSetParameterf(paint_, VG_COLOR_MATRIX_NDS, 1);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgGetParameteri(paint_, VG_COLOR_MATRIX_NDS);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
    vgSeti(VG_IMAGE_MODE, imageModeOfMatrix);
    EXPECT_EQ(vgGeti(VG_IMAGE_MODE), imageModeOfMatrix);
    vgSeti(VG_IMAGE_MODE, imageModeOfMatrix + 1);
    EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR);
}

TEST_F(PaintGeneration, TransformsColors) {
    for (const bool isLinear : {false, true})
        for (const Color& color : {Color{0.25, 0.5, 0.75, 1}, {1, 0.125, 0, 0.5}, {0.9, 0.8, 0.1, 0.25}}) {
            const float numbers[] = {float(color[0]), float(color[1]), float(color[2]), float(color[3])};
            vgSetParameterfv(paint_, VG_PAINT_COLOR, 4, numbers);
            set(mixing, isLinear);
            fillSurface();
            expectPixel(surfaceBytes(), 7, 9, transformed(color, mixing, isLinear));
            set(identity, isLinear);
            fillSurface();
            expectPixel(surfaceBytes(), 7, 9, color);
        }
}

TEST_F(PaintGeneration, TransformsStopsAndInterpolatesInEitherSpace) {
    const Color first{0.1, 0.9, 0.25, 0.25}, last{1, 0.125, 0.5, 0.75};
    const float stops[] = {0, 0.1f, 0.9f, 0.25f, 0.25f, 1, 1, 0.125f, 0.5f, 0.75f};
    const float line[] = {0, 0, side, 0}, circle[] = {0, 0, 0, 0, side};
    vgSetParameterfv(paint_, VG_PAINT_COLOR_RAMP_STOPS, 10, stops);
    vgSetParameterfv(paint_, VG_PAINT_LINEAR_GRADIENT, 4, line);
    vgSetParameterfv(paint_, VG_PAINT_RADIAL_GRADIENT, 5, circle);
    for (int bits = 0; bits < 32; ++bits) {
        SCOPED_TRACE(bits);
        const bool transformLinear = bits & 1, rampLinear = bits & 2, isPremultiplied = bits & 4,
                   isRadial = bits & 8;
        const Matrix& matrix = bits & 16 ? mixing : identity;
        set(matrix, transformLinear);
        vgSetParameteri(paint_, VG_PAINT_COLOR_RAMP_LINEAR_NDS, rampLinear);
        vgSetParameteri(paint_, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, isPremultiplied);
        vgSetParameteri(paint_, VG_PAINT_TYPE,
                        isRadial ? VG_PAINT_TYPE_RADIAL_GRADIENT : VG_PAINT_TYPE_LINEAR_GRADIENT);
        fillSurface();
        const Bytes result = surfaceBytes();
        const auto stop = [&](const Color& color) {
            const Color t = transformed(color, matrix, transformLinear), s = rampLinear ? linear(t) : t;
            return isPremultiplied ? premultiplied(s) : s;
        };
        const Color a = stop(first), b = stop(last);
        for (int x = 0; x < side; ++x) {
            const int y = isRadial ? x / 2 : 3;
            const double t =
                std::min((isRadial ? std::hypot(x + 0.5, y + 0.5) : x + 0.5) / double(side), 1.0);
            Color color;
            for (std::size_t c = 0; c < 4; ++c)
                color[c] = a[c] + (b[c] - a[c]) * t;
            if (isPremultiplied)
                color = unpremultiplied(color);
            expectPixel(result, x, y, rampLinear ? nonlinear(color) : color);
        }
    }
}

/// Images of noise in spaces of all kinds, opaque and not.
class PaintGenerationOfImages : public PaintGeneration {
protected:
    static constexpr int width = 8, height = 4;

    struct Format {
        VGImageFormat name;
        bool linear, premultiplied;
    };
    static constexpr Format formats[] = {
        {sRGBA, false, false}, {sRGBA_PRE, false, true}, {lRGBA, true, false}, {lRGBA_PRE, true, true}};

    static Color colorOf(const Bytes& bytes, int pixel, const Format& format) {
        Color color = colorAt(bytes, pixel);
        if (format.premultiplied)
            color = unpremultiplied(color);
        return format.linear ? nonlinear(color) : color;
    }
};

TEST_F(PaintGenerationOfImages, TransformsPatternsAndTheirFill) {
    const float fill[] = {0.25f, 0.5f, 0.75f, 0.5f};
    vgSetfv(VG_TILE_FILL_COLOR, 4, fill);
    vgSetParameteri(paint_, VG_PAINT_TYPE, VG_PAINT_TYPE_PATTERN);
    for (const Format& format : formats)
        for (const bool isLinear : {false, true}) {
            SCOPED_TRACE(testing::Message() << format.name << " " << isLinear);
            const Bytes bytes = premultipliedNoise(width * height);
            const VGImage pattern = image(format.name, width, height, bytes);
            vgPaintPattern(paint_, pattern);
            set(mixing, isLinear);
            fillSurface();
            const Bytes result = surfaceBytes();
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    expectPixel(result, x, y,
                                transformed(colorOf(bytes, y * width + x, format), mixing, isLinear));
            expectPixel(result, width, 0, transformed({0.25, 0.5, 0.75, 0.5}, mixing, isLinear));
        }
}

TEST_F(PaintGenerationOfImages, TransformsDrawnImages) {
    vgSeti(VG_IMAGE_MODE, imageModeOfMatrix);
    for (const Format& format : formats)
        for (const bool isLinear : {false, true}) {
            SCOPED_TRACE(testing::Message() << format.name << " " << isLinear);
            const Bytes bytes = premultipliedNoise(width * height);
            const VGImage drawn = image(format.name, width, height, bytes);
            set(mixing, isLinear);
            vgDrawImage(drawn);
            const Bytes result = surfaceBytes();
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    expectPixel(result, x, y,
                                transformed(colorOf(bytes, y * width + x, format), mixing, isLinear));
        }
}

TEST_F(PaintGenerationOfImages, MakesColorsOfGrey) {
    // Red of grey, and the inverse of it in blue.
    const Matrix split{1, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0};
    set(split, false);
    vgSeti(VG_IMAGE_MODE, imageModeOfMatrix);
    vgDrawImage(image(VG_sL_8, 1, 1, {51}));
    expectPixel(surfaceBytes(), 0, 0, {0.2, 0, 0.8, 1});
}

TEST_F(PaintGenerationOfImages, DrawsInPerspectiveAsEver) {
    // Section 10.8: projective maps draw images as they are.
    const Bytes bytes{10, 200, 30, 255};
    const float squeezed[] = {16, 0, 0, 0, 16, 0.25f, 0, 0, 1};
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgLoadMatrix(squeezed);
    set(mixing, false);
    vgSeti(VG_IMAGE_MODE, imageModeOfMatrix);
    vgDrawImage(image(sRGBA, 1, 1, bytes));
    expectPixel(surfaceBytes(), 3, 3, colorAt(bytes, 0));
}

TEST_F(PaintGeneration, SurvivesWhatIsNoNumber) {
    Matrix broken;
    broken.fill(NAN);
    for (const bool isLinear : {false, true}) {
        set(broken, isLinear);
        fillSurface();
        expectPixel(surfaceBytes(), 0, 0, {0, 0, 0, 0});
    }
}

}  // namespace
}  // namespace extensions
