/// \file
/// Affine maps of the plane, as GLM matrices. Source: CSS Transforms Level 1.
#pragma once

#include <optional>

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

/// SVG's matrix(a b c d e f): the columns are (a b), (c d), (e f). Maps p to M·(p, 1).
using Affine = glm::dmat3x2;

inline constexpr Affine identity{1, 0, 0, 1, 0, 0};

/// Maps a point.
glm::dvec2 apply(const Affine& m, glm::dvec2 p);
/// Maps a direction: applies the linear part only.
glm::dvec2 applyVector(const Affine& m, glm::dvec2 v);
/// Returns the map that applies `inner` first, then `outer`.
Affine compose(const Affine& outer, const Affine& inner);
/// Returns the determinant of the linear part: the signed factor by which areas grow.
double determinant(const Affine& m);
/// Returns nullopt if the determinant is 0, NaN or so small that its reciprocal is not finite, or if the
/// inverse has a coefficient that is not finite.
std::optional<Affine> inverse(const Affine& m);
Affine translation(double x, double y);
Affine scaling(double x, double y);

}  // namespace vtm::scene

#pragma GCC visibility pop
