// Perlin's noise as the specification defines it: its random numbers, its lattice and its sums, so that every
// renderer that follows it shows the same picture. Source: Filter Effects Module Level 1, section 9.21.

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/vec2.hpp>

#include <vtm/limits/limits.hpp>
#include "raster/filter/operations.hpp"

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

constexpr int latticeSize = 256;
/// Keeps lattice coordinates positive.
constexpr double latticeOffset = 4096;

/// Lattice points at which the noise repeats, so that tiles fit together.
struct Stitching {
    int width = 0, height = 0, wrapX = 0, wrapY = 0;

    Stitching doubled() const {
        return {2 * width, 2 * height, 2 * wrapX - int(latticeOffset), 2 * wrapY - int(latticeOffset)};
    }
};

class Noise {
public:
    explicit Noise(std::int64_t seed) {
        Random random(seed);
        for (auto& gradients : gradients_) {
            for (int i = 0; i < latticeSize; ++i) {
                lattice_[std::size_t(i)] = i;
                // The conversion order of the specification's code: x first.
                const double x = double(random() % (2 * latticeSize) - latticeSize) / latticeSize;
                const double y = double(random() % (2 * latticeSize) - latticeSize) / latticeSize;
                const double length = std::sqrt(x * x + y * y);
                gradients[std::size_t(i)] = length > 0 ? glm::dvec2(x, y) / length : glm::dvec2(0);
            }
        }
        for (int i = latticeSize - 1; i > 0; --i)
            std::swap(lattice_[std::size_t(i)], lattice_[std::size_t(random() % latticeSize)]);
        for (std::size_t i = 0; i < latticeSize + 2; ++i) {
            lattice_[latticeSize + i] = lattice_[i];
            for (auto& gradients : gradients_)
                gradients[latticeSize + i] = gradients[i];
        }
    }

    /// In [-1, 1], of all four channels at once.
    std::array<double, 4> operator()(glm::dvec2 point, const Stitching* stitching) const {
        const Axis x = axis(point.x, stitching ? stitching->width : 0, stitching ? stitching->wrapX : 0),
                   y = axis(point.y, stitching ? stitching->height : 0, stitching ? stitching->wrapY : 0);
        const int left = lattice_[std::size_t(x.low)], right = lattice_[std::size_t(x.high)];
        const auto at = [&](int column, int row) { return std::size_t(lattice_[std::size_t(column + row)]); };
        const std::size_t b00 = at(left, y.low), b10 = at(right, y.low), b01 = at(left, y.high),
                          b11 = at(right, y.high);
        std::array<double, 4> noise{};
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const auto& g = gradients_[channel];
            const auto dot = [](glm::dvec2 a, double u, double v) { return u * a.x + v * a.y; };
            const double top = mix(x.curve, dot(g[b00], x.rest, y.rest), dot(g[b10], x.rest - 1, y.rest));
            const double bottom =
                mix(x.curve, dot(g[b01], x.rest, y.rest - 1), dot(g[b11], x.rest - 1, y.rest - 1));
            noise[channel] = mix(y.curve, top, bottom);
        }
        return noise;
    }

private:
    struct Axis {
        int low, high;
        double rest, curve;
    };

    static Axis axis(double coordinate, int period, int wrap) {
        const double t = coordinate + latticeOffset;
        const auto whole = std::int64_t(t);
        const double rest = t - double(whole);
        std::int64_t low = whole, high = whole + 1;
        if (period > 0) {
            low -= low >= wrap ? period : 0;
            high -= high >= wrap ? period : 0;
        }
        return {int(low & (latticeSize - 1)), int(high & (latticeSize - 1)), rest,
                rest * rest * (3 - 2 * rest)};
    }
    static double mix(double t, double a, double b) { return a + t * (b - a); }

    std::array<int, 2 * latticeSize + 2> lattice_{};
    std::array<std::array<glm::dvec2, 2 * latticeSize + 2>, 4> gradients_{};
};

/// The frequency next to the given one that fits a whole number of times into a length.
double stitched(double frequency, double length) {
    if (frequency == 0 || !(length > 0))
        return frequency;
    const double low = std::floor(length * frequency) / length, high = std::ceil(length * frequency) / length;
    return low > 0 && frequency / low < high / frequency ? low : high;
}

}  // namespace

Layer turbulence(const FilterStep& step) {
    const FilterParameters& p = step.parameters;
    const int octaves = int(p[2]);
    const bool stitches = p[4] != 0, fractal = p[5] != 0;
    glm::dvec2 frequency(p[0], p[1]);
    // Truncated towards zero and kept within the generator's numbers.
    const double seed = std::trunc(double(p[3]));
    const Noise noise(std::int64_t(std::min(std::max(seed, -2147483648.0), 2147483647.0)));
    const PixelRect& region = step.regions[0];
    const glm::dvec2 min = (region.min - step.origin) / step.scale,
                     size = (region.max - region.min) / step.scale;
    Stitching first;
    if (stitches) {
        frequency = {stitched(frequency.x, size.x), stitched(frequency.y, size.y)};
        const auto lattice = [](double v) { return int(std::min(std::max(v, -1e8), 1e8)); };
        first.width = lattice(size.x * frequency.x + 0.5);
        first.height = lattice(size.y * frequency.y + 0.5);
        first.wrapX = lattice(min.x * frequency.x + latticeOffset + first.width);
        first.wrapY = lattice(min.y * frequency.y + latticeOffset + first.height);
    }
    Layer result(step.box, step.linear);
    for (int y = step.box.min.y; y < step.box.max.y && !result.empty(); ++y) {
        limits::check();
        for (int x = step.box.min.x; x < step.box.max.x; ++x) {
            glm::dvec2 at = (glm::dvec2(x + 0.5, y + 0.5) - step.origin) / step.scale * frequency;
            Stitching stitching = first;
            double share = 1;
            std::array<double, 4> sum{};
            for (int octave = 0; octave < octaves && glm::all(glm::lessThan(glm::abs(at), glm::dvec2(1e15)));
                 ++octave) {
                const std::array<double, 4> value = noise(at, stitches ? &stitching : nullptr);
                for (std::size_t c = 0; c < 4; ++c)
                    sum[c] += share * (fractal ? value[c] : std::abs(value[c]));
                at *= 2.0;
                share /= 2;
                stitching = stitching.doubled();
            }
            Float4 color{};
            for (int c = 0; c < 4; ++c)
                color[c] = float(fractal ? (sum[std::size_t(c)] + 1) / 2 : sum[std::size_t(c)]);
            result.row(y)[x - step.box.min.x] = premultiplied(unit(color));
        }
    }
    return result;
}

}  // namespace vtm::asset
