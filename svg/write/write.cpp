// Groups and items.

#include <vtm/svg/write.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <vtm/svg/load.hpp>
#include "svg/css/cursor.hpp"
#include "svg/geometry/path_geometry.hpp"
#include "svg/write/values.hpp"
#include "svg/write/writer.hpp"

namespace vtm::svg {

using namespace scene;

const char* nameOf(BlendMode mode) {
    constexpr const char* names[] = {"normal",     "multiply",    "screen",     "overlay",    "darken",
                                     "lighten",    "color-dodge", "color-burn", "hard-light", "soft-light",
                                     "difference", "exclusion",   "hue",        "saturation", "color",
                                     "luminosity", "plus-lighter"};
    return names[int(mode)];
}

namespace {

bool isPlain(const Group& g) {
    return g.opacity == 1 && g.blend == BlendMode::Normal && !g.clip && !g.mask && !g.filter;
}

bool hasBlendingChild(const Group& g) {
    return std::any_of(g.children.begin(), g.children.end(), [](const Node& node) {
        const auto* child = std::get_if<Group>(&node.value);
        return child && child->blend != BlendMode::Normal;
    });
}

bool isFill(const Item& item) { return std::holds_alternative<FillRule>(item.geometry); }

std::string sizeAttributes(const Rect& shown) {
    return attribute("width", number(shown.width)) + attribute("height", number(shown.height)) +
           attribute("viewBox", pair({shown.x, shown.y}) + " " + pair({shown.width, shown.height}));
}

}  // namespace

bool isFlat(const Affine& map) {
    for (int i = 0; i < 3; ++i)
        if (!(std::max(std::abs(map[i].x), std::abs(map[i].y)) <= maxNumber))
            return false;  // not known; it cannot be written
    return !inverse(map);
}

std::string reference(std::string_view name, const std::string& id) {
    return attribute(name, "url(#" + id + ")");
}

Writer::Level::Level(Writer& writer) : writer_(writer) {
    limits::check();
    if (++writer.depth_ <= Limits::maxDepth)
        return;
    --writer.depth_;
    throw WriteError(fmt::format("the scene cannot be written as SVG: it is nested more than {} levels deep",
                                 Limits::maxDepth));
}

std::string Writer::run(const Scene& scene) {
    const Part body = aside([&] { content(scene.root); });
    const Rect shown = options_.part.value_or(Rect{0, 0, scene.width, scene.height});
    return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + sizeAttributes(shown) + ">\n" +
           definitions_.document(body.text, options_.shared) + "</svg>\n";
}

void Writer::append(const std::string& start, const Part& part, const std::string& end) {
    part_.text += start;
    part_.text += part.text;
    part_.text += end;
    part_.box.add(part.box);
}

/// Of what is a group by itself.
void Writer::content(const Group& g) {
    if (isPlain(g))
        children(g);
    else
        group(g);
}

/// Of what may have several users, each time the same.
const Writer::Part& Writer::shared(const std::shared_ptr<const Group>& g) {
    if (const auto known = contents_.find(g); known != contents_.end())
        return known->second;
    return contents_[g] = aside([&] { content(*g); });
}

void Writer::group(const Group& g) {
    const Level level(*this);
    if (!(g.opacity > 0))
        return;
    Part inner = aside([&] { children(g); });
    if (g.filter)
        inner = filtered(*g.filter, inner);
    if (inner.text.empty())
        return;
    const std::string attributes = groupAttributes(g);
    if (attributes.empty())
        append("", inner, "");
    else
        append("<g" + attributes + ">\n", inner, "</g>\n");
}

/// SVG isolates groups with any of these attributes.
std::string Writer::groupAttributes(const Group& g) {
    std::string attributes = opacityAttribute("opacity", g.opacity);
    if (g.clip)
        attributes += reference("clip-path", clip(g.clip));
    if (g.mask)
        attributes += reference("mask", mask(g.mask));
    if (g.blend != BlendMode::Normal)
        attributes += attribute("style", fmt::format("mix-blend-mode:{}", nameOf(g.blend)));
    if (attributes.empty() && hasBlendingChild(g))
        attributes = attribute("style", "isolation:isolate");
    return attributes;
}

void Writer::children(const Group& g) {
    const NodeList& nodes = g.children;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        limits::check();
        if (const auto* child = std::get_if<Group>(&nodes[i].value))
            group(*child);
        else if (const auto* selection = std::get_if<Select>(&nodes[i].value))
            select(*selection);
        else {
            const Item& first = std::get<Item>(nodes[i].value);
            const auto* next = i + 1 < nodes.size() ? std::get_if<Item>(&nodes[i + 1].value) : nullptr;
            const bool both = options_.shared && next && areOneShape(first, *next);
            item(first, both ? next : nullptr);
            i += both;
        }
    }
}

/// Whether one element says both: a fill and a stroke of the same path.
bool Writer::areOneShape(const Item& a, const Item& b) {
    return a.geometry.index() != b.geometry.index() && a.transform == b.transform &&
           !std::holds_alternative<ImagePaint>(a.paint) && !std::holds_alternative<ImagePaint>(b.paint) &&
           outline(a.path) == outline(b.path);
}

/// The item and, if it is not null, the one that lies on it and is the same shape.
void Writer::item(const Item& item, const Item* above) {
    if (item.path->empty() || isFlat(item.transform))
        return;
    if (const auto* paint = std::get_if<ImagePaint>(&item.paint))
        return image(item, *paint);
    const auto first = paintAttributes(item), second = above ? paintAttributes(*above) : std::nullopt;
    if (!first && !second)
        return;
    std::string attributes = first.value_or("") + second.value_or("");
    if (!(first && isFill(item)) && !(second && isFill(*above)))
        attributes += attribute("fill", "none");
    if (first && second && isFill(*above))
        attributes += attribute("paint-order", "stroke");
    Part part{
        "<" + outline(item.path) + transformAttribute("transform", item.transform) + attributes + "/>\n",
        boxOf(item)};
    if (above)
        part.box.add(boxOf(*above));
    append("", part, "");
}

/// Nothing where nothing is painted.
std::optional<std::string> Writer::paintAttributes(const Item& item) {
    const auto* color = std::get_if<Color>(&item.paint);
    const float alpha = color ? color->a * item.opacity : item.opacity;
    const auto value = alpha > 0 ? paint(item.paint) : std::nullopt;
    if (!value)
        return std::nullopt;
    if (const auto* style = std::get_if<StrokeStyle>(&item.geometry))
        return attribute("stroke", *value) + opacityAttribute("stroke-opacity", alpha) +
               strokeAttributes(*style);
    const bool isEvenOdd = std::get<FillRule>(item.geometry) == FillRule::EvenOdd;
    return attribute("fill", *value) + opacityAttribute("fill-opacity", alpha) +
           (isEvenOdd ? attribute("fill-rule", "evenodd") : "");
}

const std::string& Writer::outline(const std::shared_ptr<const Path>& path) {
    std::string& known = outlines_[path];
    if (known.empty())
        known = definitions_.shareable("path" + attribute("d", pathData(*path)));
    return known;
}

std::string write(const Scene& scene, const WriteOptions& options) { return Writer(options).run(scene); }

}  // namespace vtm::svg
