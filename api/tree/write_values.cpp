#include "api/tree/write_values.hpp"

#include <cmath>

#include <fmt/format.h>

#include "api/tree/keywords.hpp"
#include "svg/notation.hpp"

namespace vtm::treetext {

using svg::number, svg::pair;

namespace {

/// As readColor reads #rrggbb.
bool isByte(float channel) {
    return channel == static_cast<float>(static_cast<double>(std::lround(255 * channel)) / 255);
}

template <class Gradient>
std::string behindPlace(const Gradient& gradient) {
    std::string text;
    if (gradient.spread != scene::Spread::Pad)
        text += fmt::format(" {}", keywords::spreads[std::size_t(gradient.spread)]);
    text += paintTransform(gradient.transform) + " {";
    for (const scene::GradientStop& stop : gradient.stops)
        text += fmt::format("{} {} {}", &stop == gradient.stops.data() ? "" : ",", number(stop.offset),
                            color(stop.color));
    return text + " }";
}

}  // namespace

std::string inQuotes(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += '\\';
        result += c;
    }
    return result + '"';
}

std::string color(const scene::Color& c) {
    if (isByte(c.r) && isByte(c.g) && isByte(c.b) && c.a == 1)
        return svg::hex(c);
    const std::string alpha = c.a == 1 ? "" : " / " + number(c.a);
    if (isByte(c.r) && isByte(c.g) && isByte(c.b))
        return fmt::format("rgb({} {} {}{})", std::lround(255 * c.r), std::lround(255 * c.g),
                           std::lround(255 * c.b), alpha);
    return fmt::format("color(srgb {} {} {}{})", number(c.r), number(c.g), number(c.b), alpha);
}

std::string transform(const scene::Affine& m) {
    const bool isDiagonal = m[0].y == 0 && m[1].x == 0;
    if (isDiagonal && m[0].x == 1 && m[1].y == 1)
        return fmt::format("translate({})", pair(m[2]));
    if (isDiagonal && m[2] == glm::dvec2(0))
        return m[0].x == m[1].y ? fmt::format("scale({})", number(m[0].x))
                                : fmt::format("scale({} {})", number(m[0].x), number(m[1].y));
    return fmt::format("matrix({} {} {})", pair(m[0]), pair(m[1]), pair(m[2]));
}

std::string paintTransform(const scene::Affine& map) {
    return map == scene::identity ? "" : " transform " + transform(map);
}

std::string geometry(const std::variant<scene::FillRule, scene::StrokeStyle>& geometry) {
    if (const auto* rule = std::get_if<scene::FillRule>(&geometry))
        return *rule == scene::FillRule::EvenOdd ? " evenodd" : "";
    const auto& style = std::get<scene::StrokeStyle>(geometry);
    const scene::StrokeStyle initial;
    std::string text = " stroke " + number(style.width);
    if (style.cap != initial.cap)
        text += fmt::format(" cap {}", keywords::caps[std::size_t(style.cap)]);
    if (style.join != initial.join)
        text += fmt::format(" join {}", keywords::joins[std::size_t(style.join)]);
    if (style.miterLimit != initial.miterLimit)
        text += " miter " + number(style.miterLimit);
    if (!style.dashes.empty()) {
        text += " dash(";
        for (const double& dash : style.dashes)
            text += (&dash == style.dashes.data() ? "" : " ") + number(dash);
        text += ")";
    }
    return style.dashPhase == 0 ? text : text + " phase " + number(style.dashPhase);
}

std::string gradient(const scene::LinearGradient& g) {
    return fmt::format("linear({}, {})", pair(g.start), pair(g.end)) + behindPlace(g);
}

std::string gradient(const scene::RadialGradient& g) {
    std::string text = fmt::format("radial({} {})", pair(g.center), number(g.radius));
    if (g.focus != g.center || g.focalRadius != 0)
        text += fmt::format(" focus({} {})", pair(g.focus), number(g.focalRadius));
    return text + behindPlace(g);
}

}  // namespace vtm::treetext
