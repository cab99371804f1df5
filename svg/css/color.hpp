/// \file
/// Colours. Source: SVG 1.1 section 4.2, CSS Color 4 sections 4 to 10, CSS Color 5 section 3.
#pragma once

#include <optional>
#include <string_view>

#include <vtm/scene/paint.hpp>
#include "svg/css/cursor.hpp"

namespace vtm::svg {

/// A named or system colour, `#` notation, transparent, or one of the functions rgb(), hsl(), hwb(), lab(),
/// lch(), oklab(), oklch(), color(), color-mix() and light-dark(), cut to sRGB; `currentColor` is not one.
/// Stays where it is, or stops at the offending place, if there is none.
std::optional<scene::Color> readColor(Cursor& cursor);
/// The whole text, an icc-color() behind it ignored.
std::optional<scene::Color> parseColor(std::string_view text);
/// In upper or lower case, `transparent` too.
std::optional<scene::Color> namedColor(std::string_view name);
std::optional<scene::Color> systemColor(std::string_view name);

}  // namespace vtm::svg
