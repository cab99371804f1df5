/// \file
/// Gradients of which a picture shows a small part.
///
/// The asset's matrices are single precision: of a ramp that is 2^30 times as long as the picture, a sharp
/// stop could be placed nowhere in it. So the part of the ramp that the picture shows becomes a ramp of its
/// own.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/paint.hpp>

namespace vtm::compiler {

/// A linear gradient along x, from 0 to 1.
struct Ramp {
    scene::Affine toRamp;  ///< picture to the ramp's space
    std::vector<scene::GradientStop> stops;
    scene::Spread spread = scene::Spread::Pad;
};

/// The same colours in [0, size.x] × [0, size.y]; nothing if these are so much of the ramp that single
/// precision will do.
std::optional<Ramp> narrowed(const Ramp& ramp, glm::dvec2 size);

/// A radial gradient as a linear one, where its circles are nearly straight all over the picture, so that no
/// colour is farther off than a 2^13th of the picture's size; else nothing. `toUnit` leads from the picture
/// to the space in which the end circle is the unit circle.
std::optional<Ramp> straightened(const scene::RadialGradient& gradient, const scene::Affine& toUnit,
                                 glm::dvec2 size);

}  // namespace vtm::compiler
