#include "backend_gl/tiles/tile_windows.hpp"

namespace vtm::gl {

using glm::ivec2;

TileWindows::TileWindows(const Atlas::Region& region, const std::vector<const Placed*>& tiles)
    : size_(ivec2(region.max - region.min) + 1), tiles_(std::size_t((size_.x + 1) * (size_.y + 1))) {
    auto next = tiles.begin();
    for (int y = 1; y < size_.y; ++y)
        for (int x = 1; x < size_.x; ++x) {
            const Placed& tile = **next++;
            tiles_[std::size_t(y * (size_.x + 1) + x)] = &tile;
            for (const CellKind kind : cellKinds)
                if ((tile.kinds >> unsigned(kind) & 1) != 0)
                    putCells(tile.cells[kind], {x, y}, cells_[std::size_t(kind)]);
        }
}

void TileWindows::putCells(const CellSet& cells, ivec2 tile, std::vector<std::uint32_t>& rows) const {
    if (rows.empty())
        rows.resize(rowOf({size_.x, 0}) + 1 + BlockShape::maxRows);
    std::uint32_t *const onTheLeft = rows.data() + rowOf(tile) + 1, *const onTheRight =
                                                                        rows.data() +
                                                                        rowOf(tile - ivec2(1, 0)) + 1;
    for (std::size_t row = 0; row < cells.size(); ++row) {
        onTheLeft[row] |= cells[row];
        onTheRight[row] |= std::uint32_t(cells[row]) << cellsPerTile;
    }
}

}  // namespace vtm::gl
