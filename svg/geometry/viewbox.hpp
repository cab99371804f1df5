/// \file
/// viewBox and preserveAspectRatio. Source: SVG 2 sections 8.6 to 8.8.
#pragma once

#include <optional>
#include <string_view>

#include <vtm/scene/fit.hpp>
#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {

using scene::Rect;
using AspectRatio = scene::Placement;

inline Box toBox(const Rect& rect) { return {{rect.x, rect.y}, {rect.x + rect.width, rect.y + rect.height}}; }

/// Nothing unless there are four numbers and both sizes are positive.
std::optional<Rect> parseViewBox(std::string_view text);

/// Four numbers, one size 0 and none negative: nothing of the element is drawn (SVG 2 section 8.6).
bool isEmptyViewBox(std::string_view text);

std::optional<AspectRatio> readAspectRatio(std::string_view text);
/// The default, xMidYMid meet, for anything malformed.
inline AspectRatio parseAspectRatio(std::string_view text) {
    return readAspectRatio(text).value_or(AspectRatio{});
}

}  // namespace vtm::svg
