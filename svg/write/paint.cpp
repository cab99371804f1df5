#include <fmt/format.h>

#include <cmath>

#include <vtm/image/codec.hpp>
#include "svg/geometry/path_geometry.hpp"
#include "svg/write/values.hpp"
#include "svg/write/writer.hpp"
#include "svg/xml/resource.hpp"

namespace vtm::svg {

using namespace scene;

// ---- Paints as values of fill and stroke --------------------------------------------------------

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

// ---- Items that are painted with bitmaps --------------------------------------------------------

namespace {

Box boxOf(const image::Bitmap& bitmap) { return {Point(0), Point(bitmap.width, bitmap.height)}; }

/// Its corners, if it is filled along the axes of its space.
std::optional<Box> rectangleOf(const Item& item) {
    if (!std::holds_alternative<FillRule>(item.geometry))
        return std::nullopt;
    const Box box = boundingBox(*item.path, identity);
    return pathData(*item.path) == pathData(rectangle(box.min, box.max)) ? std::optional(box) : std::nullopt;
}

/// The item's rectangle in the bitmap's pixels, if it lies along them. Corners that are the bitmap's but for
/// the rounding of the transforms are the bitmap's.
std::optional<Box> rectangleOf(const Item& item, const Affine& paintTransform, const Box& bitmap) {
    constexpr double rounding = 1e-9;  // of the bitmap's size; doubles have 1e-16
    const auto toBitmap = inverse(paintTransform);
    const auto rectangle = rectangleOf(item);
    if (!rectangle || !toBitmap || (*toBitmap)[0][1] != 0 || (*toBitmap)[1][0] != 0)
        return std::nullopt;
    Box box = geometry::mapped(*rectangle, *toBitmap);
    const Point near = rounding * bitmap.max;
    for (int axis : {0, 1}) {
        if (std::abs(box.min[axis] - bitmap.min[axis]) <= near[axis])
            box.min[axis] = bitmap.min[axis];
        if (std::abs(box.max[axis] - bitmap.max[axis]) <= near[axis])
            box.max[axis] = bitmap.max[axis];
    }
    return box;
}

std::string filterAttribute(ImageFilter filter) {
    switch (filter) {
        case ImageFilter::Nearest:
            return attribute("image-rendering", "pixelated");
        case ImageFilter::Bicubic:
            return attribute("image-rendering", "high-quality");
        case ImageFilter::Trilinear:
            return "";
        case ImageFilter::Bilinear:
            break;
    }
    throw WriteError("an image with the bilinear filter cannot be written as SVG");
}

/// Without the sides on the bitmap's border, where the image ends by itself: covered by both, a pixel there
/// would be lighter.
Box withoutBorder(Box cut, const Box& bitmap) {
    const Point pixel(1);
    cut.min -= pixel * Point(glm::lessThanEqual(cut.min, bitmap.min));
    cut.max += pixel * Point(glm::greaterThanEqual(cut.max, bitmap.max));
    return cut;
}

}  // namespace

/// The whole bitmap, in a group that is cut to the item's outline where that is another one.
void Writer::image(const Item& item, const ImagePaint& paint) {
    const Affine transform = compose(item.transform, paint.transform);
    if (isFlat(transform) || !(item.opacity > 0))
        return;
    const std::string element = "<" + picture(paint.bitmap) + transformAttribute("transform", transform) +
                                opacityAttribute("opacity", item.opacity) + filterAttribute(paint.filter) +
                                "/>\n";
    const Part part{element, geometry::mapped(boxOf(*paint.bitmap), transform)};
    if (const std::string cut = cutAttribute(item, paint); cut.empty())
        append("", part, "");
    else
        append("<g" + cut + ">\n", part, "</g>\n");
}

std::string Writer::cutAttribute(const Item& item, const ImagePaint& paint) {
    const Box bitmap = boxOf(*paint.bitmap);
    const auto rectangle = rectangleOf(item, paint.transform, bitmap);
    if (rectangle && rectangle->min == bitmap.min && rectangle->max == bitmap.max)
        return "";
    Item cut = item;
    cut.transform = identity;
    if (!liesInside({{cut}}, inverse(paint.transform).value_or(identity), bitmap))
        throw WriteError("an item that reaches beyond the image it is painted with cannot be written as SVG");
    if (!rectangle)
        return insideAttribute({item.path, item.transform, item.geometry});
    const Box wide = withoutBorder(*rectangle, bitmap);
    return insideAttribute({std::make_shared<const Path>(scene::rectangle(wide.min, wide.max)),
                            compose(item.transform, paint.transform), FillRule::NonZero});
}

const std::string& Writer::picture(const std::shared_ptr<const image::Bitmap>& bitmap) {
    std::string& known = pictures_[bitmap];
    if (known.empty())
        known = definitions_.shareable("image" + attribute("width", std::to_string(bitmap->width)) +
                                       attribute("height", std::to_string(bitmap->height)) +
                                       attribute("href", dataUrl("image/png", image::encodePng(*bitmap))));
    return known;
}

}  // namespace vtm::svg
