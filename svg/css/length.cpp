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
        if (!math)
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
        if (!math || !cursor.atEnd() || math->length != 0 || (math->isLength && !math->hasPercent))
            return std::nullopt;
        return math->hasPercent ? math->percent / 100 : math->number;
    }
    std::optional<double> value = cursor.number();
    if (value && cursor.consume('%'))
        *value /= 100;
    return cursor.atEnd() ? value : std::nullopt;
}

std::optional<double> readAngle(Cursor& cursor) {
    const std::optional<double> value = cursor.number();
    if (!value)
        return std::nullopt;
    const std::string_view unit = cursor.unit();
    const auto is = [&](std::string_view name) { return equalsIgnoringCase(unit, name); };
    if (unit.empty() || is("deg"))
        return *value;
    if (is("rad"))
        return *value * 180 / std::numbers::pi;
    if (is("grad"))
        return *value * 0.9;
    if (is("turn"))
        return *value * 360;
    return std::nullopt;
}

}  // namespace vtm::svg
