// Shapes: their cached outlines, their fills and strokes.

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "svg/convert/converter.hpp"
#include "svg/geometry/path_measure.hpp"

namespace vtm::svg {
bool isWithinReach(const Box& box) {
    return box.empty() || (std::abs(box.min.x) <= maxCoordinate && std::abs(box.min.y) <= maxCoordinate &&
                           std::abs(box.max.x) <= maxCoordinate && std::abs(box.max.y) <= maxCoordinate);
}

Converter::CachedShape* Converter::shapeOf(const Element& element, const Scope& scope) {
    CachedShape& cached = shapes_[&element];
    const bool fresh =
        cached.path && cached.viewport == scope.viewport && cached.fontSize == scope.style.fontSize;
    if (!fresh) {
        Shape shape = makeShape(lengths(element, scope));
        if (!shape.problem.empty())
            reporter_.warn(Kind::Value, element, shape.problem);
        if (!isDrawable(shape.path, scene::identity)) {
            reporter_.warn(Kind::Limit, element, "a coordinate is too large; it is left out");
            shape.path.clear();
        }
        cached = {scope.viewport,
                  scope.style.fontSize,
                  std::make_shared<const scene::Path>(std::move(shape.path)),
                  {},
                  {}};
    }
    return cached.path->empty() ? nullptr : &cached;
}

const Box& Converter::boxOf(CachedShape& shape) {
    if (!shape.box)
        shape.box = boundingBox(*shape.path, scene::identity);
    return *shape.box;
}

void Converter::convertShape(const Element& element, const Scope& scope, Nodes& out) {
    CachedShape* shape = shapeOf(element, scope);
    if (!shape)
        return;
    if (!isWithinReach(geometry::mapped(boxOf(*shape), scope.transform))) {
        reporter_.warn(Kind::Limit, element, "lies too far away; it is left out");
        return;
    }
    if (outlineListeners_ > 0)
        outlines_.push_back({shape->path, scope.transform});
    if (!scope.style.visible)
        return;
    // A copy: what markers draw may replace the cache's entry.
    CachedShape own = *shape;
    for (const PaintStage stage : scope.style.paintOrder)
        switch (stage) {
            case PaintStage::Fill:
                fillShape(element, scope, own, out);
                break;
            case PaintStage::Stroke:
                strokeShape(element, scope, own, out);
                break;
            case PaintStage::Markers:
                convertMarkers(element, scope, own, out);
                break;
        }
}

void Converter::fillShape(const Element& element, const Scope& scope, CachedShape& shape, Nodes& out) {
    const Box& box = boxOf(shape);
    if (scope.style.fillOpacity <= 0 || !(box.width() > 0 && box.height() > 0))
        return;
    auto fill = paint(scope.style.fill, element, scope, box);
    if (!fill)
        return;
    scene::Item item;
    item.path = shape.path;
    item.transform = scope.transform;
    item.geometry = scope.style.fillRule;
    item.paint = std::move(*fill);
    item.opacity = static_cast<float>(scope.style.fillOpacity);
    item.place = placeOf(element);
    out.push_back({std::move(item)});
}

void Converter::strokeShape(const Element& element, const Scope& scope, CachedShape& shape, Nodes& out) {
    if (scope.style.stroke.kind == PaintKind::None || scope.style.strokeOpacity <= 0)
        return;
    auto style = strokeStyle(element, scope, shape);
    if (!style)
        return;
    auto stroke = paint(scope.style.stroke, element, scope, boxOf(shape));
    if (!stroke)
        return;
    // A 4096th of its width is far below what is seen of a stroke.
    const auto path = withoutTinyControls(*shape.path, style->width / 4096);
    scene::Item item{path ? path : shape.path,
                     scope.transform,
                     std::move(*style),
                     std::move(*stroke),
                     static_cast<float>(scope.style.strokeOpacity),
                     placeOf(element)};
    if (scope.style.nonScalingStroke) {  // the stroke is made in the picture's space
        item.path = std::make_shared<const scene::Path>(mapPath(scope.transform, *item.path));
        item.paint = mapPaint(std::move(item.paint), scope.transform);
        item.transform = scene::identity;
    }
    out.push_back({std::move(item)});
}

std::optional<scene::StrokeStyle> Converter::strokeStyle(const Element& element, const Scope& scope,
                                                         CachedShape& shape) {
    const Style& style = scope.style;
    scene::StrokeStyle stroke;
    stroke.width = resolve(style.strokeWidth, Axis::Diagonal, scope.viewport);
    if (!(stroke.width > 0))
        return std::nullopt;
    if (stroke.width > maxCoordinate) {
        reporter_.warn(Kind::Limit, element,
                       fmt::format("the stroke is drawn {} wide, not wider", maxCoordinate));
        stroke.width = maxCoordinate;
    }
    stroke.cap = style.cap;
    stroke.join = style.join;
    stroke.miterLimit = style.miterLimit;
    addDashes(element, scope, shape, stroke);
    return stroke;
}

/// SVG 2 sections 13.5.6 and 9.6.1: dashes are scaled to the path's true length where the author
/// gave one of his own.
void Converter::addDashes(const Element& element, const Scope& scope, CachedShape& shape,
                          scene::StrokeStyle& stroke) {
    if (!scope.style.dashes)
        return;
    double scale = 1;
    const auto given = lengths(element, scope).length("pathLength", Axis::X);
    if (given && *given == 0)
        return;  // every dash is endless
    if (given && *given > 0) {
        if (!shape.length)
            shape.length = PathMeasure(*shape.path).length();
        scale = *shape.length / *given;
    }
    double sum = 0;
    for (const Length& dash : *scope.style.dashes) {
        stroke.dashes.push_back(resolve(dash, Axis::Diagonal, scope.viewport) * scale);
        sum += stroke.dashes.back();
    }
    if (!(sum > 0) || sum > maxCoordinate) {
        stroke.dashes.clear();
        return;
    }
    if (stroke.dashes.size() % 2 == 1)
        stroke.dashes.insert(stroke.dashes.end(), stroke.dashes.begin(), stroke.dashes.end());
    const double phase = resolve(scope.style.dashOffset, Axis::Diagonal, scope.viewport) * scale;
    stroke.dashPhase = std::fmod(phase, 2 * sum);
}

}  // namespace vtm::svg
