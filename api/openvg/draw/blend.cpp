#include "api/openvg/draw/blend.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <VG/vgext.h>

namespace vtm::openvg {

namespace {

// ---- Section 12.2: Porter-Duff --------------------------------------------------------------------

Color clear(Color, Color) { return Color(0); }
Color dst(Color, Color d) { return d; }
Color srcOut(Color s, Color d) { return s * (1 - d.a); }
Color dstOut(Color s, Color d) { return d * (1 - s.a); }
Color srcAtop(Color s, Color d) { return s * d.a + d * (1 - s.a); }
Color dstAtop(Color s, Color d) { return s * (1 - d.a) + d * s.a; }
Color exclusiveOr(Color s, Color d) { return s * (1 - d.a) + d * (1 - s.a); }

// ---- Section 12.3: channel by channel -------------------------------------------------------------

/// A colour channel of source and destination, premultiplied, and their alphas.
struct Operands {
    float s, d, sa, da;

    /// What shows where only one of the two is.
    float apart() const { return s * (1 - da) + d * (1 - sa); }
    /// The destination without its alpha. No colour is divided by zero: it is zero then.
    float plain() const { return da > 0 ? d / da : 0; }
};

using ChannelBlend = float (*)(const Operands&);

/// Colours are clamped to [0, alpha]; alpha is that of source over destination (section 13.4 of OpenVG 1.1).
template <ChannelBlend channel>
Color separable(Color s, Color d) {
    const float alpha = s.a + d.a * (1 - s.a);
    Color result(0, 0, 0, alpha);
    for (int c = 0; c < 3; ++c)
        result[c] = std::clamp(channel({s[c], d[c], s.a, d.a}), 0.0f, alpha);
    return result;
}

float multiplied(const Operands& o) { return 2 * o.s * o.d + o.apart(); }
float screened(const Operands& o) { return o.sa * o.da - 2 * (o.da - o.d) * (o.sa - o.s) + o.apart(); }

float overlay(const Operands& o) { return 2 * o.d < o.da ? multiplied(o) : screened(o); }
float hardLight(const Operands& o) { return 2 * o.s < o.sa ? multiplied(o) : screened(o); }

/// How both soft lights lighten all but the darkest destinations.
float lightened(const Operands& o) {
    return o.d * o.sa + (std::sqrt(o.plain()) * o.da - o.d) * (2 * o.s - o.sa) + o.apart();
}

float softLightSvg(const Operands& o) {
    const float p = o.plain(), light = (1 - p) * (2 * o.s - o.sa);
    if (2 * o.s < o.sa)
        return o.d * (o.sa - light) + o.apart();
    return 8 * o.d <= o.da ? o.d * (o.sa - light * (3 - 8 * p)) + o.apart() : lightened(o);
}

float softLight(const Operands& o) {
    const float p = o.plain(), light = 2 * o.s - o.sa;
    if (2 * o.s < o.sa)
        return o.d * o.sa + o.d * (1 - p) * light + o.apart();
    return 4 * o.d <= o.da ? o.d * o.sa + o.d * ((16 * p - 12) * p + 3) * light + o.apart() : lightened(o);
}

/// `share` of the source's darkness divides.
float dodged(const Operands& o, float share) {
    const float both = o.sa * o.da;
    if (!(o.s < o.sa))
        return both + o.apart();
    return std::min(both, o.d * o.sa / (share * (1 - o.s / o.sa))) + o.apart();
}

/// `share` of the source's light divides.
float burnt(const Operands& o, float share) {
    if (!(o.s > 0))
        return o.apart();
    const float both = o.sa * o.da;
    return both - std::min(both, o.sa * (o.sa * (o.da - o.d) / (share * o.s))) + o.apart();
}

float colorDodge(const Operands& o) { return dodged(o, 1); }
float colorBurn(const Operands& o) { return burnt(o, 1); }
float vividLight(const Operands& o) { return 2 * o.s < o.sa ? burnt(o, 2) : dodged(o, 2); }

float difference(const Operands& o) { return o.s + o.d - 2 * std::min(o.s * o.da, o.d * o.sa); }
float subtract(const Operands& o) { return std::max(o.d - o.s, 0.0f); }
float invert(const Operands& o) { return (1 - o.sa) * o.d + o.sa * (1 - o.d); }
float exclusion(const Operands& o) { return o.s * o.da + o.d * o.sa - 2 * o.s * o.d + o.apart(); }

float linearDodge(const Operands& o) {
    const float both = o.sa * o.da;
    return o.s * o.da + o.d * o.sa <= both ? o.s + o.d : both + o.apart();
}

float linearBurn(const Operands& o) {
    const float both = o.sa * o.da;
    return o.s * o.da + o.d * o.sa > both ? o.s + o.d - both : o.apart();
}

float linearLight(const Operands& o) {
    const float both = o.sa * o.da, sum = 2 * o.s * o.da + o.d * o.sa;
    return std::clamp(sum - both, 0.0f, both) + o.apart();
}

float pinLight(const Operands& o) {
    // The larger is the text's choice in all its cases: `source` is more than `both` only for light sources.
    const float both = o.sa * o.da, source = 2 * o.s * o.da, destination = o.d * o.sa;
    return std::max(source - both, std::min(source, destination)) + o.apart();
}

float hardMix(const Operands& o) {
    const float both = o.sa * o.da;
    return (o.s * o.da + o.d * o.sa < both ? 0 : both) + o.apart();
}

template <Blend pixel>
void blendRow(std::span<const Color> source, std::span<Color> destination) {
    for (std::size_t i = 0; i < source.size(); ++i)
        destination[i] = pixel(source[i], destination[i]);
}
template <Blend pixel>
constexpr BlendMode modeOf{pixel, blendRow<pixel>};

/// From VG_BLEND_OVERLAY_KHR on.
constexpr std::array<BlendMode, 23> modes{modeOf<separable<overlay>>,
                                          modeOf<separable<hardLight>>,
                                          modeOf<separable<softLightSvg>>,
                                          modeOf<separable<softLight>>,
                                          modeOf<separable<colorDodge>>,
                                          modeOf<separable<colorBurn>>,
                                          modeOf<separable<difference>>,
                                          modeOf<separable<subtract>>,
                                          modeOf<separable<invert>>,
                                          modeOf<separable<exclusion>>,
                                          modeOf<separable<linearDodge>>,
                                          modeOf<separable<linearBurn>>,
                                          modeOf<separable<vividLight>>,
                                          modeOf<separable<linearLight>>,
                                          modeOf<separable<pinLight>>,
                                          modeOf<separable<hardMix>>,
                                          modeOf<clear>,
                                          modeOf<dst>,
                                          modeOf<srcOut>,
                                          modeOf<dstOut>,
                                          modeOf<srcAtop>,
                                          modeOf<dstAtop>,
                                          modeOf<exclusiveOr>};
static_assert(modes.size() == VG_BLEND_XOR_KHR - VG_BLEND_OVERLAY_KHR + 1);

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

BlendMode blendModeOf(VGint mode) {
    switch (mode) {
        case VG_BLEND_SRC:
            return modeOf<src>;
        case VG_BLEND_DST_OVER:
            return modeOf<dstOver>;
        case VG_BLEND_SRC_IN:
            return modeOf<srcIn>;
        case VG_BLEND_DST_IN:
            return modeOf<dstIn>;
        case VG_BLEND_MULTIPLY:
            return modeOf<multiply>;
        case VG_BLEND_SCREEN:
            return modeOf<screen>;
        case VG_BLEND_DARKEN:
            return modeOf<darken>;
        case VG_BLEND_LIGHTEN:
            return modeOf<lighten>;
        case VG_BLEND_ADDITIVE:
            return modeOf<additive>;
        default:
            return mode >= VG_BLEND_OVERLAY_KHR && mode <= VG_BLEND_XOR_KHR
                       ? modes[std::size_t(mode - VG_BLEND_OVERLAY_KHR)]
                       : modeOf<srcOver>;
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
