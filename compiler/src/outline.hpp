/// \file
/// Curves to chords on the lattice.
#pragma once

#include <vector>

#include "compiler/src/lattice.hpp"
#include "scene/affine.hpp"
#include "scene/path.hpp"

namespace vtm::compiler {

/// A directed straight edge of a layer's outline.
struct Chord {
    LatticePoint a, b;
};

/// The closed contours of `path` under `toSteps` (path space to lattice steps) as chords: every
/// subpath is closed, every curve's chords lie within `tolerance` steps of it, every vertex is even,
/// and what lies outside [clampMin, clampMax] is moved onto that box's border, which changes no
/// winding number inside it.
std::vector<Chord> outline(const scene::Path& path, const scene::Affine& toSteps, double tolerance,
                           glm::dvec2 clampMin, glm::dvec2 clampMax);

/// Tolerance, as a share of the given one, in path space: how much `m` stretches at most.
double largestStretch(const scene::Affine& m);

}  // namespace vtm::compiler
