#include "conformance/cases/drawn_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "asset/walk.hpp"
#include "conformance/cases/asset_properties.hpp"

namespace vtm::cases {

using glm::dvec2;

dvec2 DrawnBoundary::Curve::at(double s) const {
    const double t = s * (1 - s) * (slopeA * (1 - s) - slopeB * s);
    return a + s * ab + t * dvec2(-ab.y, ab.x);
}

dvec2 DrawnBoundary::Curve::derivative(double s) const {
    const double t = slopeA * (1 - s) * (1 - 3 * s) - slopeB * s * (2 - 3 * s);
    return ab + t * dvec2(-ab.y, ab.x);
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
    constexpr double scale{asset::slopeScale};
    for (const asset::Map& map : asset.maps) {
        asset::walk(asset, map.root, [&](asset::Cell cell, asset::Entry entry) {
            if (entry.kind() != asset::Entry::Kind::Leaf)
                return;
            const double side = std::ldexp(map.side, -2 * int(cell.level)), step = side / asset::leafExtent;
            const dvec2 corner = dvec2(map.x, map.y) + side * dvec2(cell.x, cell.y);
            const asset::Leaf& leaf = asset.leaves[entry.payload()];
            for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
                const asset::Piece& p = asset.pieces[leaf.firstPiece + i];
                const dvec2 a = corner + step * dvec2(p.a[0], p.a[1]),
                            b = corner + step * dvec2(p.b[0], p.b[1]);
                curves_.push_back({a, b - a, p.slopeA / scale, p.slopeB / scale});
                if (asset::sideOf(p.a) >= 0)
                    crossings_.push_back(a);
                if (asset::sideOf(p.b) >= 0)
                    crossings_.push_back(b);
            }
        });
        for (const BorderGap& gap : borderGaps(asset, map, 0))
            curves_.push_back({gap.from, gap.to - gap.from, 0, 0});
    }
}

double DrawnBoundary::distance(dvec2 from, double maximum) const {
    double best = std::numeric_limits<double>::infinity();
    for (const Curve& curve : curves_) {
        // Slopes within tan 22.5° keep the curve within an eighth of its length of the chord.
        const dvec2 b = curve.a + curve.ab,
                    off = glm::max(glm::min(curve.a, b) - from, from - glm::max(curve.a, b));
        if (std::max(off.x, off.y) <= maximum + glm::length(curve.ab) / 8)
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

}  // namespace vtm::cases
