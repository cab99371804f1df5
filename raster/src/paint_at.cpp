#include <vtm/raster/paint_at.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "asset/walk.hpp"
#include "raster/planar_map.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;

/// The way from a point to a corner of its leaf.
struct Way {
    dvec2 from, along;

    /// Of a point of a curve: on which side of the way it lies.
    double side(dvec2 p) const { return cross(along, p - from); }
    /// 0 at `from`, 1 at the corner.
    double place(dvec2 p) const { return glm::dot(p - from, along) / glm::dot(along, along); }
};

/// Parameters that split [0, 1] into parts on which side(curve.at(s)) is monotone: the roots of its
/// derivative, a quadratic.
std::array<double, 4> monotoneParts(const PlanarPiece& curve, const Way& way) {
    // side' = cross(along, chord) + cross(along, normal) (mA (1 - 4s + 3s²) - mB (2s - 3s²))
    const dvec2 chord = curve.b - curve.a;
    const double n = cross(way.along, dvec2(-chord.y, chord.x));
    const double c = cross(way.along, chord) + n * curve.slopeA;
    const double halfB = -n * (2 * curve.slopeA + curve.slopeB), a = 3 * n * (curve.slopeA + curve.slopeB);
    std::array<double, 4> parts{0, 0, 1, 1};
    const double discriminant = halfB * halfB - a * c;
    if (discriminant <= 0)
        return parts;
    const double q = -(halfB + std::copysign(std::sqrt(discriminant), halfB));
    const auto within = [](double s) { return std::isfinite(s) && s > 0 && s < 1; };
    const double one = q / a, other = c / q;
    parts[1] = within(one) ? one : 0;
    parts[2] = within(other) ? other : 1;
    std::ranges::sort(parts);
    return parts;
}

/// Where the way is crossed between s0 and s1, whose sides differ.
double crossing(const PlanarPiece& curve, const Way& way, double s0, double s1) {
    const bool first = way.side(curve.at(s0)) >= 0;
    // Doubles have no more than some 60 steps between them.
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (s0 + s1);
        ((way.side(curve.at(middle)) >= 0) == first ? s0 : s1) = middle;
    }
    return 0.5 * (s0 + s1);
}

struct Found {
    std::uint32_t paint;
    /// How far the decision is from one that rounding could turn: the larger the better, at most 1.
    double sureness;
};

/// The paint at the beginning of a way that ends in `corner` paint: what the nearest piece on the way says.
Found paintOnWay(std::span<const Piece> pieces, const Way& way, std::uint32_t corner) {
    Found found{corner, 1};
    double nearest = 1;
    for (const Piece& piece : pieces) {
        const PlanarPiece curve = planarPiece(piece);
        const std::array<double, 4> parts = monotoneParts(curve, way);
        for (std::size_t i = 0; i < 3; ++i) {
            if (parts[i] == parts[i + 1] ||
                (way.side(curve.at(parts[i])) >= 0) == (way.side(curve.at(parts[i + 1])) >= 0))
                continue;
            const double s = crossing(curve, way, parts[i], parts[i + 1]), place = way.place(curve.at(s));
            if (place < 0 || place >= nearest)
                continue;
            nearest = place;
            const dvec2 direction = curve.derivative(s);
            const double sine = cross(direction, -way.along) /
                                std::sqrt(glm::dot(direction, direction) * glm::dot(way.along, way.along));
            found.paint = sine > 0 ? piece.left : piece.right;
            // Ends, where several pieces meet, and grazed curves are the places to avoid.
            found.sureness = std::min(std::abs(sine), 4 * std::min(s, 1 - s));
        }
    }
    return found;
}

std::uint32_t paintInLeaf(const AssetView& asset, const Leaf& leaf, dvec2 point) {
    const std::span<const Piece> pieces = asset.pieces.subspan(leaf.firstPiece, leaf.pieceCount);
    const std::array<dvec2, 4> corners{dvec2(0, 0), dvec2(leafExtent, 0), dvec2(leafExtent, leafExtent),
                                       dvec2(0, leafExtent)};
    Found best{0, -1};
    for (std::size_t k = 0; k < 4; ++k) {
        const Way way{point, corners[k] - point};
        if (way.along == dvec2(0))
            return leaf.corners[k];
        const Found found = paintOnWay(pieces, way, leaf.corners[k]);
        if (found.sureness > best.sureness)
            best = found;
    }
    return best.paint;
}

}  // namespace

std::uint32_t paintAt(const AssetView& asset, dvec2 point) {
    if (!isSumOfMaps(asset))
        throw std::invalid_argument("a compat asset has layers, not regions");
    for (const Command& command : asset.commands) {
        const Map& map = asset.maps[command.map];
        const dvec2 p = (point - dvec2(map.x, map.y)) / map.side;
        if (!(p.x >= 0 && p.y >= 0 && p.x <= 1 && p.y <= 1))
            continue;
        const auto [cell, entry, within] = squareAt(asset, map.root, p);
        return entry.kind() == Entry::Kind::Solid
                   ? entry.payload()
                   : paintInLeaf(asset, asset.leaves[entry.payload()], within * double(leafExtent));
    }
    return 0;
}

}  // namespace vtm::asset
