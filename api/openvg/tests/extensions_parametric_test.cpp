// VG_KHR_parametric_filter against its formulas, and VGU's effects against their pseudo-code.

#include <optional>

#include "api/openvg/tests/extensions_fixture.hpp"

namespace extensions {
namespace {

constexpr VGbitfield allFlags =
    VG_PF_OBJECT_VISIBLE_FLAG_KHR | VG_PF_KNOCKOUT_FLAG_KHR | VG_PF_OUTER_FLAG_KHR | VG_PF_INNER_FLAG_KHR;

Color scaled(Color c, double by) { return {c[0] * by, c[1] * by, c[2] * by, c[3] * by}; }
Color additive(const Color& a, const Color& b) {
    Color sum;
    for (std::size_t c = 0; c < 4; ++c)
        sum[c] = std::min(a[c] + b[c], 1.0);
    return sum;
}

/// A paint, and what the extension's highlight() or shadow() makes of it.
struct TestPaint {
    enum Kind { None, Solid, Gradient } kind = None;
    Color color{};  ///< of a gradient: its last stop; the first is transparent, both at the ends

    VGPaint create() const {
        if (kind == None)
            return VG_INVALID_HANDLE;
        const VGPaint paint = vgCreatePaint();
        const float r = float(color[0]), g = float(color[1]), b = float(color[2]), a = float(color[3]);
        const float numbers[] = {r, g, b, a}, stops[] = {0, r, g, b, 0, 1, r, g, b, a};
        if (kind == Solid) {
            vgSetParameterfv(paint, VG_PAINT_COLOR, 4, numbers);
        } else {
            vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_LINEAR_GRADIENT);
            vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, 10, stops);
        }
        return paint;
    }

    /// Stops that differ in alpha only: premultiplied, both kinds grow in proportion.
    Color operator()(double amount, bool isLinear) const {
        if (kind == None)
            return {};
        return scaled(premultiplied(isLinear ? linear(color) : color), std::clamp(amount, 0.0, 1.0));
    }
};

class ParametricFilter : public Extensions {
protected:
    static constexpr int width = 9, height = 6;

    void SetUp() override {
        Extensions::SetUp();
        sourceBytes_ = premultipliedNoise(width * height);
        blurBytes_ = noise(width * height);
        source_ = image(sRGBA_PRE, width, height, sourceBytes_);
        blur_ = image(VG_A_8, width, height, blurBytes_);
        result_ = image(sRGBA_PRE, width, height, Bytes(sourceBytes_.size()));
    }

    /// Between pixels, border pixels going on.
    double blurAt(double x, double y) const {
        const auto at = [&](double u, double v) {
            const int i = int(std::clamp(u, 0.0, width - 1.0)), j = int(std::clamp(v, 0.0, height - 1.0));
            return blurBytes_[std::size_t(j * width + i)] / 255.0;
        };
        const double i = std::floor(x), j = std::floor(y), s = x - i, t = y - j;
        return (at(i, j) * (1 - s) + at(i + 1, j) * s) * (1 - t) +
               (at(i, j + 1) * (1 - s) + at(i + 1, j + 1) * s) * t;
    }

