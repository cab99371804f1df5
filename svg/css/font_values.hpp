/// \file
/// How the values of the properties of fonts are read, as in property_values.hpp; the keywords of
/// `font-variant` and the OpenType features that they switch. Source: CSS Fonts 4.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "svg/css/style.hpp"
#include "text/shape.hpp"

namespace vtm::svg {

enum class VariantGroup { Ligatures, Caps, Position, Numeric, EastAsian };

/// A set of keywords, bit N for row N of the table.
using FontVariants = std::uint64_t;

/// The keywords of one longhand property, `normal` or `none` too; nothing if one is not the group's.
std::optional<FontVariants> parseVariants(std::string_view text, VariantGroup group);
/// Those of the shorthand `font-variant`.
std::optional<FontVariants> parseVariants(std::string_view text);
/// All keywords of a group.
FontVariants variantsOf(VariantGroup group);
/// The features that the keywords switch on or off.
std::vector<text::Feature> featuresOf(FontVariants variants);

/// Four letters as a tag, first in the highest byte.
constexpr text::Tag fontTag(std::string_view letters) {
    text::Tag tag = 0;
    for (const char letter : letters)
        tag = tag << 8 | static_cast<unsigned char>(letter);
    return tag;
}

/// Names separated by commas, generic ones among them; the text itself.
std::optional<std::string_view> parseFontFamily(std::string_view text, const Units&);
/// The names in such a list, without quotes.
std::vector<std::string> familiesIn(std::string_view text);
/// `bolder` and `lighter` refer to the units' font weight, the parent's.
std::optional<double> parseFontWeight(std::string_view text, const Units& units);
std::optional<double> parseFontStretch(std::string_view text, const Units&);
std::optional<text::Slant> parseFontStyle(std::string_view text, const Units&);
std::optional<std::optional<double>> parseFontSizeAdjust(std::string_view text, const Units&);
std::optional<std::string_view> parseFontFeatures(std::string_view text, const Units&);
std::optional<std::string_view> parseFontVariations(std::string_view text, const Units&);
/// What well formed values of font-feature-settings and font-variation-settings say.
std::vector<text::Feature> featuresIn(std::string_view text);
std::vector<text::Variation> variationsIn(std::string_view text);
std::optional<std::optional<bool>> parseFontKerning(std::string_view text, const Units&);

// Shorthands, which set several members of the style.
bool applyFont(Style& style, std::string_view value, const Units& units);
std::optional<bool> parseSynthesis(std::string_view text, const Units& units);
bool applyFontSynthesis(Style& style, std::string_view value, const Units& units);

}  // namespace vtm::svg
