/// \file
/// How the values of the properties of fonts and text are read: as in property_values.hpp. Source: CSS Fonts
/// 4, CSS Text 4, CSS Writing Modes 4, SVG 2 chapter 11.
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
std::optional<Length> parseSpacing(std::string_view text, const Units& units);
std::optional<TextAnchor> parseTextAnchor(std::string_view text, const Units&);
std::optional<Baseline> parseDominantBaseline(std::string_view text, const Units&);
std::optional<Baseline> parseAlignmentBaseline(std::string_view text, const Units&);
std::optional<BaselineShift> parseBaselineShift(std::string_view text, const Units& units);
std::optional<WritingMode> parseWritingMode(std::string_view text, const Units&);
std::optional<text::TextOrientation> parseTextOrientation(std::string_view text, const Units&);
/// `glyph-orientation-vertical`, which text-orientation replaced.
std::optional<text::TextOrientation> parseGlyphOrientation(std::string_view text, const Units&);
/// By font size.
std::optional<double> parseLineHeight(std::string_view text, const Units& units);
/// `text-align`, of text that is broken into lines.
std::optional<TextAnchor> parseTextAlign(std::string_view text, const Units&);
std::optional<std::optional<Length>> parseInlineSize(std::string_view text, const Units& units);
std::optional<bool> parseDirection(std::string_view text, const Units&);
std::optional<UnicodeBidi> parseUnicodeBidi(std::string_view text, const Units&);
std::optional<std::optional<WhiteSpace>> parseWhiteSpace(std::string_view text, const Units&);

// Shorthands, which set several members of the style.
bool applyFont(Style& style, std::string_view value, const Units& units);
std::optional<bool> parseSynthesis(std::string_view text, const Units& units);
bool applyFontSynthesis(Style& style, std::string_view value, const Units& units);
bool applyTextDecoration(Style& style, std::string_view value, const Units& units);
bool applyTextLines(Style& style, std::string_view value, const Units& units);
bool applyLineStyle(Style& style, std::string_view value, const Units& units);
bool applyLineThickness(Style& style, std::string_view value, const Units& units);
std::optional<std::optional<Length>> parseUnderlineOffset(std::string_view text, const Units& units);

}  // namespace vtm::svg
