// Clip paths. Source: CSS Masking 1 section 7.

#include "svg/convert/converter.hpp"

namespace vtm::svg {

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
    const Element* clipPath = resource(scope.style.clipPath, Tag::ClipPath, element);
    return clipPath ? clip(*clipPath, scope, box) : nullptr;
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
    inner.transform =
        scene::compose(scope.transform, transformFrom(inner.style.transform, inner.style, scope.viewport));
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
    if (child.tag != Tag::Use)
        return;
    const std::optional<Scope> scope = spend() ? enter(child, parent) : std::nullopt;
    const Element* target = tree_.byHref(hrefOf(child).value_or(std::string_view{}));
    if (!scope || !target || !(isShape(target->tag) || target->tag == Tag::Text))
        return;
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

}  // namespace vtm::svg
