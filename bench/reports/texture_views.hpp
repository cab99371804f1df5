/// \file
/// Planes of repeated pictures, as the reports of textures look at them.
#pragma once

#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace vtm::bench {

/// So many pictures along the raster, turned a little more each round.
inline glm::dmat3 flatPlane(int side, double periods, int round) {
    const double angle = 0.1 + 0.02 * round;
    const glm::dvec2 x = periods / side * glm::dvec2(std::cos(angle), std::sin(angle));
    return {{x.x, -x.y, 0}, {x.y, x.x, 0}, {0, 0, 1}};
}

/// A floor up to a horizon just above the raster, moving on each round: in the first row one picture is as
/// wide as the raster, and footprints are 8 times as long as wide in the last.
inline glm::dmat3 floorUpToTheHorizon(int side, int round) {
    const double horizon = side / 16.0, b = 0.9 / side * (horizon + side), a = 8 * b * horizon;
    const glm::dmat3 moved({1, 0, 0}, {0, 1, 0}, {0.01 * round, 0.03 * round, 1});
    return moved * glm::dmat3({b, 0, 0}, {0.5, 0, 1}, {0.5 * horizon - b * side / 2, a, horizon});
}

/// `toTexture`: (pixel, 1) to homogeneous (s, t).
struct TextureView {
    const char* name;
    glm::dmat3 (*toTexture)(int side, int round);
};
inline constexpr TextureView textureViews[] = {
    {"flat, one picture", [](int side, int round) { return flatPlane(side, 1, round); }},
    {"flat, 4 x 4", [](int side, int round) { return flatPlane(side, 4, round); }},
    {"minified, 16 x 16", [](int side, int round) { return flatPlane(side, 16, round); }},
    {"perspective, to the horizon", floorUpToTheHorizon}};

}  // namespace vtm::bench
