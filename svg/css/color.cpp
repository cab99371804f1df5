#include "svg/css/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "svg/css/length.hpp"

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

}  // namespace

std::optional<scene::Color> readColor(Cursor& cursor) {
    if (cursor.consume('#'))
        return readHex(cursor);
    if (cursor.consume("rgba(") || cursor.consume("rgb("))
        return readRgb(cursor);
    if (cursor.consume("hsla(") || cursor.consume("hsl("))
        return readHsl(cursor);
    return namedColor(cursor.identifier());
}

std::optional<scene::Color> parseColor(std::string_view text) {
    Cursor cursor(trim(text));
    const std::optional<scene::Color> color = readColor(cursor);
    cursor.skipSpaces();
    return cursor.atEnd() || cursor.consume("icc-color(") ? color : std::nullopt;
}

}  // namespace vtm::svg
