#include "svg/css/font_values.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "svg/css/cursor.hpp"
#include "svg/css/property_values.hpp"

namespace vtm::svg {

// ---- font-variant: keywords and OpenType features (CSS Fonts 4 section 6) -----------------------

namespace {

struct Row {
    std::string_view keyword;
    VariantGroup group;
    std::string_view features;  ///< four letters each
    std::uint32_t value = 1;
};

constexpr Row variantRows[]{{"common-ligatures", VariantGroup::Ligatures, "ligaclig"},
                            {"no-common-ligatures", VariantGroup::Ligatures, "ligaclig", 0},
                            {"discretionary-ligatures", VariantGroup::Ligatures, "dlig"},
                            {"no-discretionary-ligatures", VariantGroup::Ligatures, "dlig", 0},
                            {"historical-ligatures", VariantGroup::Ligatures, "hlig"},
                            {"no-historical-ligatures", VariantGroup::Ligatures, "hlig", 0},
                            {"contextual", VariantGroup::Ligatures, "calt"},
                            {"no-contextual", VariantGroup::Ligatures, "calt", 0},
                            {"small-caps", VariantGroup::Caps, "smcp"},
                            {"all-small-caps", VariantGroup::Caps, "smcpc2sc"},
                            {"petite-caps", VariantGroup::Caps, "pcap"},
                            {"all-petite-caps", VariantGroup::Caps, "pcapc2pc"},
                            {"unicase", VariantGroup::Caps, "unic"},
                            {"titling-caps", VariantGroup::Caps, "titl"},
                            {"sub", VariantGroup::Position, "subs"},
                            {"super", VariantGroup::Position, "sups"},
                            {"lining-nums", VariantGroup::Numeric, "lnum"},
                            {"oldstyle-nums", VariantGroup::Numeric, "onum"},
                            {"proportional-nums", VariantGroup::Numeric, "pnum"},
                            {"tabular-nums", VariantGroup::Numeric, "tnum"},
                            {"diagonal-fractions", VariantGroup::Numeric, "frac"},
                            {"stacked-fractions", VariantGroup::Numeric, "afrc"},
                            {"ordinal", VariantGroup::Numeric, "ordn"},
                            {"slashed-zero", VariantGroup::Numeric, "zero"},
                            {"jis78", VariantGroup::EastAsian, "jp78"},
                            {"jis83", VariantGroup::EastAsian, "jp83"},
                            {"jis90", VariantGroup::EastAsian, "jp90"},
                            {"jis04", VariantGroup::EastAsian, "jp04"},
                            {"simplified", VariantGroup::EastAsian, "smpl"},
                            {"traditional", VariantGroup::EastAsian, "trad"},
                            {"full-width", VariantGroup::EastAsian, "fwid"},
                            {"proportional-width", VariantGroup::EastAsian, "pwid"},
                            {"ruby", VariantGroup::EastAsian, "ruby"}};

FontVariants bit(std::size_t row) { return FontVariants(1) << row; }

/// The bit of a keyword; nothing for words that are not in the table.
std::optional<std::size_t> rowOf(std::string_view keyword) {
    const auto found = std::find_if(std::begin(variantRows), std::end(variantRows),
                                    [&](const Row& row) { return equalsIgnoringCase(row.keyword, keyword); });
    return found == std::end(variantRows)
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - std::begin(variantRows)));
}

std::optional<FontVariants> parseWords(std::string_view text, FontVariants allowed) {
    FontVariants variants = 0;
    for (Cursor cursor(text); !cursor.atEnd(); cursor.skipSpaces()) {
        const auto row = rowOf(cursor.identifier());
        if (!row || !(allowed & bit(*row)) || (variants & bit(*row)))
            return std::nullopt;
        variants |= bit(*row);
    }
    return variants;
}

}  // namespace

FontVariants variantsOf(VariantGroup group) {
    FontVariants variants = 0;
    for (std::size_t row = 0; row < std::size(variantRows); ++row)
        if (variantRows[row].group == group)
            variants |= bit(row);
    return variants;
}

std::optional<FontVariants> parseVariants(std::string_view text, VariantGroup group) {
    if (equalsIgnoringCase(text, "normal"))
        return FontVariants(0);
    if (group == VariantGroup::Ligatures && equalsIgnoringCase(text, "none"))
        return parseWords(
            "no-common-ligatures no-discretionary-ligatures no-historical-ligatures no-contextual",
            variantsOf(group));
    return parseWords(text, variantsOf(group));
}

std::optional<FontVariants> parseVariants(std::string_view text) {
    if (equalsIgnoringCase(text, "normal") || equalsIgnoringCase(text, "none"))
        return parseVariants(text, VariantGroup::Ligatures);
    return parseWords(text, ~FontVariants(0));
}

std::vector<text::Feature> featuresOf(FontVariants variants) {
    std::vector<text::Feature> features;
    for (std::size_t row = 0; row < std::size(variantRows); ++row)
        if (variants & bit(row))
            for (std::string_view letters = variantRows[row].features; !letters.empty();
                 letters.remove_prefix(4))
                features.push_back({fontTag(letters.substr(0, 4)), variantRows[row].value});
    return features;
}

// ---- The other properties -----------------------------------------------------------------------

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
    return value && *value >= 0 && cursor.atEnd() ? valid(value) : std::nullopt;
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
    std::string_view word = cursor.word();
    while (!word.empty() && (equalsIgnoringCase(word, "normal") || applyFontWord(made, word, units))) {
        cursor.skipSpaces();
        word = cursor.word();
    }
    const auto size = parseFontSize(word, units);
    cursor.skipSpaces();
    if (cursor.consume('/')) {  // the height of lines, which single lines do not have
        cursor.skipSpaces();
        cursor.word();
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

}  // namespace vtm::svg
