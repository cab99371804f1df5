/// \file
/// A picture's boundaries as one planar map over the whole plane, in exact coordinates: what scanners, tiles
/// and point queries read.
///
/// Leaves are a way to store a picture, and their borders mean nothing to it. What is drawn needs the
/// boundaries alone, and needs them to close: going round any point, the changes of paint must cancel. Inside
/// a leaf the compiler certifies that. Across a border two leaves may disagree by a step of the coarser one,
/// or a leaf may end where the picture does; there the *seams* stand, straight pieces along the border.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

/// The lattice of a map that was made of leaves: steps of a leaf of the deepest level. End points of every
/// level lie on it exactly, and so in a double.
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

/// Where a map's square lies in the picture: from `origin` on, `side` picture units or `extent` lattice
/// steps.
struct MapPlace {
    glm::dvec2 origin{0};
    double side = 0;
    double extent = double(latticeExtent);
};

/// All boundaries in a square of the picture, those with paint 0 around it included; outside lies paint 0.
/// Ends of pieces are whole numbers of lattice steps.
struct PlanarMap : MapPlace {
    std::vector<PlanarPiece> pieces;
};

/// Of the map alone, without those that are placed in it.
PlanarMap planarMap(const AssetView& asset, const Map& map);
/// With all that are placed in it and in each other, their ends rounded to its lattice. Curves that a
/// placement shears are cut into parts within 2^-14 of their chords.
PlanarMap flatPlanarMap(const AssetView& asset, const Map& map);
/// Flat ones, which the asset's commands draw. std::invalid_argument unless it is a sum of maps.
std::vector<PlanarMap> planarMaps(const AssetView& asset);
/// Throws std::invalid_argument unless the asset is a sum of maps.
void requireSumOfMaps(const AssetView& asset);

// ---- Points ---------------------------------------------------------------------------------------

/// A change of paint on the way from one point to another.
struct Change {
    std::uint32_t at;  ///< along a square's side: steps from its first corner
    std::uint32_t before, after;
};

/// The paint behind changes that follow each other in some order, `paint` being before the first: the one
/// that is entered once more often than left.
std::uint32_t paintBehind(std::uint32_t paint, std::span<const Change> changes);

/// Calls visit(from, to, paint) for the stretches of a square's side of `length` steps, from its first corner
/// on, where `corner` is the paint. `changes` ascend.
template <class Visit>
void forEachStretch(std::uint32_t corner, std::span<const Change> changes, std::uint32_t length,
                    Visit&& visit) {
    std::uint32_t from = 0, paint = corner;
    for (std::size_t i = 0; i < changes.size();) {
        std::size_t end = i + 1;
        while (end < changes.size() && changes[end].at == changes[i].at)
            ++end;
        if (changes[i].at > from)
            visit(from, changes[i].at, paint);
        from = changes[i].at;
        paint = paintBehind(paint, changes.subspan(i, end - i));
        i = end;
    }
    if (from < length)
        visit(from, length, paint);
}

/// On the upper border of a square of that extent: just below it, for the row of a point is just above.
inline glm::dvec2 belowTop(glm::dvec2 point, double extent) {
    return {point.x, std::min(point.y, std::nextafter(extent, 0.0))};
}

/// Appends what changes at a piece on the way along a row from its left end to a point. The row is just above
/// the point, so that it has no end points.
void addChanges(const PlanarPiece& piece, glm::dvec2 point, std::vector<Change>& changes);

/// A planar map with its pieces by rows, for asking which paint is at a point.
class PlanarIndex {
public:
    explicit PlanarIndex(PlanarMap map);

    const PlanarMap& map() const { return map_; }
    /// At a point in lattice coordinates; 0 outside the map. Right unless the point is nearer to a boundary
    /// than rounding, some 2^-50 of the map's side; there either side may be told. Proportional to the number
    /// of pieces in a row, about the root of all.
    std::uint32_t paintAt(glm::dvec2 point) const;

private:
    std::size_t rowOf(double y) const;

    PlanarMap map_;
    std::size_t rows_;
    std::vector<std::uint32_t> firsts_, numbers_;  ///< of pieces: those of row r from firsts_[r] on
};

}  // namespace vtm::asset
