// Paints as values of fill and stroke.

#include <cmath>

#include <fmt/format.h>

#include "svg/write/values.hpp"
#include "svg/write/writer.hpp"

namespace vtm::svg {

using namespace scene;

namespace {

std::string url(const std::string& id) { return "url(#" + id + ")"; }

std::string stopElement(const GradientStop& stop) {
    return "<stop" + attribute("offset", number(stop.offset)) + attribute("stop-color", hex(stop.color)) +
           opacityAttribute("stop-opacity", stop.color.a) + "/>\n";
}

/// What both kinds of gradients have, behind their geometry.
template <class Gradient>
std::string commonPart(const Gradient& gradient) {
    constexpr const char* spreads[] = {"pad", "reflect", "repeat"};
    std::string text = attribute("gradientUnits", "userSpaceOnUse");
    if (gradient.spread != Spread::Pad)
        text += attribute("spreadMethod", spreads[int(gradient.spread)]);
    text += transformAttribute("gradientTransform", gradient.transform) + ">\n";
    for (const GradientStop& stop : gradient.stops) {
        limits::check();
        text += stopElement(stop);
    }
    return text;
}

/// A length that leads from one number to the other when added to it, if there is one.
double span(double from, double to) {
    const double length = to - from;
    for (const double near : {length, std::nextafter(length, 0), std::nextafter(length, INFINITY)})
        if (from + near == to)
            return near;
    return length;
}

/// A tile that does not begin at the origin needs a viewBox: else the origin of the content would be moved to
/// its corner.
std::string tileAttributes(const Pattern& pattern) {
    const std::string width = number(span(pattern.min.x, pattern.max.x)),
                      height = number(span(pattern.min.y, pattern.max.y));
    const std::string size = attribute("width", width) + attribute("height", height);
    if (pattern.min == Point(0))
        return size;
    return attribute("x", number(pattern.min.x)) + attribute("y", number(pattern.min.y)) + size +
           attribute("viewBox", pair(pattern.min) + " " + width + " " + height);
}

}  // namespace

std::optional<std::string> Writer::paint(const Paint& paint) {
    return std::visit([&](const auto& p) { return value(p); }, paint);
}

std::optional<std::string> Writer::value(const Color& color) { return hex(color); }

std::optional<std::string> Writer::value(const LinearGradient& gradient) {
    if (isFlat(gradient.transform))
        return std::nullopt;
    return url(definitions_.add("linearGradient", attribute("x1", number(gradient.start.x)) +
                                                      attribute("y1", number(gradient.start.y)) +
                                                      attribute("x2", number(gradient.end.x)) +
                                                      attribute("y2", number(gradient.end.y)) +
                                                      commonPart(gradient) + "</linearGradient>"));
}

std::optional<std::string> Writer::value(const RadialGradient& gradient) {
    if (isFlat(gradient.transform))
        return std::nullopt;
    std::string text = attribute("cx", number(gradient.center.x)) +
                       attribute("cy", number(gradient.center.y)) + attribute("r", number(gradient.radius));
    if (gradient.focus != gradient.center)
        text += attribute("fx", number(gradient.focus.x)) + attribute("fy", number(gradient.focus.y));
    if (gradient.focalRadius != 0)
        text += attribute("fr", number(gradient.focalRadius));
    return url(definitions_.add("radialGradient", text + commonPart(gradient) + "</radialGradient>"));
}

std::optional<std::string> Writer::value(const Pattern& pattern) {
    if (isFlat(pattern.transform))
        return std::nullopt;
    const Level level(*this);
    const std::string& tile = shared(pattern.content).text;
    if (tile.empty())
        return std::nullopt;
    return url(definitions_.add("pattern", attribute("patternUnits", "userSpaceOnUse") +
                                               tileAttributes(pattern) +
                                               transformAttribute("patternTransform", pattern.transform) +
                                               ">\n" + tile + "</pattern>"));
}

/// Items of images are elements of their own.
std::optional<std::string> Writer::value(const ImagePaint&) { return std::nullopt; }

std::optional<std::string> Writer::value(const Material& material) {
    throw WriteError(fmt::format("the material '{}' cannot be written as SVG", material.name));
}

}  // namespace vtm::svg
