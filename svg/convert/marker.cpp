// Markers. Source: SVG 2 section 11.6.

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

#include "svg/convert/converter.hpp"

namespace vtm::svg {
namespace {

double degreesOf(glm::dvec2 direction) {
    return std::atan2(direction.y, direction.x) * 180 / std::numbers::pi;
}

/// Halfway between the directions of arrival and departure; the one that there is at an end.
double bisector(const Vertex& vertex) {
    const glm::dvec2 none(0);
    if (vertex.incoming == none || vertex.outgoing == none)
        return degreesOf(vertex.incoming == none ? vertex.outgoing : vertex.incoming);
    const double in = degreesOf(vertex.incoming), out = degreesOf(vertex.outgoing);
    double turn = std::fmod(out - in, 360.0);
    turn += turn > 180 ? -360 : turn <= -180 ? 360 : 0;
    return in + turn / 2;
}

/// `orient`: auto, auto-start-reverse or an angle.
double orientation(std::string_view orient, const Vertex& vertex, bool start) {
    orient = trim(orient);
    if (orient == "auto")
        return bisector(vertex);
    if (orient == "auto-start-reverse")
        return bisector(vertex) + (start ? 180 : 0);
    Cursor cursor(orient);
    const auto angle = readAngle(cursor);
    return cursor.atEnd() ? angle.value_or(0) : 0;
}

/// refX and refY: a length or a keyword for a share of the viewBox.
double reference(const LengthReader& reader, std::string_view name, Axis axis, const Rect& box) {
    const std::string_view text = trim(reader.text(name));
    const double origin = axis == Axis::X ? box.x : box.y, size = axis == Axis::X ? box.width : box.height;
    if (text == "left" || text == "top")
        return origin;
    if (text == "center")
        return origin + size / 2;
    if (text == "right" || text == "bottom")
        return origin + size;
    return reader.lengthOr(name, axis, 0);
}

}  // namespace

void Converter::convertMarkers(const Element& element, const Scope& scope, CachedShape& shape, Nodes& out) {
    const Style& style = scope.style;
    if (style.markerStart.empty() && style.markerMid.empty() && style.markerEnd.empty())
        return;
    const auto find = [&](std::string_view href) {
        return href.empty() ? nullptr : resource(href, Tag::Marker, element);
    };
    const Element *start = find(style.markerStart), *mid = find(style.markerMid),
                  *end = find(style.markerEnd);
    const std::vector<Vertex> vertices = verticesOf(*shape.path);
    const ContextElement context{element, scope, boxOf(shape)};
    const auto draw = [&](const Element* marker, std::size_t i, bool first) {
        if (marker)
            convertMarker(*marker, context, vertices[i].at,
                          orientation(marker->get("orient"), vertices[i], first), out);
    };
    draw(start, 0, true);
    for (std::size_t i = 1; mid && i + 1 < vertices.size(); ++i)
        draw(mid, i, false);
    draw(end, vertices.size() - 1, false);
}

void Converter::convertMarker(const Element& marker, const ContextElement& context, scene::Point at,
                              double degrees, Nodes& out) {
    const Scope& shape = context.scope;
    const Expansion expansion(active_, marker);
    if (!expansion || !spend()) {
        reporter_.warn(Kind::Reference, marker, "refers to itself, directly or indirectly");
        return;
    }
    const Level level(*this, marker);
    if (!level)
        return;
    Scope scope{styleOf(marker), shape.transform, shape.viewport, &context, shape.depth + 1};
    const LengthReader reader = lengths(marker, scope);
    const Rect viewport{0, 0, reader.lengthOr("markerWidth", Axis::X, 3),
                        reader.lengthOr("markerHeight", Axis::Y, 3)};
    // `display` of the marker itself does not matter (SVG 2 section 13.7.1).
    if (!(viewport.width > 0 && viewport.height > 0) || isEmptyViewBox(marker.get("viewBox")))
        return;
    const auto viewBox = parseViewBox(marker.get("viewBox"));
    const scene::Affine inner =
        viewBox ? scene::fittedMap(*viewBox, parseAspectRatio(marker.get("preserveAspectRatio")), viewport)
                : scene::identity;
    const Rect box = viewBox.value_or(viewport);
    const scene::Point ref = scene::apply(
        inner, {reference(reader, "refX", Axis::X, box), reference(reader, "refY", Axis::Y, box)});
    const double scale = trim(marker.get("markerUnits")) == "userSpaceOnUse"
                             ? 1
                             : resolve(shape.style.strokeWidth, Axis::Diagonal, shape.viewport);
    for (const scene::Affine& step : {scene::translation(at.x, at.y), rotation(degrees),
                                      scene::scaling(scale, scale), scene::translation(-ref.x, -ref.y)})
        scope.transform = scene::compose(scope.transform, step);
    Scope content = scope;
    content.transform = scene::compose(scope.transform, inner);
    content.viewport = {box.width, box.height};
    if (!scene::inverse(content.transform))
        return;
    const bool visible = scope.style.overflow.value_or(false);
    Nodes nodes;
    withoutOutlines([&] { convertChildren(marker, content, visible ? out : nodes); });
    appendClipped(viewport, scope.transform, std::move(nodes), out);
}

}  // namespace vtm::svg
