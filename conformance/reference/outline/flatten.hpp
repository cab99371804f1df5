/// \file
/// Curves as chains of short chords.
#pragma once

#include <vector>

#include "conformance/reference/outline/curve.hpp"

namespace vtm::reference {

/// A point on a curve and the curve's direction there (unit length, or zero where all is one point).
struct Sample {
    Point at;
    Vector direction;
};

/// How fine the chords are. Lengths are in pixels, whatever space the curve is in.
struct Fineness {
    Affine toPixels;
    Box view;          ///< pixels: what lies outside may be coarse
    double tolerance;  ///< greatest distance between chord and curve
    double maxTurn;    ///< greatest turn of the curve's direction along a chord, radians
    /// The tolerance outside the view, as a share of the piece's size.
    double hiddenTolerance;
};

/// A whole piece becomes its chord: right for windings, since the lens between lies outside the view.
inline constexpr double wholePiece = 1e9;

/// The samples from a curve's start to its end, both included, in the curve's own space.
std::vector<Sample> flatten(const Curve& curve, const Fineness& fineness);

}  // namespace vtm::reference
