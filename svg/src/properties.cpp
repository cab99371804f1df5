// The table of properties: how each value is read and where it is kept.

#include <algorithm>
#include <type_traits>
#include <unordered_map>

#include "svg/src/color.hpp"
#include "svg/src/style.hpp"

namespace vtm::svg {
namespace {

template <class T>
using Parser = std::optional<T> (*)(std::string_view, const Units&);

/// One row of a keyword table.
template <class T>
struct Keyword {
    std::string_view name;
    T value;
};

template <class T, std::size_t N>
std::optional<T> findKeyword(std::string_view text, const Keyword<T> (&table)[N]) {
    const auto found = std::find_if(std::begin(table), std::end(table), [&](const Keyword<T>& row) {
        return equalsIgnoringCase(row.name, text);
    });
    return found == std::end(table) ? std::nullopt : std::optional(found->value);
}

std::optional<PaintKind> paintKeyword(std::string_view word) {
    static constexpr Keyword<PaintKind> table[]{{"none", PaintKind::None},
                                                {"currentColor", PaintKind::CurrentColor},
                                                {"context-fill", PaintKind::ContextFill},
                                                {"context-stroke", PaintKind::ContextStroke}};
    return findKeyword(word, table);
}

/// What may stand alone or behind a url(): none, a colour, currentColor.
std::optional<PaintValue> parsePlainPaint(std::string_view text) {
    if (const auto kind = paintKeyword(text))
        return PaintValue{*kind, {}, {}, {}};
    if (const auto color = parseColor(text))
        return PaintValue{PaintKind::Color, *color, {}, {}};
    return std::nullopt;
}

std::optional<PaintValue> parsePaint(std::string_view text, const Units&) {
    Cursor cursor(text);
    const auto url = readUrl(cursor);
    if (!url)
        return parsePlainPaint(text);
    PaintValue paint{PaintKind::Server, {}, *url, {}};
    if (const auto fallback = parsePlainPaint(trim(cursor.rest()))) {
        paint.fallback = fallback->kind;
        paint.color = fallback->color;
    }
    return paint;
}

std::optional<ColorValue> parseColorValue(std::string_view text, const Units&) {
    if (equalsIgnoringCase(text, "currentColor"))
        return ColorValue{true, {}};
    const auto color = parseColor(text);
    return color ? std::optional(ColorValue{false, *color}) : std::nullopt;
}

std::optional<scene::Color> parsePlainColor(std::string_view text, const Units&) { return parseColor(text); }

std::optional<std::optional<scene::Color>> parseBackground(std::string_view text, const Units&) {
    const auto color = parseColor(text);
    return color ? std::optional(color) : std::nullopt;
}

std::optional<double> parseOpacity(std::string_view text, const Units&) {
    const auto value = parseFraction(text);
    return value ? std::optional(std::clamp(*value, 0.0, 1.0)) : std::nullopt;
}

std::optional<scene::FillRule> parseFillRule(std::string_view text, const Units&) {
    static constexpr Keyword<scene::FillRule> table[]{{"nonzero", scene::FillRule::NonZero},
                                                      {"evenodd", scene::FillRule::EvenOdd}};
    return findKeyword(text, table);
}

std::optional<Length> parseAnyLength(std::string_view text, const Units& units) {
    return parseLength(text, units);
}

std::optional<Length> parseWidth(std::string_view text, const Units& units) {
    const auto length = parseLength(text, units);
    return length && length->value >= 0 ? length : std::nullopt;
}

std::optional<scene::Cap> parseCap(std::string_view text, const Units&) {
    static constexpr Keyword<scene::Cap> table[]{
        {"butt", scene::Cap::Butt}, {"round", scene::Cap::Round}, {"square", scene::Cap::Square}};
    return findKeyword(text, table);
}

/// `arcs` falls back to a mitre, as SVG 2 section 13.5.5 allows where it is not supported.
std::optional<scene::Join> parseJoin(std::string_view text, const Units&) {
    static constexpr Keyword<scene::Join> table[]{{"miter", scene::Join::Miter},
                                                  {"miter-clip", scene::Join::MiterClip},
                                                  {"arcs", scene::Join::Miter},
                                                  {"round", scene::Join::Round},
                                                  {"bevel", scene::Join::Bevel}};
    return findKeyword(text, table);
}

std::optional<double> parseMiterLimit(std::string_view text, const Units&) {
    Cursor cursor(text);
    const auto value = cursor.number();
    return value && *value >= 1 && cursor.atEnd() ? value : std::nullopt;
}

using Dashes = std::shared_ptr<const std::vector<Length>>;

std::optional<Dashes> parseDashes(std::string_view text, const Units& units) {
    if (equalsIgnoringCase(text, "none"))
        return Dashes{};
    auto dashes = std::make_shared<std::vector<Length>>();
    for (Cursor cursor(text); !cursor.atEnd(); cursor.skipCommaSpaces()) {
        const auto dash = readLength(cursor, units);
        if (!dash)
            return std::nullopt;
        dashes->push_back(*dash);
    }
    return Dashes(std::move(dashes));
}

std::optional<bool> parseVisibility(std::string_view text, const Units&) {
    static constexpr Keyword<bool> table[]{{"visible", true}, {"hidden", false}, {"collapse", false}};
    return findKeyword(text, table);
}

std::optional<bool> parseDisplay(std::string_view text, const Units&) {
    return !equalsIgnoringCase(text, "none");
}

std::optional<std::optional<bool>> findOverflow(std::string_view text) {
    static constexpr Keyword<std::optional<bool>> table[]{
        {"visible", true}, {"auto", true}, {"hidden", false}, {"scroll", false}, {"clip", false}};
    return findKeyword(text, table);
}

/// url() or none; anything else that CSS allows there (shapes, image masks) is not supported.
std::optional<std::string_view> parseReference(std::string_view text, const Units&) {
    if (equalsIgnoringCase(text, "none"))
        return std::string_view{};
    Cursor cursor(text);
    return readUrl(cursor);
}

std::optional<std::string_view> parseFilter(std::string_view text, const Units&) {
    return equalsIgnoringCase(text, "none") ? std::string_view{} : text;
}

/// `paint-order`: the stages that are not named follow in their normal order.
std::optional<std::array<PaintStage, 3>> parsePaintOrder(std::string_view text, const Units&) {
    static constexpr Keyword<PaintStage> table[]{
        {"fill", PaintStage::Fill}, {"stroke", PaintStage::Stroke}, {"markers", PaintStage::Markers}};
    const Style initial;
    if (equalsIgnoringCase(text, "normal"))
        return initial.paintOrder;
    std::vector<PaintStage> order;
    const auto isNew = [&](PaintStage stage) {
        return std::find(order.begin(), order.end(), stage) == order.end();
    };
    for (Cursor cursor(text); !cursor.atEnd(); cursor.skipSpaces()) {
        const auto stage = findKeyword(cursor.identifier(), table);
        if (!stage || !isNew(*stage))
            return std::nullopt;
        order.push_back(*stage);
    }
    for (const PaintStage stage : initial.paintOrder)
        if (isNew(stage))
            order.push_back(stage);
    return std::array{order[0], order[1], order[2]};
}

std::optional<scene::BlendMode> parseBlend(std::string_view text, const Units&) {
    using scene::BlendMode;
    static constexpr Keyword<BlendMode> table[]{{"normal", BlendMode::Normal},
                                                {"multiply", BlendMode::Multiply},
                                                {"screen", BlendMode::Screen},
                                                {"overlay", BlendMode::Overlay},
                                                {"darken", BlendMode::Darken},
                                                {"lighten", BlendMode::Lighten},
                                                {"color-dodge", BlendMode::ColorDodge},
                                                {"color-burn", BlendMode::ColorBurn},
                                                {"hard-light", BlendMode::HardLight},
                                                {"soft-light", BlendMode::SoftLight},
                                                {"difference", BlendMode::Difference},
                                                {"exclusion", BlendMode::Exclusion},
                                                {"hue", BlendMode::Hue},
                                                {"saturation", BlendMode::Saturation},
                                                {"color", BlendMode::Color},
                                                {"luminosity", BlendMode::Luminosity},
                                                {"plus-lighter", BlendMode::PlusLighter}};
    return findKeyword(text, table);
}

std::optional<bool> parseIsolation(std::string_view text, const Units&) {
    static constexpr Keyword<bool> table[]{{"auto", false}, {"isolate", true}};
    return findKeyword(text, table);
}

std::optional<scene::MaskKind> parseMaskType(std::string_view text, const Units&) {
    static constexpr Keyword<scene::MaskKind> table[]{{"luminance", scene::MaskKind::Luminance},
                                                      {"alpha", scene::MaskKind::Alpha}};
    return findKeyword(text, table);
}

std::optional<bool> parseColorInterpolation(std::string_view text, const Units&) {
    static constexpr Keyword<bool> table[]{{"auto", false}, {"sRGB", false}, {"linearRGB", true}};
    return findKeyword(text, table);
}

std::optional<scene::ImageFilter> parseImageRendering(std::string_view text, const Units&) {
    using scene::ImageFilter;
    static constexpr Keyword<ImageFilter> table[]{
        {"auto", ImageFilter::Trilinear},        {"optimizeQuality", ImageFilter::Trilinear},
        {"smooth", ImageFilter::Trilinear},      {"high-quality", ImageFilter::Bicubic},
        {"optimizeSpeed", ImageFilter::Nearest}, {"pixelated", ImageFilter::Nearest},
        {"crisp-edges", ImageFilter::Nearest}};
    return findKeyword(text, table);
}

std::optional<bool> parseVectorEffect(std::string_view text, const Units&) {
    static constexpr Keyword<bool> table[]{{"none", false}, {"non-scaling-stroke", true}};
    return findKeyword(text, table);
}

/// Here units.fontSize is the parent's.
std::optional<double> parseFontSize(std::string_view text, const Units& units) {
    // CSS Fonts 4 section 2.5: steps of 1.2 around medium, which is the root's size.
    static constexpr Keyword<double> absolute[]{{"xx-small", 0.6}, {"x-small", 0.75}, {"small", 0.89},
                                                {"medium", 1},     {"large", 1.2},    {"x-large", 1.5},
                                                {"xx-large", 2}};
    static constexpr Keyword<double> relative[]{{"smaller", 1 / 1.2}, {"larger", 1.2}};
    if (const auto factor = findKeyword(text, absolute))
        return *factor * units.rootFontSize;
    if (const auto factor = findKeyword(text, relative))
        return *factor * units.fontSize;
    const auto length = parseWidth(text, units);
    if (!length)
        return std::nullopt;
    return length->percent ? length->value / 100 * units.fontSize : length->value;
}

std::optional<std::string_view> parseTransformText(std::string_view text, const Units& units) {
    return parseTransform(text, units, {1, 1}) ? std::optional(text) : std::nullopt;
}

std::optional<std::optional<TransformOrigin>> parseOrigin(std::string_view text, const Units& units) {
    const auto origin = parseTransformOrigin(text, units);
    return origin ? std::optional(origin) : std::nullopt;
}

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

bool applyOverflow(Style& style, std::string_view value, const Units&) {
    const auto overflow = findOverflow(value);
    if (overflow)
        style.overflow = *overflow;
    return overflow.has_value();
}

/// Inherited from an element that declares nothing it is the initial value, visible; that some
/// elements are clipped where nothing is declared is the user agent's style sheet.
void copyOverflow(Style& to, const Style& from) { to.overflow = from.overflow.value_or(true); }

template <class Part>
constexpr bool isInherited = std::is_same_v<Part, Inherited>;

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

template <std::size_t I>
bool applyGeometry(Style& style, std::string_view value, const Units&) {
    style.geometry.push_back({geometryNames[I], value});
    return true;
}

template <std::size_t I>
void copyGeometry(Style& to, const Style& from) {
    for (const Attribute& attribute : from.geometry)
        if (attribute.name == geometryNames[I])
            to.geometry.push_back(attribute);
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
        property<&Inherited::imageFilter, parseImageRendering>("image-rendering"),
        property<&Inherited::fontSize, parseFontSize>("font-size"),
        property<&Own::displayed, parseDisplay>("display"),
        property<&Own::opacity, parseOpacity>("opacity"),
        property<&Own::blend, parseBlend>("mix-blend-mode", false),
        property<&Own::isolated, parseIsolation>("isolation", false),
        {"overflow", true, false, applyOverflow, copyOverflow},
        property<&Own::clipPath, parseReference>("clip-path"),
        property<&Own::mask, parseReference>("mask"),
        property<&Own::filter, parseFilter>("filter"),
        property<&Own::maskKind, parseMaskType>("mask-type"),
        property<&Own::stopColor, parseColorValue>("stop-color"),
        property<&Own::stopOpacity, parseOpacity>("stop-opacity"),
        property<&Own::background, parseBackground>("background-color", false),
        property<&Own::nonScalingStroke, parseVectorEffect>("vector-effect"),
        property<&Own::transform, parseTransformText>("transform"),
        property<&Own::transformOrigin, parseOrigin>("transform-origin"),
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

std::optional<std::string_view> readUrl(Cursor& cursor) {
    Cursor start = cursor;
    cursor.skipSpaces();
    if (!cursor.consume("url(")) {
        cursor = start;
        return std::nullopt;
    }
    std::string_view href = trim(cursor.until(')'));
    if (href.size() >= 2 && (href.front() == '"' || href.front() == '\'') && href.back() == href.front())
        href = trim(href.substr(1, href.size() - 2));
    return href;
}

}  // namespace vtm::svg
