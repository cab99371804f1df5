/// \file
/// An outline in a tile in; out comes the outline of all tiles of a fill, so that what repeats is one layer.
///
/// Where tiles meet, edges along their borders that run against each other are left out, and contours go on
/// from tile to tile. So lines across tiles become long lines, and tiles that are filled the box around all
/// of them.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include <vtm/scene/affine.hpp>
#include "compiler/lower/lattice.hpp"
#include "compiler/lower/outline.hpp"
#include "compiler/patterns/tile_range.hpp"

namespace vtm::compiler {

/// Tiles on a lattice of their own, on which each is a square. Tile (x, y) spans [x side, (x + 1) side] ×
/// [y side, (y + 1) side].
struct Tiling {
    Coord side = 0;              ///< even
    std::vector<TileSpan> rows;  ///< tiles that are seen, in rows from 0 on
    scene::Affine toOutside;     ///< to steps of the lattice around them

    glm::dvec2 tileMin() const { return {0, 0}; }
    glm::dvec2 tileMax() const { return {side, side}; }
};

/// Appends the outline of all tiles. `tile`: of tile (0, 0), cut at its borders as addOutline() does. What
/// lies beyond the box outside is moved onto its border.
void addTiled(Outlines& outlines, const Outlines& tile, const Tiling& tiling, glm::dvec2 clampMin,
              glm::dvec2 clampMax);

}  // namespace vtm::compiler
