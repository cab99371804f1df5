#include "tools/src/framing.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/core.h>

#include "tools/src/commands.hpp"

namespace vtm::tools {

namespace {

double parseNumber(const char*& at, const char* end) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value))
        throw UsageError("--view: wants four numbers: x,y,width,height");
    at = next;
    return value;
}

Rectangle parseView(const std::string& text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    double numbers[4];
    for (int i = 0; i < 4; ++i) {
        if (i > 0 && (at == end || *at++ != ','))
            throw UsageError("--view: wants four numbers: x,y,width,height");
        numbers[i] = parseNumber(at, end);
    }
    if (at != end || numbers[2] <= 0 || numbers[3] <= 0)
        throw UsageError("--view: wants x,y,width,height with width and height above zero");
    return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

struct Size {
    double width, height;
};

Size wantedSize(const Framing& framing, const Rectangle& part) {
    if (framing.width && framing.height)
        return {double(*framing.width), double(*framing.height)};
    if (framing.width)
        return {double(*framing.width), *framing.width * part.height / part.width};
    if (framing.height)
        return {*framing.height * part.width / part.height, double(*framing.height)};
    return {part.width * framing.scale, part.height * framing.scale};
}

/// Doubles until the limit has been checked: a file may ask for 1e30 pixels.
Size limited(Size size) {
    size = {std::max(1.0, std::round(size.width)), std::max(1.0, std::round(size.height))};
    if (size.width > asset::maxViewSide || size.height > asset::maxViewSide ||
        size.width * size.height > double(asset::maxViewPixels))
        throw std::length_error(fmt::format(
            "{:.0f} x {:.0f} pixels are too many (at most {} a side and {} in all); choose a smaller "
            "--width, --height or --scale",
            size.width, size.height, asset::maxViewSide, asset::maxViewPixels));
    return size;
}

}  // namespace

void addFramingOptions(CLI::App& command, Framing& framing) {
    const auto side = CLI::Range(1, asset::maxViewSide);
    auto* width =
        command.add_option("--width", framing.width, "Pixels; alone it keeps the aspect")->check(side);
    auto* height =
        command.add_option("--height", framing.height, "Pixels; alone it keeps the aspect")->check(side);
    command.add_option("--scale", framing.scale, "Pixels a user unit")
        ->check(CLI::PositiveNumber)
        ->excludes(width)
        ->excludes(height);
    command.add_option_function<std::string>(
        "--view", [&framing](const std::string& text) { framing.part = parseView(text); },
        "x,y,width,height in user units: the part that fills the raster");
}

asset::View frame(const Framing& framing, double pictureWidth, double pictureHeight) {
    const Rectangle part = framing.part.value_or(Rectangle{0, 0, pictureWidth, pictureHeight});
    const Size size = limited(wantedSize(framing, part));
    const double sx = size.width / part.width, sy = size.height / part.height;
    return {int(size.width), int(size.height), {sx, 0, 0, sy, -part.x * sx, -part.y * sy}};
}

}  // namespace vtm::tools
