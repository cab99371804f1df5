#include "backend_gl/tiles/tile_pieces.hpp"

#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>

namespace vtm::gl {

namespace {

using asset::cross;
using glm::dvec2;

/// A piece longer than this many tiles is cut into parts, so that end points within reach lie in [-1, 3)
/// and slopes of 12 bits place the curve within 4/27 · 2 / 4094 = 7e-5 of its length.
constexpr double longestPiece = 0.75, longestPart = 0.5;
/// Into at least so many: the part of a cubic over its own chord is a cubic no more, but within L (1/8)^4 · 4
/// / 384 = 2.5e-6 of the length L.
constexpr double minParts = 8;

/// What a curve may leave its tangent by within a pixel, in pixels: the shader looks for the ends of the part
/// in the box on the tangent, and what it misses there is about the square of that.
constexpr double flatEnough = 0.006;

/// The part [s0, s1], by its ends and tangents.
PlanarPiece partOf(const PlanarPiece& p, double s0, double s1) {
    PlanarPiece part = p;
    part.a = p.at(s0);
    part.b = p.at(s1);
    const dvec2 chord = part.b - part.a;
    const auto slope = [&](double s) {
        const dvec2 tangent = p.derivative(s);
        return cross(chord, tangent) / glm::dot(chord, tangent);
    };
    part.slopeA = slope(s0);
    part.slopeB = slope(s1);
    return part;
}

double rounded(double coordinate) {
    return std::ldexp(std::nearbyint(std::ldexp(coordinate, tileStepLog2)), -int(tileStepLog2));
}

}  // namespace

LocalPieces::LocalPieces(double extent, const TilePlace& place, double margin,
                         std::span<const PlanarPiece* const> near)
    : side_(std::ldexp(extent, -place.level)), corner_(dvec2(place.x, place.y) * side_), margin_(margin) {
    for (const PlanarPiece* piece : near)
        add(*piece);
}

PlanarPiece LocalPieces::toTile(const PlanarPiece& piece) const {
    PlanarPiece local = piece;
    local.a = (piece.a - corner_) / side_;
    local.b = (piece.b - corner_) / side_;
    return local;
}

void LocalPieces::add(const PlanarPiece& piece) {
    const PlanarPiece local = toTile(piece);
    const double length = glm::length(local.b - local.a);
    const double parts =
        std::max(length <= longestPiece ? 1.0 : std::max(minParts, std::ceil(length / longestPart)),
                 std::ceil(length / longestBend(local, length)));
    if (parts == 1)
        return addRounded(local);
    for (double i = 0; i < parts; ++i)
        addRounded(partOf(local, i / parts, (i + 1) / parts));
}

/// A length over which the piece bends away from its tangents by no more than the shader may ignore.
double LocalPieces::longestBend(const PlanarPiece& piece, double length) const {
    const double turn = std::abs(piece.slopeA - piece.slopeB) + std::abs(piece.slopeA + piece.slopeB);
    const double pixel = margin_ * std::numbers::sqrt2, curvature = turn / length;
    const double maximum = flatEnough * pixel * 8 / curvature;
    // Within a box of one pixel nothing longer matters.
    return maximum >= pixel * pixel ? HUGE_VAL : std::sqrt(maximum);
}

void LocalPieces::addRounded(PlanarPiece piece) {
    const double reach = margin_ + piece.bulge();
    const dvec2 minimum = glm::min(piece.a, piece.b) - reach, maximum = glm::max(piece.a, piece.b) + reach;
    if (!(minimum.x <= 1 && minimum.y <= 1 && maximum.x >= 0 && maximum.y >= 0))
        return;
    // Both pieces at a point round it alike, so that the map stays closed.
    piece.a = {rounded(piece.a.x), rounded(piece.a.y)};
    piece.b = {rounded(piece.b.x), rounded(piece.b.y)};
    piece.slopeA = slopeSteps(piece.slopeA) / tileSlopeScale;
    piece.slopeB = slopeSteps(piece.slopeB) / tileSlopeScale;
    if (piece.a != piece.b)
        pieces_.push_back(piece);
}

}  // namespace vtm::gl
