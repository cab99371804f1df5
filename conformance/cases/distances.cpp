#include "conformance/cases/distances.hpp"

#include <algorithm>
#include <cmath>

#include "conformance/cases/certify.hpp"
#include "conformance/cases/drawn_boundary.hpp"

namespace vtm::cases {
namespace {

using scene::Point;

bool isInside(const scene::Scene& scene, Point p, double margin) {
    return p.x > margin && p.y > margin && p.x < scene.width - margin && p.y < scene.height - margin;
}

/// Whether the true colours on the two sides of an outline differ and nothing else shows within two
/// tolerances. (Threads thinner than the tolerance may vanish.)
bool partsTwoColours(const scene::Scene& scene, const OutlinePoint& p, double tolerance) {
    constexpr int n = 8, margin = 3;  // the columns in between may be of both
    const Window window{p.at, tolerance / 2, n, tolerance, -std::atan2(p.normal.y, p.normal.x)};
    const image::Raster raster = reference::render(scene, {n, n, toPixels(window)}, {.flatness = 1.0 / 64});
    const auto differ = [&](int x, int y, int x0) {
        for (int c = 0; c < 4; ++c)
            if (std::abs(raster.pixel(x, y)[c] - raster.pixel(x0, 0)[c]) > colourBound)
                return true;
        return false;
    };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < margin; ++x)
            if (differ(x, y, 0) || differ(n - 1 - x, y, n - 1))
                return false;
    return differ(0, 0, n - 1);
}

}  // namespace

FarPoints farPoints(const scene::Scene& scene, const asset::Asset& asset, double tolerance,
                    std::uint64_t seed, int points) {
    const Outlines outlines(scene);
    FarPoints found;
    for (const Point& p : DrawnBoundary(asset).somePoints(seed, points)) {
        ++found.looked;
        if (!outlines.isNear(p, tolerance) && !looksEqualAbout(asset, p, tolerance / 8))
            found.at.push_back(p);
    }
    return found;
}

Distances measure(const scene::Scene& scene, const asset::Asset& asset, double tolerance, std::uint64_t seed,
                  int drawn, int truths) {
    constexpr double maximum = 2;  // tolerances
    const Outlines outlines(scene);
    const DrawnBoundary boundary(asset);
    Distances found;
    for (const Point& p : boundary.somePoints(seed, drawn)) {
        ++found.drawn;
        const bool isFarther = found.fromDrawn == 0 || !outlines.isNear(p, found.fromDrawn * tolerance);
        if (isFarther && !looksEqualAbout(asset, p, tolerance / 8))
            found.fromDrawn =
                std::max(found.fromDrawn, outlines.distance(p, maximum * tolerance) / tolerance);
    }
    for (const OutlinePoint& p : outlines.pointsOn(seed, truths))
        if (isInside(scene, p.at, 2 * tolerance) && partsTwoColours(scene, p, tolerance)) {
            found.fromTrue =
                std::max(found.fromTrue, boundary.distance(p.at, maximum * tolerance) / tolerance);
            ++found.truths;
        }
    return found;
}

}  // namespace vtm::cases
