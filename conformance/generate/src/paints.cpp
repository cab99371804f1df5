#include "conformance/generate/src/paints.hpp"

#include <numbers>

namespace vtm::generate {
namespace {

using namespace scene;

constexpr double gradients = 0.15;  ///< share of all paints

Color randomColor(Random& random) {
    const auto channel = [&] { return float(random.integer(0, 255)) / 255; };
    Color color{channel(), channel(), channel(), 1};
    if (random.chance(0.4))
        color.a = channel();
    return color;
}

/// Few and apart from each other, so that they vary little in a small part of the picture, and ending as they
/// begin, so that no spread makes a sharp edge.
std::vector<GradientStop> randomStops(Random& random) {
    const Color ends = randomColor(random);
    std::vector<GradientStop> stops{{0, ends}};
    const int between = random.integer(1, 2);
    for (int i = 1; i <= between; ++i)
        stops.push_back({float(i) / float(between + 1), randomColor(random)});
    stops.push_back({1, ends});
    return stops;
}

}  // namespace

scene::Paint randomPaint(Random& random, double side) {
    if (!random.chance(gradients))
        return randomColor(random);
    const Point centre = random.point(0, side);
    const double reach = random.uniform(0.5, 1.5) * side, angle = random.uniform(0, 2 * std::numbers::pi);
    if (random.chance(0.5))
        return LinearGradient{centre, centre + reach * Point(std::cos(angle), std::sin(angle)),
                              randomStops(random), random.any(Spread::Repeat)};
    return RadialGradient{centre,
                          reach,
                          centre + random.point(-0.3 * reach, 0.3 * reach),
                          0,
                          randomStops(random),
                          random.any(Spread::Repeat)};
}

}  // namespace vtm::generate
