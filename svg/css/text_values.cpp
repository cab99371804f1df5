#include "svg/css/text_values.hpp"

#include <cmath>

#include "svg/css/color.hpp"
#include "svg/css/property_values.hpp"

namespace vtm::svg {
namespace {

std::optional<Baseline> baselineOf(std::string_view word) {
    static constexpr Keyword<Baseline> table[]{{"alphabetic", Baseline::Alphabetic},
                                               {"ideographic", Baseline::Ideographic},
                                               {"middle", Baseline::Middle},
                                               {"central", Baseline::Central},
                                               {"center", Baseline::Central},
                                               {"mathematical", Baseline::Mathematical},
                                               {"hanging", Baseline::Hanging},
                                               {"text-bottom", Baseline::TextBottom},
                                               {"text-after-edge", Baseline::TextBottom},
                                               {"after-edge", Baseline::TextBottom},
                                               {"bottom", Baseline::TextBottom},
                                               {"text-top", Baseline::TextTop},
                                               {"text-before-edge", Baseline::TextTop},
                                               {"before-edge", Baseline::TextTop},
                                               {"top", Baseline::TextTop}};
    return findKeyword(word, table);
}

}  // namespace

std::optional<Length> parseSpacing(std::string_view text, const Units& units) {
    return equalsIgnoringCase(text, "normal") ? Length{} : parseLength(text, units);
}

std::optional<TextAnchor> parseTextAnchor(std::string_view text, const Units&) {
    static constexpr Keyword<TextAnchor> table[]{
        {"start", TextAnchor::Start}, {"middle", TextAnchor::Middle}, {"end", TextAnchor::End}};
    return findKeyword(text, table);
}

/// SVG 1.1's `use-script`, `no-change` and `reset-size` change nothing.
std::optional<Baseline> parseDominantBaseline(std::string_view text, const Units&) {
    static constexpr Keyword<Baseline> table[]{{"auto", Baseline::Auto},
                                               {"use-script", Baseline::Auto},
                                               {"no-change", Baseline::Auto},
                                               {"reset-size", Baseline::Auto}};
    const auto unchanged = findKeyword(text, table);
    return unchanged ? unchanged : baselineOf(text);
}

std::optional<Baseline> parseAlignmentBaseline(std::string_view text, const Units&) {
    static constexpr Keyword<Baseline> table[]{{"auto", Baseline::Auto}, {"baseline", Baseline::Auto}};
    const auto unchanged = findKeyword(text, table);
    return unchanged ? unchanged : baselineOf(text);
}

std::optional<BaselineShift> parseBaselineShift(std::string_view text, const Units& units) {
    using Kind = BaselineShift::Kind;
    static constexpr Keyword<Kind> table[]{
        {"baseline", Kind::Length}, {"sub", Kind::Sub}, {"super", Kind::Super}};
    if (const auto kind = findKeyword(text, table))
        return BaselineShift{*kind, {}};
    const auto length = parseLength(text, units);
    return length ? std::optional(BaselineShift{Kind::Length, *length}) : std::nullopt;
}

std::optional<WritingMode> parseWritingMode(std::string_view text, const Units&) {
    static constexpr Keyword<WritingMode> table[]{{"horizontal-tb", WritingMode::Horizontal},
                                                  {"lr", WritingMode::Horizontal},
                                                  {"lr-tb", WritingMode::Horizontal},
                                                  {"rl", WritingMode::Horizontal},
                                                  {"rl-tb", WritingMode::Horizontal},
                                                  {"vertical-rl", WritingMode::VerticalRl},
                                                  {"tb", WritingMode::VerticalRl},
                                                  {"tb-rl", WritingMode::VerticalRl},
                                                  {"vertical-lr", WritingMode::VerticalLr}};
    return findKeyword(text, table);
}

std::optional<text::TextOrientation> parseTextOrientation(std::string_view text, const Units&) {
    using text::TextOrientation;
    static constexpr Keyword<TextOrientation> table[]{{"mixed", TextOrientation::Mixed},
                                                      {"upright", TextOrientation::Upright},
                                                      {"sideways", TextOrientation::Sideways},
                                                      {"sideways-right", TextOrientation::Sideways}};
    return findKeyword(text, table);
}

std::optional<text::TextOrientation> parseGlyphOrientation(std::string_view text, const Units&) {
    if (equalsIgnoringCase(text, "auto"))
        return text::TextOrientation::Mixed;
    Cursor cursor(text);
    const auto degrees = readAngle(cursor);
    if (!degrees || !cursor.atEnd() || (*degrees != 0 && *degrees != 90))
        return std::nullopt;
    return *degrees == 0 ? text::TextOrientation::Upright : text::TextOrientation::Sideways;
}

std::optional<double> parseLineHeight(std::string_view text, const Units& units) {
    if (equalsIgnoringCase(text, "normal"))
        return TextStyle{}.lineHeight;
    Cursor cursor(text);
    if (const auto factor = cursor.number(); factor && cursor.atEnd())
        return *factor >= 0 ? factor : std::nullopt;
    const auto length = parseWidth(text, units);
    if (!length || !(units.fontSize > 0))
        return std::nullopt;
    return length->of(units.fontSize) / units.fontSize;
}

/// Justified lines begin at the start.
std::optional<TextAnchor> parseTextAlign(std::string_view text, const Units&) {
    static constexpr Keyword<TextAnchor> table[]{
        {"start", TextAnchor::Start},   {"left", TextAnchor::Start}, {"justify", TextAnchor::Start},
        {"center", TextAnchor::Middle}, {"end", TextAnchor::End},    {"right", TextAnchor::End}};
    return findKeyword(text, table);
}

std::optional<std::optional<Length>> parseInlineSize(std::string_view text, const Units& units) {
    if (equalsIgnoringCase(text, "auto"))
        return std::optional<Length>();
    return valid(parseWidth(text, units));
}

std::optional<bool> parseDirection(std::string_view text, const Units&) {
    static constexpr Keyword<bool> table[]{{"ltr", false}, {"rtl", true}};
    return findKeyword(text, table);
}

std::optional<UnicodeBidi> parseUnicodeBidi(std::string_view text, const Units&) {
    static constexpr Keyword<UnicodeBidi> table[]{{"normal", UnicodeBidi::Normal},
                                                  {"embed", UnicodeBidi::Embed},
                                                  {"isolate", UnicodeBidi::Isolate},
                                                  {"bidi-override", UnicodeBidi::Override},
                                                  {"isolate-override", UnicodeBidi::IsolateOverride},
                                                  {"plaintext", UnicodeBidi::Plaintext}};
    return findKeyword(text, table);
}

std::optional<std::optional<WhiteSpace>> parseWhiteSpace(std::string_view text, const Units&) {
    using Value = std::optional<WhiteSpace>;
    static constexpr Keyword<Value> table[]{
        {"normal", WhiteSpace::Collapse},   {"nowrap", WhiteSpace::Collapse},
        {"pre-line", WhiteSpace::Collapse}, {"pre", WhiteSpace::Preserve},
        {"pre-wrap", WhiteSpace::Preserve}, {"break-spaces", WhiteSpace::Preserve}};
    return findKeyword(text, table);
}

// ---- Lines of text-decoration -----------------------------------------------------------------------

namespace {

std::optional<unsigned> lineOf(std::string_view word) {
    static constexpr Keyword<unsigned> table[]{{"none", 0},
                                               {"blink", 0},
                                               {"underline", Underline},
                                               {"overline", Overline},
                                               {"line-through", LineThrough}};
    return findKeyword(word, table);
}

/// Wavy lines are plain ones.
std::optional<LineStyle> lineStyleOf(std::string_view word) {
    static constexpr Keyword<LineStyle> table[]{{"solid", LineStyle::Solid},
                                                {"double", LineStyle::Double},
                                                {"dotted", LineStyle::Dotted},
                                                {"dashed", LineStyle::Dashed},
                                                {"wavy", LineStyle::Solid}};
    return findKeyword(word, table);
}

/// `auto` and `from-font` are the font's.
std::optional<std::optional<Length>> lineThicknessOf(std::string_view word, const Units& units) {
    if (equalsIgnoringCase(word, "auto") || equalsIgnoringCase(word, "from-font"))
        return std::optional<Length>();
    return valid(parseLength(word, units));
}

}  // namespace

/// Lines have the paints of their element (SVG 2 section 11.10.3): the colour is read only.
bool applyTextDecoration(Style& style, std::string_view value, const Units& units) {
    unsigned lines = 0;
    TextDecoration decoration;
    for (Cursor cursor(value); !cursor.atEnd(); cursor.skipSpaces()) {
        const std::string_view word = cursor.word();
        if (word.empty())
            return false;
        const auto line = lineOf(word);
        if (const auto lineStyle = lineStyleOf(word))
            decoration.style = *lineStyle;
        else if (const auto thickness = lineThicknessOf(word, units))
            decoration.thickness = *thickness;
        else if (!line && !equalsIgnoringCase(word, "currentColor") && !parseColor(word))
            return false;
        lines |= line.value_or(0);
    }
    style.textLines = lines;
    style.decoration = decoration;
    return true;
}

bool applyTextLines(Style& style, std::string_view value, const Units&) {
    unsigned lines = 0;
    for (Cursor cursor(value); !cursor.atEnd(); cursor.skipSpaces()) {
        const auto line = lineOf(cursor.word());
        if (!line)
            return false;
        lines |= *line;
    }
    style.textLines = lines;
    return true;
}

bool applyLineStyle(Style& style, std::string_view value, const Units&) {
    const auto lineStyle = lineStyleOf(value);
    style.decoration.style = lineStyle.value_or(style.decoration.style);
    return lineStyle.has_value();
}

bool applyLineThickness(Style& style, std::string_view value, const Units& units) {
    const auto thickness = lineThicknessOf(value, units);
    style.decoration.thickness = thickness.value_or(style.decoration.thickness);
    return thickness.has_value();
}

std::optional<std::optional<Length>> parseUnderlineOffset(std::string_view text, const Units& units) {
    if (equalsIgnoringCase(text, "auto"))
        return std::optional<Length>();
    return valid(parseLength(text, units));
}

}  // namespace vtm::svg
