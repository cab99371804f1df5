// Shapes, clips, compositing, transforms.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "api/tree/keywords.hpp"
#include "api/tree/reader.hpp"

namespace vtm {

namespace {

/// As two half circles.
scene::Path circle(scene::Point center, double radius) {
    const scene::Point left = center - scene::Point(radius, 0), right = center + scene::Point(radius, 0);
    return {scene::MoveTo{left}, scene::ArcTo{scene::Point(radius), 0, false, true, right},
            scene::ArcTo{scene::Point(radius), 0, false, true, left}, scene::Close{}};
}

}  // namespace

void TreeReader::check(std::string_view at, scene::Item item) {
    if (!item.path)
        item.path = std::make_shared<const scene::Path>();
    scene::Scene trial{1, 1, {}};
    trial.root.children.push_back({std::move(item)});
    obey(at, [&] { scene::validate(trial); });
}

TreeReader::CountedShape TreeReader::shape() {
    const std::string_view at = in_.rest();
    CountedShape shape = outline();
    for (;;) {
        const std::string_view modifier = in_.rest();
        if (in_.accept("evenodd")) {
            if (!std::holds_alternative<scene::FillRule>(shape.part.geometry))
                in_.fail(modifier, "a stroke has no fill rule");
            shape.part.geometry = scene::FillRule::EvenOdd;
        } else if (in_.accept("stroke")) {
            shape = stroked(shape, modifier);
        } else if (in_.accept("placed")) {
            shape.part.transform = scene::compose(transform(), shape.part.transform);
        } else {
            break;
        }
    }
    check(at, {shape.part.path, shape.part.transform, shape.part.geometry, scene::Color()});
    return shape;
}

TreeReader::CountedShape TreeReader::outline() {
    constexpr std::string_view what = "a shape (path data in quotes, rect, circle or a name)";
    if (in_.accept("rect")) {
        const auto [x1, y1, x2, y2] = numbers<4>();
        return {filled(scene::rectangle({x1, y1}, {x2, y2})), 1};
    }
    if (in_.accept("circle")) {
        const auto [x, y, radius] = numbers<3>();
        return {filled(circle({x, y}, radius)), 1};
    }
    return in_.peek() == "\"" ? CountedShape{filled(pathData()), 1} : named<CountedShape>(what);
}

scene::Path TreeReader::pathData() {
    const std::string_view text = in_.quoted("path data");
    svg::ParsedPath parsed = svg::parsePathData(text);
    if (!parsed.complete)
        in_.fail(parsed.unread.empty() ? text.substr(text.size()) : parsed.unread,
                 "the path data is not complete or not valid from here on");
    return std::move(parsed.path);
}

bool TreeReader::attribute(std::string_view word, std::vector<std::string_view>& given) {
    if (in_.peek() != word)
        return false;
    if (std::ranges::count(given, word) != 0)
        in_.fail(in_.rest(), fmt::format("'{}' is given twice", word));
    given.push_back(word);
    in_.next();
    return true;
}

TreeReader::CountedShape TreeReader::stroked(CountedShape shape, std::string_view at) {
    if (!std::holds_alternative<scene::FillRule>(shape.part.geometry))
        in_.fail(at, "the shape is a stroke already");
    if (shape.part.transform != scene::identity)
        in_.fail(at, "the shape is placed already; 'stroke' stands before 'placed'");
    scene::StrokeStyle style;
    style.width = in_.number("the width of the stroke");
    for (std::vector<std::string_view> given;;) {
        if (attribute("cap", given))
            style.cap = keyword<scene::Cap>(keywords::caps);
        else if (attribute("join", given))
            style.join = keyword<scene::Join>(keywords::joins);
        else if (attribute("miter", given))
            style.miterLimit = in_.number("the mitre limit");
        else if (attribute("dash", given))
            style.dashes = dashes();
        else if (attribute("phase", given))
            style.dashPhase = in_.number("the dash phase");
        else
            break;
    }
    shape.nodes = sum(shape.nodes, style.dashes.size());
    shape.part.geometry = std::move(style);
    return shape;
}

/// A list of odd length is doubled, as in SVG.
std::vector<double> TreeReader::dashes() {
    std::vector<double> lengths;
    in_.expect("(");
    while (!in_.accept(")"))
        lengths.push_back(in_.number("a length or ')'"));
    if (lengths.size() % 2 != 0)
        lengths.insert(lengths.end(), lengths.begin(), lengths.end());
    return lengths;
}

TreeReader::CountedClip TreeReader::clip() {
    const Level level(*this);
    if (in_.peek() == "{")
        return clipBlock();
    return named<CountedClip>("a clip ('{' or a name)");
}

TreeReader::CountedClip TreeReader::clipBlock() {
    in_.expect("{");
    scene::Clip made;
    std::size_t nodes = 1;
    while (!in_.accept("}"))
        made.shapes.push_back(clipShape(nodes));
    made.clip = within(nodes);
    return {std::make_shared<const scene::Clip>(std::move(made)), nodes};
}

scene::ClipShape TreeReader::clipShape(std::size_t& nodes) {
    limits::check();
    const std::string_view at = in_.rest();
    const CountedShape made = shape();
    const auto* rule = std::get_if<scene::FillRule>(&made.part.geometry);
    if (rule == nullptr)
        in_.fail(at, "clips are made of filled shapes, not of strokes");
    nodes = sum(nodes, made.nodes);
    return {made.part.path, made.part.transform, *rule, within(nodes)};
}

/// Null where there is none.
scene::Link<scene::Clip> TreeReader::within(std::size_t& nodes) {
    if (!in_.accept("within"))
        return nullptr;
    const CountedClip outer = clip();
    nodes = sum(nodes, outer.nodes);
    return outer.part;
}

Compositing TreeReader::compositing(std::size_t& nodes) {
    Compositing how;
    for (std::vector<std::string_view> given;;) {
        if (attribute("opacity", given)) {
            how.opacity = unit("an opacity");
        } else if (attribute("blend", given)) {
            how.blend = keyword<scene::BlendMode>(keywords::blends);
        } else if (attribute("clip", given)) {
            const CountedClip made = clip();
            nodes = sum(nodes, made.nodes);
            how.clip = made.part;
        } else if (attribute("mask", given)) {
            how.mask = mask(nodes);
        } else {
            return how;
        }
    }
}

scene::Link<scene::Mask> TreeReader::mask(std::size_t& nodes) {
    const int kind = keyword<int>(keywords::masks);
    const CountedVtm content = part();
    nodes = sum(nodes, content.nodes);
    // A paint over the whole plane reaches as far as a picture can.
    const scene::Point corner(scene::maxSide);
    const scene::Link<scene::Group> made = group(content, -corner, corner);
    scene::Link<scene::Mask>& known = masks_[{made.get(), kind}];
    if (!known)
        known = std::make_shared<const scene::Mask>(
            scene::Mask{made, kind == 1 ? scene::MaskKind::Alpha : scene::MaskKind::Luminance, kind == 2});
    return known;
}

bool TreeReader::isTransformNext() {
    constexpr std::array<std::string_view, 9> names{
        "matrix", "translate", "translateX", "translateY", "scale", "scaleX", "scaleY", "rotate", "skewX"};
    const std::string_view name = in_.peek();
    return (std::ranges::count(names, name) != 0 || name == "skewY") &&
           skipBlank(in_.rest().substr(name.size())).starts_with('(');
}

/// SVG's functions, the last one applied first.
scene::Affine TreeReader::transform() {
    if (!isTransformNext())
        in_.failExpecting("matrix(), translate(), scale(), rotate(), skewX() or skewY()");
    scene::Affine all = scene::identity;
    while (isTransformNext()) {
        const std::string_view at = in_.rest();
        const std::string_view function = at.substr(0, std::min(at.find(')'), at.size() - 1) + 1);
        const auto map = svg::parseTransform(function, {}, {});
        if (!map)
            in_.fail(at, "the transform cannot be read");
        in_.advance(function.size());
        all = scene::compose(all, *map);
        for (const double number : {all[0].x, all[0].y, all[1].x, all[1].y, all[2].x, all[2].y})
            if (!(std::abs(number) < svg::maxNumber))
                in_.fail(at, "the transform has a number beyond 1e30");
    }
    return all;
}

float TreeReader::unit(std::string_view what) {
    const std::string_view at = in_.rest();
    const double value = in_.number(what);
    if (!(value >= 0 && value <= 1))
        in_.fail(at, fmt::format("{} is not in [0, 1]", value));
    return static_cast<float>(value);
}

}  // namespace vtm
