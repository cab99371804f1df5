#include "conformance/cases/distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "asset/instances.hpp"
#include "asset/walk.hpp"
#include "conformance/cases/asset_properties.hpp"
#include "conformance/cases/certify.hpp"

namespace vtm::cases {

using glm::dvec2;

dvec2 DrawnBoundary::Curve::at(double s) const {
    const double t = s * (1 - s) * (slopeA * (1 - s) - slopeB * s);
    return a + s * ab + t * across;
}

dvec2 DrawnBoundary::Curve::derivative(double s) const {
    const double t = slopeA * (1 - s) * (1 - 3 * s) - slopeB * s * (2 - 3 * s);
    return ab + t * across;
}

/// Newton's steps from the foot on the chord: pieces are nearly straight.
double DrawnBoundary::Curve::distance(dvec2 from) const {
    constexpr int steps = 12;
    double s = 0, best = std::min(glm::distance(from, at(0)), glm::distance(from, at(1)));
    if (const double length2 = glm::dot(ab, ab); length2 > 0)
        s = std::clamp(glm::dot(from - a, ab) / length2, 0.0, 1.0);
    for (int i = 0; i < steps; ++i) {
        best = std::min(best, glm::distance(from, at(s)));
        const dvec2 along = derivative(s);
        s = std::clamp(s + glm::dot(from - at(s), along) / glm::dot(along, along), 0.0, 1.0);
    }
    return best;
}

DrawnBoundary::DrawnBoundary(const asset::Asset& asset) {
    for (const asset::Command& command : asset.commands)
        asset::forEachMap(asset, asset.maps[command.map], [&](const asset::PlacedMap& placed) {
            add(asset, placed);
            return true;
        });
}

void DrawnBoundary::add(const asset::Asset& asset, const asset::PlacedMap& placed) {
    constexpr double scale{asset::slopeScale};
    const asset::Map& map = placed.map;
    const auto toPicture = [&](dvec2 p) { return placed.toPicture((p - dvec2(map.x, map.y)) / map.side); };
    const glm::dmat2 linear = placed.toPicture.linear * (1 / map.side);
    const auto addCurve = [&](dvec2 a, dvec2 b, double slopeA, double slopeB) {
        const dvec2 ab = b - a;
        curves_.push_back({toPicture(a), linear * ab, linear * dvec2(-ab.y, ab.x), slopeA, slopeB});
    };
    asset::walk(asset, map.root, [&](asset::Cell cell, asset::Entry entry) {
        if (entry.kind() != asset::Entry::Kind::Leaf)
            return;
        const double side = std::ldexp(map.side, -2 * int(cell.level)), step = side / asset::leafExtent;
        const dvec2 corner = dvec2(map.x, map.y) + side * dvec2(cell.x, cell.y);
        const asset::Leaf& leaf = asset.leaves[entry.payload()];
        for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
            const asset::Piece& p = asset.pieces[leaf.firstPiece + i];
            const dvec2 a = corner + step * dvec2(p.a[0], p.a[1]), b = corner + step * dvec2(p.b[0], p.b[1]);
            addCurve(a, b, p.slopeA / scale, p.slopeB / scale);
            if (asset::sideOf(p.a) >= 0)
                crossings_.push_back(toPicture(a));
            if (asset::sideOf(p.b) >= 0)
                crossings_.push_back(toPicture(b));
        }
    });
    for (const BorderGap& gap : borderGaps(asset, map, 0))
        addCurve(gap.from, gap.to, 0, 0);
}

double DrawnBoundary::distance(dvec2 from, double maximum) const {
    double best = std::numeric_limits<double>::infinity();
    for (const Curve& curve : curves_) {
        // Slopes within tan 22.5° keep the curve within an eighth of `across` of the chord.
        const dvec2 b = curve.a + curve.ab,
                    off = glm::max(glm::min(curve.a, b) - from, from - glm::max(curve.a, b));
        if (std::max(off.x, off.y) <= maximum + glm::length(curve.across) / 8)
            best = std::min(best, curve.distance(from));
    }
    return best <= maximum ? best : std::numeric_limits<double>::infinity();
}

std::vector<dvec2> DrawnBoundary::somePoints(std::uint64_t seed, int count) const {
    std::mt19937_64 random(seed);
    std::vector<dvec2> points;
    for (int i = 0; i < count && !curves_.empty(); ++i) {
        const Curve& curve = curves_[random() % curves_.size()];
        points.push_back(curve.at(std::ldexp(double(random() >> 11), -53)));
    }
    return points;
}

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
