/// \file
/// One cubic through samples of a smooth curve.
#pragma once

#include <array>

#include "compiler/stroke/curve.hpp"

namespace vtm::compiler::stroke {

struct Sample {
    Point at;
    Point tangent;  ///< unit, in the direction of travel
};

/// In order along the curve. Inner samples both shape the fit and certify it: fifteen of them see
/// each of the at most eight lobes that the error of such a fit has.
using Samples = std::array<Sample, 17>;

/// A fit is cut at least in two at each level. What is left at the last one, far below the tolerance, is a
/// straight edge.
inline constexpr int maxFitDepth = 20;

struct Fit {
    Cubic cubic;
    double error;  ///< largest distance of a sample from the cubic; infinite if it runs astray
};

/// Keeps the end points and end tangents exactly; stops at the tolerance.
Fit fitCubic(const Samples& samples, double tolerance);

/// Whether all samples lie within the tolerance of the chord.
bool isChord(const Samples& samples, double tolerance);

}  // namespace vtm::compiler::stroke
