#include "svg/write/values.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <vtm/limits/limits.hpp>
#include <vtm/svg/write.hpp>
#include "svg/css/cursor.hpp"

namespace vtm::svg {
namespace {

using namespace scene;

/// As the importer reads them.
double radians(double degrees) { return degrees * std::numbers::pi / 180; }

double roundedTo(double value, int digits) {
    return Cursor(fmt::format("{:.{}g}", value, digits)).number().value_or(value);
}

/// The shortest degrees that read back as these radians. Those of a file are within two steps of the
/// quotient, which is taken for radians that no degrees give.
double degreesOf(double angle) {
    const double quotient = angle * 180 / std::numbers::pi;
    for (int digits = 1; digits < std::numeric_limits<double>::max_digits10; ++digits)
        if (const double near = roundedTo(quotient, digits); radians(near) == angle)
            return near;
    double down = quotient, up = quotient;
    for (int step = 0; step <= 2; ++step) {
        for (const double near : {down, up})
            if (radians(near) == angle)
                return near;
        down = std::nextafter(down, -INFINITY);
        up = std::nextafter(up, INFINITY);
    }
    return quotient;
}

struct CommandText {
    std::string operator()(const MoveTo& c) const { return "M" + pair(c.to); }
    std::string operator()(const LineTo& c) const { return "L" + pair(c.to); }
    std::string operator()(const QuadTo& c) const { return "Q" + pair(c.control) + " " + pair(c.to); }
    std::string operator()(const CubicTo& c) const {
        return "C" + pair(c.control1) + " " + pair(c.control2) + " " + pair(c.to);
    }
    std::string operator()(const ArcTo& c) const {
        return fmt::format("A{} {} {:d} {:d} {}", pair(c.radii), number(degreesOf(c.rotation)), c.largeArc,
                           c.sweep, pair(c.to));
    }
    std::string operator()(const Close&) const { return "Z"; }
};

template <class Value>
std::string shortest(Value value) {
    if (!(std::abs(value) <= maxNumber))
        throw WriteError(fmt::format("the number {} cannot be written as SVG: it is beyond 1e30", value));
    return fmt::format("{}", value + Value(0));  // + 0: no negative zero
}

}  // namespace

std::string number(double value) { return shortest(value); }
std::string number(float value) { return shortest(value); }

std::string pair(Point p) { return number(p.x) + " " + number(p.y); }

std::string pathData(const Path& path) {
    std::string d;
    for (const Command& command : path) {
        limits::check();
        d += std::visit(CommandText(), command);
    }
    return d;
}

std::string hex(const Color& color) {
    const auto byte = [](float v) { return std::lround(255 * v); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(color.r), byte(color.g), byte(color.b));
}

std::string attribute(std::string_view name, std::string_view value) {
    return fmt::format(" {}=\"{}\"", name, value);
}

std::string opacityAttribute(std::string_view name, float value) {
    return value == 1 ? "" : attribute(name, number(value));
}

std::string transformAttribute(std::string_view name, const Affine& map) {
    if (map == identity)
        return "";
    const bool isTranslation = map[0] == identity[0] && map[1] == identity[1];
    return attribute(name, isTranslation
                               ? fmt::format("translate({})", pair(map[2]))
                               : fmt::format("matrix({} {} {})", pair(map[0]), pair(map[1]), pair(map[2])));
}

std::string strokeAttributes(const StrokeStyle& style) {
    constexpr const char* caps[] = {"butt", "round", "square"};
    constexpr const char* joins[] = {"miter", "miter-clip", "round", "bevel"};
    const StrokeStyle initial;
    std::string s;
    if (style.width != initial.width)
        s += attribute("stroke-width", number(style.width));
    if (style.cap != initial.cap)
        s += attribute("stroke-linecap", caps[int(style.cap)]);
    if (style.join != initial.join)
        s += attribute("stroke-linejoin", joins[int(style.join)]);
    if (style.miterLimit != initial.miterLimit)
        s += attribute("stroke-miterlimit", number(style.miterLimit));
    std::string dashes;
    for (const double dash : style.dashes)
        dashes += (dashes.empty() ? "" : " ") + number(dash);
    if (!dashes.empty())
        s += attribute("stroke-dasharray", dashes);
    if (!dashes.empty() && style.dashPhase != 0)
        s += attribute("stroke-dashoffset", number(style.dashPhase));
    return s;
}

}  // namespace vtm::svg
