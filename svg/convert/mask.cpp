// Masks. Source: CSS Masking 1 section 8.

#include "svg/convert/converter.hpp"

namespace vtm::svg {
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
    return std::make_shared<const scene::Mask>(
        scene::Mask{std::move(content), inner.style.maskKind, inner.style.linearColors});
}

}  // namespace vtm::svg
