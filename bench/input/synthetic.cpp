#include "bench/input/synthetic.hpp"

#include <cmath>
#include <cstdint>

namespace vtm::bench {
namespace {

using scene::Point;

constexpr std::size_t curvesOfBlob = 4;
/// Blobs cover the picture about once: pi · radius² · count = 1, times this.
constexpr double cover = 1;

/// SplitMix64 (Steele, Lea, Flood 2014), to [0, 1).
class Random {
public:
    double operator()() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return std::ldexp(double((z ^ (z >> 31)) >> 11), -53);
    }

private:
    std::uint64_t state_ = 2005;
};

/// A disc of four quarters whose control points are shaken.
scene::Path blob(Random& random, Point centre, double radius) {
    constexpr double kappa = 0.5522847498307936;  // of a quarter circle
    const auto shaken = [&](double x, double y) {
        const Point p{x + 0.4 * (random() - 0.5), y + 0.4 * (random() - 0.5)};
        return centre + radius * p;
    };
    constexpr double quarter[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const Point start = shaken(1, 0);
    scene::Path path{scene::MoveTo{start}};
    for (int k = 0; k < 4; ++k) {
        const auto &a = quarter[k], &b = quarter[(k + 1) % 4];
        const Point c1 = shaken(a[0] + kappa * b[0], a[1] + kappa * b[1]);
        const Point c2 = shaken(b[0] + kappa * a[0], b[1] + kappa * a[1]);
        path.push_back(scene::CubicTo{c1, c2, k == 3 ? start : shaken(b[0], b[1])});
    }
    path.push_back(scene::Close{});
    return path;
}

}  // namespace

scene::Scene syntheticScene(std::size_t curves) {
    Random random;
    const std::size_t blobs = (curves + curvesOfBlob - 1) / curvesOfBlob;
    const double radius = std::sqrt(cover / (3.14159265358979 * double(blobs)));
    scene::Scene scene{1, 1, {}};
    for (std::size_t i = 0; i < blobs; ++i) {
        scene::Item item;
        const double x = random(), y = random();
        item.path = std::make_shared<scene::Path>(blob(random, {x, y}, radius));
        item.geometry = scene::FillRule::NonZero;
        const auto channel = [&] { return float(int(random() * 8)) / 7; };
        const float r = channel(), g = channel(), b = channel();
        item.paint = scene::Color{r, g, b, 1};
        scene.root.children.push_back({item});
    }
    return scene;
}

}  // namespace vtm::bench
