#include "svg/css/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "svg/css/length.hpp"

namespace vtm::svg {

// ---- Names (CSS Color 4 section 6.1), sorted ----------------------------------------------------

namespace {

struct Named {
    std::string_view name;
    std::uint32_t rgb;
};

constexpr std::array<Named, 148> names{{
    {"aliceblue", 0xf0f8ff},
    {"antiquewhite", 0xfaebd7},
    {"aqua", 0x00ffff},
    {"aquamarine", 0x7fffd4},
    {"azure", 0xf0ffff},
    {"beige", 0xf5f5dc},
    {"bisque", 0xffe4c4},
    {"black", 0x000000},
    {"blanchedalmond", 0xffebcd},
    {"blue", 0x0000ff},
    {"blueviolet", 0x8a2be2},
    {"brown", 0xa52a2a},
    {"burlywood", 0xdeb887},
    {"cadetblue", 0x5f9ea0},
    {"chartreuse", 0x7fff00},
    {"chocolate", 0xd2691e},
    {"coral", 0xff7f50},
    {"cornflowerblue", 0x6495ed},
    {"cornsilk", 0xfff8dc},
    {"crimson", 0xdc143c},
    {"cyan", 0x00ffff},
    {"darkblue", 0x00008b},
    {"darkcyan", 0x008b8b},
    {"darkgoldenrod", 0xb8860b},
    {"darkgray", 0xa9a9a9},
    {"darkgreen", 0x006400},
    {"darkgrey", 0xa9a9a9},
    {"darkkhaki", 0xbdb76b},
    {"darkmagenta", 0x8b008b},
    {"darkolivegreen", 0x556b2f},
    {"darkorange", 0xff8c00},
    {"darkorchid", 0x9932cc},
    {"darkred", 0x8b0000},
    {"darksalmon", 0xe9967a},
    {"darkseagreen", 0x8fbc8f},
    {"darkslateblue", 0x483d8b},
    {"darkslategray", 0x2f4f4f},
    {"darkslategrey", 0x2f4f4f},
    {"darkturquoise", 0x00ced1},
    {"darkviolet", 0x9400d3},
    {"deeppink", 0xff1493},
    {"deepskyblue", 0x00bfff},
    {"dimgray", 0x696969},
    {"dimgrey", 0x696969},
    {"dodgerblue", 0x1e90ff},
    {"firebrick", 0xb22222},
    {"floralwhite", 0xfffaf0},
    {"forestgreen", 0x228b22},
    {"fuchsia", 0xff00ff},
    {"gainsboro", 0xdcdcdc},
    {"ghostwhite", 0xf8f8ff},
    {"gold", 0xffd700},
    {"goldenrod", 0xdaa520},
    {"gray", 0x808080},
    {"green", 0x008000},
    {"greenyellow", 0xadff2f},
    {"grey", 0x808080},
    {"honeydew", 0xf0fff0},
    {"hotpink", 0xff69b4},
    {"indianred", 0xcd5c5c},
    {"indigo", 0x4b0082},
    {"ivory", 0xfffff0},
    {"khaki", 0xf0e68c},
    {"lavender", 0xe6e6fa},
    {"lavenderblush", 0xfff0f5},
    {"lawngreen", 0x7cfc00},
    {"lemonchiffon", 0xfffacd},
    {"lightblue", 0xadd8e6},
    {"lightcoral", 0xf08080},
    {"lightcyan", 0xe0ffff},
    {"lightgoldenrodyellow", 0xfafad2},
    {"lightgray", 0xd3d3d3},
    {"lightgreen", 0x90ee90},
    {"lightgrey", 0xd3d3d3},
    {"lightpink", 0xffb6c1},
    {"lightsalmon", 0xffa07a},
    {"lightseagreen", 0x20b2aa},
    {"lightskyblue", 0x87cefa},
    {"lightslategray", 0x778899},
    {"lightslategrey", 0x778899},
    {"lightsteelblue", 0xb0c4de},
    {"lightyellow", 0xffffe0},
    {"lime", 0x00ff00},
    {"limegreen", 0x32cd32},
    {"linen", 0xfaf0e6},
    {"magenta", 0xff00ff},
    {"maroon", 0x800000},
    {"mediumaquamarine", 0x66cdaa},
    {"mediumblue", 0x0000cd},
    {"mediumorchid", 0xba55d3},
    {"mediumpurple", 0x9370db},
    {"mediumseagreen", 0x3cb371},
    {"mediumslateblue", 0x7b68ee},
    {"mediumspringgreen", 0x00fa9a},
    {"mediumturquoise", 0x48d1cc},
    {"mediumvioletred", 0xc71585},
    {"midnightblue", 0x191970},
    {"mintcream", 0xf5fffa},
    {"mistyrose", 0xffe4e1},
    {"moccasin", 0xffe4b5},
    {"navajowhite", 0xffdead},
    {"navy", 0x000080},
    {"oldlace", 0xfdf5e6},
    {"olive", 0x808000},
    {"olivedrab", 0x6b8e23},
    {"orange", 0xffa500},
    {"orangered", 0xff4500},
    {"orchid", 0xda70d6},
    {"palegoldenrod", 0xeee8aa},
    {"palegreen", 0x98fb98},
    {"paleturquoise", 0xafeeee},
    {"palevioletred", 0xdb7093},
    {"papayawhip", 0xffefd5},
    {"peachpuff", 0xffdab9},
    {"peru", 0xcd853f},
    {"pink", 0xffc0cb},
    {"plum", 0xdda0dd},
    {"powderblue", 0xb0e0e6},
    {"purple", 0x800080},
    {"rebeccapurple", 0x663399},
    {"red", 0xff0000},
    {"rosybrown", 0xbc8f8f},
    {"royalblue", 0x4169e1},
    {"saddlebrown", 0x8b4513},
    {"salmon", 0xfa8072},
    {"sandybrown", 0xf4a460},
    {"seagreen", 0x2e8b57},
    {"seashell", 0xfff5ee},
    {"sienna", 0xa0522d},
    {"silver", 0xc0c0c0},
    {"skyblue", 0x87ceeb},
    {"slateblue", 0x6a5acd},
    {"slategray", 0x708090},
    {"slategrey", 0x708090},
    {"snow", 0xfffafa},
    {"springgreen", 0x00ff7f},
    {"steelblue", 0x4682b4},
    {"tan", 0xd2b48c},
    {"teal", 0x008080},
    {"thistle", 0xd8bfd8},
    {"tomato", 0xff6347},
    {"turquoise", 0x40e0d0},
    {"violet", 0xee82ee},
    {"wheat", 0xf5deb3},
    {"white", 0xffffff},
    {"whitesmoke", 0xf5f5f5},
    {"yellow", 0xffff00},
    {"yellowgreen", 0x9acd32},
}};

scene::Color fromRgb(std::uint32_t rgb) {
    const auto channel = [&](int shift) { return static_cast<float>(rgb >> shift & 0xff) / 255; };
    return {channel(16), channel(8), channel(0), 1};
}

}  // namespace

std::optional<scene::Color> namedColor(std::string_view name) {
    std::string lower(name);
    for (char& c : lower)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c;
    if (lower == "transparent")
        return scene::Color{0, 0, 0, 0};
    const auto found =
        std::lower_bound(names.begin(), names.end(), lower,
                         [](const Named& named, const std::string& key) { return named.name < key; });
    return found != names.end() && found->name == lower ? std::optional(fromRgb(found->rgb)) : std::nullopt;
}

// ---- Colours ------------------------------------------------------------------------------------

namespace {

/// Channels come in steps of 1/255, as all engines keep them.
scene::Color fromBytes(double r, double g, double b, double alpha) {
    const auto channel = [](double v) {
        return static_cast<float>(std::round(std::clamp(v, 0.0, 255.0)) / 255);
    };
    return {channel(r), channel(g), channel(b), static_cast<float>(std::clamp(alpha, 0.0, 1.0))};
}

/// #rgb, #rgba, #rrggbb or #rrggbbaa, the cursor behind the '#'.
std::optional<scene::Color> readHex(Cursor& cursor) {
    const std::string_view digits = cursor.identifier();
    const std::size_t size = digits.size();
    if ((size != 3 && size != 4 && size != 6 && size != 8) ||
        std::any_of(digits.begin(), digits.end(), [](char c) { return hexDigit(c) < 0; }))
        return std::nullopt;
    const bool small = size < 6;
    std::array<double, 4> bytes{0, 0, 0, 255};
    for (std::size_t i = 0; i < size / (small ? 1 : 2); ++i)
        bytes[i] =
            small ? hexDigit(digits[i]) * 17 : hexDigit(digits[2 * i]) * 16 + hexDigit(digits[2 * i + 1]);
    return fromBytes(bytes[0], bytes[1], bytes[2], bytes[3] / 255);
}

/// One number of a colour function.
struct Component {
    double value;
    bool percent;
};

std::optional<Component> readComponent(Cursor& cursor) {
    cursor.skipSpaces();
    if (cursor.consume("none"))
        return Component{0, false};
    const std::optional<double> value = cursor.number();
    if (!value)
        return std::nullopt;
    return Component{*value, cursor.consume('%')};
}

/// The rest of a colour function behind its first component: two more and perhaps alpha, separated by
/// commas, spaces and, before alpha, a slash; then the closing parenthesis.
struct Tail {
    Component second, third;
    double alpha = 1;
};

std::optional<Tail> readTail(Cursor& cursor) {
    cursor.skipCommaSpaces();
    const auto second = readComponent(cursor);
    cursor.skipCommaSpaces();
    const auto third = readComponent(cursor);
    if (!second || !third)
        return std::nullopt;
    Tail tail{*second, *third};
    cursor.skipSpaces();
    if (cursor.consume(',') || cursor.consume('/')) {
        const auto alpha = readComponent(cursor);
        if (!alpha)
            return std::nullopt;
        tail.alpha = alpha->percent ? alpha->value / 100 : alpha->value;
        cursor.skipSpaces();
    }
    return cursor.consume(')') ? std::optional(tail) : std::nullopt;
}

std::optional<scene::Color> readRgb(Cursor& cursor) {
    const auto first = readComponent(cursor);
    if (!first)
        return std::nullopt;
    const auto tail = readTail(cursor);
    if (!tail)
        return std::nullopt;
    if (first->percent != tail->second.percent || first->percent != tail->third.percent)
        return std::nullopt;  // numbers and percentages do not mix
    const auto byte = [](Component c) { return c.percent ? c.value * 2.55 : c.value; };
    return fromBytes(byte(*first), byte(tail->second), byte(tail->third), tail->alpha);
}

/// CSS Color 4 section 7.1.
std::optional<scene::Color> readHsl(Cursor& cursor) {
    cursor.skipSpaces();
    const std::optional<double> hue = readAngle(cursor);
    if (!hue)
        return std::nullopt;
    const auto tail = readTail(cursor);
    if (!tail)
        return std::nullopt;
    const double saturation = std::clamp(tail->second.value / 100, 0.0, 1.0);
    const double lightness = std::clamp(tail->third.value / 100, 0.0, 1.0);
    const auto channel = [&](double n) {
        const double k = std::fmod(std::fmod(n + *hue / 30, 12.0) + 12, 12.0);
        const double a = saturation * std::min(lightness, 1 - lightness);
        return 255 * (lightness - a * std::clamp(std::min(k - 3, 9 - k), -1.0, 1.0));
    };
    return fromBytes(channel(0), channel(8), channel(4), tail->alpha);
}

// ---- Colours in other spaces (CSS Color 4 sections 8 to 10) ----------------------------------------

using Vec3 = glm::dvec3;

/// Rows of a matrix, as specifications print them.
glm::dmat3 rows(Vec3 x, Vec3 y, Vec3 z) { return glm::transpose(glm::dmat3(x, y, z)); }

const glm::dmat3 xyzToSrgb = rows({3.2409699419045226, -1.537383177570094, -0.4986107602930034},
                                  {-0.9692436362808796, 1.8759675015077202, 0.04155505740717559},
                                  {0.05563007969699366, -0.20397695888897652, 1.0569715142428786});
/// Bradford's adaptation from the white of D50.
const glm::dmat3 d50ToD65 = rows({0.955473421488075, -0.02309845494876471, 0.06325924320057072},
                                 {-0.0283697093338637, 1.0099953980813041, 0.021041441191917323},
                                 {0.012314014864481998, -0.020507649298898964, 1.330365926242124});
const Vec3 whiteD50(0.3457 / 0.3585, 1, (1 - 0.3457 - 0.3585) / 0.3585);

double srgbEncoded(double v) {
    const double size = std::abs(v);
    return std::copysign(size > 0.0031308 ? 1.055 * std::pow(size, 1 / 2.4) - 0.055 : 12.92 * size, v);
}
double srgbDecoded(double v) {
    const double size = std::abs(v);
    return std::copysign(size > 0.04045 ? std::pow((size + 0.055) / 1.055, 2.4) : size / 12.92, v);
}
Vec3 each(Vec3 v, double (*f)(double)) { return {f(v.x), f(v.y), f(v.z)}; }

/// What lies outside of sRGB is cut to it, as browsers do.
scene::Color fromXyz(Vec3 xyz, double alpha) {
    const Vec3 rgb = 255.0 * each(xyzToSrgb * xyz, srgbEncoded);
    return fromBytes(rgb.x, rgb.y, rgb.z, alpha);
}

Vec3 labToXyz(Vec3 lab) {
    constexpr double kappa = 24389.0 / 27, epsilon = 216.0 / 24389;
    const double y = (lab.x + 16) / 116, x = lab.y / 500 + y, z = y - lab.z / 200;
    const auto open = [&](double f) { return f * f * f > epsilon ? f * f * f : (116 * f - 16) / kappa; };
    const double height = lab.x > kappa * epsilon ? y * y * y : lab.x / kappa;
    return d50ToD65 * (whiteD50 * Vec3(open(x), height, open(z)));
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

/// Of a linear colour, by the name that color() has for its space.
struct RgbSpace {
    std::string_view name;
    glm::dmat3 toXyz;
    double (*decoded)(double);
    bool isD50 = false;
};

const RgbSpace* findSpace(std::string_view name) {
    const auto same = [](double v) { return v; };
    const auto gamma = [](double v) { return std::copysign(std::pow(std::abs(v), 563.0 / 256), v); };
    const auto prophoto = [](double v) {
        return std::abs(v) <= 16.0 / 512 ? v / 16 : std::copysign(std::pow(std::abs(v), 1.8), v);
    };
    const auto rec2020 = [](double v) {
        constexpr double alpha = 1.09929682680944, beta = 0.018053968510807, size = 4.5;
        return std::abs(v) < beta * size
                   ? v / size
                   : std::copysign(std::pow((std::abs(v) + alpha - 1) / alpha, 1 / 0.45), v);
    };
    static const glm::dmat3 srgb = glm::inverse(xyzToSrgb), identity(1);
    static const RgbSpace spaces[]{
        {"srgb", srgb, srgbDecoded},
        {"srgb-linear", srgb, same},
        {"display-p3",
         rows({0.4865709486482162, 0.26566769316909306, 0.1982172852343625},
              {0.2289745640697488, 0.6917385218365064, 0.079286914093745},
              {0, 0.04511338185890264, 1.043944368900976}),
         srgbDecoded},
        {"a98-rgb",
         rows({0.5766690429101305, 0.1855582379065463, 0.1882286462349947},
              {0.29734497525053605, 0.6273635662554661, 0.07529145849399788},
              {0.02703136138641234, 0.07068885253582723, 0.9913375368376388}),
         gamma},
        {"prophoto-rgb",
         rows({0.7977666449006423, 0.13518129740053308, 0.0313477341283922},
              {0.2880748288194013, 0.7118352342418731, 0.00008993693872564}, {0, 0, 0.8251046025104602}),
         prophoto, true},
        {"rec2020",
         rows({0.6369580483012914, 0.14461690358620832, 0.1688809751641721},
              {0.2627002120112671, 0.6779980715188708, 0.05930171646986196},
              {0, 0.028072693049087428, 1.060985057710791}),
         rec2020},
        {"xyz", identity, same},
        {"xyz-d65", identity, same},
        {"xyz-d50", identity, same, true}};
    const auto found =
        std::ranges::find_if(spaces, [&](const RgbSpace& s) { return equalsIgnoringCase(s.name, name); });
    return found == std::end(spaces) ? nullptr : found;
}

/// Three components and perhaps alpha, with spaces and a slash, as in all newer functions.
struct Components {
    std::array<Component, 3> values;
    double alpha = 1;
};

std::optional<Components> readComponents(Cursor& cursor, bool hueFirst, bool hueLast) {
    Components result;
    for (std::size_t i = 0; i < 3; ++i) {
        cursor.skipSpaces();
        const bool isHue = (hueFirst && i == 0) || (hueLast && i == 2);
        if (isHue && !cursor.consume("none")) {
            const auto angle = readAngle(cursor);
            if (!angle)
                return std::nullopt;
            result.values[i] = {*angle, false};
        } else if (!isHue) {
            const auto component = readComponent(cursor);
            if (!component)
                return std::nullopt;
            result.values[i] = *component;
        }
    }
    cursor.skipSpaces();
    if (cursor.consume('/')) {
        const auto alpha = readComponent(cursor);
        if (!alpha)
            return std::nullopt;
        result.alpha = alpha->percent ? alpha->value / 100 : alpha->value;
        cursor.skipSpaces();
    }
    return cursor.consume(')') ? std::optional(result) : std::nullopt;
}

/// `whole`: what 100 % are.
double valueOf(Component c, double whole) { return c.percent ? c.value / 100 * whole : c.value; }

Vec3 polar(double lightness, double chroma, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {lightness, std::max(chroma, 0.0) * std::cos(angle), std::max(chroma, 0.0) * std::sin(angle)};
}

/// lab(), lch(), oklab() and oklch().
std::optional<scene::Color> readLab(Cursor& cursor, bool isOk, bool isPolar) {
    const auto read = readComponents(cursor, false, isPolar);
    if (!read)
        return std::nullopt;
    const auto& [a, b, c] = read->values;
    const double light = isOk ? 1 : 100, axis = isOk ? 0.4 : 125, chroma = isOk ? 0.4 : 150;
    const double lightness = std::clamp(valueOf(a, light), 0.0, light);
    const Vec3 lab = isPolar ? polar(lightness, valueOf(b, chroma), c.value)
                             : Vec3(lightness, valueOf(b, axis), valueOf(c, axis));
    return fromXyz(isOk ? oklabToXyz(lab) : labToXyz(lab), read->alpha);
}

/// CSS Color 4 section 7.2.
std::optional<scene::Color> readHwb(Cursor& cursor) {
    const auto read = readComponents(cursor, true, false);
    if (!read)
        return std::nullopt;
    const double white = std::clamp(read->values[1].value / 100, 0.0, 1.0),
                 black = std::clamp(read->values[2].value / 100, 0.0, 1.0), sum = white + black;
    const auto channel = [&](double n) {
        const double k = std::fmod(std::fmod(n + read->values[0].value / 30, 12.0) + 12, 12.0);
        const double pure = 0.5 - 0.5 * std::clamp(std::min(k - 3, 9 - k), -1.0, 1.0);
        return 255 * (sum >= 1 ? white / sum : pure * (1 - sum) + white);
    };
    return fromBytes(channel(0), channel(8), channel(4), read->alpha);
}

/// `color(space x y z / alpha)`
std::optional<scene::Color> readColorFunction(Cursor& cursor) {
    cursor.skipSpaces();
    const RgbSpace* space = findSpace(cursor.identifier());
    const auto read = space ? readComponents(cursor, false, false) : std::nullopt;
    if (!read)
        return std::nullopt;
    const auto& v = read->values;
    const Vec3 xyz =
        space->toXyz * each({valueOf(v[0], 1), valueOf(v[1], 1), valueOf(v[2], 1)}, space->decoded);
    return fromXyz(space->isD50 ? d50ToD65 * xyz : xyz, read->alpha);
}

std::optional<scene::Color> readColor(Cursor& cursor, int depth);

/// One colour of color-mix() and its share.
struct Mixed {
    scene::Color color;
    std::optional<double> share;
};

std::optional<Mixed> readMixed(Cursor& cursor, int depth) {
    cursor.skipSpaces();
    const auto percentage = [&]() -> std::optional<double> {
        Cursor ahead = cursor;
        const auto number = ahead.number();
        if (!number || !ahead.consume('%'))
            return std::nullopt;
        cursor = ahead;
        return *number / 100;
    };
    auto share = percentage();
    cursor.skipSpaces();
    const auto color = readColor(cursor, depth + 1);
    cursor.skipSpaces();
    if (!share)
        share = percentage();
    cursor.skipSpaces();
    const bool isValid = color && (!share || (*share >= 0 && *share <= 1));
    return isValid ? std::optional(Mixed{*color, share}) : std::nullopt;
}

/// CSS Color 5 section 3, in srgb, srgb-linear and oklab.
std::optional<scene::Color> readMix(Cursor& cursor, int depth) {
    cursor.skipSpaces();
    const bool isIn = cursor.consume("in ");
    cursor.skipSpaces();
    const std::string_view space = cursor.identifier();
    const bool isLinear = equalsIgnoringCase(space, "srgb-linear"),
               isOklab = equalsIgnoringCase(space, "oklab");
    if (!isIn || !(isLinear || isOklab || equalsIgnoringCase(space, "srgb")))
        return std::nullopt;
    cursor.skipSpaces();
    if (!cursor.consume(','))
        return std::nullopt;
    const auto first = readMixed(cursor, depth);
    if (!first || !cursor.consume(','))
        return std::nullopt;
    const auto second = readMixed(cursor, depth);
    if (!second || !cursor.consume(')'))
        return std::nullopt;
    double a = first->share.value_or(second->share ? 1 - *second->share : 0.5),
           b = second->share.value_or(1 - a);
    const double sum = a + b, opacity = std::min(sum, 1.0);
    if (!(sum > 0))
        return std::nullopt;
    a /= sum, b /= sum;
    const auto toSpace = [&](const scene::Color& c) {
        const Vec3 rgb(c.r, c.g, c.b);
        if (!isLinear && !isOklab)
            return rgb;
        const Vec3 linear = each(rgb, srgbDecoded);
        if (isLinear)
            return linear;
        return glm::inverse(oklabToLms) * each(glm::inverse(lmsToXyz) * (glm::inverse(xyzToSrgb) * linear),
                                               [](double v) { return std::cbrt(v); });
    };
    const double alpha = a * double(first->color.a) + b * double(second->color.a);
    Vec3 mixed(0);
    if (alpha > 0)
        mixed = (a * double(first->color.a) * toSpace(first->color) +
                 b * double(second->color.a) * toSpace(second->color)) /
                alpha;
    if (isOklab)
        return fromXyz(oklabToXyz(mixed), alpha * opacity);
    const Vec3 rgb = 255.0 * (isLinear ? each(mixed, srgbEncoded) : mixed);
    return fromBytes(rgb.x, rgb.y, rgb.z, alpha * opacity);
}

std::optional<scene::Color> readColor(Cursor& cursor, int depth) {
    constexpr int maxDepth = 8;  // of color-mix() in itself
    if (depth > maxDepth)
        return std::nullopt;
    if (cursor.consume('#'))
        return readHex(cursor);
    if (cursor.consume("rgba(") || cursor.consume("rgb("))
        return readRgb(cursor);
    if (cursor.consume("hsla(") || cursor.consume("hsl("))
        return readHsl(cursor);
    if (cursor.consume("hwb("))
        return readHwb(cursor);
    if (cursor.consume("lab("))
        return readLab(cursor, false, false);
    if (cursor.consume("lch("))
        return readLab(cursor, false, true);
    if (cursor.consume("oklab("))
        return readLab(cursor, true, false);
    if (cursor.consume("oklch("))
        return readLab(cursor, true, true);
    if (cursor.consume("color("))
        return readColorFunction(cursor);
    if (cursor.consume("color-mix("))
        return readMix(cursor, depth);
    return namedColor(cursor.identifier());
}

}  // namespace

std::optional<scene::Color> readColor(Cursor& cursor) { return readColor(cursor, 0); }

std::optional<scene::Color> parseColor(std::string_view text) {
    Cursor cursor(trim(text));
    const std::optional<scene::Color> color = readColor(cursor);
    cursor.skipSpaces();
    return cursor.atEnd() || cursor.consume("icc-color(") ? color : std::nullopt;
}

}  // namespace vtm::svg
