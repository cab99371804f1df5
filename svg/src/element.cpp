#include "svg/src/element.hpp"

#include "svg/src/cursor.hpp"

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
