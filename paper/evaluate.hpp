/// \file
/// What the paper's Vector Texture Map shows, on the CPU: one fragment, or a view (docs/paper.md).
#pragma once

#include <cstdint>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>
#include "paper/model.hpp"

namespace vtm::paper {

// ---- Cells --------------------------------------------------------------------------------------

/// The implicit function of a piece and its gradient.
struct Value {
    double value = 0;
    glm::dvec2 gradient{0};
};
/// f and ∇f at a point in cell coordinates. A and B must differ.
Value implicitValue(const Piece& piece, glm::dvec2 point);

/// The same piece with inside and outside exchanged.
Piece reversed(const Piece& piece);

/// Signed distance to the cell's boundary, positive *outside*, in the units to which `toPixels` maps
/// cell coordinates: to first order h = d·n, d = -f ∇f / |∇f|², n = ∇f / |∇f|. Of two pieces the
/// intersection is max(h1, h2), the union -max(-h1, -h2).
double signedDistance(const Cell& cell, glm::dvec2 point, const glm::dmat2& toPixels);

// ---- Masks --------------------------------------------------------------------------------------

/// Pixels 2^64 texels wide and more: a mask has faded to nothing in single precision.
inline constexpr double maxLod = 64;

/// What a lookup touched (row 10).
struct Cost {
    std::uint64_t nodes = 0, masks = 0, indirections = 0, cells = 0, mips = 0, paints = 0;
    Cost& operator+=(const Cost& other);
};

/// A pixel's size and shape under a view.
struct Footprint {
    glm::dmat2 toPixels;  ///< the view's linear part; its determinant must not be 0
    double longer;        ///< the longer of the pixel's axes in picture units
    explicit Footprint(const glm::dmat2& toPixels);
};

/// Coverage of a mask by the pixel around a picture point.
double maskCoverage(const Mask& mask, glm::dvec2 point, const Footprint& pixel, Cost& cost);

/// The same where the picture repeats over the plane, in pixels up to the picture's size: as one grows from
/// half the picture's shorter side to all of it, the mask's share of the picture takes over.
double repeatedCoverage(const Mask& mask, glm::dvec2 pictureSize, glm::dvec2 point, const Footprint& pixel,
                        Cost& cost);

/// Whether a picture point is inside; on or beyond the square's border it is not.
bool classify(const Mask& mask, glm::dvec2 point);

// ---- Nodes --------------------------------------------------------------------------------------

struct Sample {
    glm::vec4 color{0};  ///< premultiplied
    bool discarded = false;
    Cost cost;
};
/// One fragment: the recursion walked at a picture point.
Sample sample(const Asset& asset, glm::dvec2 point, const Footprint& pixel);
/// The same where the picture repeats.
Sample sampleRepeated(const Asset& asset, glm::dvec2 point, const Footprint& pixel);

/// Draws on transparent black, a sample a pixel, times the coverage of the picture's rectangle (by the
/// distance to its nearest side); adds what it cost to `cost` if there is one. `asset`
/// must be valid. Throws std::length_error if the view is beyond its limits.
image::Raster evaluate(const Asset& asset, const asset::View& view, Cost* cost = nullptr);

}  // namespace vtm::paper
