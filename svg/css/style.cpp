#include "svg/css/style.hpp"

namespace vtm::svg {
namespace {

const Style& initialStyle() {
    static const Style style;
    return style;
}

/// CSS-wide keywords (CSS Cascade 4 section 7.3); no other style sheet stands behind the author's, to which
/// `revert` could go back.
bool applyKeyword(Style& style, const Style& parent, const Property& property, std::string_view value) {
    // currentColor as the colour itself is the parent's (CSS Color 4 section 9.3).
    if (equalsIgnoringCase(value, "inherit") ||
        (property.name == "color" && equalsIgnoringCase(value, "currentColor"))) {
        property.copy(style, parent);
        return true;
    }
    if (equalsIgnoringCase(value, "initial")) {
        property.copy(style, initialStyle());
        return true;
    }
    if (equalsIgnoringCase(value, "unset") || equalsIgnoringCase(value, "revert")) {
        property.copy(style, property.inherited ? parent : initialStyle());
        return true;
    }
    return false;
}

}  // namespace

Style computeStyle(const Element& element, const Style& parent, Units units) {
    Style style;
    static_cast<Inherited&>(style) = parent;
    // Fonts first: their em is the parent's, all others' em is the element's own.
    units.fontSize = parent.fontSize;
    units.fontWeight = parent.fontWeight;
    for (const bool fontPass : {true, false}) {
        for (const Declaration& declaration : element.declarations)
            if (declaration.property->name.starts_with("font") == fontPass &&
                !applyKeyword(style, parent, *declaration.property, declaration.value))
                declaration.property->apply(style, declaration.value, units);
        units.fontSize = style.fontSize;
    }
    return style;
}

bool isValid(const Property& property, std::string_view value) {
    Style style;
    return applyKeyword(style, initialStyle(), property, value) || property.apply(style, value, {});
}

scene::Color resolveColor(const ColorValue& value, const Style& style) {
    return value.current ? style.color : value.color;
}

}  // namespace vtm::svg
