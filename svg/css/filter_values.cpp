#include "svg/css/filter_values.hpp"

#include <algorithm>

#include "svg/css/color.hpp"
#include "svg/css/property_values.hpp"

namespace vtm::svg {
namespace {

using FunctionKind = FilterFunction::Kind;

constexpr Keyword<FunctionKind> functionNames[]{
    {"blur", FunctionKind::Blur},           {"brightness", FunctionKind::Brightness},
    {"contrast", FunctionKind::Contrast},   {"drop-shadow", FunctionKind::DropShadow},
    {"grayscale", FunctionKind::Grayscale}, {"hue-rotate", FunctionKind::HueRotate},
    {"invert", FunctionKind::Invert},       {"opacity", FunctionKind::Opacity},
    {"saturate", FunctionKind::Saturate},   {"sepia", FunctionKind::Sepia}};

/// A length that is no percentage.
std::optional<double> readPlainLength(Cursor& cursor, const Units& units) {
    const auto length = readLength(cursor, units);
    return length && !length->percent ? std::optional(length->value) : std::nullopt;
}

bool readBlur(std::string_view text, const Units& units, FilterFunction& function) {
    const auto length = text.empty() ? std::optional(Length{}) : parseLength(text, units);
    if (!length || length->percent || length->value < 0)
        return false;
    function.deviation = length->value;
    return true;
}

/// `color? && length{2,3}`
bool readDropShadow(std::string_view text, const Units& units, FilterFunction& function) {
    Cursor cursor(text);
    bool hasColor = false;
    std::vector<double> lengths;
    const auto readAnyColor = [&] {
        if (cursor.consume(std::string_view("currentColor"))) {
            function.color.current = true;
            return true;
        }
        const auto color = readColor(cursor);
        if (color)
            function.color = {false, *color};
        return color.has_value();
    };
    while (cursor.skipSpaces(), !cursor.atEnd()) {
        const char first = cursor.peek();
        const bool isNumber = isDigit(first) || first == '.' || first == '-' || first == '+';
        if (isNumber) {
            if (!lengths.empty() && hasColor && lengths.size() == 3)
                return false;
            const auto length = readPlainLength(cursor, units);
            if (!length)
                return false;
            lengths.push_back(*length);
        } else if (hasColor || (!lengths.empty() && lengths.size() < 2) || !readAnyColor()) {
            return false;
        } else {
            hasColor = true;
        }
    }
    if (lengths.size() < 2 || lengths.size() > 3 || (lengths.size() == 3 && lengths[2] < 0))
        return false;
    function.x = lengths[0];
    function.y = lengths[1];
    function.deviation = lengths.size() == 3 ? lengths[2] : 0;
    return true;
}

bool readHueRotate(std::string_view text, FilterFunction& function) {
    Cursor cursor(text);
    const auto angle = text.empty() ? std::optional(0.0) : readAngle(cursor);
    if (!angle || !trim(cursor.rest()).empty())
        return false;
    // Only zero may stand without a unit.
    const char last = text.empty() ? 'g' : text.back();
    if (*angle != 0 && (isDigit(last) || last == '.'))
        return false;
    function.amount = *angle;
    return true;
}

bool readAmount(std::string_view text, FilterFunction& function) {
    const auto amount = text.empty() ? std::optional(1.0) : parseFraction(text);
    if (!amount || *amount < 0)
        return false;
    const FunctionKind kind = function.kind;
    const bool mayExceedOne =
        kind == FunctionKind::Brightness || kind == FunctionKind::Contrast || kind == FunctionKind::Saturate;
    function.amount = mayExceedOne ? *amount : std::min(*amount, 1.0);
    return true;
}

bool readArguments(std::string_view text, const Units& units, FilterFunction& function) {
    switch (function.kind) {
        case FunctionKind::Blur:
            return readBlur(text, units, function);
        case FunctionKind::DropShadow:
            return readDropShadow(text, units, function);
        case FunctionKind::HueRotate:
            return readHueRotate(text, function);
        default:
            return readAmount(text, function);
    }
}

std::optional<FilterFunction> readFunction(Cursor& cursor, const Units& units) {
    const auto kind = findKeyword(cursor.identifier(), functionNames);
    if (!kind || !cursor.consume('('))
        return std::nullopt;
    const std::size_t length = extentOf(cursor.rest(), ")");
    if (length >= cursor.rest().size())
        return std::nullopt;
    const std::string_view arguments = trim(cursor.rest().substr(0, length));
    cursor.advance(length + 1);
    FilterFunction function;
    function.kind = *kind;
    return readArguments(arguments, units, function) ? std::optional(function) : std::nullopt;
}

}  // namespace

std::optional<std::vector<FilterValue>> parseFilterList(std::string_view text, const Units& units) {
    std::vector<FilterValue> list;
    if (equalsIgnoringCase(trim(text), "none"))
        return list;
    for (Cursor cursor(text); cursor.skipSpaces(), !cursor.atEnd();) {
        if (const auto href = readUrl(cursor)) {
            list.push_back(FilterReference{*href});
            continue;
        }
        const auto function = readFunction(cursor, units);
        if (!function)
            return std::nullopt;
        list.push_back(*function);
    }
    return list;
}

}  // namespace vtm::svg
