/// \file
/// A map's pieces without its leaves: one planar map over the whole plane, in exact coordinates.
///
/// Leaves are a way to store a picture, and their borders mean nothing to it. What is drawn needs the
/// boundaries alone, and needs them to close: going round any point, the changes of paint must cancel. Inside
/// a leaf the compiler certifies that. Across a border two leaves may disagree by a step of the coarser one,
/// or a leaf may end where the picture does; there the *seams* stand, straight pieces along the border.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

/// Lattice coordinates: steps of a leaf of the deepest level, 0 to latticeExtent from one border of the
/// map to the other. End points of every level lie on it exactly, and so in a double.
inline constexpr std::int64_t latticeExtent = std::int64_t(leafExtent) << (2 * maxLevel);

/// Where a point lies. Beyond the ends of a piece both are the chord's.
struct Sides {
    bool leftOfChord, leftOfCurve;
};

/// Piece in lattice coordinates, or in others.
struct PlanarPiece {
    glm::dvec2 a, b;
    double slopeA = 0, slopeB = 0;
    std::uint32_t left = 0, right = 0;

    /// t(s) of Piece, in chord lengths, and its derivatives.
    double height(double s) const { return s * (1 - s) * (slopeA * (1 - s) - slopeB * s); }
    double slope(double s) const { return slopeA * (1 - s) * (1 - 3 * s) - slopeB * s * (2 - 3 * s); }
    double bend(double s) const { return slopeA * (6 * s - 4) + slopeB * (6 * s - 2); }
    /// The ends exactly.
    glm::dvec2 at(double s) const;
    glm::dvec2 derivative(double s) const;
    Sides sidesOf(glm::dvec2 point) const;
    /// No point of the curve is further from the chord, in its units.
    double bulge() const;
};

/// In leaf coordinates.
PlanarPiece planarPiece(const Piece& piece);

inline double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// A change of paint on the way from one point to another.
struct Change {
    std::uint32_t at;  ///< along a leaf's side: leaf steps from its first corner
    std::uint32_t before, after;
};

/// The paint behind changes that follow each other in some order, `paint` being before the first: the one
/// that is entered once more often than left.
std::uint32_t paintBehind(std::uint32_t paint, std::span<const Change> changes);

/// All of a map's boundaries, those with paint 0 around it included; outside the map lies paint 0.
std::vector<PlanarPiece> planarPieces(const AssetView& asset, const Map& map);

/// The paint at a point, lattice coordinates. Its y must not be that of any end point or corner: take one
/// that is no whole number. `near`: at least the pieces with the point between curve and chord.
std::uint32_t paintAt(const AssetView& asset, const Map& map, glm::dvec2 point,
                      std::span<const PlanarPiece* const> near);

}  // namespace vtm::asset
