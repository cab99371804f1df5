// Sums of Perlin's noise (noise.cpp), all four channels at once.

#include <vtm/limits/limits.hpp>
#include "raster/filter/operations.hpp"
#include "raster/filter_tables.hpp"

namespace vtm::asset {

namespace {

Float4 load(const std::array<float, 4>& v) { return Float4{v[0], v[1], v[2], v[3]}; }

Float4 mixed(float t, Float4 a, Float4 b) { return a + t * (b - a); }

/// In [-1, 1].
Float4 noiseAt(const Noise& noise, const Noise::Axis& x, const Noise::Axis& y) {
    const std::size_t left = noise.lattice[x.low], right = noise.lattice[x.high];
    const auto dot = [&](std::size_t point, float u, float v) {
        return u * load(noise.x[point]) + v * load(noise.y[point]);
    };
    const Float4 top = mixed(x.curve, dot(noise.lattice[left + y.low], x.rest, y.rest),
                             dot(noise.lattice[right + y.low], x.rest - 1, y.rest));
    const Float4 bottom = mixed(x.curve, dot(noise.lattice[left + y.high], x.rest, y.rest - 1),
                                dot(noise.lattice[right + y.high], x.rest - 1, y.rest - 1));
    return mixed(y.curve, top, bottom);
}

}  // namespace

Layer turbulence(const FilterStep& step) {
    const Noise noise = noiseOf(step.parameters, step.regions[0], step.box, step.scale, step.origin);
    Layer result(step.box, step.linear);
    const auto width = std::size_t(result.width()), height = std::size_t(result.height());
    for (std::size_t y = 0; y < height && !result.empty(); ++y) {
        limits::check();
        Float4* row = result.row(step.box.min.y + int(y));
        float share = 1;
        for (std::size_t octave = 0; octave < std::size_t(noise.octaves); ++octave, share /= 2) {
            const Noise::Axis& down = noise.rows[octave * height + y];
            const Noise::Axis* across = &noise.columns[octave * width];
            for (std::size_t x = 0; x < width; ++x) {
                const Float4 value = noiseAt(noise, across[x], down);
                row[x] += share * (noise.fractal ? value : (value < 0 ? -value : value));
            }
        }
        for (std::size_t x = 0; x < width; ++x)
            row[x] = premultiplied(unit(noise.fractal ? (row[x] + 1) / 2 : row[x]));
    }
    return result;
}

}  // namespace vtm::asset
