/// \file
/// Areas by Green's theorem, in a pixel's own coordinates: its box is [0, 1]², x right and y up in
/// the numbers (docs/coverage.md). Single precision; twin of backend_gl/shaders/shared/coverage.glsl.
#pragma once

#include <array>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

/// Chords over the part of a piece that can meet the pixel; docs/coverage.md bounds the error.
inline constexpr int chordCount = 6;

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

}  // namespace vtm::asset
