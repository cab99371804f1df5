/// \file
/// How the value of each property is read: the text as it is declared, trimmed; nothing if it is none of the
/// property's (CSS Values 4, SVG 2 section 6).
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "svg/css/cursor.hpp"
#include "svg/css/style.hpp"

namespace vtm::svg {

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
    if (found == std::end(table))
        return std::nullopt;
    return std::optional<T>(std::in_place, found->value);
}

/// Of properties whose value may be none, as `auto` is: what was read, but nothing where it is invalid. (An
/// optional that is returned as an optional of optionals would hold none.)
template <class T>
std::optional<std::optional<T>> valid(const std::optional<T>& read) {
    if (!read)
        return std::nullopt;
    return std::optional<std::optional<T>>(std::in_place, read);
}

using Dashes = std::shared_ptr<const std::vector<Length>>;

std::optional<PaintValue> parsePaint(std::string_view text, const Units&);
std::optional<ColorValue> parseColorValue(std::string_view text, const Units&);
std::optional<scene::Color> parsePlainColor(std::string_view text, const Units&);
std::optional<std::optional<scene::Color>> parseBackgroundColor(std::string_view text, const Units&);
/// The shorthand `background`: the colour of its last layer, transparent where there is none. Nothing where
/// the layer holds neither a colour nor an image nor `none`. Source: CSS Backgrounds 3 section 2.10.
std::optional<std::optional<scene::Color>> parseBackground(std::string_view text, const Units&);
/// Clamped to [0, 1].
std::optional<double> parseOpacity(std::string_view text, const Units&);
std::optional<scene::FillRule> parseFillRule(std::string_view text, const Units&);
std::optional<Length> parseAnyLength(std::string_view text, const Units&);
/// Not negative.
std::optional<Length> parseWidth(std::string_view text, const Units&);
std::optional<scene::Cap> parseCap(std::string_view text, const Units&);
std::optional<scene::Join> parseJoin(std::string_view text, const Units&);
std::optional<double> parseMiterLimit(std::string_view text, const Units&);
/// None negative.
std::optional<Dashes> parseDashes(std::string_view text, const Units&);
std::optional<bool> parseVisibility(std::string_view text, const Units&);
std::optional<bool> parseDisplay(std::string_view text, const Units&);
std::optional<TransformBox> parseTransformBox(std::string_view text, const Units& units);
std::optional<std::optional<bool>> parseOverflow(std::string_view text, const Units&);
/// url() or none; anything else that CSS allows there (shapes, image masks) is not supported.
std::optional<std::string_view> parseReference(std::string_view text, const Units&);
std::optional<std::string_view> parseFilter(std::string_view text, const Units&);
std::optional<std::array<PaintStage, 3>> parsePaintOrder(std::string_view text, const Units&);
std::optional<scene::BlendMode> parseBlend(std::string_view text, const Units&);
std::optional<bool> parseIsolation(std::string_view text, const Units&);
/// `clip-path`: empty for none, else the whole value: a reference or a shape.
std::optional<std::string_view> parseClipPath(std::string_view text, const Units& units);
/// `mask-mode`: what a mask's own type gives way to; inside nothing: it does not.
std::optional<std::optional<scene::MaskKind>> parseMaskMode(std::string_view text, const Units&);
std::optional<scene::MaskKind> parseMaskType(std::string_view text, const Units&);
std::optional<bool> parseColorInterpolation(std::string_view text, const Units&);
/// color-interpolation-filters, whose `auto` is linear light.
std::optional<bool> parseFilterColors(std::string_view text, const Units&);
std::optional<scene::ImageFilter> parseImageRendering(std::string_view text, const Units&);
std::optional<bool> parseVectorEffect(std::string_view text, const Units&);
/// Here the units' font size is the parent's.
std::optional<double> parseFontSize(std::string_view text, const Units&);
/// The text itself, if it is well formed.
std::optional<std::string_view> parseTransformText(std::string_view text, const Units&);
/// The same of the properties `translate`, `rotate`, `scale`; empty for none.
std::optional<std::string_view> parseTranslateText(std::string_view text, const Units&);
std::optional<std::string_view> parseRotateText(std::string_view text, const Units&);
std::optional<std::string_view> parseScaleText(std::string_view text, const Units&);
std::optional<std::optional<TransformOrigin>> parseOrigin(std::string_view text, const Units&);

/// `url(#id)`, `url("#id")`: what is in it. Stays where it is if there is none.
std::optional<std::string_view> readUrl(Cursor& cursor);

}  // namespace vtm::svg
