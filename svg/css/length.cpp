#include "svg/css/length.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "svg/css/math.hpp"

namespace vtm::svg {
namespace {

/// How many user units one unit is; nothing for unknown ones.
std::optional<double> unitSize(std::string_view unit, const Units& units) {
    const auto is = [&](std::string_view name) { return equalsIgnoringCase(unit, name); };
    if (unit.empty() || is("px"))
        return 1;
    if (is("pt"))
        return units.dpi / 72;
    if (is("pc"))
        return units.dpi / 6;
    if (is("mm"))
        return units.dpi / 25.4;
    if (is("cm"))
        return units.dpi / 2.54;
    if (is("q"))
        return units.dpi / 101.6;
    if (is("in"))
        return units.dpi;
    if (is("em"))
        return units.fontSize;
    if (is("ex") || is("ch"))  // without font metrics, CSS Values 4 section 6.1.1 takes half an em
        return units.fontSize / 2;
    if (is("rem"))
        return units.rootFontSize;
    if (is("vw"))
        return units.root.width / 100;
    if (is("vh"))
        return units.root.height / 100;
    if (is("vmin"))
        return std::min(units.root.width, units.root.height) / 100;
    if (is("vmax"))
        return std::max(units.root.width, units.root.height) / 100;
    return std::nullopt;
}

}  // namespace

std::optional<Length> readLength(Cursor& cursor, const Units& units) {
    if (startsMath(cursor)) {
        const auto math = readMath(cursor, units);
        if (!math || math->isAngle)
            return std::nullopt;
        return math->hasPercent ? Length{math->percent, true, math->length}
                                : Length{math->isLength ? math->length : math->number};
    }
    const std::optional<double> value = cursor.number();
    if (!value)
        return std::nullopt;
    if (cursor.consume('%'))
        return Length{*value, true};
    const std::optional<double> size = unitSize(cursor.unit(), units);
    return size ? std::optional(Length{*value * *size}) : std::nullopt;
}

std::optional<Length> parseLength(std::string_view text, const Units& units) {
    Cursor cursor(trim(text));
    const std::optional<Length> length = readLength(cursor, units);
    return cursor.atEnd() ? length : std::nullopt;
}

bool isAnyLength(std::string_view text, Units units) {
    units.whole = 1;
    return parseLength(text, units).has_value();
}

bool isNotNegative(std::string_view text, const Units& units) {
    const auto length = parseLength(text, units);
    return length ? length->value >= 0 || length->plus != 0 : isAnyLength(text, units);
}

double resolve(Length length, Axis axis, const Viewport& viewport) {
    switch (axis) {
        case Axis::X:
            return length.of(viewport.width);
        case Axis::Y:
            return length.of(viewport.height);
        case Axis::Diagonal:
            break;
    }
    return length.of(std::hypot(viewport.width, viewport.height) / std::numbers::sqrt2);
}

std::optional<double> parseFraction(std::string_view text) {
    Cursor cursor(trim(text));
    if (startsMath(cursor)) {
        const auto math = readMath(cursor, {});
        if (!math || math->isAngle || !cursor.atEnd() || math->length != 0 ||
            (math->isLength && !math->hasPercent))
            return std::nullopt;
        return math->hasPercent ? math->percent / 100 : math->number;
    }
    std::optional<double> value = cursor.number();
    if (value && cursor.consume('%'))
        *value /= 100;
    return cursor.atEnd() ? value : std::nullopt;
}

std::optional<double> degreesIn(std::string_view unit) {
    const auto is = [&](std::string_view name) { return equalsIgnoringCase(unit, name); };
    return is("deg")    ? std::optional(1.0)
           : is("rad")  ? std::optional(180 / std::numbers::pi)
           : is("grad") ? std::optional(0.9)
           : is("turn") ? std::optional(360.0)
                        : std::nullopt;
}

std::optional<double> readAngle(Cursor& cursor) {
    if (startsMath(cursor)) {
        const auto math = readMath(cursor, {});
        if (!math || math->isLength)
            return std::nullopt;
        return math->isAngle ? math->length : math->number;
    }
    const std::optional<double> value = cursor.number();
    const std::string_view unit = cursor.unit();
    const auto degrees = unit.empty() ? std::optional(1.0) : degreesIn(unit);
    return value && degrees ? std::optional(*value * *degrees) : std::nullopt;
}

}  // namespace vtm::svg
