/// \file
/// How the values of the properties of text are read: as in property_values.hpp. Source: CSS Text 4, CSS Text
/// Decoration 4, CSS Writing Modes 4, SVG 2 chapter 11.
#pragma once

#include "svg/css/style.hpp"

namespace vtm::svg {

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
bool applyTextDecoration(Style& style, std::string_view value, const Units& units);
bool applyTextLines(Style& style, std::string_view value, const Units& units);
bool applyLineStyle(Style& style, std::string_view value, const Units& units);
bool applyLineThickness(Style& style, std::string_view value, const Units& units);
std::optional<std::optional<Length>> parseUnderlineOffset(std::string_view text, const Units& units);

}  // namespace vtm::svg