    /// The extension's text, for a premultiplied source pixel in the filter's format.
    Color expected(int x, int y, const Color& src, double strength, double dx, double dy, VGbitfield flags,
                   const TestPaint& highlight, const TestPaint& shadow, bool isLinear) const {
        const double h = highlight.kind == TestPaint::None ? 0 : blurAt(x + dx, y + dy),
                     s = shadow.kind == TestPaint::None ? 0 : blurAt(x - dx, y - dy);
        const Color highlightPixel = highlight(std::max(h - s, 0.0) * strength, isLinear),
                    shadowPixel = shadow(std::max(s - h, 0.0) * strength, isLinear),
                    inverseShadowPixel = shadow((1 - std::max(s - h, 0.0)) * strength, isLinear);
        const Color outerEffect = additive(highlightPixel, shadowPixel);
        const Color innerEffect = highlight.kind == TestPaint::None ? inverseShadowPixel : outerEffect;
        const bool inner = flags & VG_PF_INNER_FLAG_KHR, outer = flags & VG_PF_OUTER_FLAG_KHR,
                   knockout = flags & VG_PF_KNOCKOUT_FLAG_KHR,
                   visible = flags & VG_PF_OBJECT_VISIBLE_FLAG_KHR;
        double innerAlpha = 0, objectAlpha = 0, outerAlpha = 0;
        if (inner)
            innerAlpha = src[3];
        if (!knockout && visible)
            objectAlpha = inner ? 1 - innerEffect[3] : 1;
        if (outer)
            outerAlpha = knockout || visible ? 1 - src[3] : 1;
        return additive(additive(scaled(innerEffect, innerAlpha), scaled(src, objectAlpha)),
                        scaled(outerEffect, outerAlpha));
    }

    void check(double strength, double dx, double dy, VGbitfield flags, const TestPaint& highlight,
               const TestPaint& shadow, bool isLinear = false) {
        SCOPED_TRACE(testing::Message() << strength << " (" << dx << ", " << dy << ") flags " << flags
                                        << " paints " << highlight.kind << " " << shadow.kind);
        vgSeti(VG_FILTER_FORMAT_LINEAR, isLinear);
        const VGPaint h = highlight.create(), s = shadow.create();
        vgParametricFilterKHR(result_, source_, blur_, float(strength), float(dx), float(dy), flags, h, s);
        const Bytes result = bytesOf(result_, sRGBA_PRE);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width && !HasFailure(); ++x) {
                const int i = y * width + x;
                Color src = colorAt(sourceBytes_, i);
                if (isLinear)
                    src = premultiplied(linear(unpremultiplied(src)));
                Color color = expected(x, y, src, strength, dx, dy, flags, highlight, shadow, isLinear);
                if (isLinear)
                    color = premultiplied(nonlinear(unpremultiplied(color)));
                for (std::size_t c = 0; c < 4; ++c)
                    expectByte(color[c], result[std::size_t(i) * 4 + c], 0.05);
            }
        for (const VGPaint paint : {h, s})
            if (paint != VG_INVALID_HANDLE)
                vgDestroyPaint(paint);
    }

    VGImage source_ = VG_INVALID_HANDLE, blur_ = VG_INVALID_HANDLE, result_ = VG_INVALID_HANDLE;
    Bytes sourceBytes_, blurBytes_;
};

TEST_F(ParametricFilter, IsNamedAndFound) {
    EXPECT_TRUE(has("VG_KHR_parametric_filter"));
    EXPECT_EQ(vtmGetProcAddress("vgParametricFilterKHR"), VtmFunction(&vgParametricFilterKHR));
    EXPECT_EQ(vtmGetProcAddress("vguDropShadowKHR"), VtmFunction(&vguDropShadowKHR));
    EXPECT_EQ(vtmGetProcAddress("vguGlowKHR"), VtmFunction(&vguGlowKHR));
    EXPECT_EQ(vtmGetProcAddress("vguBevelKHR"), VtmFunction(&vguBevelKHR));
    EXPECT_EQ(vtmGetProcAddress("vguGradientGlowKHR"), VtmFunction(&vguGradientGlowKHR));
    EXPECT_EQ(vtmGetProcAddress("vguGradientBevelKHR"), VtmFunction(&vguGradientBevelKHR));
}

