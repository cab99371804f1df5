#include "api/openvg/draw/blend.hpp"

#include "api/openvg/draw/blend_advanced.hpp"

namespace vtm::openvg {

namespace {

Color src(Color s, Color) { return s; }
Color srcOver(Color s, Color d) { return s + d * (1 - s.a); }
Color dstOver(Color s, Color d) { return s * (1 - d.a) + d; }
Color srcIn(Color s, Color d) { return s * d.a; }
Color dstIn(Color s, Color d) { return d * s.a; }

/// Alpha of the modes of section 13.4 is that of srcOver, which their formulas give too, but for the last
/// two.
Color multiply(Color s, Color d) {
    const Color c = s * (1 - d.a) + d * (1 - s.a) + s * d;
    return {c.r, c.g, c.b, srcOver(s, d).a};
}
Color screen(Color s, Color d) { return s + d - s * d; }
Color darken(Color s, Color d) { return glm::min(srcOver(s, d), dstOver(s, d)); }
Color lighten(Color s, Color d) { return glm::max(srcOver(s, d), dstOver(s, d)); }
Color additive(Color s, Color d) { return glm::min(s + d, 1.0f); }

}  // namespace

Blend blendOf(VGint mode) {
    switch (mode) {
        case VG_BLEND_SRC:
            return src;
        case VG_BLEND_DST_OVER:
            return dstOver;
        case VG_BLEND_SRC_IN:
            return srcIn;
        case VG_BLEND_DST_IN:
            return dstIn;
        case VG_BLEND_MULTIPLY:
            return multiply;
        case VG_BLEND_SCREEN:
            return screen;
        case VG_BLEND_DARKEN:
            return darken;
        case VG_BLEND_LIGHTEN:
            return lighten;
        case VG_BLEND_ADDITIVE:
            return additive;
        default: {
            const Blend advanced = advancedBlendOf(mode);
            return advanced ? advanced : srcOver;
        }
    }
}

Color blendChannels(Blend blend, Color source, Color alphas, Color destination) {
    Color result;
    for (int c = 0; c < 3; ++c)
        result[c] =
            blend(Color(glm::vec3(source[c]), alphas[c]), Color(glm::vec3(destination[c]), destination.a)).r;
    result.a = blend(alphas, destination).a;
    return result;
}

}  // namespace vtm::openvg
