#include "svg/css/text_values.hpp"

#include <cmath>

#include "svg/css/color.hpp"
#include "svg/css/font_variants.hpp"
#include "svg/css/keyword.hpp"
#include "svg/css/property_values.hpp"

namespace vtm::svg {
namespace {

/// A string in quotes; nothing, and the cursor stays, where none begins or it does not end.
std::optional<std::string_view> readString(Cursor& cursor) {
    const char quote = cursor.peek();
    if (quote != '"' && quote != '\'')
        return std::nullopt;
    Cursor ahead = cursor;
    ahead.advance();
    if (ahead.rest().find(quote) == std::string_view::npos)
        return std::nullopt;
    const std::string_view text = ahead.until(quote);
    cursor = ahead;
    return text;
}

bool isGenericFamily(std::string_view name) {
    static constexpr Keyword<bool> table[]{
        {"serif", true},     {"sans-serif", true},    {"cursive", true},
        {"fantasy", true},   {"monospace", true},     {"ui-serif", true},
        {"system-ui", true}, {"ui-sans-serif", true}, {"ui-monospace", true}};
    return findKeyword(name, table).has_value();
}

/// A family's name: a string, or words joined by single spaces. Empty where there is none. A generic name in
/// quotes keeps them: it is the name of a font.
std::string readFamily(Cursor& cursor) {
    cursor.skipSpaces();
    if (const auto quoted = readString(cursor)) {
        cursor.skipSpaces();
        return isGenericFamily(*quoted) ? '"' + std::string(*quoted) + '"' : std::string(*quoted);
    }
    std::string name;
    for (std::string_view word = cursor.identifier(); !word.empty(); word = cursor.identifier()) {
        name += (name.empty() ? "" : " ") + std::string(word);
        cursor.skipSpaces();
    }
    return name;
}

/// An OpenType tag in quotes: four printable characters.
std::optional<text::Tag> readTag(Cursor& cursor) {
    cursor.skipSpaces();
    const auto letters = readString(cursor);
    cursor.skipSpaces();
    const bool valid =
        letters && letters->size() == 4 &&
        std::all_of(letters->begin(), letters->end(), [](char c) { return c >= 0x20 && c <= 0x7e; });
    return valid ? std::optional(fontTag(*letters)) : std::nullopt;
}

/// `item, item, …` where `read` returns an item or nothing; nothing for a malformed list.
template <class Item, class Read>
std::optional<std::vector<Item>> readList(std::string_view text, Read read) {
    std::vector<Item> items;
    if (equalsIgnoringCase(trim(text), "normal"))
        return items;
    Cursor cursor(trim(text));
    do {
        const std::optional<Item> item = read(cursor);
        if (!item)
            return std::nullopt;
        items.push_back(*item);
        cursor.skipSpaces();
    } while (cursor.consume(','));
    return cursor.atEnd() ? std::optional(std::move(items)) : std::nullopt;
}

std::optional<text::Feature> readFeature(Cursor& cursor) {
    const auto tag = readTag(cursor);
    if (!tag)
        return std::nullopt;
    if (cursor.consume("on"))
        return text::Feature{*tag, 1};
    if (cursor.consume("off"))
        return text::Feature{*tag, 0};
    const auto value = cursor.number();
    if (value && !(*value >= 0 && *value <= 65535))
        return std::nullopt;
    return text::Feature{*tag, static_cast<std::uint32_t>(value.value_or(1))};
}

std::optional<text::Variation> readVariation(Cursor& cursor) {
    const auto tag = readTag(cursor);
    const auto value = tag ? cursor.number() : std::nullopt;
    return value ? std::optional(text::Variation{*tag, static_cast<float>(*value)}) : std::nullopt;
}

/// CSS Fonts 4 section 2.2.1.
double bolder(double weight) { return weight < 350 ? 400 : weight < 550 ? 700 : weight < 900 ? 900 : weight; }
double lighter(double weight) {
    return weight < 100 ? weight : weight < 550 ? 100 : weight < 750 ? 400 : 700;
}

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

/// The part of `font` before the size: style, variant, weight and stretch in any order. False for other
/// words.
bool applyFontWord(TextStyle& style, std::string_view word, const Units& units) {
    if (const auto slant = parseFontStyle(word, units))
        style.fontSlant = *slant;
    else if (equalsIgnoringCase(word, "small-caps"))
        style.fontVariants = *parseVariants(word, VariantGroup::Caps);
    else if (const auto weight = parseFontWeight(word, units))
        style.fontWeight = *weight;
    else if (const auto stretch = parseFontStretch(word, units))
        style.fontStretch = *stretch;
    else
        return false;
    return true;
}

std::string_view readWord(Cursor& cursor) {
    const std::string_view rest = cursor.rest();
    std::size_t size = 0;
    while (size < rest.size() && !isSpace(rest[size]) && rest[size] != '/' && rest[size] != ',')
        ++size;
    cursor.advance(size);
    return rest.substr(0, size);
}

}  // namespace

std::vector<std::string> familiesIn(std::string_view text) {
    std::vector<std::string> families;
    Cursor cursor(text);
    do
        if (std::string family = readFamily(cursor); !family.empty())
            families.push_back(std::move(family));
    while (cursor.consume(','));
    return families;
}

std::optional<std::string_view> parseFontFamily(std::string_view text, const Units&) {
    Cursor cursor(text);
    do
        if (readFamily(cursor).empty())
            return std::nullopt;
    while (cursor.consume(','));
    return cursor.atEnd() ? std::optional(text) : std::nullopt;
}

std::optional<double> parseFontWeight(std::string_view text, const Units& units) {
    static constexpr Keyword<double> table[]{{"normal", 400}, {"bold", 700}};
    if (equalsIgnoringCase(text, "bolder"))
        return bolder(units.fontWeight);
    if (equalsIgnoringCase(text, "lighter"))
        return lighter(units.fontWeight);
    if (const auto weight = findKeyword(text, table))
        return weight;
    Cursor cursor(text);
    const auto weight = cursor.number();
    return weight && cursor.atEnd() && *weight >= 1 && *weight <= 1000 ? weight : std::nullopt;
}

std::optional<double> parseFontStretch(std::string_view text, const Units&) {
    static constexpr Keyword<double> table[]{{"normal", 100},
                                             {"ultra-condensed", 50},
                                             {"extra-condensed", 62.5},
                                             {"condensed", 75},
                                             {"semi-condensed", 87.5},
                                             {"semi-expanded", 112.5},
                                             {"expanded", 125},
                                             {"extra-expanded", 150},
                                             {"ultra-expanded", 200},
                                             {"narrower", 75},
                                             {"wider", 125}};
    if (const auto stretch = findKeyword(text, table))
        return stretch;
    Cursor cursor(text);
    const auto percent = cursor.number();
    return percent && *percent > 0 && cursor.consume('%') && cursor.atEnd() ? percent : std::nullopt;
}

/// The angle of `oblique 10deg` is not looked at.
std::optional<text::Slant> parseFontStyle(std::string_view text, const Units&) {
    static constexpr Keyword<text::Slant> table[]{
        {"normal", text::Slant::Normal}, {"italic", text::Slant::Italic}, {"oblique", text::Slant::Oblique}};
    Cursor cursor(text);
    const auto slant = findKeyword(cursor.identifier(), table);
    cursor.skipSpaces();
    if (slant == text::Slant::Oblique && !cursor.atEnd() && !readAngle(cursor))
        return std::nullopt;
    return cursor.atEnd() ? slant : std::nullopt;
}

std::optional<std::optional<double>> parseFontSizeAdjust(std::string_view text, const Units&) {
    if (equalsIgnoringCase(text, "none"))
        return std::optional<double>();
    Cursor cursor(text);
    const auto value = cursor.number();
    return value && *value >= 0 && cursor.atEnd() ? std::optional(value) : std::nullopt;
}

std::optional<std::string_view> parseFontFeatures(std::string_view text, const Units&) {
    return readList<text::Feature>(text, readFeature) ? std::optional(text) : std::nullopt;
}

std::optional<std::string_view> parseFontVariations(std::string_view text, const Units&) {
    return readList<text::Variation>(text, readVariation) ? std::optional(text) : std::nullopt;
}

std::vector<text::Feature> featuresIn(std::string_view text) {
    return readList<text::Feature>(text, readFeature).value_or(std::vector<text::Feature>());
}

std::vector<text::Variation> variationsIn(std::string_view text) {
    return readList<text::Variation>(text, readVariation).value_or(std::vector<text::Variation>());
}

std::optional<std::optional<bool>> parseFontKerning(std::string_view text, const Units&) {
    static constexpr Keyword<std::optional<bool>> table[]{
        {"auto", std::nullopt}, {"normal", true}, {"none", false}};
    return findKeyword(text, table);
}

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
    return length->percent ? length->value / 100 : length->value / units.fontSize;
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
    const auto length = parseWidth(text, units);
    return length ? std::optional(length) : std::nullopt;
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

/// System fonts such as `caption` are the default font here.
bool applyFont(Style& style, std::string_view value, const Units& units) {
    static constexpr Keyword<bool> systemFonts[]{{"caption", true},       {"icon", true},
                                                 {"menu", true},          {"message-box", true},
                                                 {"small-caption", true}, {"status-bar", true}};
    TextStyle made = style;
    const TextStyle initial;
    made.fontSlant = initial.fontSlant;
    made.fontVariants = initial.fontVariants;
    made.fontWeight = initial.fontWeight;
    made.fontStretch = initial.fontStretch;
    made.fontSizeAdjust = initial.fontSizeAdjust;
    made.fontFeatures = made.fontVariations = {};
    made.kerning = initial.kerning;
    if (findKeyword(value, systemFonts)) {
        made.fontFamily = {};
        static_cast<TextStyle&>(style) = made;
        return true;
    }
    Cursor cursor(value);
    std::string_view word = readWord(cursor);
    while (!word.empty() && (equalsIgnoringCase(word, "normal") || applyFontWord(made, word, units))) {
        cursor.skipSpaces();
        word = readWord(cursor);
    }
    const auto size = parseFontSize(word, units);
    cursor.skipSpaces();
    if (cursor.consume('/')) {  // the height of lines, which single lines do not have
        cursor.skipSpaces();
        readWord(cursor);
    }
    const auto family = parseFontFamily(trim(cursor.rest()), units);
    if (!size || !family)
        return false;
    made.fontSize = *size;
    made.fontFamily = *family;
    static_cast<TextStyle&>(style) = made;
    return true;
}

std::optional<bool> parseSynthesis(std::string_view text, const Units&) {
    static constexpr Keyword<bool> table[]{{"auto", true}, {"none", false}};
    return findKeyword(text, table);
}

bool applyFontSynthesis(Style& style, std::string_view value, const Units&) {
    bool weight = false, slant = false, smallCaps = false;
    for (Cursor cursor(value); !cursor.atEnd(); cursor.skipSpaces()) {
        const std::string_view word = cursor.identifier();
        if (equalsIgnoringCase(word, "weight"))
            weight = true;
        else if (equalsIgnoringCase(word, "style"))
            slant = true;
        else if (equalsIgnoringCase(word, "small-caps"))
            smallCaps = true;
        else if (word.empty() || !(equalsIgnoringCase(word, "none") || equalsIgnoringCase(word, "position")))
            return false;
    }
    style.synthesizeSmallCaps = smallCaps;
    style.synthesizeWeight = weight;
    style.synthesizeSlant = slant;
    return true;
}

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
    const auto length = parseLength(word, units);
    return length ? std::optional(length) : std::nullopt;
}

}  // namespace

/// Lines have the paints of their element (SVG 2 section 11.10.3): the colour is read only.
bool applyTextDecoration(Style& style, std::string_view value, const Units& units) {
    unsigned lines = 0;
    TextDecoration decoration;
    for (Cursor cursor(value); !cursor.atEnd(); cursor.skipSpaces()) {
        const std::string_view word = readWord(cursor);
        const auto line = lineOf(word);
        if (const auto lineStyle = lineStyleOf(word))
            decoration.style = *lineStyle;
        else if (const auto thickness = lineThicknessOf(word, units))
            decoration.thickness = *thickness;
        else if (word.empty() || (!line && !equalsIgnoringCase(word, "currentColor") && !parseColor(word)))
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
        const auto line = lineOf(readWord(cursor));
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
    const auto length = parseLength(text, units);
    return length ? std::optional(length) : std::nullopt;
}

}  // namespace vtm::svg
