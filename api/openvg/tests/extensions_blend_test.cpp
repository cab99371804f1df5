// VG_KHR_advanced_blending against its equations, written out as the registry has them.

#include <algorithm>
#include <cmath>
#include <functional>

#include "api/openvg/tests/extensions_fixture.hpp"

namespace extensions {
namespace {

/// Premultiplied channels and alphas; the result is premultiplied and not yet clamped.
using Equation = std::function<double(double s, double d, double sa, double da)>;

double over(double s, double d, double sa, double da) { return s * (1 - da) + d * (1 - sa); }
/// A quotient, zero if there is nothing to divide by.
double part(double d, double da) { return da == 0 ? 0 : d / da; }

const std::vector<std::pair<VGint, Equation>>& equations() {
    static const std::vector<std::pair<VGint, Equation>> all{
        {VG_BLEND_OVERLAY_KHR,
         [](double s, double d, double sa, double da) {
             return 2 * d < da ? 2 * s * d + over(s, d, sa, da)
                               : sa * da - 2 * (da - d) * (sa - s) + over(s, d, sa, da);
         }},
        {VG_BLEND_HARDLIGHT_KHR,
         [](double s, double d, double sa, double da) {
             return 2 * s < sa ? 2 * s * d + over(s, d, sa, da)
                               : sa * da - 2 * (da - d) * (sa - s) + over(s, d, sa, da);
         }},
        {VG_BLEND_SOFTLIGHT_SVG_KHR,
         [](double s, double d, double sa, double da) {
             if (2 * s < sa)
                 return d * (sa - (1 - part(d, da)) * (2 * s - sa)) + over(s, d, sa, da);
             if (8 * d <= da)
                 return d * (sa - (1 - part(d, da)) * (2 * s - sa) * (3 - 8 * part(d, da))) +
                        over(s, d, sa, da);
             return d * sa + (std::pow(part(d, da), 0.5) * da - d) * (2 * s - sa) + over(s, d, sa, da);
         }},
        {VG_BLEND_SOFTLIGHT_KHR,
         [](double s, double d, double sa, double da) {
             if (2 * s < sa)
                 return d * sa + d * (1 - part(d, da)) * (2 * s - sa) + over(s, d, sa, da);
             if (4 * d <= da)
                 return d * sa + d * ((16 * part(d, da) - 12) * part(d, da) + 3) * (2 * s - sa) +
                        over(s, d, sa, da);
             return d * sa + (std::pow(part(d, da), 0.5) * da - d) * (2 * s - sa) + over(s, d, sa, da);
         }},
        {VG_BLEND_COLORDODGE_KHR,
         [](double s, double d, double sa, double da) {
             return s < sa ? std::min(sa * da, d * sa / (1 - s / sa)) + over(s, d, sa, da)
                           : sa * da + over(s, d, sa, da);
         }},
        {VG_BLEND_COLORBURN_KHR,
         [](double s, double d, double sa, double da) {
             return s > 0 ? sa * da - std::min(sa * da, sa * (sa * (da - d) / s)) + over(s, d, sa, da)
                          : over(s, d, sa, da);
         }},
        {VG_BLEND_DIFFERENCE_KHR,
         [](double s, double d, double sa, double da) { return s + d - 2 * std::min(s * da, d * sa); }},
        {VG_BLEND_SUBTRACT_KHR, [](double s, double d, double, double) { return std::max(d - s, 0.0); }},
        {VG_BLEND_INVERT_KHR,
         [](double, double d, double sa, double) { return (1 - sa) * d + sa * (1 - d); }},
        {VG_BLEND_EXCLUSION_KHR, [](double s, double d, double sa,
                                    double da) { return s * da + d * sa - 2 * s * d + over(s, d, sa, da); }},
        {VG_BLEND_LINEARDODGE_KHR,
         [](double s, double d, double sa, double da) {
             return s * da + d * sa <= sa * da ? s + d : sa * da + over(s, d, sa, da);
         }},
        {VG_BLEND_LINEARBURN_KHR,
         [](double s, double d, double sa, double da) {
             return s * da + d * sa > sa * da ? s + d - sa * da : over(s, d, sa, da);
         }},
        {VG_BLEND_VIVIDLIGHT_KHR,
         [](double s, double d, double sa, double da) {
             if (2 * s < sa)
                 return s > 0
                            ? sa * da - std::min(sa * da, sa * (sa * (da - d) / (2 * s))) + over(s, d, sa, da)
                            : over(s, d, sa, da);
             return s < sa ? std::min(sa * da, d * sa / (2 * (1 - s / sa))) + over(s, d, sa, da)
                           : sa * da + over(s, d, sa, da);
         }},
        {VG_BLEND_LINEARLIGHT_KHR,
         [](double s, double d, double sa, double da) {
             if (2 * s * da + d * sa > 2 * sa * da)
                 return sa * da + over(s, d, sa, da);
             return 2 * s * da + d * sa > sa * da ? 2 * s * da + d * sa - sa * da + over(s, d, sa, da)
                                                  : over(s, d, sa, da);
         }},
        {VG_BLEND_PINLIGHT_KHR,
         [](double s, double d, double sa, double da) {
             if (2 * s * da - d * sa > sa * da)
                 return 2 * s < sa ? over(s, d, sa, da) : 2 * s * da - sa * da + over(s, d, sa, da);
             return 2 * s * da < d * sa ? 2 * s * da + over(s, d, sa, da) : d * sa + over(s, d, sa, da);
         }},
        {VG_BLEND_HARDMIX_KHR,
         [](double s, double d, double sa, double da) {
             return s * da + d * sa < sa * da ? over(s, d, sa, da) : sa * da + over(s, d, sa, da);
         }},
    };
    return all;
}

/// Factors of source and destination.
struct PorterDuff {
    VGint mode;
    double (*source)(double da);
    double (*destination)(double sa);
};

const PorterDuff porterDuffs[] = {
    {VG_BLEND_CLEAR_KHR, [](double) { return 0.0; }, [](double) { return 0.0; }},
    {VG_BLEND_DST_KHR, [](double) { return 0.0; }, [](double) { return 1.0; }},
    {VG_BLEND_SRC_OUT_KHR, [](double da) { return 1 - da; }, [](double) { return 0.0; }},
    {VG_BLEND_DST_OUT_KHR, [](double) { return 0.0; }, [](double sa) { return 1 - sa; }},
    {VG_BLEND_SRC_ATOP_KHR, [](double da) { return da; }, [](double sa) { return 1 - sa; }},
    {VG_BLEND_DST_ATOP_KHR, [](double da) { return 1 - da; }, [](double sa) { return sa; }},
    {VG_BLEND_XOR_KHR, [](double da) { return 1 - da; }, [](double sa) { return 1 - sa; }},
};

/// Sources whose premultiplied numbers are exact; extremes and what equations compare with are among them.
const Color sources[] = {{0, 0.5, 1, 1},           {0.25, 0.75, 0.125, 1},  {0.375, 0.625, 0.875, 0.5},
                         {1, 0.5, 0, 0.5},         {0.5, 0.25, 0.75, 0.25}, {1, 1, 1, 0},
                         {0.0625, 0.9375, 1, 0.75}};

class AdvancedBlending : public Extensions {
protected:
    /// Blends every source with a surface of many destinations, transparent and opaque ones among them.
    template <class Check>
    void blendAll(VGint mode, Check&& check) {
        SCOPED_TRACE(mode);
        Bytes destinations = premultipliedNoise(std::size_t(side) * side);
        for (std::size_t i = 0; i < std::size_t(side) * 4; ++i)
            destinations[i] = 0;
        for (std::size_t i = 0; i < std::size_t(side); ++i)
            destinations[std::size_t(side) * 4 + 4 * i + 3] = 255;
        vgSeti(VG_BLEND_MODE, mode);
        EXPECT_EQ(vgGeti(VG_BLEND_MODE), mode);
        const VGPaint paint = vgCreatePaint();
        vgSetPaint(paint, VG_FILL_PATH);
        for (const Color& source : sources) {
            vgWritePixels(destinations.data(), side * 4, sRGBA_PRE, 0, 0, side, side);
            const float numbers[] = {float(source[0]), float(source[1]), float(source[2]), float(source[3])};
            vgSetParameterfv(paint, VG_PAINT_COLOR, 4, numbers);
            fillSurface();
            const Bytes result = surfaceBytes();
            for (int i = 0; i < side * side && !HasFailure(); ++i)
                check(premultiplied(source), colorAt(destinations, i), &result[std::size_t(i) * 4]);
        }
        vgDestroyPaint(paint);
    }
};

TEST_F(AdvancedBlending, IsNamed) { EXPECT_TRUE(has("VG_KHR_advanced_blending")); }

TEST_F(AdvancedBlending, FollowsItsEquations) {
    for (const auto& [mode, equation] : equations())
        blendAll(mode, [&](const Color& s, const Color& d, const std::uint8_t* result) {
            const double alpha = s[3] + d[3] * (1 - s[3]);
            for (std::size_t c = 0; c < 3; ++c)
                expectByte(std::clamp(equation(s[c], d[c], s[3], d[3]), 0.0, alpha), result[c]);
            expectByte(alpha, result[3]);
        });
}

TEST_F(AdvancedBlending, FollowsPorterAndDuff) {
    for (const PorterDuff& rule : porterDuffs)
        blendAll(rule.mode, [&](const Color& s, const Color& d, const std::uint8_t* result) {
            for (std::size_t c = 0; c < 4; ++c)
                expectByte(s[c] * rule.source(d[3]) + d[c] * rule.destination(s[3]), result[c]);
        });
}

TEST_F(AdvancedBlending, RefusesWhatLiesBetweenAndBehind) {
    vgSeti(VG_BLEND_MODE, VG_BLEND_XOR_KHR);
    for (const VGint mode : {0x1FFF, 0x200A, 0x200F, 0x2027}) {
        vgSeti(VG_BLEND_MODE, mode);
        EXPECT_EQ(vgGetError(), VG_ILLEGAL_ARGUMENT_ERROR) << mode;
        EXPECT_EQ(vgGeti(VG_BLEND_MODE), VG_BLEND_XOR_KHR);
    }
}

}  // namespace
}  // namespace extensions
