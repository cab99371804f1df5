#include "svg/geometry/transform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "svg/css/cursor.hpp"

namespace vtm::svg {

// ---- Transforms ---------------------------------------------------------------------------------

namespace {

using scene::Affine;

struct Arguments {
    const Units& units;
    const Viewport& viewport;
    std::vector<Length> values;
    std::size_t count() const { return values.size(); }
    double operator[](std::size_t i) const { return i < count() ? values[i].value : 0; }
    /// As a length along an axis, 0 where absent.
    double length(std::size_t i, Axis axis) const {
        return i < count() ? resolve(values[i], axis, viewport) : 0;
    }
    /// As a factor: percentages are allowed there.
    double factor(std::size_t i) const { return values[i].percent ? values[i].value / 100 : values[i].value; }
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Functions of three dimensions, seen along z (CSS Transforms 2 section 12); those that turn the plane out
/// of itself are not known.
std::optional<Affine> makeSpatial(std::string_view name, const Arguments& a) {
    const auto is = [&](std::string_view other, std::size_t count) {
        return equalsIgnoringCase(name, other) && a.count() == count;
    };
    if (is("translate3d", 3))
        return scene::translation(a.length(0, Axis::X), a.length(1, Axis::Y));
    if (is("scale3d", 3))
        return scene::scaling(a.factor(0), a.factor(1));
    if (is("rotateZ", 1))
        return rotation(a[0]);
    if (is("rotate3d", 4) && a[0] == 0 && a[1] == 0)
        return rotation(std::copysign(a[2] == 0 ? 0 : a[3], a[2] * a[3]));
    if (is("matrix3d", 16))
        return Affine{a[0], a[1], a[4], a[5], a[12], a[13]};
    return is("translateZ", 1) || is("scaleZ", 1) ? std::optional(scene::identity) : std::nullopt;
}

std::optional<Affine> makeTransform(std::string_view name, const Arguments& a) {
    const auto is = [&](std::string_view other, std::size_t minimum, std::size_t maximum) {
        return equalsIgnoringCase(name, other) && a.count() >= minimum && a.count() <= maximum;
    };
    if (is("matrix", 6, 6))
        return Affine{a[0], a[1], a[2], a[3], a[4], a[5]};
    if (is("translate", 1, 2))
        return scene::translation(a.length(0, Axis::X), a.length(1, Axis::Y));
    if (is("translateX", 1, 1))
        return scene::translation(a.length(0, Axis::X), 0);
    if (is("translateY", 1, 1))
        return scene::translation(0, a.length(0, Axis::Y));
    if (is("scale", 1, 2))
        return scene::scaling(a.factor(0), a.factor(a.count() - 1));
    if (is("scaleX", 1, 1))
        return scene::scaling(a.factor(0), 1);
    if (is("scaleY", 1, 1))
        return scene::scaling(1, a.factor(0));
    if (is("rotate", 1, 1))
        return rotation(a[0]);
    if (is("rotate", 2, 3))
        return aroundPoint(rotation(a[0]), {a[1], a[2]});
    if (is("skewX", 1, 1))
        return Affine{1, 0, std::tan(radians(a[0])), 1, 0, 0};
    if (is("skewY", 1, 1))
        return Affine{1, std::tan(radians(a[0])), 0, 1, 0, 0};
    if (is("skew", 1, 2))
        return Affine{1, std::tan(radians(a[1])), std::tan(radians(a[0])), 1, 0, 0};
    return makeSpatial(name, a);
}

bool takesAngles(std::string_view name) {
    return equalsIgnoringCase(name.substr(0, 6), "rotate") || equalsIgnoringCase(name.substr(0, 4), "skew");
}

std::optional<Length> readArgument(Cursor& cursor, bool angle, const Units& units) {
    if (!angle)
        return readLength(cursor, units);
    const std::optional<double> degrees = readAngle(cursor);
    return degrees ? std::optional(Length{*degrees}) : std::nullopt;
}

std::optional<Affine> readFunction(Cursor& cursor, const Units& units, const Viewport& viewport) {
    const std::string_view name = cursor.identifier();
    cursor.skipSpaces();
    if (!cursor.consume('('))
        return std::nullopt;
    Arguments arguments{units, viewport, {}};
    cursor.skipSpaces();
    while (!cursor.consume(')')) {
        // Only rotate's first argument is an angle; the others have no unit in practice.
        const std::optional<Length> value = readArgument(cursor, takesAngles(name), units);
        constexpr std::size_t most = 16;
        if (!value || arguments.count() >= most)
            return std::nullopt;
        arguments.values.push_back(*value);
        cursor.skipCommaSpaces();
    }
    return makeTransform(name, arguments);
}

std::optional<Length> originKeyword(std::string_view word, Axis axis) {
    const auto is = [&](std::string_view name) { return equalsIgnoringCase(word, name); };
    if (is("center"))
        return Length{50, true};
    if (axis == Axis::X ? is("left") : is("top"))
        return Length{0, true};
    if (axis == Axis::X ? is("right") : is("bottom"))
        return Length{100, true};
    return std::nullopt;
}

std::optional<Length> originPart(std::string_view word, Axis axis, const Units& units) {
    const std::optional<Length> keyword = originKeyword(word, axis);
    return keyword ? keyword : parseLength(word, units);
}

/// Up to the next space outside of brackets.
std::string_view readWord(Cursor& cursor) {
    cursor.skipSpaces();
    const std::string_view word = cursor.rest().substr(0, extentOf(cursor.rest(), " \t\n\r\f"));
    cursor.advance(word.size());
    return word;
}

/// One to `most` values with spaces between them.
std::vector<Length> readLengths(std::string_view text, const Units& units, std::size_t most) {
    std::vector<Length> values;
    for (Cursor cursor(trim(text)); !cursor.atEnd(); cursor.skipSpaces()) {
        const auto value = readLength(cursor, units);
        if (!value || values.size() == most || (!cursor.atEnd() && !isSpace(cursor.peek())))
            return {};
        values.push_back(*value);
    }
    return values;
}

}  // namespace

Affine rotation(double degrees) {
    const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
    return {c, s, -s, c, 0, 0};
}

Affine aroundPoint(const Affine& transform, glm::dvec2 origin) {
    return scene::compose(scene::compose(scene::translation(origin.x, origin.y), transform),
                          scene::translation(-origin.x, -origin.y));
}

Affine nested(const Affine& outer, const Affine& inner) {
    Affine result = scene::compose(outer, inner);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 2; ++row) {
            const double magnitude = std::abs(outer[0][row] * inner[column][0]) +
                                     std::abs(outer[1][row] * inner[column][1]) +
                                     (column == 2 ? std::abs(outer[2][row]) : 0);
            const double whole = row == column ? std::round(result[column][row]) : 0;
            if (whole <= 1 && std::abs(result[column][row] - whole) <= cancellationError * magnitude)
                result[column][row] = whole;
        }
    return result;
}

std::optional<Affine> parseTransform(std::string_view text, const Units& units, const Viewport& viewport) {
    Affine result = scene::identity;
    text = trim(text);
    if (equalsIgnoringCase(text, "none"))
        return result;
    for (Cursor cursor(text); !cursor.atEnd(); cursor.skipCommaSpaces()) {
        const std::optional<Affine> next = readFunction(cursor, units, viewport);
        if (!next)
            return std::nullopt;
        result = scene::compose(result, *next);
    }
    return result;
}

std::optional<Affine> parseTranslate(std::string_view text, const Units& units, const Viewport& viewport) {
    if (equalsIgnoringCase(trim(text), "none"))
        return scene::identity;
    const std::vector<Length> values = readLengths(text, units, 3);
    if (values.empty())
        return std::nullopt;
    const Arguments arguments{units, viewport, values};
    return scene::translation(arguments.length(0, Axis::X), arguments.length(1, Axis::Y));
}

std::optional<Affine> parseRotate(std::string_view text) {
    Cursor cursor(trim(text));
    if (equalsIgnoringCase(cursor.rest(), "none"))
        return scene::identity;
    if (cursor.consume("z ") || cursor.consume("0 0 1 "))
        cursor.skipSpaces();
    const auto degrees = readAngle(cursor);
    return degrees && cursor.atEnd() ? std::optional(rotation(*degrees)) : std::nullopt;
}

std::optional<Affine> parseScale(std::string_view text) {
    if (equalsIgnoringCase(trim(text), "none"))
        return scene::identity;
    const std::vector<Length> values = readLengths(text, {}, 3);
    if (values.empty())
        return std::nullopt;
    const Arguments arguments{{}, {}, values};
    return scene::scaling(arguments.factor(0), arguments.factor(values.size() > 1 ? 1 : 0));
}

std::optional<TransformOrigin> parseTransformOrigin(std::string_view text, const Units& units) {
    Cursor cursor(text);
    const std::string_view first = readWord(cursor), second = readWord(cursor);
    const bool swapped =
        !originPart(first, Axis::X, units);  // "top", "top left": keywords may come in any order
    const std::string_view xWord = swapped ? second : first, yWord = swapped ? first : second;
    const std::optional<Length> x = originPart(xWord.empty() ? "center" : xWord, Axis::X, units);
    const std::optional<Length> y = originPart(yWord.empty() ? "center" : yWord, Axis::Y, units);
    return x && y ? std::optional(TransformOrigin{*x, *y}) : std::nullopt;
}

// ---- viewBox and preserveAspectRatio ------------------------------------------------------------

namespace {

/// `xMin`, `YMax`, …: the fraction that the last three letters stand for.
std::optional<double> readAlignment(Cursor& cursor) {
    constexpr std::array<std::pair<std::string_view, double>, 3> words{
        {{"Min", 0}, {"Mid", 0.5}, {"Max", 1}}};
    for (const auto& [word, fraction] : words)
        if (cursor.consume(word))
            return fraction;
    return std::nullopt;
}

std::optional<Rect> readRect(std::string_view text) {
    Cursor cursor(text);
    std::array<double, 4> values{};
    for (double& value : values) {
        cursor.skipCommaSpaces();
        const auto number = cursor.number();
        if (!number)
            return std::nullopt;
        value = *number;
    }
    return Rect{values[0], values[1], values[2], values[3]};
}

}  // namespace

std::optional<Rect> parseViewBox(std::string_view text) {
    const auto rect = readRect(text);
    return rect && rect->width > 0 && rect->height > 0 ? rect : std::nullopt;
}

bool isEmptyViewBox(std::string_view text) {
    const auto rect = readRect(text);
    return rect && std::min(rect->width, rect->height) == 0;
}

std::optional<AspectRatio> readAspectRatio(std::string_view text) {
    Cursor cursor(trim(text));
    if (cursor.consume("defer"))
        cursor.skipSpaces();
    AspectRatio ratio;
    const bool keepsAspect = !cursor.consume("none");
    if (keepsAspect) {
        const auto x = cursor.consume('x') ? readAlignment(cursor) : std::nullopt;
        const auto y = cursor.consume('Y') ? readAlignment(cursor) : std::nullopt;
        if (!x || !y)
            return std::nullopt;
        ratio.alignX = *x;
        ratio.alignY = *y;
    }
    cursor.skipSpaces();
    const bool slices = cursor.consume("slice");
    if (!slices)
        cursor.consume("meet");
    ratio.fit = !keepsAspect ? scene::Fit::Stretch : slices ? scene::Fit::Cover : scene::Fit::Contain;
    return cursor.atEnd() ? std::optional(ratio) : std::nullopt;
}

}  // namespace vtm::svg
