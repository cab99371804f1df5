#include "svg/css/clip_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "svg/css/property_values.hpp"
#include "svg/geometry/path_data.hpp"

namespace vtm::svg {
namespace {

using scene::Path;
using scene::Point;

// ---- Reading --------------------------------------------------------------------------------------

bool atWord(Cursor cursor, std::string_view word) { return equalsIgnoringCase(cursor.identifier(), word); }

/// 1 to 4 lengths as margins have them: what is absent is as its opposite.
std::optional<std::array<Length, 4>> readFour(Cursor& cursor, const Units& units) {
    std::array<Length, 4> values{};
    std::size_t count = 0;
    for (; count < 4; ++count) {
        cursor.skipSpaces();
        Cursor ahead = cursor;
        const auto length = readLength(ahead, units);
        if (!length)
            break;
        values[count] = *length;
        cursor = ahead;
    }
    if (count == 0)
        return std::nullopt;
    if (count < 2)
        values[1] = values[0];
    if (count < 3)
        values[2] = values[0];
    if (count < 4)
        values[3] = values[1];
    return values;
}

bool isNegative(const Length& length) { return length.value < 0; }

/// `round` and radii, if they are there.
bool readRadii(Cursor& cursor, const Units& units, ClipRectangle& rectangle) {
    cursor.skipSpaces();
    if (cursor.atEnd())
        return true;
    if (!equalsIgnoringCase(cursor.identifier(), "round"))
        return false;
    const auto x = readFour(cursor, units);
    cursor.skipSpaces();
    const auto y = cursor.consume('/') ? readFour(cursor, units) : x;
    cursor.skipSpaces();
    if (!x || !y || std::ranges::any_of(*x, isNegative) || std::ranges::any_of(*y, isNegative))
        return false;
    rectangle.radiiX = *x;
    rectangle.radiiY = *y;
    return cursor.atEnd();
}

using Shape = decltype(ClipShape::shape);

std::optional<Shape> readInset(Cursor cursor, const Units& units) {
    ClipRectangle rectangle;
    const auto sides = readFour(cursor, units);
    if (!sides || !readRadii(cursor, units, rectangle))
        return std::nullopt;
    rectangle.values = *sides;
    return rectangle;
}

/// `rect()` and `xywh()`: four values, all there.
std::optional<Shape> readRectangle(Cursor cursor, const Units& units, ClipRectangle::Sides sides) {
    ClipRectangle rectangle;
    rectangle.sides = sides;
    for (std::size_t i = 0; i < 4; ++i) {
        cursor.skipSpaces();
        rectangle.automatic[i] = sides == ClipRectangle::Sides::Rect && atWord(cursor, "auto");
        if (rectangle.automatic[i]) {
            cursor.identifier();
            continue;
        }
        const auto length = readLength(cursor, units);
        if (!length || (sides == ClipRectangle::Sides::Xywh && i > 1 && isNegative(*length)))
            return std::nullopt;
        rectangle.values[i] = *length;
    }
    return readRadii(cursor, units, rectangle) ? std::optional<Shape>(rectangle) : std::nullopt;
}

std::optional<ClipEllipse::Radius> readRadius(Cursor& cursor, const Units& units) {
    using Kind = ClipEllipse::Radius::Kind;
    for (const auto& [word, kind] :
         {std::pair("closest-side", Kind::ClosestSide), {"farthest-side", Kind::FarthestSide}})
        if (atWord(cursor, word)) {
            cursor.identifier();
            return ClipEllipse::Radius{kind, {}};
        }
    const auto length = readLength(cursor, units);
    if (!length || isNegative(*length))
        return std::nullopt;
    return ClipEllipse::Radius{Kind::Given, *length};
}

/// `right 10px bottom 20%`, or one or two words as transform-origin has them.
std::optional<TransformOrigin> parsePosition(std::string_view text, const Units& units) {
    std::array<std::string_view, 4> words;
    std::size_t count = 0;
    for (Cursor cursor(text); cursor.skipSpaces(), !cursor.atEnd() && count < words.size(); ++count) {
        words[count] = cursor.rest().substr(0, extentOf(cursor.rest(), " \t\n\r\f"));
        cursor.advance(words[count].size());
    }
    if (count == 1 || count == 2)
        return parseTransformOrigin(text, units);
    const auto from = [&](std::string_view side, std::string_view offset) -> std::optional<Length> {
        const auto length = parseLength(offset, units);
        const bool isFar = equalsIgnoringCase(side, "right") || equalsIgnoringCase(side, "bottom");
        if (!length || !isFar)
            return length;
        return length->percent ? Length{100 - length->value, true, -length->plus}
                               : Length{100, true, -length->value};
    };
    const bool isColumnFirst = equalsIgnoringCase(words[0], "top") || equalsIgnoringCase(words[0], "bottom");
    const std::size_t x = isColumnFirst ? 2 : 0, y = isColumnFirst ? 0 : 2;
    const bool hasSides = (equalsIgnoringCase(words[x], "left") || equalsIgnoringCase(words[x], "right")) &&
                          (equalsIgnoringCase(words[y], "top") || equalsIgnoringCase(words[y], "bottom"));
    const auto left = from(words[x], words[x + 1]), top = from(words[y], words[y + 1]);
    return count == 4 && hasSides && left && top ? std::optional(TransformOrigin{*left, *top}) : std::nullopt;
}

std::optional<Shape> readEllipse(Cursor cursor, const Units& units, bool isCircle) {
    ClipEllipse ellipse;
    ellipse.isCircle = isCircle;
    const auto hasRadius = [&] {
        cursor.skipSpaces();
        return !cursor.atEnd() && !atWord(cursor, "at");
    };
    for (ClipEllipse::Radius* radius : {&ellipse.x, &ellipse.y}) {
        if (!hasRadius() || (isCircle && radius == &ellipse.y))
            break;
        const auto read = readRadius(cursor, units);
        if (!read || (radius == &ellipse.x && !isCircle && !hasRadius()))
            return std::nullopt;
        *radius = *read;
    }
    cursor.skipSpaces();
    if (cursor.atEnd())
        return ellipse;
    if (!equalsIgnoringCase(cursor.identifier(), "at"))
        return std::nullopt;
    const auto center = parsePosition(trim(cursor.rest()), units);
    if (!center)
        return std::nullopt;
    ellipse.center = *center;
    return ellipse;
}

void readFillRule(Cursor& cursor, scene::FillRule& rule) {
    cursor.skipSpaces();
    for (const auto& [word, meant] :
         {std::pair("nonzero", scene::FillRule::NonZero), {"evenodd", scene::FillRule::EvenOdd}})
        if (atWord(cursor, word)) {
            cursor.identifier();
            rule = meant;
            cursor.skipCommaSpaces();
            return;
        }
}

std::optional<Shape> readPolygon(Cursor cursor, const Units& units) {
    ClipPolygon polygon;
    while (cursor.skipSpaces(), !cursor.atEnd()) {
        const auto x = readLength(cursor, units);
        cursor.skipSpaces();
        const auto y = x ? readLength(cursor, units) : std::nullopt;
        cursor.skipSpaces();
        if (!y || (!cursor.atEnd() && !cursor.consume(',')))
            return std::nullopt;
        polygon.points.push_back({*x, *y});
    }
    return polygon.points.empty() ? std::nullopt : std::optional<Shape>(std::move(polygon));
}

std::optional<Shape> readPath(Cursor cursor) {
    const std::string_view text = trim(cursor.rest());
    if (text.size() < 2 || (text.front() != '"' && text.front() != '\'') || text.back() != text.front())
        return std::nullopt;
    ParsedPath parsed = parsePathData(text.substr(1, text.size() - 2));
    if (!parsed.complete || parsed.path.empty())
        return std::nullopt;
    return ClipPathData{std::move(parsed.path)};
}

std::optional<Shape> readShape(std::string_view name, std::string_view arguments, const Units& units,
                               scene::FillRule& rule) {
    Cursor cursor(arguments);
    const auto is = [&](std::string_view word) { return equalsIgnoringCase(name, word); };
    if (is("inset"))
        return readInset(cursor, units);
    if (is("rect"))
        return readRectangle(cursor, units, ClipRectangle::Sides::Rect);
    if (is("xywh"))
        return readRectangle(cursor, units, ClipRectangle::Sides::Xywh);
    if (is("circle") || is("ellipse"))
        return readEllipse(cursor, units, is("circle"));
    readFillRule(cursor, rule);
    if (is("polygon"))
        return readPolygon(cursor, units);
    return is("path") ? readPath(cursor) : std::nullopt;
}

/// Those of CSS stand for boxes of SVG (CSS Masking 1 section 5.1).
constexpr Keyword<TransformBox> boxes[]{
    {"fill-box", TransformBox::Fill},    {"stroke-box", TransformBox::Stroke},
    {"view-box", TransformBox::View},    {"content-box", TransformBox::Fill},
    {"padding-box", TransformBox::Fill}, {"border-box", TransformBox::Stroke},
    {"margin-box", TransformBox::Stroke}};

// ---- Outlines -------------------------------------------------------------------------------------

Path rectangleOf(const ClipRectangle& r, const Box& box) {
    const auto at = [&](std::size_t i) { return r.values[i].of(i % 2 ? box.width() : box.height()); };
    Point min, max;
    switch (r.sides) {
        case ClipRectangle::Sides::Inset:
            min = {at(3), at(0)};
            max = {box.width() - at(1), box.height() - at(2)};
            break;
        case ClipRectangle::Sides::Rect:
            min = {r.automatic[3] ? 0 : at(3), r.automatic[0] ? 0 : at(0)};
            max = {r.automatic[1] ? box.width() : at(1), r.automatic[2] ? box.height() : at(2)};
            max = glm::max(min, max);
            break;
        case ClipRectangle::Sides::Xywh:
            min = {r.values[0].of(box.width()), r.values[1].of(box.height())};
            max = min + Point(r.values[2].of(box.width()), r.values[3].of(box.height()));
            break;
    }
    if (r.sides == ClipRectangle::Sides::Inset)  // insets that meet share what there is
        for (int axis = 0; axis < 2; ++axis) {
            const double whole = axis ? box.height() : box.width(), both = whole - (max[axis] - min[axis]);
            if (max[axis] < min[axis])
                min[axis] = max[axis] = whole * min[axis] / both;
        }
    const Point size = max - min;
    std::array<Point, 4> radii;
    for (std::size_t i = 0; i < 4; ++i)
        radii[i] = {r.radiiX[i].of(box.width()), r.radiiY[i].of(box.height())};
    // Corners that would overlap shrink together (CSS Backgrounds 3 section 4.5).
    double share = 1;
    for (std::size_t i = 0; i < 4; ++i) {
        const Point sum = radii[i] + radii[(i + 1) % 4];
        const double side = i % 2 ? size.y : size.x, along = i % 2 ? sum.y : sum.x;
        if (along > side)
            share = std::min(share, side / along);
    }
    const Point corners[]{min, {max.x, min.y}, max, {min.x, max.y}};
    const Point directions[]{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};  // of the sides that leave the corners
    Path path;
    for (std::size_t i = 0; i < 4; ++i) {
        const Point radius = share * radii[i];
        const Point from = box.min + corners[i] - directions[(i + 3) % 4] * radius,
                    to = box.min + corners[i] + directions[i] * radius;
        if (i == 0)
            path.push_back(scene::MoveTo{from});
        else
            path.push_back(scene::LineTo{from});
        if (radius.x > 0 && radius.y > 0)
            path.push_back(scene::ArcTo{radius, 0, false, true, to});
    }
    path.push_back(scene::Close{});
    return path;
}

double radiusOf(const ClipEllipse::Radius& radius, double whole, double before, double after) {
    using Kind = ClipEllipse::Radius::Kind;
    const double near = std::min(std::abs(before), std::abs(after)),
                 far = std::max(std::abs(before), std::abs(after));
    return radius.kind == Kind::Given         ? radius.given.of(whole)
           : radius.kind == Kind::ClosestSide ? near
                                              : far;
}

Path ellipseOf(const ClipEllipse& e, const Box& box) {
    const Point center(e.center.x.of(box.width()), e.center.y.of(box.height()));
    const Point after = Point(box.width(), box.height()) - center;
    Point radii;
    if (e.isCircle) {
        const double diagonal = std::hypot(box.width(), box.height()) / std::numbers::sqrt2;
        const double x = radiusOf(e.x, diagonal, center.x, after.x),
                     y = radiusOf(e.x, diagonal, center.y, after.y);
        const bool isFarthest = e.x.kind == ClipEllipse::Radius::Kind::FarthestSide;
        radii = Point(isFarthest ? std::max(x, y) : std::min(x, y));
    } else {
        radii = {radiusOf(e.x, box.width(), center.x, after.x),
                 radiusOf(e.y, box.height(), center.y, after.y)};
    }
    if (!(radii.x > 0 && radii.y > 0))
        return {};
    const Point middle = box.min + center, across(radii.x, 0);
    return {scene::MoveTo{middle + across}, scene::ArcTo{radii, 0, false, true, middle - across},
            scene::ArcTo{radii, 0, false, true, middle + across}, scene::Close{}};
}

Path polygonOf(const ClipPolygon& polygon, const Box& box) {
    Path path;
    for (const auto& [x, y] : polygon.points) {
        const Point at = box.min + Point(x.of(box.width()), y.of(box.height()));
        if (path.empty())
            path.push_back(scene::MoveTo{at});
        else
            path.push_back(scene::LineTo{at});
    }
    path.push_back(scene::Close{});
    return path;
}

}  // namespace

std::optional<ClipShape> parseClipShape(std::string_view text, const Units& units) {
    ClipShape result;  // a box alone: the whole of it
    bool hasShape = false, hasBox = false;
    for (Cursor cursor(text); cursor.skipSpaces(), !cursor.atEnd();) {
        const std::string_view name = cursor.identifier();
        if (cursor.consume('(')) {
            const std::size_t length = extentOf(cursor.rest(), ")");
            if (hasShape || length >= cursor.rest().size())
                return std::nullopt;
            const auto shape = readShape(name, trim(cursor.rest().substr(0, length)), units, result.fillRule);
            if (!shape)
                return std::nullopt;
            result.shape = *shape;
            hasShape = true;
            cursor.advance(length + 1);
        } else {
            const auto box = findKeyword(name, boxes);
            if (!box || hasBox)
                return std::nullopt;
            result.box = *box;
            hasBox = true;
        }
    }
    return hasShape || hasBox ? std::optional(std::move(result)) : std::nullopt;
}

scene::Path outlineOf(const ClipShape& shape, const Box& box) {
    if (const auto* rectangle = std::get_if<ClipRectangle>(&shape.shape))
        return rectangleOf(*rectangle, box);
    if (const auto* ellipse = std::get_if<ClipEllipse>(&shape.shape))
        return ellipseOf(*ellipse, box);
    if (const auto* polygon = std::get_if<ClipPolygon>(&shape.shape))
        return polygonOf(*polygon, box);
    return mapPath(scene::translation(box.min.x, box.min.y), std::get<ClipPathData>(shape.shape).path);
}

}  // namespace vtm::svg
