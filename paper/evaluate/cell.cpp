// Strict cells of the paper mode: rows 1, 2 and 6.

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "paper/evaluate.hpp"

namespace vtm::paper {

namespace {

using glm::dvec2;

dvec2 decode(const std::array<std::uint16_t, 2>& p) { return dvec2(p[0], p[1]) / cellExtent; }

struct Cubic {
    double value, slope;
};

/// The Hermite function with slopes mA and mB; beyond [0, 1] it would diverge, so its tangents go on.
Cubic hermite(double mA, double mB, double u) {
    if (u < 0)
        return {mA * u, mA};
    if (u > 1)
        return {mB * (u - 1), mB};
    const double w = 1 - u;
    return {mA * u * w * w - mB * u * u * w, mA * w * (1 - 3 * u) - mB * u * (2 - 3 * u)};
}

double distanceTo(const Piece& piece, dvec2 point, const glm::dmat2& inverseTransposed) {
    const Value f = implicitValue(piece, point);
    return -f.value / glm::length(inverseTransposed * f.gradient);
}

}  // namespace

Value implicitValue(const Piece& piece, dvec2 point) {
    const dvec2 a = decode(piece.a), chord = decode(piece.b) - a;
    const dvec2 along = chord / glm::dot(chord, chord), across(-along.y, along.x), p = point - a;
    const Cubic t = hermite(piece.slopeA / slopeScale, piece.slopeB / slopeScale, glm::dot(p, along));
    return {glm::dot(p, across) - t.value, across - t.slope * along};
}

Piece reversed(const Piece& piece) { return {piece.b, piece.a, piece.slopeB, piece.slopeA}; }

double signedDistance(const Cell& cell, dvec2 point, const glm::dmat2& toPixels) {
    const glm::dmat2 inverseTransposed = glm::transpose(glm::inverse(toPixels));
    const double h = distanceTo(cell.pieces[0], point, inverseTransposed);
    if (cell.count < 2)
        return h;
    const double other = distanceTo(cell.pieces[1], point, inverseTransposed);
    return cell.combine == Operator::Intersection ? std::max(h, other) : -std::max(-h, -other);
}

}  // namespace vtm::paper
