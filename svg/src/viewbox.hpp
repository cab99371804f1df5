/// \file
/// viewBox and preserveAspectRatio. Source: SVG 2 sections 8.6 to 8.8.
#pragma once

#include <optional>
#include <string_view>

#include "scene/affine.hpp"
#include "svg/src/path_geometry.hpp"

namespace vtm::svg {

struct Rect {
    double x = 0, y = 0, width = 0, height = 0;
    Box box() const { return {{x, y}, {x + width, y + height}}; }
};

/// Nothing unless there are four numbers and both sizes are positive.
std::optional<Rect> parseViewBox(std::string_view text);

struct AspectRatio {
    bool keep = true;                   ///< false: none
    double alignX = 0.5, alignY = 0.5;  ///< 0: min, 1: max
    bool slice = false;
};

/// The default, xMidYMid meet, for anything malformed.
AspectRatio parseAspectRatio(std::string_view text);

/// Where `content` lies once fitted into `viewport`.
Rect fittedRect(double contentWidth, double contentHeight, const AspectRatio& ratio, const Rect& viewport);
/// Maps `viewBox` into `viewport`.
scene::Affine fit(const Rect& viewBox, const AspectRatio& ratio, const Rect& viewport);

}  // namespace vtm::svg
