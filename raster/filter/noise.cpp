// Perlin's noise as the specification defines it: its random numbers, its lattice and its sums, so that every
// renderer that follows it shows the same picture. Source: Filter Effects Module Level 1, section 9.21.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "raster/filter_tables.hpp"

namespace vtm::asset {

namespace {

/// Park and Miller's generator with Schrage's method: 16807 r mod 2^31 - 1.
class Random {
public:
    explicit Random(std::int64_t seed) : state_(seed) {
        if (state_ <= 0)
            state_ = -(state_ % (modulus - 1)) + 1;
        if (state_ > modulus - 1)
            state_ = modulus - 1;
    }
    std::int64_t operator()() { return state_ = 16807 * state_ % modulus; }

private:
    static constexpr std::int64_t modulus = 2147483647;
    std::int64_t state_;
};

/// Keeps lattice coordinates positive.
constexpr std::int64_t latticeOffset = 4096;

void fillLattice(std::int64_t seed, Noise& noise) {
    constexpr auto size = std::int64_t(latticeSize);
    Random random(seed);
    for (std::size_t channel = 0; channel < 4; ++channel)
        for (std::size_t i = 0; i < latticeSize; ++i) {
            noise.lattice[i] = std::uint16_t(i);
            // The conversion order of the specification's code: x first.
            const double x = double(random() % (2 * size) - size) / double(size);
            const double y = double(random() % (2 * size) - size) / double(size);
            const double length = std::sqrt(x * x + y * y);
            noise.x[i][channel] = length > 0 ? float(x / length) : 0;
            noise.y[i][channel] = length > 0 ? float(y / length) : 0;
        }
    for (std::size_t i = latticeSize - 1; i > 0; --i)
        std::swap(noise.lattice[i], noise.lattice[std::size_t(random() % size)]);
    for (std::size_t i = 0; i < latticeEnd - latticeSize; ++i) {
        noise.lattice[latticeSize + i] = noise.lattice[i];
        noise.x[latticeSize + i] = noise.x[i];
        noise.y[latticeSize + i] = noise.y[i];
    }
}

/// The frequency next to the given one that fits a whole number of times into a length.
double stitched(double frequency, double length) {
    if (frequency == 0 || !(length > 0))
        return frequency;
    const double low = std::floor(length * frequency) / length, high = std::ceil(length * frequency) / length;
    return low > 0 && frequency / low < high / frequency ? low : high;
}

/// One axis of the region and the pixels.
struct Line {
    int first, end;        ///< pixels
    double scale, origin;  ///< pixel = scale · coordinate + origin
    double min, size;      ///< of the region, user units
    double frequency;
};

bool isUseful(double coordinate) { return std::abs(coordinate) < 1e15; }

/// Where both ends of the line still have numbers.
int usefulOctaves(const Line& line, int octaves) {
    const auto at = [&](int pixel) { return (pixel + 0.5 - line.origin) / line.scale * line.frequency; };
    double largest = std::max(std::abs(at(line.first)), std::abs(at(line.end - 1)));
    for (int octave = 0; octave < octaves; ++octave, largest *= 2)
        if (!isUseful(largest))
            return octave;
    return octaves;
}

/// `stitches`: the noise repeats at the region's ends, so that tiles fit together.
std::vector<Noise::Axis> placesAlong(const Line& line, bool stitches, int octaves) {
    const auto whole = [](double v) { return std::int64_t(std::min(std::max(v, -1e8), 1e8)); };
    std::int64_t period = 0, wrap = 0;
    if (stitches) {
        period = whole(line.size * line.frequency + 0.5);
        wrap = whole(line.min * line.frequency + double(latticeOffset) + double(period));
    }
    std::vector<Noise::Axis> places;
    places.reserve(std::size_t(octaves) * std::size_t(std::max(line.end - line.first, 0)));
    double factor = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        for (int pixel = line.first; pixel < line.end; ++pixel) {
            const double at = (pixel + 0.5 - line.origin) / line.scale * line.frequency * factor;
            const double t = at + double(latticeOffset);
            const auto first = std::int64_t(t);
            const double rest = t - double(first);
            std::int64_t low = first, high = first + 1;
            if (period > 0) {
                low -= low >= wrap ? period : 0;
                high -= high >= wrap ? period : 0;
            }
            constexpr auto mask = std::int64_t(latticeSize - 1);
            places.push_back({std::uint16_t(low & mask), std::uint16_t(high & mask), float(rest),
                              float(rest * rest * (3 - 2 * rest))});
        }
        factor *= 2;
        period *= 2;
        wrap = 2 * wrap - latticeOffset;
    }
    return places;
}

}  // namespace

Noise noiseOf(const FilterParameters& p, const PixelRect& region, const PixelBox& box, glm::dvec2 scale,
              glm::dvec2 origin) {
    Noise noise;
    noise.fractal = p[5] != 0;
    // Truncated towards zero and kept within the generator's numbers.
    const double seed = std::trunc(double(p[3]));
    fillLattice(std::int64_t(std::min(std::max(seed, -2147483648.0), 2147483647.0)), noise);
    if (box.empty())
        return noise;
    const bool stitches = p[4] != 0;
    const glm::dvec2 min = (region.min - origin) / scale, size = (region.max - region.min) / scale;
    glm::dvec2 frequency(p[0], p[1]);
    if (stitches)
        frequency = {stitched(frequency.x, size.x), stitched(frequency.y, size.y)};
    const Line across{box.min.x, box.max.x, scale.x, origin.x, min.x, size.x, frequency.x},
        down{box.min.y, box.max.y, scale.y, origin.y, min.y, size.y, frequency.y};
    noise.octaves = usefulOctaves(down, usefulOctaves(across, int(p[2])));
    noise.columns = placesAlong(across, stitches, noise.octaves);
    noise.rows = placesAlong(down, stitches, noise.octaves);
    return noise;
}

}  // namespace vtm::asset
