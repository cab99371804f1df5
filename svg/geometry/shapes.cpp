#include "svg/geometry/shapes.hpp"

#include <algorithm>
#include <iterator>

#include "svg/geometry/path_data.hpp"
#include "svg/xml/report.hpp"

namespace vtm::svg {
namespace {

using scene::ArcTo;
using scene::Path;
using scene::Point;

/// SVG 2 section 10.2: corners as quarter ellipses.
Path roundedRect(Point min, Point size, Point r) {
    const Point max = min + size;
    const auto corner = [&](double x, double y) { return ArcTo{r, 0, false, true, {x, y}}; };
    return {scene::MoveTo{{min.x + r.x, min.y}}, scene::LineTo{{max.x - r.x, min.y}},
            corner(max.x, min.y + r.y),          scene::LineTo{{max.x, max.y - r.y}},
            corner(max.x - r.x, max.y),          scene::LineTo{{min.x + r.x, max.y}},
            corner(min.x, max.y - r.y),          scene::LineTo{{min.x, min.y + r.y}},
            corner(min.x + r.x, min.y),          scene::Close{}};
}

/// A radius that is absent, auto or negative is taken from the other one.
std::optional<double> radius(const LengthReader& reader, std::string_view name, Axis axis) {
    const auto value = reader.length(name, axis);
    return value && *value >= 0 ? value : std::nullopt;
}

Shape rect(const LengthReader& reader) {
    const Point min(reader.lengthOr("x", Axis::X, 0), reader.lengthOr("y", Axis::Y, 0));
    const Point size(reader.lengthOr("width", Axis::X, 0), reader.lengthOr("height", Axis::Y, 0));
    if (size.x <= 0 || size.y <= 0)
        return {{}, "width and height must be positive"};
    const auto rx = radius(reader, "rx", Axis::X), ry = radius(reader, "ry", Axis::Y);
    const Point r(std::min(rx.value_or(ry.value_or(0)), size.x / 2),
                  std::min(ry.value_or(rx.value_or(0)), size.y / 2));
    if (r.x <= 0 || r.y <= 0)
        return {scene::rectangle(min, min + size)};
    return {roundedRect(min, size, r)};
}

Path ellipsePath(Point c, Point r) {
    const auto quarter = [&](double x, double y) { return ArcTo{r, 0, false, true, {x, y}}; };
    return {scene::MoveTo{{c.x + r.x, c.y}}, quarter(c.x, c.y + r.y), quarter(c.x - r.x, c.y),
            quarter(c.x, c.y - r.y),         quarter(c.x + r.x, c.y), scene::Close{}};
}

Shape ellipse(const LengthReader& reader, Point r) {
    if (!(r.x > 0 && r.y > 0))
        return {{}, "the radius must be positive"};
    return {ellipsePath({reader.lengthOr("cx", Axis::X, 0), reader.lengthOr("cy", Axis::Y, 0)}, r)};
}

Shape circle(const LengthReader& reader) {
    return ellipse(reader, Point(reader.lengthOr("r", Axis::Diagonal, 0)));
}

Shape ellipse(const LengthReader& reader) {
    const auto rx = radius(reader, "rx", Axis::X), ry = radius(reader, "ry", Axis::Y);
    return ellipse(reader, {rx.value_or(ry.value_or(0)), ry.value_or(rx.value_or(0))});
}

Shape line(const LengthReader& reader) {
    return {{scene::MoveTo{{reader.lengthOr("x1", Axis::X, 0), reader.lengthOr("y1", Axis::Y, 0)}},
             scene::LineTo{{reader.lengthOr("x2", Axis::X, 0), reader.lengthOr("y2", Axis::Y, 0)}}}};
}

/// What is wrong with data that was read up to an error; empty if it was not.
std::string problemOf(std::string_view name, const ParsedPath& parsed) {
    if (parsed.complete)
        return {};
    const std::string at =
        parsed.unread.empty() ? " ends too early" : " is malformed at " + quoted(parsed.unread);
    return std::string(name) + at + "; it is read up to there";
}

Shape polyline(const LengthReader& reader, bool closed) {
    ParsedPath parsed = parsePoints(reader.element.get("points"));
    const std::string problem = problemOf("points", parsed);
    if (parsed.path.size() < 2)
        return {{}, problem.empty() ? "there are fewer than two points" : problem};
    if (closed)
        parsed.path.push_back(scene::Close{});
    return {std::move(parsed.path), problem};
}

Shape path(const LengthReader& reader) {
    ParsedPath parsed = parsePathData(pathFunctionData(reader.text("d")));
    const std::string problem = problemOf("d", parsed);
    return {std::move(parsed.path), problem};
}

}  // namespace

std::string_view LengthReader::text(std::string_view name) const {
    const auto declared = std::find_if(style.geometry.rbegin(), style.geometry.rend(),
                                       [&](const Attribute& attribute) { return attribute.name == name; });
    return declared != style.geometry.rend() ? declared->value : element.get(name);
}

std::optional<double> LengthReader::length(std::string_view name, Axis axis) const {
    const std::string_view written = text(name);
    Units own = units;
    own.whole = resolve({100, true}, axis, viewport);
    const auto length = written.empty() ? std::nullopt : parseLength(written, own);
    return length ? std::optional(resolve(*length, axis, viewport)) : std::nullopt;
}

bool isShape(Tag tag) {
    constexpr Tag shapes[]{Tag::Path, Tag::Rect,     Tag::Circle, Tag::Ellipse,
                           Tag::Line, Tag::Polyline, Tag::Polygon};
    return std::find(std::begin(shapes), std::end(shapes), tag) != std::end(shapes);
}

Shape makeShape(const LengthReader& reader) {
    switch (reader.element.tag) {
        case Tag::Rect:
            return rect(reader);
        case Tag::Circle:
            return circle(reader);
        case Tag::Ellipse:
            return ellipse(reader);
        case Tag::Line:
            return line(reader);
        case Tag::Polyline:
            return polyline(reader, false);
        case Tag::Polygon:
            return polyline(reader, true);
        case Tag::Path:
            return path(reader);
        default:
            return {};
    }
}

}  // namespace vtm::svg
