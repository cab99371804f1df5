/// \file
/// The tiles of a view, two by two, as a block meets them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "backend_gl/tiles/atlas.hpp"
#include "backend_gl/tiles/block_shape.hpp"

namespace vtm::gl {

class TileWindows {
public:
    using Placed = Atlas::Placed;

    /// `tiles`: row by row, as many as lie in the region.
    TileWindows(const Atlas::Region& region, const std::vector<const Placed*>& tiles);

    /// Windows: their first tiles may lie one tile before the region.
    glm::ivec2 size() const { return size_; }
    /// Of one the four tiles, row by row; null: beyond the region.
    std::array<const Placed*, 4> tilesAt(glm::ivec2 window) const {
        const Placed* const* const first = tiles_.data() + window.y * (size_.x + 1) + window.x;
        return {first[0], first[1], first[size_.x + 1], first[size_.x + 2]};
    }
    /// Whether a block meets cells of a kind. Only if there are some in the window.
    bool meets(glm::ivec2 window, CellKind kind, const BlockShape::Place& place) const {
        return place.meets(cells_[std::size_t(kind)].data() + rowOf(window) +
                           std::size_t(place.firstRow + 1));
    }

private:
    std::size_t rowOf(glm::ivec2 window) const {
        return std::size_t((window.x * (size_.y + 1) + window.y) * cellsPerTile);
    }
    void putCells(const CellSet& cells, glm::ivec2 tile, std::vector<std::uint32_t>& rows) const;

    glm::ivec2 size_;
    std::vector<const Placed*> tiles_;  ///< with a border of null
    /// By kind, if there are any: columns of windows, in each the rows of all its cells, so that those of a
    /// window follow each other. A row stands before all of them, and as many as a block may have behind.
    std::array<std::vector<std::uint32_t>, std::size(cellKinds)> cells_;
};

}  // namespace vtm::gl
