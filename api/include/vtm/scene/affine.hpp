/// \file
/// Affine maps of the plane, on GLM.
#pragma once

#include <optional>

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

/// SVG's matrix(a b c d e f): columns (a b), (c d), (e f); maps p to M·(p, 1).
using Affine = glm::dmat3x2;

inline constexpr Affine identity{1, 0, 0, 1, 0, 0};

glm::dvec2 apply(const Affine& m, glm::dvec2 p);
/// The linear part only: maps a direction.
glm::dvec2 applyVector(const Affine& m, glm::dvec2 v);
/// First `inner`, then `outer`.
Affine compose(const Affine& outer, const Affine& inner);
double determinant(const Affine& m);
/// Nothing where the map flattens the plane (determinant zero or not finite) or the inverse has a number that
/// is not finite.
std::optional<Affine> inverse(const Affine& m);
Affine translation(double x, double y);
Affine scaling(double x, double y);

}  // namespace vtm::scene

#pragma GCC visibility pop
