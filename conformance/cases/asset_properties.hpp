/// \file
/// What must hold for every asset, whatever the scene: decided on the stored numbers, as renderers decide.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::cases {

/// Share of the tolerance by which a piece may leave its leaf (docs/regions.md): its curve lies within 1/4
/// of points in the leaf, and its ends are rounded by 1/8.
inline constexpr double dilation = 1.0 / 4 + 1.0 / 8;

/// Membership: pieces and paints in range, ends in the leaf but not on its corners and apart, different
/// paints on both sides, slopes within tan 22.5°, the quantised curve within the leaf dilated by `dilation`
/// times `tolerance` (share of the picture's longer side). Empty, or what breaks it.
std::string strayPiece(const asset::Asset& asset, double tolerance);

/// Closure (docs/coverage.md): at every point inside a leaf what is left and right of the pieces cancels;
/// along each side the pieces' ends lead from corner's paint to corner's paint. Empty, or what breaks it.
std::string openLoop(const asset::Asset& asset);

/// A stretch of a border on whose sides two squares of a map have different paints, in picture coordinates.
struct BorderGap {
    glm::dvec2 from, to;
};

/// Neighbours: the stretches longer than `slack` (picture units) along which leaves and solid squares that
/// touch do not agree. The asset is closed.
std::vector<BorderGap> borderGaps(const asset::Asset& asset, const asset::Map& map, double slack);

}  // namespace vtm::cases
