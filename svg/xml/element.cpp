#include "svg/xml/element.hpp"

#include "svg/css/cursor.hpp"

namespace vtm::svg {

Tag tagOf(std::string_view localName) {
    static const std::unordered_map<std::string_view, Tag> tags{{"a", Tag::A},
                                                                {"animate", Tag::Animation},
                                                                {"animateColor", Tag::Animation},
                                                                {"animateMotion", Tag::Animation},
                                                                {"animateTransform", Tag::Animation},
                                                                {"circle", Tag::Circle},
                                                                {"clipPath", Tag::ClipPath},
                                                                {"cursor", Tag::Cursor},
                                                                {"defs", Tag::Defs},
                                                                {"desc", Tag::Descriptive},
                                                                {"ellipse", Tag::Ellipse},
                                                                {"filter", Tag::Filter},
                                                                {"flowDiv", Tag::FlowPara},
                                                                {"flowLine", Tag::FlowPara},
                                                                {"flowPara", Tag::FlowPara},
                                                                {"flowRegion", Tag::FlowRegion},
                                                                {"flowRoot", Tag::FlowRoot},
                                                                {"flowSpan", Tag::FlowSpan},
                                                                {"foreignObject", Tag::ForeignObject},
                                                                {"g", Tag::G},
                                                                {"image", Tag::Image},
                                                                {"line", Tag::Line},
                                                                {"linearGradient", Tag::LinearGradient},
                                                                {"marker", Tag::Marker},
                                                                {"mask", Tag::Mask},
                                                                {"metadata", Tag::Descriptive},
                                                                {"path", Tag::Path},
                                                                {"pattern", Tag::Pattern},
                                                                {"polygon", Tag::Polygon},
                                                                {"polyline", Tag::Polyline},
                                                                {"radialGradient", Tag::RadialGradient},
                                                                {"rect", Tag::Rect},
                                                                {"script", Tag::Script},
                                                                {"set", Tag::Animation},
                                                                {"stop", Tag::Stop},
                                                                {"style", Tag::Style},
                                                                {"svg", Tag::Svg},
                                                                {"switch", Tag::Switch},
                                                                {"symbol", Tag::Symbol},
                                                                {"text", Tag::Text},
                                                                {"textPath", Tag::TextPath},
                                                                {"title", Tag::Descriptive},
                                                                {"tref", Tag::Tref},
                                                                {"tspan", Tag::Tspan},
                                                                {"use", Tag::Use},
                                                                {"view", Tag::View}};
    if (const auto found = tags.find(localName); found != tags.end())
        return found->second;
    return localName.starts_with("fe") ? Tag::FilterPrimitive : Tag::Unknown;
}

const char* nameOf(Tag tag) {
    switch (tag) {
        case Tag::A:
            return "a";
        case Tag::Circle:
            return "circle";
        case Tag::ClipPath:
            return "clipPath";
        case Tag::Ellipse:
            return "ellipse";
        case Tag::FlowPara:
            return "flowPara";
        case Tag::FlowRoot:
            return "flowRoot";
        case Tag::FlowSpan:
            return "flowSpan";
        case Tag::G:
            return "g";
        case Tag::Image:
            return "image";
        case Tag::Line:
            return "line";
        case Tag::Marker:
            return "marker";
        case Tag::Mask:
            return "mask";
        case Tag::Path:
            return "path";
        case Tag::Pattern:
            return "pattern";
        case Tag::Polygon:
            return "polygon";
        case Tag::Polyline:
            return "polyline";
        case Tag::Rect:
            return "rect";
        case Tag::Style:
            return "style";
        case Tag::Svg:
            return "svg";
        case Tag::Switch:
            return "switch";
        case Tag::Symbol:
            return "symbol";
        case Tag::Text:
            return "text";
        case Tag::TextPath:
            return "textPath";
        case Tag::Tref:
            return "tref";
        case Tag::Tspan:
            return "tspan";
        case Tag::Use:
            return "use";
        default:
            return "";
    }
}

std::optional<std::string_view> Element::find(std::string_view attribute) const {
    for (const Attribute& candidate : attributes)
        if (candidate.name == attribute)
            return candidate.value;
    return std::nullopt;
}

std::optional<std::string_view> hrefOf(const Element& element) {
    std::optional<std::string_view> href = element.find("href");
    if (!href)
        href = element.find("xlink:href");
    return href ? std::optional(trim(*href)) : std::nullopt;
}

const Element* Tree::byId(std::string_view id) const {
    const auto found = ids.find(id);
    return found == ids.end() ? nullptr : found->second;
}

const Element* Tree::byHref(std::string_view href) const {
    return href.starts_with('#') ? byId(href.substr(1)) : nullptr;
}

}  // namespace vtm::svg
