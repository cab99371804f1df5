#include "svg/src/viewbox.hpp"

#include <algorithm>
#include <array>

#include "svg/src/cursor.hpp"

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

}  // namespace

std::optional<Rect> parseViewBox(std::string_view text) {
    Cursor cursor(text);
    std::array<double, 4> values{};
    for (double& value : values) {
        cursor.skipCommaSpaces();
        const auto number = cursor.number();
        if (!number)
            return std::nullopt;
        value = *number;
    }
    if (values[2] <= 0 || values[3] <= 0)
        return std::nullopt;
    return Rect{values[0], values[1], values[2], values[3]};
}

AspectRatio parseAspectRatio(std::string_view text) {
    Cursor cursor(text);
    cursor.skipSpaces();
    if (cursor.consume("defer"))
        cursor.skipSpaces();
    AspectRatio ratio;
    if (cursor.consume("none")) {
        ratio.keep = false;
        return ratio;
    }
    const auto x = cursor.consume('x') ? readAlignment(cursor) : std::nullopt;
    const auto y = cursor.consume('Y') ? readAlignment(cursor) : std::nullopt;
    if (!x || !y)
        return {};
    cursor.skipSpaces();
    return {true, *x, *y, cursor.consume("slice")};
}

Rect fittedRect(double contentWidth, double contentHeight, const AspectRatio& ratio, const Rect& viewport) {
    if (!ratio.keep)
        return viewport;
    const double scaleX = viewport.width / contentWidth, scaleY = viewport.height / contentHeight;
    const double scale = ratio.slice ? std::max(scaleX, scaleY) : std::min(scaleX, scaleY);
    const double width = contentWidth * scale, height = contentHeight * scale;
    return {viewport.x + (viewport.width - width) * ratio.alignX,
            viewport.y + (viewport.height - height) * ratio.alignY, width, height};
}

scene::Affine fit(const Rect& viewBox, const AspectRatio& ratio, const Rect& viewport) {
    const Rect to = fittedRect(viewBox.width, viewBox.height, ratio, viewport);
    const double scaleX = to.width / viewBox.width, scaleY = to.height / viewBox.height;
    return {scaleX, 0, 0, scaleY, to.x - viewBox.x * scaleX, to.y - viewBox.y * scaleY};
}

}  // namespace vtm::svg