TEST_F(ParametricFilter, FollowsItsFormulas) {
    const TestPaint none, red{TestPaint::Solid, {1, 0.5, 0.25, 0.75}},
        blue{TestPaint::Solid, {0, 0.25, 1, 1}}, fade{TestPaint::Gradient, {0.5, 1, 0, 1}};
    for (VGbitfield flags = 0; flags <= allFlags; ++flags) {
        for (const auto& [highlight, shadow] :
             {std::pair(none, red), {red, none}, {red, blue}, {fade, none}, {blue, fade}, {none, none}}) {
            check(1, 0, 0, flags, highlight, shadow);
            check(0.6, 2, -1, flags, highlight, shadow);
            check(1.75, 1.5, 0.25, flags, highlight, shadow, true);
        }
        check(1, 1e6, -1e6, flags, red, blue);
    }
}

TEST_F(ParametricFilter, SurvivesWhatIsNoNumber) {
    const VGPaint paint = vgCreatePaint();
    for (const float number : {NAN, INFINITY, -INFINITY})
        vgParametricFilterKHR(result_, source_, blur_, number, number, number, allFlags, paint, paint);
    vgDestroyPaint(paint);
}

TEST_F(ParametricFilter, NamesErrors) {
    const VGPaint paint = vgCreatePaint();
    const auto error = [&](VGImage dst, VGImage src, VGImage blur, VGPaint highlight, VGPaint shadow) {
        vgParametricFilterKHR(dst, src, blur, 1, 0, 0, allFlags, highlight, shadow);
        return vgGetError();
    };
    EXPECT_EQ(error(result_, source_, blur_, paint, VG_INVALID_HANDLE), VG_NO_ERROR);
    EXPECT_EQ(error(paint, source_, blur_, paint, paint), VG_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(result_, paint, blur_, paint, paint), VG_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(result_, source_, VG_INVALID_HANDLE, paint, paint), VG_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(result_, source_, blur_, source_, paint), VG_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(result_, source_, blur_, paint, source_), VG_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(source_, source_, blur_, paint, paint), VG_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(error(result_, source_, result_, paint, paint), VG_ILLEGAL_ARGUMENT_ERROR);
    for (const VGPaintType type : {VG_PAINT_TYPE_RADIAL_GRADIENT, VG_PAINT_TYPE_PATTERN}) {
        vgSetParameteri(paint, VG_PAINT_TYPE, type);
        EXPECT_EQ(error(result_, source_, blur_, paint, VG_INVALID_HANDLE), VG_ILLEGAL_ARGUMENT_ERROR);
        EXPECT_EQ(error(result_, source_, blur_, VG_INVALID_HANDLE, paint), VG_ILLEGAL_ARGUMENT_ERROR);
    }
    vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_LINEAR_GRADIENT);  // from opaque black to white
    EXPECT_EQ(error(result_, source_, blur_, paint, VG_INVALID_HANDLE), VG_ILLEGAL_ARGUMENT_ERROR);
    const float seen[] = {0.25f, 1, 1, 1, 0.01f}, hidden[] = {0.25f, 1, 1, 1, 0};
    vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, 5, seen);
    EXPECT_EQ(error(result_, source_, blur_, paint, VG_INVALID_HANDLE), VG_ILLEGAL_ARGUMENT_ERROR);
    vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, 5, hidden);
    EXPECT_EQ(error(result_, source_, blur_, paint, VG_INVALID_HANDLE), VG_NO_ERROR);
    vgDestroyPaint(paint);
}

/// Blur of 3.5 by 2 pixels, twice; 3 pixels towards 30 degrees; all flags but for the knockout.
class Effects : public ParametricFilter {
protected:
    static constexpr float dimX = 3.5f, dimY = 2, strength = 1.5f, distance = 3, angle = 30;
    static constexpr VGbitfield flags = allFlags & ~VG_PF_KNOCKOUT_FLAG_KHR,
                                quality = VG_IMAGE_QUALITY_BETTER;

