// Filter Effects Module Level 1, section 9.21: Perlin's noise, with the specification's random numbers.

#include <array>
#include <cmath>
#include <cstdint>

#include "conformance/reference/filter/operations.hpp"

namespace vtm::reference {
namespace {

constexpr int size = 256, mask = size - 1, perlinN = 4096;

struct Tables {
    std::array<int, 2 * size + 2> selector{};
    std::array<std::array<std::array<double, 2>, 2 * size + 2>, 4> gradient{};

    explicit Tables(std::int64_t seed) {
        constexpr std::int64_t m = 2147483647, a = 16807, q = 127773, r = 2836;
        if (seed <= 0)
            seed = -(seed % (m - 1)) + 1;
        if (seed > m - 1)
            seed = m - 1;
        const auto random = [&] {
            std::int64_t next = a * (seed % q) - r * (seed / q);
            if (next <= 0)
                next += m;
            return seed = next;
        };
        for (auto& channel : gradient)
            for (int i = 0; i < size; ++i) {
                selector[std::size_t(i)] = i;
                auto& g = channel[std::size_t(i)];
                for (double& part : g)
                    part = double(random() % (size + size) - size) / size;
                const double length = std::hypot(g[0], g[1]);
                if (length > 0)
                    for (double& part : g)
                        part /= length;
            }
        for (int i = size - 1; i > 0; --i)
            std::swap(selector[std::size_t(i)], selector[std::size_t(random() % size)]);
        for (std::size_t i = 0; i < size + 2; ++i) {
            selector[size + i] = selector[i];
            for (auto& channel : gradient)
                channel[size + i] = channel[i];
        }
    }
};

struct Stitch {
    int width, height, wrapX, wrapY;
};

double noise(const Tables& tables, std::size_t channel, double x, double y, const Stitch* stitch) {
    const auto split = [](double v, std::int64_t& low, double& rest) {
        const double t = v + perlinN;
        low = std::int64_t(t);
        rest = t - double(low);
    };
    std::int64_t bx0, by0;
    double rx0, ry0;
    split(x, bx0, rx0);
    split(y, by0, ry0);
    std::int64_t bx1 = bx0 + 1, by1 = by0 + 1;
    if (stitch) {
        bx0 -= bx0 >= stitch->wrapX ? stitch->width : 0;
        bx1 -= bx1 >= stitch->wrapX ? stitch->width : 0;
        by0 -= by0 >= stitch->wrapY ? stitch->height : 0;
        by1 -= by1 >= stitch->wrapY ? stitch->height : 0;
    }
    const auto at = [&](std::int64_t column, std::int64_t row) -> const std::array<double, 2>& {
        const int i = tables.selector[std::size_t(column & mask)];
        return tables.gradient[channel][std::size_t(tables.selector[std::size_t(i + int(row & mask))])];
    };
    const auto curve = [](double t) { return t * t * (3 - 2 * t); };
    const auto lerp = [](double t, double a, double b) { return a + t * (b - a); };
    const auto dot = [](const std::array<double, 2>& g, double u, double v) { return u * g[0] + v * g[1]; };
    const double sx = curve(rx0), sy = curve(ry0);
    const double top = lerp(sx, dot(at(bx0, by0), rx0, ry0), dot(at(bx1, by0), rx0 - 1, ry0));
    const double bottom = lerp(sx, dot(at(bx0, by1), rx0, ry0 - 1), dot(at(bx1, by1), rx0 - 1, ry0 - 1));
    return lerp(sy, top, bottom);
}

/// So that a whole number of periods fits into a length.
double fitted(double frequency, double length) {
    if (frequency == 0)
        return 0;
    const double low = std::floor(length * frequency) / length, high = std::ceil(length * frequency) / length;
    return low > 0 && frequency / low < high / frequency ? low : high;
}

}  // namespace

Pixels operate(const scene::TurbulenceFilter& f, const Reading& in, Pixels result) {
    const Tables tables(f.seed);
    const glm::dvec2 corner = (in.regions[0].min - in.frame.origin) / in.frame.scale,
                     extent = (in.regions[0].max - in.regions[0].min) / in.frame.scale;
    double fx = f.frequencyX, fy = f.frequencyY;
    Stitch first{};
    if (f.stitch) {
        fx = fitted(fx, extent.x);
        fy = fitted(fy, extent.y);
        first.width = int(extent.x * fx + 0.5);
        first.height = int(extent.y * fy + 0.5);
        first.wrapX = int(corner.x * fx + perlinN + first.width);
        first.wrapY = int(corner.y * fy + perlinN + first.height);
    }
    result.fill([&](int x, int y) {
        const glm::dvec2 point = (glm::dvec2(x + 0.5, y + 0.5) - in.frame.origin) / in.frame.scale;
        Colour colour;
        for (int channel = 0; channel < 4; ++channel) {
            double sum = 0, ratio = 1, vx = point.x * fx, vy = point.y * fy;
            Stitch stitch = first;
            for (int octave = 0; octave < f.octaves; ++octave) {
                const double n = noise(tables, std::size_t(channel), vx, vy, f.stitch ? &stitch : nullptr);
                sum += (f.fractalNoise ? n : std::abs(n)) / ratio;
                vx *= 2;
                vy *= 2;
                ratio *= 2;
                stitch = {2 * stitch.width, 2 * stitch.height, 2 * stitch.wrapX - perlinN,
                          2 * stitch.wrapY - perlinN};
            }
            colour[channel] = std::min(1.0, std::max(0.0, f.fractalNoise ? (sum + 1) / 2 : sum));
        }
        return Colour(colour.r * colour.a, colour.g * colour.a, colour.b * colour.a, colour.a);
    });
    return result;
}

}  // namespace vtm::reference
