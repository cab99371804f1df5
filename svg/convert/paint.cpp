// Values of fill and stroke. Source: SVG 2 section 13.2.

#include <fmt/format.h>

#include "svg/convert/converter.hpp"

namespace vtm::svg {

scene::Paint mapPaint(scene::Paint paint, const scene::Affine& change) {
    std::visit(
        [&](auto& value) {
            if constexpr (requires { value.transform; })
                value.transform = scene::compose(change, value.transform);
        },
        paint);
    return paint;
}

std::optional<scene::Paint> Converter::paint(const PaintValue& value, const Element& element,
                                             const Scope& scope, const Box& box) {
    switch (value.kind) {
        case PaintKind::None:
            return std::nullopt;
        case PaintKind::Color:
            return value.color;
        case PaintKind::CurrentColor:
            return scope.style.color;
        case PaintKind::ContextFill:
            return contextPaint(true, scope);
        case PaintKind::ContextStroke:
            return contextPaint(false, scope);
        case PaintKind::Server:
            break;
    }
    ServerResult result = server(value.server, element, scope, box);
    if (auto* paint = std::get_if<scene::Paint>(&result))
        return std::move(*paint);
    if (std::holds_alternative<Nothing>(result) || !value.fallback)
        return std::nullopt;
    return paint({*value.fallback, value.color, {}, {}}, element, scope, box);
}

std::optional<scene::Paint> Converter::contextPaint(bool fill, const Scope& scope) {
    if (!scope.context)
        return std::nullopt;
    const Scope& outer = scope.context->scope;
    const PaintValue& value = fill ? outer.style.fill : outer.style.stroke;
    const Box box = value.kind == PaintKind::Server ? contextBox(*scope.context) : Box{};
    auto result = paint(value, scope.context->element, outer, box);
    const auto toUser = scene::inverse(scope.transform);
    if (!result || !toUser)
        return std::nullopt;
    return mapPaint(std::move(*result), scene::compose(*toUser, outer.transform));
}

/// The box of a use is that of its content, which a trial conversion finds.
const Box& Converter::contextBox(const ContextElement& context) {
    if (!context.box) {
        context.box = Box{};  // what the trial itself sees
        withoutOutlines([&] {
            context.box = boxAround(context.scope, [&] {
                Nodes unused;
                convertUsed(context.element, *tree_.byHref(*hrefOf(context.element)), context.scope, unused);
            });
        });
    }
    return *context.box;
}

Converter::ServerResult Converter::server(std::string_view href, const Element& element, const Scope& scope,
                                          const Box& box) {
    const Element* server = tree_.byHref(href);
    const Tag tag = server ? server->tag : Tag::Unknown;
    if (tag == Tag::LinearGradient || tag == Tag::RadialGradient)
        return gradient(*server, scope, box);
    if (tag == Tag::Pattern)
        return pattern(*server, scope, box);
    reporter_.warn(Kind::Reference, element, fmt::format("\"{}\" is not a paint server", href));
    return Invalid{};
}

std::string_view inherited(const TemplateChain& chain, std::string_view name, Tag tag) {
    for (const Element* element : chain)
        if (tag == Tag::Unknown || element->tag == tag)
            if (const auto value = element->find(name))
                return *value;
    return {};
}

TemplateChain Converter::templateChain(const Element& server) {
    const bool isPattern = server.tag == Tag::Pattern;
    std::vector<const Element*> chain;
    std::unordered_set<const Element*> seen;
    for (const Element* next = &server; next;) {
        const bool fits = isPattern ? next->tag == Tag::Pattern
                                    : next->tag == Tag::LinearGradient || next->tag == Tag::RadialGradient;
        if (!fits || !seen.insert(next).second) {
            reporter_.warn(
                Kind::Reference, server,
                fits ? "refers to itself, directly or indirectly" : "refers to an element of another kind");
            break;
        }
        limits::check();
        chain.push_back(next);
        const auto href = hrefOf(*next);
        next = href ? tree_.byHref(*href) : nullptr;
        if (href && !next)
            reporter_.warn(Kind::Reference, server,
                           fmt::format("refers to \"{}\", which is not here", *href));
    }
    return chain;
}

}  // namespace vtm::svg
