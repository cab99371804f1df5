#include "svg/css/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "svg/css/color_spaces.hpp"
#include "svg/css/length.hpp"
#include "svg/css/math.hpp"

namespace vtm::svg {

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
    if (startsMath(cursor)) {
        const auto math = readMath(cursor, {});
        if (!math || math->length != 0 || math->isLength != math->hasPercent)
            return std::nullopt;
        return Component{math->hasPercent ? math->percent : math->number, math->hasPercent};
    }
    const std::optional<double> value = cursor.number();
    if (!value)
        return std::nullopt;
    return Component{*value, cursor.consume('%')};
}

/// The rest of a colour function behind its first component: two more and perhaps alpha, with commas, or with
/// spaces and a slash before alpha; then the closing parenthesis.
struct Tail {
    Component second, third;
    double alpha = 1;
    bool hasCommas = false;
};

std::optional<Tail> readTail(Cursor& cursor) {
    cursor.skipSpaces();
    const bool hasCommas = cursor.consume(',');
    const auto second = readComponent(cursor);
    cursor.skipSpaces();
    if (cursor.consume(',') != hasCommas)
        return std::nullopt;
    const auto third = readComponent(cursor);
    if (!second || !third)
        return std::nullopt;
    Tail tail{*second, *third, 1, hasCommas};
    cursor.skipSpaces();
    if (cursor.consume(hasCommas ? ',' : '/')) {
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
    const auto tail = first ? readTail(cursor) : std::nullopt;
    if (!tail)
        return std::nullopt;
    const bool isMixed = first->percent != tail->second.percent || first->percent != tail->third.percent;
    if (isMixed && tail->hasCommas)
        return std::nullopt;
    const auto byte = [](Component c) { return c.percent ? c.value * 255 / 100 : c.value; };
    return fromBytes(byte(*first), byte(tail->second), byte(tail->third), tail->alpha);
}

std::optional<double> readHue(Cursor& cursor) {
    cursor.skipSpaces();
    return cursor.consume("none") ? std::optional(0.0) : readAngle(cursor);
}

scene::Color fromXyz(Vec3 xyz, double alpha);

/// CSS Color 4 section 7.1.
std::optional<scene::Color> readHsl(Cursor& cursor) {
    const auto hue = readHue(cursor);
    const auto tail = hue ? readTail(cursor) : std::nullopt;
    if (!tail)
        return std::nullopt;
    const double saturation = std::clamp(tail->second.value / 100, 0.0, 1.0);
    const double lightness = std::clamp(tail->third.value / 100, 0.0, 1.0);
    return fromXyz(findColorSpace("hsl")->toXyz({*hue, saturation, lightness}), tail->alpha);
}

// ---- Colours in other spaces (CSS Color 4 sections 7 to 10) ----------------------------------------

/// What lies outside of sRGB is cut to it, as browsers do.
scene::Color fromXyz(Vec3 xyz, double alpha) {
    const Vec3 rgb = 255.0 * findColorSpace("srgb")->fromXyz(xyz);
    return fromBytes(rgb.x, rgb.y, rgb.z, alpha);
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
        const auto angle = isHue ? readHue(cursor) : std::nullopt;
        const auto component = angle   ? Component{*angle, false}
                               : isHue ? std::nullopt
                                       : readComponent(cursor);
        if (!component)
            return std::nullopt;
        result.values[i] = *component;
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

/// lab(), lch(), oklab() and oklch().
std::optional<scene::Color> readLab(Cursor& cursor, const ColorSpace& space, bool isOk) {
    const bool isPolar = space.hue >= 0;
    const auto read = readComponents(cursor, false, isPolar);
    if (!read)
        return std::nullopt;
    const auto& [a, b, c] = read->values;
    const double light = isOk ? 1 : 100, axis = isOk ? 0.4 : 125, chroma = isOk ? 0.4 : 150;
    const Vec3 value(std::clamp(valueOf(a, light), 0.0, light), valueOf(b, isPolar ? chroma : axis),
                     valueOf(c, axis));
    return fromXyz(space.toXyz(value), read->alpha);
}

/// CSS Color 4 section 8.
std::optional<scene::Color> readHwb(Cursor& cursor) {
    const auto read = readComponents(cursor, true, false);
    if (!read)
        return std::nullopt;
    const double white = std::clamp(read->values[1].value / 100, 0.0, 1.0),
                 black = std::clamp(read->values[2].value / 100, 0.0, 1.0);
    return fromXyz(findColorSpace("hwb")->toXyz({read->values[0].value, white, black}), read->alpha);
}

/// `color(space x y z / alpha)`
std::optional<scene::Color> readColorFunction(Cursor& cursor) {
    cursor.skipSpaces();
    const ColorSpace* space = findColorSpace(cursor.identifier());
    const auto read = space && space->isCommon ? readComponents(cursor, false, false) : std::nullopt;
    if (!read)
        return std::nullopt;
    const auto& v = read->values;
    return fromXyz(space->toXyz({valueOf(v[0], 1), valueOf(v[1], 1), valueOf(v[2], 1)}), read->alpha);
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

/// CSS Color 4 section 12.4.
enum class HueArc { Shorter, Longer, Increasing, Decreasing };

HueArc readHueArc(Cursor& cursor) {
    for (const auto& [name, arc] : {std::pair("shorter hue", HueArc::Shorter),
                                    {"longer hue", HueArc::Longer},
                                    {"increasing hue", HueArc::Increasing},
                                    {"decreasing hue", HueArc::Decreasing}})
        if (cursor.consume(name))
            return arc;
    return HueArc::Shorter;
}

double mixedHue(double from, double to, double share, HueArc arc) {
    double turn = to - from;
    const bool isShort = std::abs(turn) < 180 || turn == 180;
    switch (arc) {
        case HueArc::Shorter:
            turn += isShort || turn == -180 ? 0 : turn > 0 ? -360 : 360;
            break;
        case HueArc::Longer:
            turn += !isShort ? 0 : turn > 0 ? -360 : 360;
            break;
        case HueArc::Increasing:
            turn += turn < 0 ? 360 : 0;
            break;
        case HueArc::Decreasing:
            turn -= turn > 0 ? 360 : 0;
            break;
    }
    return from + share * turn;
}

bool isGrey(const scene::Color& c) { return c.r == c.g && c.g == c.b; }

/// Colours weighted by their alpha, hues not; a grey has the other one's hue (CSS Color 4 section 12).
scene::Color mixed(const scene::Color& first, const scene::Color& second, double share,
                   const ColorSpace& space, HueArc arc, double opacity) {
    const auto inSpace = [&](const scene::Color& c) {
        return space.fromXyz(findColorSpace("srgb")->toXyz({c.r, c.g, c.b}));
    };
    const Vec3 a = inSpace(first), b = inSpace(second);
    const double weightA = (1 - share) * double(first.a), weightB = share * double(second.a),
                 alpha = weightA + weightB;
    Vec3 result = alpha > 0 ? (weightA * a + weightB * b) / alpha : Vec3(0);
    if (const int h = space.hue; h >= 0)
        result[h] = isGrey(first) ? b[h] : isGrey(second) ? a[h] : mixedHue(a[h], b[h], share, arc);
    return fromXyz(space.toXyz(result), alpha * opacity);
}

/// `color-mix(in space, colour share, colour share)`: CSS Color 5 section 3.
std::optional<scene::Color> readMix(Cursor& cursor, int depth) {
    cursor.skipSpaces();
    const bool isIn = cursor.consume("in ");
    cursor.skipSpaces();
    const ColorSpace* space = isIn ? findColorSpace(cursor.identifier()) : nullptr;
    cursor.skipSpaces();
    const HueArc arc = readHueArc(cursor);
    cursor.skipSpaces();
    if (!space || !cursor.consume(','))
        return std::nullopt;
    const auto first = readMixed(cursor, depth);
    if (!first || !cursor.consume(','))
        return std::nullopt;
    const auto second = readMixed(cursor, depth);
    if (!second || !cursor.consume(')'))
        return std::nullopt;
    const double a = first->share.value_or(second->share ? 1 - *second->share : 0.5),
                 b = second->share.value_or(1 - a), sum = a + b;
    if (!(sum > 0))
        return std::nullopt;
    return mixed(first->color, second->color, b / sum, *space, arc, std::min(sum, 1.0));
}

/// `light-dark(colour, colour)`, of which a light scheme has the first (CSS Color 5 section 5).
std::optional<scene::Color> readLightDark(Cursor& cursor, int depth) {
    cursor.skipSpaces();
    const auto light = readColor(cursor, depth + 1);
    cursor.skipSpaces();
    if (!light || !cursor.consume(','))
        return std::nullopt;
    cursor.skipSpaces();
    const auto dark = readColor(cursor, depth + 1);
    cursor.skipSpaces();
    return dark && cursor.consume(')') ? light : std::nullopt;
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
    for (const std::string_view name : {"lab", "lch", "oklab", "oklch"}) {
        Cursor ahead = cursor;
        if (ahead.consume(name) && ahead.consume('(')) {
            cursor = ahead;
            return readLab(cursor, *findColorSpace(name), name.starts_with("ok"));
        }
    }
    if (cursor.consume("color("))
        return readColorFunction(cursor);
    if (cursor.consume("color-mix("))
        return readMix(cursor, depth);
    if (cursor.consume("light-dark("))
        return readLightDark(cursor, depth);
    const std::string_view name = cursor.identifier();
    const auto named = namedColor(name);
    return named ? named : systemColor(name);
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
