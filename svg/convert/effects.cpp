// What turns an element into a group: opacity, blending, isolation, clips, masks, filters.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "svg/convert/converter.hpp"
#include "svg/css/clip_shape.hpp"
#include "svg/css/property_values.hpp"

namespace vtm::svg {

// ---- Clip paths (CSS Masking 1 section 7) -------------------------------------------------------

std::shared_ptr<const scene::Clip> intersect(const std::shared_ptr<const scene::Clip>& first,
                                             const std::shared_ptr<const scene::Clip>& second) {
    if (!first || !second)
        return first ? first : second;
    auto both = std::make_shared<scene::Clip>(*first);
    both->clip = intersect(first->clip, second);
    return both;
}

std::shared_ptr<const scene::Clip> Converter::clipOf(const Element& element, const Scope& scope,
                                                     const Box& box) {
    if (scope.style.clipPath.empty())
        return nullptr;
    Cursor cursor(scope.style.clipPath);
    const auto href = readUrl(cursor);
    if (!href)
        return shapeClip(element, scope, box);
    const Element* clipPath = resource(*href, Tag::ClipPath, element);
    return clipPath ? clip(*clipPath, scope, box) : nullptr;
}

std::shared_ptr<const scene::Clip> Converter::shapeClip(const Element& element, const Scope& scope,
                                                        const Box& box) {
    const auto shape = parseClipShape(scope.style.clipPath, unitsFor(scope.style));
    if (!shape)
        return nullptr;
    auto made = std::make_shared<scene::Clip>();
    const Box reference = shape->box == TransformBox::Stroke ? ownStrokeBox(element, scope)
                          : shape->box == TransformBox::Fill
                              ? box
                              : Box{{0, 0}, {scope.viewport.width, scope.viewport.height}};
    if (reference.empty())
        return made;
    scene::Path path = outlineOf(*shape, reference);
    if (!path.empty() && isDrawable(path, scope.transform))
        made->shapes.push_back({std::make_shared<const scene::Path>(std::move(path)), scope.transform,
                                shape->fillRule, nullptr, placeOf(element)});
    return made;
}

std::shared_ptr<const scene::Clip> Converter::clip(const Element& clipPath, const Scope& scope,
                                                   const Box& box) {
    const Expansion expansion(active_, clipPath);
    if (!expansion || !spend()) {
        reporter_.warn(Kind::Reference, clipPath, "refers to itself, directly or indirectly");
        return nullptr;
    }
    const Level level(*this, clipPath);
    if (!level)
        return nullptr;
    // On the heap: clips and masks nest deep, and the stack may be small.
    const auto innerScope = std::make_unique<Scope>(scope);
    Scope& inner = *innerScope;
    inner.style = styleOf(clipPath);
    ++inner.depth;
    inner.transform = scene::compose(
        scope.transform, transformIn({{0, 0}, {scope.viewport.width, scope.viewport.height}}, inner.style));
    if (trim(clipPath.get("clipPathUnits")) == "objectBoundingBox")
        inner.transform = scene::compose(inner.transform, unitSquareTo(box));
    auto made = std::make_shared<scene::Clip>();
    if (scene::inverse(inner.transform))
        for (const Element* child : clipPath.children)
            addClipChild(*child, inner, *made);
    const auto ownScope = std::make_unique<Scope>(scope);
    Scope& own = *ownScope;
    own.style = inner.style;
    made->clip = clipOf(clipPath, own, box);
    return made;
}

void Converter::addClipChild(const Element& child, const Scope& parent, scene::Clip& clip) {
    if (child.tag == Tag::Text)
        return addClipText(child, parent, clip);
    if (isShape(child.tag))
        addClipShape(child, parent, nullptr, clip);
    if (child.tag == Tag::G || child.tag == Tag::Image || child.tag == Tag::Svg || child.tag == Tag::Switch)
        reporter_.warn(Kind::Element, child, "clips nothing in a clipPath; it is left out");
    if (child.tag != Tag::Use)
        return;
    const std::optional<Scope> scope = spend() ? enter(child, parent) : std::nullopt;
    const Element* target = tree_.byHref(hrefOf(child).value_or(std::string_view{}));
    if (!scope)
        return;
    if (!target || !(isShape(target->tag) || target->tag == Tag::Text))
        return reporter_.warn(Kind::Reference, child, "refers to no shape and no text; it is left out");
    if (target->tag == Tag::Text)
        return addClipText(*target, *scope, clip);
    const Box box = boxAround(*scope, [&] {
        Nodes unused;
        convertElement(*target, *scope, unused);
    });
    addClipShape(*target, *scope, clipOf(child, *scope, box), clip);
}

void Converter::addClipShape(const Element& child, const Scope& parent,
                             const std::shared_ptr<const scene::Clip>& around, scene::Clip& clip) {
    const std::optional<Scope> scope = spend() ? enter(child, parent) : std::nullopt;
    CachedShape* shape = scope && scope->style.visible ? shapeOf(child, *scope) : nullptr;
    if (!shape || !isWithinReach(geometry::mapped(boxOf(*shape), scope->transform)))
        return;
    const CachedShape own = *shape;  // what the child's own clip draws may replace the cache's entry
    clip.shapes.push_back({own.path, scope->transform, scope->style.clipRule,
                           intersect(clipOf(child, *scope, *own.box), around), placeOf(child)});
}

// ---- Masks (CSS Masking 1 section 8) ------------------------------------------------------------

namespace {

/// The mask region in user space: by default a tenth of the box more on each side.
Box regionOf(const LengthReader& written, bool boxUnits, const Box& box) {
    const Viewport unit{1, 1};
    const LengthReader reader{written.element, written.style, boxUnits ? unit : written.viewport,
                              written.units};
    const auto get = [&](std::string_view name, Axis axis, double percent) {
        return reader.length(name, axis).value_or(resolve({percent, true}, axis, reader.viewport));
    };
    const Rect rect{get("x", Axis::X, -10), get("y", Axis::Y, -10), get("width", Axis::X, 120),
                    get("height", Axis::Y, 120)};
    return boxUnits ? geometry::mapped(toBox(rect), unitSquareTo(box)) : toBox(rect);
}

}  // namespace

std::shared_ptr<const scene::Mask> Converter::maskOf(const Element& element, const Scope& scope,
                                                     const Box& box) {
    if (scope.style.mask.empty())
        return nullptr;
    const Element* found = resource(scope.style.mask, Tag::Mask, element);
    return found ? mask(*found, scope, box) : nullptr;
}

std::shared_ptr<const scene::Mask> Converter::mask(const Element& element, const Scope& scope,
                                                   const Box& box) {
    const Expansion expansion(active_, element);
    if (!expansion || !spend()) {
        reporter_.warn(Kind::Reference, element, "refers to itself, directly or indirectly");
        return nullptr;
    }
    const Level level(*this, element);
    if (!level)
        return nullptr;
    // On the heap: clips and masks nest deep, and the stack may be small.
    const auto innerScope = std::make_unique<Scope>(scope);
    Scope& inner = *innerScope;
    inner.style = styleOf(element);
    ++inner.depth;
    const bool boxUnits = trim(element.get("maskUnits")) != "userSpaceOnUse";
    const bool boxContent = trim(element.get("maskContentUnits")) == "objectBoundingBox";
    auto content = std::make_shared<scene::Group>();
    const Box region = regionOf(lengths(element, inner), boxUnits, box);
    const bool hasBox = box.width() > 0 && box.height() > 0;
    const bool reachable = hasBox || !(boxUnits || boxContent);  // without a box the mask hides everything
    if (reachable && region.width() > 0 && region.height() > 0) {
        if (boxContent)
            inner.transform = scene::compose(scope.transform, unitSquareTo(box));
        Nodes nodes;
        if (scene::inverse(inner.transform))
            withoutOutlines([&] { convertChildren(element, inner, nodes); });
        appendClipped({region.min.x, region.min.y, region.width(), region.height()}, scope.transform,
                      std::move(nodes), content->children);
    }
    const auto ownScope = std::make_unique<Scope>(scope);
    Scope& own = *ownScope;
    own.style = inner.style;
    content->mask = maskOf(element, own, box);
    return std::make_shared<const scene::Mask>(scene::Mask{
        std::move(content), scope.style.maskMode.value_or(inner.style.maskKind), inner.style.linearColors});
}

// ---- Effects ------------------------------------------------------------------------------------

namespace {

bool blends(const scene::Node& node) {
    const auto* group = std::get_if<scene::Group>(&node.value);
    return group && group->blend != scene::BlendMode::Normal;
}

/// A group that only its opacity tells from its one child gives way to that child.
bool foldsIntoChild(const scene::Group& group) {
    return group.children.size() == 1 && !std::holds_alternative<scene::Select>(group.children[0].value) &&
           group.blend == scene::BlendMode::Normal && !group.clip && !group.mask && !group.filter &&
           !blends(group.children.front());
}

scene::Node folded(scene::Group group) {
    scene::Node child = std::move(group.children.front());
    if (auto* item = std::get_if<scene::Item>(&child.value))
        item->opacity *= group.opacity;
    else
        std::get<scene::Group>(child.value).opacity *= group.opacity;
    return child;
}

}  // namespace

void appendGroup(scene::Group group, bool isolated, Nodes& out) {
    if ((group.children.empty() && !group.filter) || group.opacity <= 0)
        return;
    const bool plain = group.opacity >= 1 && group.blend == scene::BlendMode::Normal && !group.clip &&
                       !group.mask && !group.filter;
    const bool needsIsolation = isolated && std::any_of(group.children.begin(), group.children.end(), blends);
    if (plain && !needsIsolation)
        std::move(group.children.begin(), group.children.end(), std::back_inserter(out));
    else if (foldsIntoChild(group))
        out.push_back(folded(std::move(group)));
    else
        out.push_back({std::move(group)});
}

bool Converter::leavesPaintAlone(const Style& style) const {
    return style.opacity >= 1 && style.blend == scene::BlendMode::Normal && !style.isolated &&
           style.clipPath.empty() && style.mask.empty() && style.filter.empty();
}

void Converter::appendWithEffects(const Element& element, const Scope& scope, Nodes& out,
                                  const Content& content) {
    if (leavesPaintAlone(scope.style))
        return content(out);
    scene::Group group;
    const Box box = boxAround(scope, [&] { content(group.children); });
    Effects effects;
    withoutOutlines([&] { effects = effectsOf(element, scope, box); });
    if (!effects.draw)
        return;
    for (auto& filter : effects.filters) {
        if (group.filter) {
            scene::Group inner = std::exchange(group, {});
            group.children.push_back({std::move(inner)});
        }
        group.filter = std::move(filter);
    }
    group.opacity = static_cast<float>(scope.style.opacity);
    group.blend = scope.style.blend;
    group.clip = std::move(effects.clip);
    group.mask = std::move(effects.mask);
    appendGroup(std::move(group), scope.style.isolated, out);
}

Box Converter::boxAround(const Scope& scope, const std::function<void()>& convert) {
    const std::size_t first = outlines_.size();
    ++outlineListeners_;
    convert();
    const Box box = outlineBox(first, scope.transform);
    if (--outlineListeners_ == 0)
        outlines_.resize(first);
    return box;
}

Converter::Effects Converter::effectsOf(const Element& element, const Scope& scope, const Box& box) {
    Effects effects;
    std::optional<FilterList> filters = filtersOf(element, scope, box);
    effects.draw = filters.has_value();
    if (filters) {
        effects.filters = std::move(*filters);
        effects.clip = clipOf(element, scope, box);
        effects.mask = maskOf(element, scope, box);
    }
    return effects;
}

const Element* Converter::resource(std::string_view href, Tag tag, const Element& user) {
    const Element* element = tree_.byHref(href);
    if (element && element->tag == tag)
        return element;
    reporter_.warn(Kind::Reference, user, fmt::format("\"{}\" refers to an element of the wrong kind", href));
    return nullptr;
}

}  // namespace vtm::svg
