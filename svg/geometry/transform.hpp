/// \file
/// Transform lists. Source: SVG 1.1 section 7.6 and CSS Transforms 1 section 9, whose grammars are
/// read as one: commas optional, units allowed.
#pragma once

#include <vtm/scene/affine.hpp>
#include "svg/css/length.hpp"

namespace vtm::svg {

/// Percentages in translate() refer to `viewport`. Nothing if the list is malformed; `none` and an
/// empty list are the identity.
std::optional<scene::Affine> parseTransform(std::string_view text, const Units& units,
                                            const Viewport& viewport);

scene::Affine rotation(double degrees);

/// transform-origin: an offset from the reference box's corner.
struct TransformOrigin {
    Length x, y;
};
std::optional<TransformOrigin> parseTransformOrigin(std::string_view text, const Units& units);

/// `transform` with its origin moved to `origin`.
scene::Affine aroundPoint(const scene::Affine& transform, glm::dvec2 origin);

}  // namespace vtm::svg
