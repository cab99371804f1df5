/// \file
/// Transform lists, viewBox and preserveAspectRatio. Source: SVG 2 sections 8.6 to 8.8; for
/// transforms SVG 1.1 section 7.6 and CSS Transforms 1 section 9, whose grammars are read as one: commas
/// optional, units allowed.
#pragma once

#include <optional>
#include <string_view>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/fit.hpp>
#include "svg/css/length.hpp"
#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {

/// Percentages in translate() refer to `viewport`. Nothing if the list is malformed; `none` and an
/// empty list are the identity.
std::optional<scene::Affine> parseTransform(std::string_view text, const Units& units,
                                            const Viewport& viewport);

/// The properties `translate`, `rotate`, `scale` (CSS Transforms 2 section 5), as far as they stay in the
/// plane. Nothing if the value is not valid.
std::optional<scene::Affine> parseTranslate(std::string_view text, const Units& units,
                                            const Viewport& viewport);
std::optional<scene::Affine> parseRotate(std::string_view text);
std::optional<scene::Affine> parseScale(std::string_view text);

scene::Affine rotation(double degrees);

/// compose(outer, inner), in which terms that cancel leave exactly 0, or 1 on the diagonal: an entry is a sum
/// of products, and what is left of it below cancellationError times the sum of their magnitudes is rounding.
/// A transform inside its inverse is so the identity, as in the groups with filters that svg::write writes.
scene::Affine nested(const scene::Affine& outer, const scene::Affine& inner);
inline constexpr double cancellationError = 0x1p-49;  ///< both factors in error by 4 units in the last place

/// transform-origin: an offset from the reference box's corner.
struct TransformOrigin {
    Length x, y;
};
std::optional<TransformOrigin> parseTransformOrigin(std::string_view text, const Units& units);

/// `transform` with its origin moved to `origin`.
scene::Affine aroundPoint(const scene::Affine& transform, glm::dvec2 origin);

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
