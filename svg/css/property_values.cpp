#include "svg/css/property_values.hpp"

#include <algorithm>

#include "svg/css/clip_shape.hpp"
#include "svg/css/color.hpp"
#include "svg/css/filter_values.hpp"

namespace vtm::svg {
namespace {

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

}  // namespace

std::optional<PaintValue> parsePaint(std::string_view text, const Units&) {
    Cursor cursor(text);
    const auto url = readUrl(cursor);
    if (!url)
        return parsePlainPaint(text);
    PaintValue paint{PaintKind::Server, {}, *url, {}};
    cursor.skipSpaces();
    if (cursor.atEnd() || cursor.rest().starts_with("icc-color("))
        return paint;
    const auto fallback = parsePlainPaint(trim(cursor.rest()));
    if (!fallback)
        return std::nullopt;
    paint.fallback = fallback->kind;
    paint.color = fallback->color;
    return paint;
}

std::optional<ColorValue> parseColorValue(std::string_view text, const Units&) {
    if (equalsIgnoringCase(text, "currentColor"))
        return ColorValue{true, {}};
    const auto color = parseColor(text);
    return color ? std::optional(ColorValue{false, *color}) : std::nullopt;
}

std::optional<scene::Color> parsePlainColor(std::string_view text, const Units&) { return parseColor(text); }

std::optional<std::optional<scene::Color>> parseBackgroundColor(std::string_view text, const Units&) {
    return valid(parseColor(text));
}

std::optional<std::optional<scene::Color>> parseBackground(std::string_view text, const Units&) {
    while (extentOf(text, ",") < text.size())
        text.remove_prefix(extentOf(text, ",") + 1);
    std::optional<scene::Color> color;
    bool known = false;
    while (!(text = trim(text)).empty()) {
        const std::string_view part = text.substr(0, extentOf(text, " \t\n\r\f"));
        text.remove_prefix(part.size());
        const auto parsed = parseColor(part);
        color = parsed ? parsed : color;
        // Of an image only the name of its function is looked at: none is drawn.
        known = known || parsed || equalsIgnoringCase(part, "none") || part.find('(') != part.npos;
    }
    if (!known)
        return std::nullopt;
    return std::optional<std::optional<scene::Color>>(std::in_place, color);
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
    const auto value = text.ends_with('%') ? std::nullopt : parseFraction(text);
    return value && *value >= 1 ? value : std::nullopt;
}

std::optional<Dashes> parseDashes(std::string_view text, const Units& units) {
    if (equalsIgnoringCase(text, "none"))
        return Dashes{};
    auto dashes = std::make_shared<std::vector<Length>>();
    for (Cursor cursor(text); !cursor.atEnd(); cursor.skipCommaSpaces()) {
        const auto dash = readLength(cursor, units);
        if (!dash || dash->value < 0)
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

std::optional<TransformBox> parseTransformBox(std::string_view text, const Units&) {
    static constexpr Keyword<TransformBox> table[]{{"view-box", TransformBox::View},
                                                   {"fill-box", TransformBox::Fill},
                                                   {"content-box", TransformBox::Fill},
                                                   {"stroke-box", TransformBox::Stroke},
                                                   {"border-box", TransformBox::Stroke}};
    return findKeyword(text, table);
}

std::optional<std::optional<bool>> parseOverflow(std::string_view text, const Units&) {
    static constexpr Keyword<std::optional<bool>> table[]{
        {"visible", true}, {"auto", true}, {"hidden", false}, {"scroll", false}, {"clip", false}};
    return findKeyword(text, table);
}

std::optional<std::string_view> parseReference(std::string_view text, const Units&) {
    if (equalsIgnoringCase(text, "none"))
        return std::string_view{};
    Cursor cursor(text);
    return readUrl(cursor);
}

std::optional<std::string_view> parseFilter(std::string_view text, const Units& units) {
    const auto list = parseFilterList(text, units);
    if (!list)
        return std::nullopt;
    return list->empty() ? std::string_view{} : text;
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

std::optional<std::string_view> parseClipPath(std::string_view text, const Units& units) {
    const auto href = parseReference(text, units);
    if (href && href->empty())
        return std::string_view{};
    return href || parseClipShape(text, units) ? std::optional(text) : std::nullopt;
}

std::optional<std::optional<scene::MaskKind>> parseMaskMode(std::string_view text, const Units& units) {
    using Mode = std::optional<scene::MaskKind>;
    if (equalsIgnoringCase(text, "match-source"))
        return Mode();
    const auto kind = parseMaskType(text, units);
    return kind ? std::optional(Mode(*kind)) : std::nullopt;
}

std::optional<scene::MaskKind> parseMaskType(std::string_view text, const Units&) {
    static constexpr Keyword<scene::MaskKind> table[]{{"luminance", scene::MaskKind::Luminance},
                                                      {"alpha", scene::MaskKind::Alpha}};
    return findKeyword(text, table);
}

std::optional<bool> parseFilterColors(std::string_view text, const Units&) {
    static constexpr Keyword<bool> table[]{{"auto", true}, {"sRGB", false}, {"linearRGB", true}};
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

std::optional<double> parseFontSize(std::string_view text, const Units& units) {
    // CSS Fonts 4 section 2.5: shares of medium, the initial value.
    static constexpr Keyword<double> absolute[]{{"xx-small", 0.6}, {"x-small", 0.75}, {"small", 0.89},
                                                {"medium", 1},     {"large", 1.2},    {"x-large", 1.5},
                                                {"xx-large", 2}};
    static constexpr Keyword<double> relative[]{{"smaller", 1 / 1.2}, {"larger", 1.2}};
    if (const auto factor = findKeyword(text, absolute))
        return *factor * units.mediumFontSize;
    if (const auto factor = findKeyword(text, relative))
        return *factor * units.fontSize;
    const auto length = parseWidth(text, units);
    if (!length)
        return std::nullopt;
    return length->of(units.fontSize);
}

std::optional<std::string_view> parseTransformText(std::string_view text, const Units& units) {
    return parseTransform(text, units, {1, 1}) ? std::optional(text) : std::nullopt;
}

namespace {

std::optional<std::string_view> textOf(std::string_view text, bool isValid) {
    if (!isValid)
        return std::nullopt;
    return equalsIgnoringCase(trim(text), "none") ? std::string_view{} : text;
}

}  // namespace

std::optional<std::string_view> parseTranslateText(std::string_view text, const Units& units) {
    return textOf(text, parseTranslate(text, units, {1, 1}).has_value());
}
std::optional<std::string_view> parseRotateText(std::string_view text, const Units&) {
    return textOf(text, parseRotate(text).has_value());
}
std::optional<std::string_view> parseScaleText(std::string_view text, const Units&) {
    return textOf(text, parseScale(text).has_value());
}

std::optional<std::optional<TransformOrigin>> parseOrigin(std::string_view text, const Units& units) {
    return valid(parseTransformOrigin(text, units));
}

std::optional<std::string_view> readUrl(Cursor& cursor) {
    const Cursor start = cursor;
    cursor.skipSpaces();
    if (cursor.consume("url(")) {
        cursor.skipSpaces();
        for (const char quote : {'"', '\''})
            if (cursor.consume(quote)) {
                const std::string_view href = trim(cursor.until(quote));
                cursor.until(')');
                return href;
            }
        const std::string_view href = trim(cursor.until(')'));
        // CSS Syntax 3, section 4.3.6: without quotes it is no URL with a space, quote or bracket in it.
        if (href.find_first_of(" \t\n\r\f\"'(") == href.npos)
            return href;
    }
    cursor = start;
    return std::nullopt;
}

}  // namespace vtm::svg
