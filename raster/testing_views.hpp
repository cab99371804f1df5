/// \file
/// Views for tests: turned, mirrored, sheared, zoomed and minified.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/raster/view.hpp>

namespace vtm::asset::test {

/// `zoom` pixels a picture unit, turned by `angle`, with picture point `centre` in the raster's middle.
inline View turnedView(int width, int height, glm::dvec2 centre, double zoom, double angle, double shear = 0,
                       bool mirrored = false) {
    const glm::dvec2 x = zoom * glm::dvec2(std::cos(angle), std::sin(angle)) * (mirrored ? -1.0 : 1.0);
    const glm::dvec2 y = zoom * glm::dvec2(-std::sin(angle) + shear * std::cos(angle),
                                           std::cos(angle) + shear * std::sin(angle));
    const glm::dvec2 origin = glm::dvec2(width, height) * 0.5 - x * centre.x - y * centre.y;
    return {width, height, glm::dmat3x2(x, y, origin)};
}

/// Zoom between 1/8 and 64 times what makes the map 64 pixels, centred somewhere on the map.
inline View randomView(std::mt19937& random, int width = 40, int height = 30) {
    std::uniform_real_distribution<double> unit(0, 1);
    const glm::dvec2 centre(64 * unit(random), 64 * unit(random));
    const double zoom = std::exp2(-3 + 9 * unit(random)), angle = 2 * std::numbers::pi * unit(random);
    return turnedView(width, height, centre, zoom, angle, unit(random) - 0.5, unit(random) < 0.5);
}

}  // namespace vtm::asset::test
