/// \file
/// How the values of the properties of fonts are read: as in property_values.hpp. Source: CSS Fonts 4.
#pragma once

#include "svg/css/style.hpp"

namespace vtm::svg {

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
