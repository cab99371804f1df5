/// \file
/// Areas by Green's theorem, in a pixel's own coordinates: its box is [0, 1]², x right and y up in
/// the numbers (docs/coverage.md). Single precision; twin of backend_gl/shaders/shared/coverage.glsl.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/view.hpp>
#include "raster/planar_map.hpp"

namespace vtm::asset {

/// Chords over the part of a piece that can meet the pixel: off by 0.25/255 at most (docs/coverage.md).
inline constexpr int chordCount = 3;

/// Below this difference of x the mean of clamp(x, 0, 1) along a chord is its end's: off by 2^-31 at
/// most, less than half a step of float just below 1, while the division stays far from underflow.
inline constexpr float smallestSpan = 0x1p-30f;

/// Leaf coordinates to the pixel's: p -> linear · p + origin.
struct LeafFrame {
    glm::mat2 linear;
    glm::vec2 origin;

    glm::vec2 operator()(glm::vec2 p) const { return linear * p + origin; }
};

/// A leaf's corners in the pixel's coordinates, corner k + 4 being corner k.
using Corners = std::array<glm::vec2, 5>;
Corners cornersOf(const LeafFrame& frame);

/// ∫ clamp(x, 0, 1) dy along the chord P -> Q inside 0 <= y <= 1. Summed along a closed loop: the
/// area of the pixel's box that the loop encloses, positive if it runs counter-clockwise.
float seg(glm::vec2 p, glm::vec2 q);

/// What a piece adds to the loop of the region on its left: its own chords, closed along the leaf's
/// border. (c_left - c_right) times this, summed over the pieces, corrects the corners' colours.
float pieceSum(const LeafFrame& frame, const Corners& corners, const Piece& piece);

/// Columns first to end - 1 of a row, all covered by the same share.
struct CoverageRun {
    int first, end;
    float share;  ///< in (0, 1]
};

/// Coverage of all that is not paint 0, as the Scanner (vtm/raster/scan.hpp) sums it, without colours, for
/// renderers that bring their own. Safe to use from several threads at once.
class CoverageScanner {
public:
    /// std::invalid_argument unless `mask` is a sum of maps. Keeps nothing of it.
    explicit CoverageScanner(const AssetView& mask);
    explicit CoverageScanner(const PlanarMap& mask);
    ~CoverageScanner();
    CoverageScanner(CoverageScanner&&) noexcept;
    CoverageScanner& operator=(CoverageScanner&&) noexcept;

    /// Calls row(y, runs) for every row of the view that is covered anywhere, from the first on; the runs
    /// from left to right, where something is covered. Throws std::length_error if the view is beyond its
    /// limits.
    void scan(const View& view,
              const std::function<void(int y, std::span<const CoverageRun> runs)>& row) const;

private:
    struct Drawn;

    void add(const PlanarMap& mask);

    std::vector<Drawn> drawn_;
};

}  // namespace vtm::asset
