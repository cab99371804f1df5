#include "svg/geometry/viewbox.hpp"

#include <algorithm>
#include <array>

#include "svg/css/cursor.hpp"

namespace vtm::svg {
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
