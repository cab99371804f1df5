// Elements in general: what is rendered, with which style and where.

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "svg/convert/converter.hpp"

namespace vtm::svg {
namespace {

/// Elements that are drawn, if at all, only where something refers to them, or that never are.
bool isRendered(Tag tag) {
    switch (tag) {
        case Tag::A:
        case Tag::FlowRoot:
        case Tag::ForeignObject:
        case Tag::G:
        case Tag::Image:
        case Tag::Svg:
        case Tag::Switch:
        case Tag::Text:
        case Tag::Use:
        case Tag::Unknown:
            return true;
        default:
            return isShape(tag);
    }
}

/// BCP 47 prefix match (SVG 1.1 section 5.8.5).
bool matchesLanguage(std::string_view offered, std::string_view wanted) {
    return equalsIgnoringCase(offered.substr(0, wanted.size()), wanted) &&
           (offered.size() == wanted.size() ||
            (offered.size() > wanted.size() && offered[wanted.size()] == '-'));
}

bool anyLanguageMatches(std::string_view list, std::string_view wanted) {
    for (Cursor cursor(list); !cursor.atEnd();)
        if (matchesLanguage(trim(cursor.until(',')), wanted))
            return true;
    return false;
}

}  // namespace

Converter::Converter(const Tree& tree, Reporter& reporter, const Options& options, Budget& budget)
    : tree_(tree),
      reporter_(reporter),
      options_(options),
      budget_(budget),
      rootFontSize_(options.defaultFontSize) {
    rootFontSize_ = styleOf(*tree.root).fontSize;
    rootSize_ = computeRootSize();
}

Converter::~Converter() = default;

Converter::Level::Level(Converter& converter, const Element& element)
    : converter_(converter),
      element_(element),
      stage_(
          "converting",
          [](const void* level) {
              const auto& self = *static_cast<const Level*>(level);
              return self.converter_.placeOf(self.element_);
          },
          this) {
    limits::check();
    if (++converter_.budget_.level > Limits::maxDepth)
        converter_.reporter_.warn(Warning::Kind::Limit, element,
                                  "elements are nested too deep here; it is left out");
}

void Converter::convertElement(const Element& element, const Scope& parent, Nodes& out) {
    if (!isRendered(element.tag) || !spend())
        return;
    const Level level(*this, element);
    if (!level)
        return;
    if (only_ && &element != only_)
        return convertTowardsOnly(element, parent, out);
    const Element* const only = std::exchange(only_, nullptr);
    if (const std::optional<Scope> scope = enter(element, parent))
        appendWithEffects(element, *scope, out,
                          [&](Nodes& content) { convertContent(element, *scope, content); });
    only_ = only;
}

/// Ancestors give their transforms, viewports and inherited properties; what else they hold is passed over.
void Converter::convertTowardsOnly(const Element& element, const Scope& parent, Nodes& out) {
    if (!leadsToOnly(element))
        return;
    const std::optional<Scope> scope = enter(element, parent);
    if (!scope)
        return;
    if (element.tag == Tag::Svg)
        convertSvg(element, *scope, out);
    else
        convertChildren(element, *scope, out);
}

bool Converter::leadsToOnly(const Element& element) const {
    for (const Element* e = only_; e; e = e->parent)
        if (e == &element)
            return true;
    return false;
}

void Converter::convertChildren(const Element& element, const Scope& scope, Nodes& out) {
    for (const Element* child : element.children)
        convertElement(*child, scope, out);
}

void Converter::convertContent(const Element& element, const Scope& scope, Nodes& out) {
    switch (element.tag) {
        case Tag::A:
        case Tag::G:
            return convertChildren(element, scope, out);
        case Tag::Switch:
            return convertSwitch(element, scope, out);
        case Tag::Svg:
            return convertSvg(element, scope, out);
        case Tag::Use:
            return convertUse(element, scope, out);
        case Tag::Image:
            return convertImage(element, scope, out);
        case Tag::FlowRoot:
            return convertFlowRoot(element, scope, out);
        case Tag::Text:
            return convertText(element, scope, out);
        default:
            return isShape(element.tag) ? convertShape(element, scope, out) : warnUnsupported(element);
    }
}

void Converter::warnUnsupported(const Element& element) {
    reporter_.warn(Kind::Element, element,
                   element.tag == Tag::Unknown ? "is not an SVG element; it is left out"
                                               : "holds what is not SVG; it is left out");
}

bool Converter::spend(std::size_t visits) {
    if (budget_.visits < visits) {
        reporter_.warn(Kind::Limit, *tree_.root,
                       fmt::format("more than {} elements to draw; the rest is left out", Limits::maxNodes));
        budget_.visits = 0;
        return false;
    }
    budget_.visits -= visits;
    return true;
}

bool Converter::passesConditions(const Element& element) const {
    if (const auto extensions = element.find("requiredExtensions"); extensions && !trim(*extensions).empty())
        return false;
    const auto languages = element.find("systemLanguage");
    return !languages || anyLanguageMatches(*languages, options_.language);
}

std::optional<Scope> Converter::enter(const Element& element, const Scope& parent) {
    if (!passesConditions(element))
        return std::nullopt;
    Scope scope{computeStyle(element, parent.style, unitsFor(parent.style)), parent.transform,
                parent.viewport, parent.context, parent.depth + 1};
    if (!scope.style.displayed)
        return std::nullopt;
    scope.transform = nested(parent.transform, transformOf(element, scope));
    if (element.tag == Tag::Use) {
        const LengthReader reader = lengths(element, scope);
        const scene::Affine shift =
            scene::translation(reader.lengthOr("x", Axis::X, 0), reader.lengthOr("y", Axis::Y, 0));
        scope.transform = scene::compose(scope.transform, shift);
    }
    if (!scene::inverse(scope.transform)) {
        reporter_.warn(Kind::Value, element, "the transform flattens it; it is left out");
        return std::nullopt;
    }
    return scope;
}

/// A foreignObject is chosen only where nothing else can be: what stands behind it is meant for those who
/// cannot draw it, as in the files of draw.io.
void Converter::convertSwitch(const Element& element, const Scope& scope, Nodes& out) {
    const Element* foreign = nullptr;
    for (const Element* child : element.children) {
        if (!isRendered(child->tag) || child->tag == Tag::Unknown || !passesConditions(*child))
            continue;
        if (child->tag != Tag::ForeignObject)
            return convertElement(*child, scope, out);
        if (!foreign)
            foreign = child;
    }
    if (foreign)
        convertElement(*foreign, scope, out);
}

scene::Affine Converter::transformFrom(std::string_view text, const Style& style,
                                       const Viewport& viewport) const {
    const auto transform = parseTransform(text, unitsFor(style), viewport);
    if (!transform || !style.transformOrigin)
        return transform.value_or(scene::identity);
    return aroundPoint(*transform, {resolve(style.transformOrigin->x, Axis::X, viewport),
                                    resolve(style.transformOrigin->y, Axis::Y, viewport)});
}

scene::Affine Converter::transformOf(const Element& element, const Scope& scope) {
    const Style& style = scope.style;
    if (style.transform.empty() && style.translate.empty() && style.rotate.empty() && style.scale.empty())
        return scene::identity;
    if (style.transformBox == TransformBox::View)
        return transformIn({{0, 0}, {scope.viewport.width, scope.viewport.height}}, style);
    const Box box =
        style.transformBox == TransformBox::Fill ? ownBox(element, scope) : ownStrokeBox(element, scope);
    return transformIn(box.empty() ? Box{{0, 0}, {0, 0}} : box, style);
}

/// CSS Transforms 2 section 6: about the origin, translate, rotate, scale, then transform.
scene::Affine Converter::transformIn(const Box& box, const Style& style) const {
    const Units units = unitsFor(style);
    const Viewport size{box.width(), box.height()};
    scene::Affine result = scene::identity;
    const auto add = [&](std::string_view text, const std::optional<scene::Affine>& parsed) {
        if (!text.empty() && parsed)
            result = scene::compose(result, *parsed);
    };
    add(style.translate, parseTranslate(style.translate, units, size));
    add(style.rotate, parseRotate(style.rotate));
    add(style.scale, parseScale(style.scale));
    add(style.transform, parseTransform(style.transform, units, size));
    const TransformOrigin origin = style.transformOrigin.value_or(TransformOrigin{});
    const scene::Point at = box.min + scene::Point(origin.x.of(size.width), origin.y.of(size.height));
    return at == scene::Point(0) ? result : aroundPoint(result, at);
}

/// Of what the element fills, before its own transform.
Box Converter::ownBox(const Element& element, const Scope& scope) {
    if (isShape(element.tag)) {
        CachedShape* shape = shapeOf(element, scope);
        return shape ? boxOf(*shape) : Box{};
    }
    const std::size_t first = outlines_.size();
    Nodes measured;
    const Box box = boxAround(scope, [&] { convertContent(element, scope, measured); });
    outlines_.resize(first);  // who else listens hears of it where it is drawn
    return box;
}

Box Converter::ownStrokeBox(const Element& element, const Scope& scope) {
    Box box = ownBox(element, scope);
    Scope own = scope;
    own.transform = scene::identity;
    own.style.nonScalingStroke = false;
    const std::size_t first = outlines_.size();
    Nodes nodes;
    convertContent(element, own, nodes);
    outlines_.resize(first);
    box.add(strokedBox(nodes));
    return box;
}

const Style& Converter::styleOf(const Element& element) {
    if (const auto found = styles_.find(&element); found != styles_.end())
        return found->second;
    Style initial;
    initial.fontSize = options_.defaultFontSize;
    const Style& parent = element.parent ? styleOf(*element.parent) : initial;
    return styles_.emplace(&element, computeStyle(element, parent, unitsFor(parent))).first->second;
}

Units Converter::unitsFor(const Style& style) const {
    return {options_.dpi,     style.fontSize, rootFontSize_,
            style.fontWeight, rootSize_,      options_.defaultFontSize};
}

LengthReader Converter::lengths(const Element& element, const Scope& scope) const {
    return {element, scope.style, scope.viewport, unitsFor(scope.style)};
}

Box Converter::outlineBox(std::size_t first, const scene::Affine& userToPicture) const {
    Box box;
    const std::optional<scene::Affine> toUser = scene::inverse(userToPicture);
    for (std::size_t i = first; toUser && i < outlines_.size(); ++i) {
        limits::check();
        box.add(boundingBox(*outlines_[i].path, scene::compose(*toUser, outlines_[i].transform)));
    }
    return box;
}

}  // namespace vtm::svg
