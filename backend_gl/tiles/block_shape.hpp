/// \file
/// Which cells the pixels of a block lie in.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "backend_gl/tiles/tile.hpp"

namespace vtm::gl {

/// The tiles that a block may meet, two a side, in cells of the first grid.
inline constexpr int cellsPerWindow = 2 * cellsPerTile;

/// The centres of a block's pixels lie in a parallelogram, which is the same for all blocks of a view. The
/// cells that it meets depend on where in a cell its middle lies: they are found for sixteen squares of that,
/// and are a few more.
class BlockShape {
public:
    explicit BlockShape(const glm::dmat2& pixelsToTiles) {
        const Parallelogram all(reach * pixelsToTiles[0], reach * pixelsToTiles[1]);
        half_ = all.half();
        for (std::size_t i = 0; i < cells_.size(); ++i)
            cells_[i] = cellsOf(all, dvec2(i % places, i / places) / double(places));
    }

    /// Half its width and height, cells.
    glm::dvec2 half() const { return half_; }

    /// Calls visit(row, columns) for each row of the window that a block meets, in which a column is a bit.
    /// `middle`: the block's, in cells from the window's corner, at least half its size.
    template <class Visit>
    void forEachRow(glm::dvec2 middle, Visit&& visit) const {
        const glm::ivec2 cell(middle), place(double(places) * (middle - glm::dvec2(cell)));
        const Cells& cells = cells_[std::size_t(place.y * places + place.x)];
        const int first = std::max(cell.y + cells.firstRow, 0),
                  end = std::min(cell.y + cells.endRow, cellsPerWindow);
        for (int row = first; row < end; ++row) {
            const std::uint64_t columns = cells.columns[std::size_t(row - cell.y + centre)];
            visit(row, std::uint32_t(columns << cell.x >> centre));
        }
    }

private:
    using dvec2 = glm::dvec2;

    /// Squares of a cell a side.
    static constexpr int places = 4;
    /// From the middle to the outermost centres, as if tiles were as wide as cells. Rounding moves pixels by
    /// less than the hundredth.
    static constexpr double reach = (0.5 * blockSide - 0.5 + 0.01) * cellsPerTile;
    /// Of the cells around the one with the middle: its column and row. A block reaches less than half a tile
    /// and a cell from there.
    static constexpr int centre = cellsPerTile;

    struct Cells {
        int firstRow = 0, endRow = 0;  ///< from the one with the middle
        std::array<std::uint32_t, 2 * centre> columns{};
    };

    /// Around the origin.
    class Parallelogram {
    public:
        /// x and y: from the middle to those of the sides.
        Parallelogram(dvec2 x, dvec2 y) : half_(glm::abs(x) + glm::abs(y)) {
            cornerHeight_ = (x.x >= 0 ? x.y : -x.y) + (y.x >= 0 ? y.y : -y.y);
            const double area = std::abs(x.x * y.y - x.y * y.x);
            sides_ = {along(x, area), along(y, area)};
        }
        dvec2 half() const { return half_; }
        /// The largest x between two heights, which grows up to a corner and falls behind it. The smallest
        /// one is that of the opposite heights, with the other sign.
        double farthest(double low, double high) const {
            const double y = std::clamp(cornerHeight_, std::max(low, -half_.y), std::min(high, half_.y));
            return std::min({half_.x, sides_[0].at(y), sides_[1].at(y)});
        }

    private:
        /// Points on one side of it have x <= far + slope y.
        struct Side {
            double far = HUGE_VAL, slope = 0;
            double at(double y) const { return far + y * slope; }
        };
        /// `area`: a quarter of the parallelogram's.
        static Side along(dvec2 d, double area) {
            return d.y == 0 ? Side() : Side{area / std::abs(d.y), d.x / d.y};
        }

        dvec2 half_;
        double cornerHeight_;  ///< of that furthest to the right
        std::array<Side, 2> sides_;
    };

    /// With the middle in the square from `place` on.
    static Cells cellsOf(const Parallelogram& all, dvec2 place) {
        const dvec2 end = place + 1.0 / places;
        Cells cells;
        cells.firstRow = int(std::floor(place.y - all.half().y));
        cells.endRow = int(std::floor(end.y + all.half().y)) + 1;
        for (int row = cells.firstRow; row < cells.endRow; ++row) {
            const double low = row - end.y, high = row + 1 - place.y;
            const int first = int(std::floor(place.x - all.farthest(-high, -low))) + centre,
                      last = int(std::floor(end.x + all.farthest(low, high))) + centre;
            cells.columns[std::size_t(row + centre)] =
                (~std::uint32_t(0) << first) & (~std::uint32_t(0) >> (31 - last));
        }
        return cells;
    }

    dvec2 half_;
    std::array<Cells, places * places> cells_;
};

}  // namespace vtm::gl
