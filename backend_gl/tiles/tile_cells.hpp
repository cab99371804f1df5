/// \file
/// The cells of a tile: the points at which their paints are known, their texels, as tile.hpp describes them,
/// and what a pixel of one takes of the driver's turns of loops, at most.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "backend_gl/tiles/tile.hpp"
#include "backend_gl/tiles/tile_pieces.hpp"
#include "raster/planar_map.hpp"
#include "raster/steepness.hpp"

namespace vtm::gl {

using asset::Texel;

/// The first texel of a pair of paints.
Texel colorTexel(const PaintWords& left, const PaintWords& right);
/// A cell's texel with another paint.
Texel withColor(Texel cell, const PaintWords& paint);

/// A cell's point with a known paint; `place` numbers it on the grid of such points, row by row.
struct Reference {
    glm::dvec2 point;
    unsigned place = 0;
    std::uint32_t paint = 0;
};

/// Writes cells, and before them the pairs of paints and the lists.
class CellWriter {
public:
    /// `pieces`, whose numbers are rounded already, `words` and `texels`, which hold what stands before the
    /// pairs, must outlive it. `changes`: by paint.
    CellWriter(const TileWords& words, std::span<const asset::PaintChange> changes,
               const std::vector<PlanarPiece>& pieces, std::vector<Texel>& texels);

    std::uint32_t pairs() const { return pairs_; }
    bool hasRoomFor(std::span<const std::uint32_t> list) const {
        return texels_.size() + list.size() <= 1u << firstTexelBits;
    }
    Texel write(const Reference& reference, std::span<const std::uint32_t> list);
    Texel writeCrowded(const Reference& reference) const;

private:
    Texel withoutList(const Reference& reference) const;

    const TileWords& words_;
    const std::vector<PlanarPiece>& pieces_;
    std::vector<Texel> geometry_;  ///< by piece: its texel, with the pair, but not how a point lies
    std::uint32_t pairs_ = 0;
    std::vector<Texel>& texels_;
};

/// Squared distance from a point to a chord from `a` along `d`.
double distance2(glm::dvec2 a, glm::dvec2 d, double inverseLength2, glm::dvec2 point);

/// The reference point of a cell, as far from its pieces as can be; without its paint.
Reference referenceIn(const CellGrid& grid, int column, int row, const std::vector<PlanarPiece>& pieces,
                      std::span<const std::uint32_t> list);

/// A point of the square from the tile's least corner that pieces run past on the same side whether they
/// are rounded or not, so that its paint is the same among both; nothing where pieces lie too close. `more`:
/// by what else they may have been moved.
std::optional<glm::dvec2> clearPoint(const LocalPieces& local, double side, double more,
                                     std::span<const PlanarPiece* const> near);

/// Of tile_fragment.glsl, for a list of so many pieces.
std::uint64_t solidTurns(std::size_t pieces);

/// What paints cost, by paint.
struct PaintCosts {
    std::span<const std::uint32_t> turns;  ///< of turns.hpp
    std::span<const asset::PaintChange> changes;
    float minSteep = 0;  ///< no pixel of the tile has a smaller one

    bool mayBeSteep(std::uint32_t paint) const { return changes[paint].steepness > minSteep; }
};

/// Of tile_programs_fragment.glsl, for pieces `list` and the paint at the reference point.
std::uint64_t turnsWithPrograms(const PaintCosts& costs, std::uint32_t paint,
                                const std::vector<asset::PlanarPiece>& pieces,
                                std::span<const std::uint32_t> list);

}  // namespace vtm::gl