    /// The pseudo-code's common part.
    Bytes filtered(float dx, float dy, VGPaint highlight, VGPaint shadow) {
        const VGImage blur = vgCreateImage(VG_A_8, width, height, quality);
        vgIterativeAverageBlurKHR(blur, source_, dimX, dimY, 2, VG_TILE_PAD);
        vgParametricFilterKHR(result_, source_, blur, strength, dx, dy, flags, highlight, shadow);
        vgDestroyImage(blur);
        return taken();
    }

    /// The result, which is then cleared.
    Bytes taken() {
        const Bytes bytes = bytesOf(result_, sRGBA_PRE);
        vgClearImage(result_, 0, 0, width, height);
        return bytes;
    }

    static VGPaint solid(VGuint rgba) {
        const VGPaint paint = vgCreatePaint();
        vgSetColor(paint, rgba);
        return paint;
    }
    static VGPaint gradient(const std::vector<float>& stops) {
        const VGPaint paint = vgCreatePaint();
        vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, VGint(stops.size()), stops.data());
        vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_LINEAR_GRADIENT);
        vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, VG_FALSE);
        return paint;
    }

    const float dx_ = distance * std::cos(angle * 3.14159265f / 180),
                dy_ = distance * std::sin(angle * 3.14159265f / 180);
};

TEST_F(Effects, AreTheirPseudoCode) {
    Bytes effect;
    const VGuint red = 0xFF4020C0, blue = 0x2040FFFF;
    EXPECT_EQ(
        vguDropShadowKHR(result_, source_, dimX, dimY, 2, strength, distance, angle, flags, quality, red),
        VGU_NO_ERROR);
    effect = taken();
    EXPECT_EQ(effect, filtered(dx_, dy_, VG_INVALID_HANDLE, solid(red)));
    EXPECT_EQ(vguGlowKHR(result_, source_, dimX, dimY, 2, strength, flags, quality, red), VGU_NO_ERROR);
    effect = taken();
    EXPECT_EQ(effect, filtered(0, 0, VG_INVALID_HANDLE, solid(red)));
    EXPECT_EQ(
        vguBevelKHR(result_, source_, dimX, dimY, 2, strength, distance, angle, flags, quality, red, blue),
        VGU_NO_ERROR);
    effect = taken();
    EXPECT_EQ(effect, filtered(dx_, dy_, solid(red), solid(blue)));
    const std::vector<float> glow{0, 1, 0, 0, 0, 0.5f, 0, 1, 0, 0.5f, 1, 0, 0, 1, 1};
    EXPECT_EQ(vguGradientGlowKHR(result_, source_, dimX, dimY, 2, strength, distance, angle, flags, quality,
                                 3, glow.data()),
              VGU_NO_ERROR);
    effect = taken();
    EXPECT_EQ(effect, filtered(-dx_, -dy_, gradient(glow), VG_INVALID_HANDLE));
}

TEST_F(Effects, CutTheRampOfABevelInTwo) {
    Bytes effect;
    // Four stops without a middle one: both halves start transparent.
    const float apart[] = {0,     1, 0, 0, 1,    0.25f, 1, 1, 0, 0.5f,  //
                           0.75f, 0, 1, 0, 0.5f, 1,     0, 0, 1, 1};
    EXPECT_EQ(vguGradientBevelKHR(result_, source_, dimX, dimY, 2, strength, distance, angle, flags, quality,
                                  4, apart),
              VGU_NO_ERROR);
    effect = taken();
    EXPECT_EQ(effect, filtered(dx_, dy_, gradient({0, 0, 0, 0, 0, 0.5f, 0, 1, 0, 0.5f, 1, 0, 0, 1, 1}),
                               gradient({0, 0, 0, 0, 0, 0.5f, 1, 1, 0, 0.5f, 1, 1, 0, 0, 1})));
    // With one.
    const float joined[] = {0, 1, 0, 0, 1, 0.5f, 1, 1, 0, 0, 1, 0, 0, 1, 1};
    EXPECT_EQ(vguGradientBevelKHR(result_, source_, dimX, dimY, 2, strength, distance, angle, flags, quality,
                                  3, joined),
              VGU_NO_ERROR);
    effect = taken();
    EXPECT_EQ(effect, filtered(dx_, dy_, gradient({0, 1, 1, 0, 0, 1, 0, 0, 1, 1}),
                               gradient({0, 1, 1, 0, 0, 1, 1, 0, 0, 1})));
    // Nothing but a dark half.
    EXPECT_EQ(vguGradientBevelKHR(result_, source_, dimX, dimY, 2, strength, distance, angle, flags, quality,
                                  1, joined),
              VGU_NO_ERROR);
    effect = taken();
    EXPECT_EQ(effect,
              filtered(dx_, dy_, gradient({0, 0, 0, 0, 0}), gradient({0, 0, 0, 0, 0, 1, 1, 0, 0, 1})));
}

