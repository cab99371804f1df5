#include "svg/css/color_spaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "svg/css/cursor.hpp"

namespace vtm::svg {
namespace {

/// Rows of a matrix, as specifications print them.
glm::dmat3 rows(Vec3 x, Vec3 y, Vec3 z) { return glm::transpose(glm::dmat3(x, y, z)); }

Vec3 each(Vec3 v, double (*f)(double)) { return {f(v.x), f(v.y), f(v.z)}; }

// ---- RGB (CSS Color 4 section 10) -----------------------------------------------------------------

const glm::dmat3 xyzToSrgb = rows({3.2409699419045226, -1.537383177570094, -0.4986107602930034},
                                  {-0.9692436362808796, 1.8759675015077202, 0.04155505740717559},
                                  {0.05563007969699366, -0.20397695888897652, 1.0569715142428786});
/// Bradford's adaptation from the white of D50.
const glm::dmat3 d50ToD65 = rows({0.955473421488075, -0.02309845494876471, 0.06325924320057072},
                                 {-0.0283697093338637, 1.0099953980813041, 0.021041441191917323},
                                 {0.012314014864481998, -0.020507649298898964, 1.330365926242124});

double same(double v) { return v; }

double srgbEncoded(double v) {
    const double size = std::abs(v);
    return std::copysign(size > 0.0031308 ? 1.055 * std::pow(size, 1 / 2.4) - 0.055 : 12.92 * size, v);
}
double srgbDecoded(double v) {
    const double size = std::abs(v);
    return std::copysign(size > 0.04045 ? std::pow((size + 0.055) / 1.055, 2.4) : size / 12.92, v);
}

double a98Encoded(double v) { return std::copysign(std::pow(std::abs(v), 256.0 / 563), v); }
double a98Decoded(double v) { return std::copysign(std::pow(std::abs(v), 563.0 / 256), v); }

double prophotoEncoded(double v) {
    return std::abs(v) >= 1.0 / 512 ? std::copysign(std::pow(std::abs(v), 1 / 1.8), v) : 16 * v;
}
double prophotoDecoded(double v) {
    return std::abs(v) <= 16.0 / 512 ? v / 16 : std::copysign(std::pow(std::abs(v), 1.8), v);
}

constexpr double rec2020Alpha = 1.09929682680944, rec2020Beta = 0.018053968510807;
double rec2020Encoded(double v) {
    const double size = std::abs(v);
    return size > rec2020Beta ? std::copysign(rec2020Alpha * std::pow(size, 0.45) - (rec2020Alpha - 1), v)
                              : 4.5 * v;
}
double rec2020Decoded(double v) {
    const double size = std::abs(v);
    return size < rec2020Beta * 4.5
               ? v / 4.5
               : std::copysign(std::pow((size + rec2020Alpha - 1) / rec2020Alpha, 1 / 0.45), v);
}

ColorSpace rgb(std::string_view name, const glm::dmat3& toXyz, double (*decoded)(double),
               double (*encoded)(double)) {
    return {name, [=](Vec3 v) { return toXyz * each(v, decoded); },
            [=, fromXyz = glm::inverse(toXyz)](Vec3 v) { return each(fromXyz * v, encoded); }, -1, true};
}

// ---- Hue, saturation, lightness; hue, whiteness, blackness (sections 7 and 8) ----------------------

Vec3 srgbToXyz(Vec3 v) { return glm::inverse(xyzToSrgb) * each(v, srgbDecoded); }
Vec3 xyzToRgb(Vec3 v) { return each(xyzToSrgb * v, srgbEncoded); }

/// Channels that differ by less are equal but for rounding: a grey would get any hue and saturation.
constexpr double noise = 1e-9;

double hueOf(Vec3 rgb) {
    const double most = std::max({rgb.x, rgb.y, rgb.z}), range = most - std::min({rgb.x, rgb.y, rgb.z});
    if (range <= noise)
        return 0;
    const double sixths = most == rgb.x   ? (rgb.y - rgb.z) / range
                          : most == rgb.y ? (rgb.z - rgb.x) / range + 2
                                          : (rgb.x - rgb.y) / range + 4;
    return sixths < 0 ? 60 * sixths + 360 : 60 * sixths;
}

/// How far from its darkest to its lightest a channel of a pure hue is; n: 0 for red, 8 green, 4 blue.
double hueShare(double hue, double n) {
    const double k = std::fmod(std::fmod(n + hue / 30, 12.0) + 12, 12.0);
    return -std::clamp(std::min(k - 3, 9 - k), -1.0, 1.0);
}
Vec3 hueShares(double hue) { return {hueShare(hue, 0), hueShare(hue, 8), hueShare(hue, 4)}; }

Vec3 hslToXyz(Vec3 v) {
    const double range = v.y * std::min(v.z, 1 - v.z);
    return srgbToXyz(v.z + range * hueShares(v.x));
}
Vec3 xyzToHsl(Vec3 xyz) {
    const Vec3 rgb = xyzToRgb(xyz);
    const double most = std::max({rgb.x, rgb.y, rgb.z}), least = std::min({rgb.x, rgb.y, rgb.z});
    const double lightness = (most + least) / 2, room = std::min(lightness, 1 - lightness);
    return {hueOf(rgb), most - least > noise ? (most - lightness) / room : 0, lightness};
}

Vec3 hwbToXyz(Vec3 v) {
    const double sum = v.y + v.z;
    if (sum >= 1)
        return srgbToXyz(Vec3(v.y / sum));
    return srgbToXyz((0.5 + 0.5 * hueShares(v.x)) * (1 - sum) + v.y);
}
Vec3 xyzToHwb(Vec3 xyz) {
    const Vec3 rgb = xyzToRgb(xyz);
    return {hueOf(rgb), std::min({rgb.x, rgb.y, rgb.z}), 1 - std::max({rgb.x, rgb.y, rgb.z})};
}

// ---- Lab and Oklab (section 9) --------------------------------------------------------------------

const Vec3 whiteD50(0.3457 / 0.3585, 1, (1 - 0.3457 - 0.3585) / 0.3585);
constexpr double kappa = 24389.0 / 27, epsilon = 216.0 / 24389;

Vec3 labToXyz(Vec3 lab) {
    const double y = (lab.x + 16) / 116, x = lab.y / 500 + y, z = y - lab.z / 200;
    const auto open = [&](double f) { return f * f * f > epsilon ? f * f * f : (116 * f - 16) / kappa; };
    const double height = lab.x > kappa * epsilon ? y * y * y : lab.x / kappa;
    return d50ToD65 * (whiteD50 * Vec3(open(x), height, open(z)));
}
Vec3 xyzToLab(Vec3 xyz) {
    const Vec3 f = each(glm::inverse(d50ToD65) * xyz / whiteD50,
                        [](double v) { return v > epsilon ? std::cbrt(v) : (kappa * v + 16) / 116; });
    return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

/// Ottosson 2020.
const glm::dmat3 oklabToLms =
    rows({1, 0.3963377773761749, 0.2158037573099136}, {1, -0.1055613458156586, -0.0638541728258133},
         {1, -0.0894841775298119, -1.2914855480194092});
const glm::dmat3 lmsToXyz = rows({1.2268798758459243, -0.5578149944602171, 0.2813910456659647},
                                 {-0.0405757452148008, 1.1122868032803170, -0.0717110580655164},
                                 {-0.0763729366746601, -0.4214933324022432, 1.5869240198367816});

Vec3 oklabToXyz(Vec3 lab) {
    return lmsToXyz * each(oklabToLms * lab, [](double v) { return v * v * v; });
}
Vec3 xyzToOklab(Vec3 xyz) {
    return glm::inverse(oklabToLms) *
           each(glm::inverse(lmsToXyz) * xyz, [](double v) { return std::cbrt(v); });
}

constexpr double degree = std::numbers::pi / 180;
Vec3 fromPolar(Vec3 v) {
    const double chroma = std::max(v.y, 0.0);
    return {v.x, chroma * std::cos(v.z * degree), chroma * std::sin(v.z * degree)};
}
Vec3 toPolar(Vec3 v) {
    const double hue = std::atan2(v.z, v.y) / degree;
    return {v.x, std::hypot(v.y, v.z), hue < 0 ? hue + 360 : hue};
}

}  // namespace

const ColorSpace* findColorSpace(std::string_view name) {
    static const glm::dmat3 srgb = glm::inverse(xyzToSrgb), identity(1);
    static const ColorSpace spaces[]{
        rgb("srgb", srgb, srgbDecoded, srgbEncoded),
        rgb("srgb-linear", srgb, same, same),
        rgb("display-p3",
            rows({0.4865709486482162, 0.26566769316909306, 0.1982172852343625},
                 {0.2289745640697488, 0.6917385218365064, 0.079286914093745},
                 {0, 0.04511338185890264, 1.043944368900976}),
            srgbDecoded, srgbEncoded),
        rgb("a98-rgb",
            rows({0.5766690429101305, 0.1855582379065463, 0.1882286462349947},
                 {0.29734497525053605, 0.6273635662554661, 0.07529145849399788},
                 {0.02703136138641234, 0.07068885253582723, 0.9913375368376388}),
            a98Decoded, a98Encoded),
        rgb("prophoto-rgb",
            d50ToD65 * rows({0.7977666449006423, 0.13518129740053308, 0.0313477341283922},
                            {0.2880748288194013, 0.7118352342418731, 0.00008993693872564},
                            {0, 0, 0.8251046025104602}),
            prophotoDecoded, prophotoEncoded),
        rgb("rec2020",
            rows({0.6369580483012914, 0.14461690358620832, 0.1688809751641721},
                 {0.2627002120112671, 0.6779980715188708, 0.05930171646986196},
                 {0, 0.028072693049087428, 1.060985057710791}),
            rec2020Decoded, rec2020Encoded),
        rgb("xyz", identity, same, same),
        rgb("xyz-d65", identity, same, same),
        rgb("xyz-d50", d50ToD65, same, same),
        {"hsl", hslToXyz, xyzToHsl, 0},
        {"hwb", hwbToXyz, xyzToHwb, 0},
        {"lab", labToXyz, xyzToLab},
        {"lch", [](Vec3 v) { return labToXyz(fromPolar(v)); }, [](Vec3 v) { return toPolar(xyzToLab(v)); },
         2},
        {"oklab", oklabToXyz, xyzToOklab},
        {"oklch", [](Vec3 v) { return oklabToXyz(fromPolar(v)); },
         [](Vec3 v) { return toPolar(xyzToOklab(v)); }, 2}};
    const auto found =
        std::ranges::find_if(spaces, [&](const ColorSpace& s) { return equalsIgnoringCase(s.name, name); });
    return found == std::end(spaces) ? nullptr : found;
}

}  // namespace vtm::svg
