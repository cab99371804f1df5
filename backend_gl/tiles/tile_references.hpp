/// \file
/// Points of a tile at which paints are known, or can be.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "backend_gl/tiles/tile_pieces.hpp"
#include "backend_gl/tiles/tile_texels.hpp"

namespace vtm::gl {

/// Squared distance from a point to a chord from `a` along `d`.
double distance2(glm::dvec2 a, glm::dvec2 d, double inverseLength2, glm::dvec2 point);

/// The reference point of a cell, as far from its pieces as can be; without its paint.
Reference referenceIn(int column, int row, const std::vector<PlanarPiece>& pieces,
                      std::span<const std::uint32_t> list);

/// A point of the square from the tile's least corner that pieces run past on the same side whether they
/// are rounded or not, so that its paint is the same among both; nothing where pieces lie too close.
std::optional<glm::dvec2> clearPoint(const LocalPieces& local, double side,
                                     std::span<const PlanarPiece* const> near);

}  // namespace vtm::gl
