/// \file
/// What of a filter is computed once for all pixels, on the CPU for the GPU too: the kernels of blurs, the
/// lattice of noise.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "asset/filters.hpp"
#include "raster/filter_place.hpp"

namespace vtm::asset {

// ---- Blurs ----------------------------------------------------------------------------------------

/// How one axis is blurred: means over coarse pixels, a kernel, cubic B-splines back to pixels.
/// raster/filter/blur.cpp has the method and its error.
struct AxisBlur {
    int step = 1;               ///< pixels of a coarse one, a power of two
    std::vector<float> kernel;  ///< of coarse pixels, from the centre outwards; empty: nothing is blurred
};
/// Entries of a kernel: one beyond 3.5 deviations of less than four coarse pixels.
inline constexpr std::size_t maxBlurKernel = 15;
/// Coarse pixels beside the last that splines read.
inline constexpr int splineReach = 2;

/// `deviation` in pixels.
AxisBlur axisBlur(double deviation);
/// Pixels beyond which a deviation's blur reads nothing.
int blurReach(double deviation);
/// Coarse pixels that lie over those of a box.
PixelBox coarsened(const PixelBox& box, glm::ivec2 steps);

// ---- Noise ----------------------------------------------------------------------------------------

/// Perlin's lattice as the specification has it (Filter Effects Module Level 1, section 9.21).
inline constexpr std::size_t latticeSize = 256, latticeEnd = 2 * latticeSize + 2;

struct Noise {
    /// Where the centre of a column or row of pixels lies in the lattice, for one octave.
    struct Axis {
        std::uint16_t low, high;  ///< lattice points
        float rest, curve;        ///< from `low` to the centre, and what is interpolated with
    };

    std::array<std::uint16_t, latticeEnd> lattice{};
    /// By lattice point: x and y components, of red, green, blue and alpha.
    std::array<std::array<float, 4>, latticeEnd> x{}, y{};
    /// Octave after octave, of each column and row of the box.
    std::vector<Axis> columns, rows;
    int octaves = 0;  ///< those whose numbers are of any use
    bool fractal = false;
};

/// For the pixels of `box`, whose centres are placed by pixel = scale · point + origin. `region`: of the
/// primitive.
Noise noiseOf(const FilterParameters& turbulence, const PixelRect& region, const PixelBox& box,
              glm::dvec2 scale, glm::dvec2 origin);

}  // namespace vtm::asset