TEST_F(Effects, GlowAroundAnObject) {
    // A white dot on nothing: light around it, less the farther away.
    Bytes dot(width * height * 4);
    const auto pixel = [](int x, int y) { return std::size_t(y * width + x) * 4; };
    for (std::size_t c = 0; c < 4; ++c)
        dot[pixel(4, 3) + c] = 255;
    const VGImage object = image(sRGBA_PRE, width, height, dot);
    EXPECT_EQ(vguGlowKHR(result_, object, 3, 3, 2, 1, VG_PF_OUTER_FLAG_KHR | VG_PF_OBJECT_VISIBLE_FLAG_KHR,
                         quality, 0xFF0000FF),
              VGU_NO_ERROR);
    const Bytes result = taken();
    EXPECT_EQ(result[pixel(4, 3) + 1], 255);
    const std::vector<int> reds{result[pixel(5, 3)], result[pixel(6, 3)], result[pixel(7, 3)]};
    EXPECT_EQ(reds, (std::vector<int>{19, 9, 0}));  // 2 / 9 and 1 / 9 of 3 / 9 of 255
}

TEST_F(Effects, NameErrorsAndLeaveNone) {
    const auto error = [&](VGImage dst, VGImage src, float window, VGbitfield allowed) {
        return vguGlowKHR(dst, src, window, 2, 1, 1, flags, allowed, 0xFFFFFFFF);
    };
    EXPECT_EQ(error(result_, source_, 2, quality), VGU_NO_ERROR);
    EXPECT_EQ(error(result_, result_ + 100, 2, quality), VGU_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(VG_INVALID_HANDLE, source_, 2, quality), VGU_BAD_HANDLE_ERROR);
    EXPECT_EQ(error(source_, source_, 2, quality), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(error(result_, source_, -2, quality), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(error(result_, source_, 2, 0), VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vguGradientGlowKHR(result_, source_, 2, 2, 1, 1, 0, 0, flags, quality, 2, nullptr),
              VGU_ILLEGAL_ARGUMENT_ERROR);
    const float opaque[] = {0, 1, 1, 1, 1};
    EXPECT_EQ(vguGradientGlowKHR(result_, source_, 2, 2, 1, 1, 0, 0, flags, quality, 1, opaque),
              VGU_ILLEGAL_ARGUMENT_ERROR);
    EXPECT_EQ(vgGetError(), VG_NO_ERROR);

    VGErrorCode code = VG_NO_ERROR;
    VtmSurface* const target = vtmCreateImageSurface(context, result_, 0, &code);
    ASSERT_TRUE(vtmMakeCurrent(context, target));
    EXPECT_EQ(error(result_, source_, 2, quality), VGUErrorCode(VGU_IMAGE_IN_USE_ERROR));
    vtmMakeCurrent(nullptr, nullptr);
    EXPECT_EQ(error(result_, source_, 2, quality), VGU_BAD_HANDLE_ERROR);
    ASSERT_TRUE(vtmMakeCurrent(context, surface));
    vtmDestroySurface(target);
}

}  // namespace
}  // namespace extensions
