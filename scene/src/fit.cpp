#include <vtm/scene/fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>

namespace vtm::scene {

namespace {

/// Cosine and sine; exact for quarter turns, which then map pixels to pixels.
Point turnBy(double degrees) {
    constexpr std::array<Point, 4> quarters{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const double rest = std::fmod(degrees, 360), positive = rest < 0 ? rest + 360 : rest;
    const double quarter = positive / 90;
    if (quarter == std::floor(quarter))
        return quarters[std::size_t(quarter) % 4];
    const double angle = positive * std::numbers::pi / 180;
    return {std::cos(angle), std::sin(angle)};
}

Point turned(Point p, Point turn) { return {p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x}; }

/// Of a rectangle from the origin after a turn.
Rect turnedBounds(Point size, Point turn) {
    const Point x = turned({size.x, 0}, turn), y = turned({0, size.y}, turn);
    const Point min = glm::min(x, 0.0) + glm::min(y, 0.0), max = glm::max(x, 0.0) + glm::max(y, 0.0);
    return {min.x, min.y, max.x - min.x, max.y - min.y};
}

double rounded(double side) { return std::max(1.0, std::round(side)); }

Point rasterSize(const Framing& framing, const Rect& bounds) {
    if (framing.width && framing.height)
        return {double(*framing.width), double(*framing.height)};
    if (framing.width)
        return {double(*framing.width), rounded(*framing.width * bounds.height / bounds.width)};
    if (framing.height)
        return {rounded(*framing.height * bounds.width / bounds.height), double(*framing.height)};
    return {rounded(bounds.width * framing.scale), rounded(bounds.height * framing.scale)};
}

}  // namespace

Rect fittedRect(double contentWidth, double contentHeight, const Placement& placement, const Rect& viewport) {
    if (placement.fit == Fit::Stretch)
        return viewport;
    const double scaleX = viewport.width / contentWidth, scaleY = viewport.height / contentHeight;
    const double scale = placement.fit == Fit::Cover ? std::max(scaleX, scaleY) : std::min(scaleX, scaleY);
    const double width = contentWidth * scale, height = contentHeight * scale;
    return {viewport.x + (viewport.width - width) * placement.alignX,
            viewport.y + (viewport.height - height) * placement.alignY, width, height};
}

Affine fittedMap(const Rect& content, const Placement& placement, const Rect& viewport) {
    const Rect to = fittedRect(content.width, content.height, placement, viewport);
    const double scaleX = to.width / content.width, scaleY = to.height / content.height;
    return {scaleX, 0, 0, scaleY, to.x - content.x * scaleX, to.y - content.y * scaleY};
}

Affine Frame::toPixels() const { return toPixels({0, 0}, {1, 1}); }

Affine Frame::toPixels(Point from, Point scale) const {
    const Point perUnit = 1.0 / pixel;
    const auto vector = [&](Point v) { return turned(v, turn) * perUnit; };
    return {vector({1, 0}) / scale.x, vector({0, 1}) / scale.y, originPixel + vector(from - origin)};
}

Rect Frame::seen() const {
    const Point back(turn.x, -turn.y), first = turned(-originPixel * pixel, back);
    const Rect bounds = turnedBounds(Point(width, height) * pixel, back);
    return {origin.x + (first.x + bounds.x), origin.y + (first.y + bounds.y), bounds.width, bounds.height};
}

Frame frame(const Framing& framing, double pictureWidth, double pictureHeight) {
    const Rect part = framing.part.value_or(Rect{0, 0, pictureWidth, pictureHeight});
    const Point turn = turnBy(framing.rotation);
    const Rect bounds = turnedBounds({part.width, part.height}, turn);
    const Point size = rasterSize(framing, bounds);
    const bool isGiven = framing.width && framing.height;
    const Rect to = fittedRect(bounds.width, bounds.height,
                               isGiven ? framing.placement : Placement{Fit::Stretch}, {0, 0, size.x, size.y});
    const Point pixel{bounds.width / to.width, bounds.height / to.height};
    return {size.x, size.y,           pixel,
            turn,   {part.x, part.y}, {to.x - bounds.x / pixel.x, to.y - bounds.y / pixel.y}};
}

}  // namespace vtm::scene
