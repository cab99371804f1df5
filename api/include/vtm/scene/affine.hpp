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
inline glm::dvec2 apply(const Affine& m, glm::dvec2 p) {
    return {m[0].x * p.x + m[1].x * p.y + m[2].x, m[0].y * p.x + m[1].y * p.y + m[2].y};
}
/// Maps a direction: applies the linear part only.
inline glm::dvec2 applyVector(const Affine& m, glm::dvec2 v) {
    return {m[0].x * v.x + m[1].x * v.y, m[0].y * v.x + m[1].y * v.y};
}
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
