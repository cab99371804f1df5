#include "svg/css/style.hpp"

#include <algorithm>
#include <string>
#include <type_traits>
#include <unordered_map>

#include "svg/css/font_values.hpp"
#include "svg/css/property_values.hpp"
#include "svg/css/text_values.hpp"
#include "svg/geometry/path_data.hpp"

namespace vtm::svg {

// ---- The table of properties: by whom each value is read and where it is kept -------------------

namespace {

/// `marker`: all three at once.
bool applyMarkers(Style& style, std::string_view value, const Units& units) {
    const auto marker = parseReference(value, units);
    if (marker)
        style.markerStart = style.markerMid = style.markerEnd = *marker;
    return marker.has_value();
}

void copyMarkers(Style& to, const Style& from) {
    to.markerStart = from.markerStart;
    to.markerMid = from.markerMid;
    to.markerEnd = from.markerEnd;
}

/// `mask`: of its layers the first, and of that the reference and the mode.
bool applyMask(Style& style, std::string_view value, const Units& units) {
    const auto mask = parseReference(value, units);
    if (!mask)
        return false;
    style.mask = *mask;
    style.maskMode.reset();
    Cursor cursor(value.substr(0, extentOf(value, ",")));
    cursor.advance(extentOf(cursor.rest(), " "));
    while (cursor.skipSpaces(), !cursor.atEnd()) {
        const std::string_view word = cursor.word();
        if (const auto mode = parseMaskMode(word, units))
            style.maskMode = *mode;
        if (word.empty())
            cursor.advance();
    }
    return true;
}

void copyMask(Style& to, const Style& from) {
    to.mask = from.mask;
    to.maskMode = from.maskMode;
}

bool applyOverflow(Style& style, std::string_view value, const Units& units) {
    const auto overflow = parseOverflow(value, units);
    if (overflow)
        style.overflow = *overflow;
    return overflow.has_value();
}

/// Inherited from an element that declares nothing it is the initial value, visible; that some
/// elements are clipped where nothing is declared is the user agent's style sheet.
void copyOverflow(Style& to, const Style& from) { to.overflow = from.overflow.value_or(true); }

void copyFont(Style& to, const Style& from) {
    to.fontSize = from.fontSize;
    to.fontFamily = from.fontFamily;
    to.fontWeight = from.fontWeight;
    to.fontStretch = from.fontStretch;
    to.fontSlant = from.fontSlant;
    to.fontSizeAdjust = from.fontSizeAdjust;
    to.fontFeatures = from.fontFeatures;
    to.fontVariations = from.fontVariations;
    to.fontVariants = from.fontVariants;
    to.kerning = from.kerning;
}

void copyFontSynthesis(Style& to, const Style& from) {
    to.synthesizeWeight = from.synthesizeWeight;
    to.synthesizeSlant = from.synthesizeSlant;
    to.synthesizeSmallCaps = from.synthesizeSmallCaps;
}

void copyTextLines(Style& to, const Style& from) { to.textLines = from.textLines; }

void copyTextDecoration(Style& to, const Style& from) {
    to.textLines = from.textLines;
    to.decoration = from.decoration;
}

void copyLineStyle(Style& to, const Style& from) { to.decoration.style = from.decoration.style; }
void copyLineThickness(Style& to, const Style& from) { to.decoration.thickness = from.decoration.thickness; }

template <VariantGroup Group>
bool applyVariants(Style& style, std::string_view value, const Units&) {
    const auto variants = parseVariants(value, Group);
    if (variants)
        style.fontVariants = (style.fontVariants & ~variantsOf(Group)) | *variants;
    return variants.has_value();
}

template <VariantGroup Group>
void copyVariants(Style& to, const Style& from) {
    to.fontVariants = (to.fontVariants & ~variantsOf(Group)) | (from.fontVariants & variantsOf(Group));
}

bool applyFontVariant(Style& style, std::string_view value, const Units&) {
    const auto variants = parseVariants(value);
    style.fontVariants = variants.value_or(style.fontVariants);
    return variants.has_value();
}

void copyFontVariant(Style& to, const Style& from) { to.fontVariants = from.fontVariants; }

template <VariantGroup Group>
Property variantProperty(std::string_view name) {
    return {name, false, true, applyVariants<Group>, copyVariants<Group>};
}

template <class Part>
constexpr bool isInherited = !std::is_same_v<Part, Own>;

/// Tells the class and the type of a member from a pointer to it.
template <class>
struct MemberOf;
template <class P, class T>
struct MemberOf<T P::*> {
    using Part = P;
    using Type = T;
};

template <auto Member, auto Parse>
Property property(std::string_view name, bool attribute = true) {
    using Part = typename MemberOf<decltype(Member)>::Part;
    return {name, attribute, isInherited<Part>,
            [](Style& style, std::string_view value, const Units& units) {
                auto parsed = Parse(value, units);
                if (parsed)
                    style.*Member = std::move(*parsed);
                return parsed.has_value();
            },
            [](Style& to, const Style& from) { to.*Member = from.*Member; }};
}

constexpr std::string_view geometryNames[]{"x", "y", "width", "height", "cx", "cy", "r", "rx", "ry", "d"};

bool isGeometry(std::string_view name, std::string_view value, const Units& units) {
    if (name == "d")
        return equalsIgnoringCase(value, "none") || isPathFunction(value);
    const bool isPlace = name == "x" || name == "y" || name == "cx" || name == "cy";
    if (!isPlace && name != "r" && equalsIgnoringCase(value, "auto"))
        return true;
    return isPlace ? isAnyLength(value, units) : isNotNegative(value, units);
}

/// What is not valid gives way to the attribute, as to any other declaration.
template <std::size_t I>
bool applyGeometry(Style& style, std::string_view value, const Units& units) {
    if (!isGeometry(geometryNames[I], value, units))
        return false;
    style.geometry.push_back({geometryNames[I], value});
    return true;
}

/// An empty text stands for the initial value: the attribute is a weaker declaration.
template <std::size_t I>
void copyGeometry(Style& to, const Style& from) {
    std::string_view value;
    for (const Attribute& attribute : from.geometry)
        if (attribute.name == geometryNames[I])
            value = attribute.value;
    to.geometry.push_back({geometryNames[I], value});
}

/// Geometry that CSS may give instead of an attribute (SVG 2 section 8.14).
template <std::size_t... I>
void addGeometry(std::vector<Property>& table, std::index_sequence<I...>) {
    (table.push_back({geometryNames[I], false, false, applyGeometry<I>, copyGeometry<I>}), ...);
}

std::vector<Property> makeTable() {
    std::vector<Property> table{
        property<&Inherited::color, parsePlainColor>("color"),
        property<&Inherited::fill, parsePaint>("fill"),
        property<&Inherited::stroke, parsePaint>("stroke"),
        property<&Inherited::fillOpacity, parseOpacity>("fill-opacity"),
        property<&Inherited::strokeOpacity, parseOpacity>("stroke-opacity"),
        property<&Inherited::fillRule, parseFillRule>("fill-rule"),
        property<&Inherited::clipRule, parseFillRule>("clip-rule"),
        property<&Inherited::strokeWidth, parseWidth>("stroke-width"),
        property<&Inherited::cap, parseCap>("stroke-linecap"),
        property<&Inherited::join, parseJoin>("stroke-linejoin"),
        property<&Inherited::miterLimit, parseMiterLimit>("stroke-miterlimit"),
        property<&Inherited::dashes, parseDashes>("stroke-dasharray"),
        property<&Inherited::dashOffset, parseAnyLength>("stroke-dashoffset"),
        property<&Inherited::visible, parseVisibility>("visibility"),
        property<&Inherited::markerStart, parseReference>("marker-start"),
        property<&Inherited::markerMid, parseReference>("marker-mid"),
        property<&Inherited::markerEnd, parseReference>("marker-end"),
        {"marker", false, true, applyMarkers, copyMarkers},
        property<&Inherited::paintOrder, parsePaintOrder>("paint-order"),
        property<&Inherited::linearColors, parseColorInterpolation>("color-interpolation"),
        property<&Inherited::linearFilters, parseFilterColors>("color-interpolation-filters"),
        property<&Inherited::imageFilter, parseImageRendering>("image-rendering"),
        property<&TextStyle::fontSize, parseFontSize>("font-size"),
        {"font", false, true, applyFont, copyFont},
        property<&TextStyle::fontFamily, parseFontFamily>("font-family"),
        property<&TextStyle::fontWeight, parseFontWeight>("font-weight"),
        property<&TextStyle::fontStretch, parseFontStretch>("font-stretch"),
        property<&TextStyle::fontSlant, parseFontStyle>("font-style"),
        property<&TextStyle::fontSizeAdjust, parseFontSizeAdjust>("font-size-adjust"),
        property<&TextStyle::fontFeatures, parseFontFeatures>("font-feature-settings", false),
        property<&TextStyle::fontVariations, parseFontVariations>("font-variation-settings", false),
        property<&TextStyle::kerning, parseFontKerning>("font-kerning", false),
        {"font-variant", true, true, applyFontVariant, copyFontVariant},
        variantProperty<VariantGroup::Ligatures>("font-variant-ligatures"),
        variantProperty<VariantGroup::Caps>("font-variant-caps"),
        variantProperty<VariantGroup::Position>("font-variant-position"),
        variantProperty<VariantGroup::Numeric>("font-variant-numeric"),
        variantProperty<VariantGroup::EastAsian>("font-variant-east-asian"),
        {"font-synthesis", false, true, applyFontSynthesis, copyFontSynthesis},
        property<&TextStyle::synthesizeWeight, parseSynthesis>("font-synthesis-weight", false),
        property<&TextStyle::synthesizeSlant, parseSynthesis>("font-synthesis-style", false),
        property<&TextStyle::synthesizeSmallCaps, parseSynthesis>("font-synthesis-small-caps", false),
        property<&TextStyle::letterSpacing, parseSpacing>("letter-spacing"),
        property<&TextStyle::wordSpacing, parseSpacing>("word-spacing"),
        property<&TextStyle::anchor, parseTextAnchor>("text-anchor"),
        property<&TextStyle::align, parseTextAlign>("text-align", false),
        property<&TextStyle::lineHeight, parseLineHeight>("line-height", false),
        property<&Own::inlineSize, parseInlineSize>("inline-size", false),
        property<&TextStyle::dominantBaseline, parseDominantBaseline>("dominant-baseline"),
        property<&TextStyle::writingMode, parseWritingMode>("writing-mode"),
        property<&TextStyle::textOrientation, parseTextOrientation>("text-orientation", false),
        property<&TextStyle::textOrientation, parseGlyphOrientation>("glyph-orientation-vertical"),
        property<&TextStyle::rightToLeft, parseDirection>("direction"),
        property<&TextStyle::whiteSpace, parseWhiteSpace>("white-space"),
        property<&Own::alignmentBaseline, parseAlignmentBaseline>("alignment-baseline"),
        property<&Own::baselineShift, parseBaselineShift>("baseline-shift"),
        property<&Own::unicodeBidi, parseUnicodeBidi>("unicode-bidi"),
        {"text-decoration", true, false, applyTextDecoration, copyTextDecoration},
        {"text-decoration-line", false, false, applyTextLines, copyTextLines},
        {"text-decoration-style", false, false, applyLineStyle, copyLineStyle},
        {"text-decoration-thickness", false, false, applyLineThickness, copyLineThickness},
        property<&TextStyle::underlineOffset, parseUnderlineOffset>("text-underline-offset", false),
        property<&Own::displayed, parseDisplay>("display"),
        property<&Own::opacity, parseOpacity>("opacity"),
        property<&Own::blend, parseBlend>("mix-blend-mode", false),
        property<&Own::isolated, parseIsolation>("isolation", false),
        {"overflow", true, false, applyOverflow, copyOverflow},
        property<&Own::clipPath, parseClipPath>("clip-path"),
        {"mask", true, false, applyMask, copyMask},
        property<&Own::mask, parseReference>("mask-image", false),
        property<&Own::maskMode, parseMaskMode>("mask-mode", false),
        property<&Own::filter, parseFilter>("filter"),
        property<&Own::maskKind, parseMaskType>("mask-type"),
        property<&Own::stopColor, parseColorValue>("stop-color"),
        property<&Own::stopOpacity, parseOpacity>("stop-opacity"),
        property<&Own::floodColor, parseColorValue>("flood-color"),
        property<&Own::floodOpacity, parseOpacity>("flood-opacity"),
        property<&Own::lightingColor, parseColorValue>("lighting-color"),
        property<&Own::background, parseBackground>("background", false),
        property<&Own::background, parseBackgroundColor>("background-color", false),
        property<&Own::nonScalingStroke, parseVectorEffect>("vector-effect"),
        property<&Own::transform, parseTransformText>("transform"),
        property<&Own::transformOrigin, parseOrigin>("transform-origin"),
        property<&Own::transformBox, parseTransformBox>("transform-box", false),
        property<&Own::translate, parseTranslateText>("translate", false),
        property<&Own::rotate, parseRotateText>("rotate", false),
        property<&Own::scale, parseScaleText>("scale", false),
    };
    addGeometry(table, std::make_index_sequence<std::size(geometryNames)>{});
    return table;
}

using Index = std::unordered_map<std::string_view, const Property*>;

const Index& propertyIndex() {
    static const std::vector<Property> table = makeTable();
    static const Index index = [] {
        Index made;
        for (const Property& property : table)
            made.emplace(property.name, &property);
        return made;
    }();
    return index;
}

}  // namespace

const Property* findProperty(std::string_view name) {
    const auto found = propertyIndex().find(name);
    return found == propertyIndex().end() ? nullptr : found->second;
}

const Property* findDeclared(std::string_view name) {
    const auto isCapital = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (std::ranges::none_of(name, isCapital))
        return findProperty(name);
    std::string lower(name);
    for (char& c : lower)
        c = isCapital(c) ? static_cast<char>(c | 0x20) : c;
    return findProperty(lower);
}

// ---- The cascade's keywords ---------------------------------------------------------------------

namespace {

const Style& initialStyle() {
    static const Style style;
    return style;
}

/// CSS-wide keywords (CSS Cascade 5 section 7.3); no other style sheet stands behind the author's, to which
/// `revert` could go back. `revert-layer` goes back as far.
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
    if (equalsIgnoringCase(value, "unset") || equalsIgnoringCase(value, "revert") ||
        equalsIgnoringCase(value, "revert-layer")) {
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
