// What turns an element into a group: opacity, blending, isolation, clips, masks (and filters).

#include <fmt/format.h>

#include <algorithm>

#include "svg/convert/converter.hpp"
#include "svg/css/property_values.hpp"

namespace vtm::svg {
namespace {

bool blends(const scene::Node& node) {
    const auto* group = std::get_if<scene::Group>(&node.value);
    return group && group->blend != scene::BlendMode::Normal;
}

/// A group that only its opacity tells from its one child gives way to that child.
bool foldsIntoChild(const scene::Group& group) {
    return group.children.size() == 1 && !std::holds_alternative<scene::Select>(group.children[0].value) &&
           group.blend == scene::BlendMode::Normal && !group.clip && !group.mask &&
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
    if (group.children.empty() || group.opacity <= 0)
        return;
    const bool plain =
        group.opacity >= 1 && group.blend == scene::BlendMode::Normal && !group.clip && !group.mask;
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
    effects.draw = filterAllowsDrawing(element, scope.style);
    if (effects.draw) {
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

bool Converter::filterAllowsDrawing(const Element& element, const Style& style) {
    for (Cursor cursor(style.filter); !cursor.atEnd(); cursor.skipSpaces()) {
        if (const auto href = readUrl(cursor); href && !resource(*href, Tag::Filter, element))
            return false;
        else if (!href)
            cursor.until(')');
        reporter_.warn(Kind::Filter, element,
                       "filters are not supported yet; the element is drawn without its filter");
    }
    return true;
}

}  // namespace vtm::svg
