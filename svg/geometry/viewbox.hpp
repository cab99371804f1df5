/// \file
/// viewBox and preserveAspectRatio. Source: SVG 2 sections 8.6 to 8.8.
#pragma once

#include <optional>
#include <string_view>

#include "scene/affine.hpp"
#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {

struct Rect {
    double x = 0, y = 0, width = 0, height = 0;
    Box box() const { return {{x, y}, {x + width, y + height}}; }
};

/// Nothing unless there are four numbers and both sizes are positive.
std::optional<Rect> parseViewBox(std::string_view text);

/// Four numbers, one size 0 and none negative: nothing of the element is drawn (SVG 2 section 8.6).
bool isEmptyViewBox(std::string_view text);

struct AspectRatio {
    bool keep = true;                   ///< false: none
    double alignX = 0.5, alignY = 0.5;  ///< 0: min, 1: max
    bool slice = false;
};

std::optional<AspectRatio> readAspectRatio(std::string_view text);
/// The default, xMidYMid meet, for anything malformed.
inline AspectRatio parseAspectRatio(std::string_view text) {
    return readAspectRatio(text).value_or(AspectRatio{});
}

/// Where `content` lies once fitted into `viewport`.
Rect fittedRect(double contentWidth, double contentHeight, const AspectRatio& ratio, const Rect& viewport);
/// Maps `viewBox` into `viewport`.
scene::Affine fit(const Rect& viewBox, const AspectRatio& ratio, const Rect& viewport);

}  // namespace vtm::svg
