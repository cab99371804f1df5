/// \file
/// Which cells the pixels of a block lie in.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "backend_gl/tiles/tile.hpp"

namespace vtm::gl {

/// The tiles that a block may meet, two a side, in cells of the first grid.
inline constexpr int cellsPerWindow = 2 * cellsPerTile;

/// The centres of a block's pixels lie in a parallelogram, which is the same for all blocks of a view. The
/// cells that it meets depend on where in a cell its middle lies: they are found for sixteen squares of that,
/// when a block first needs them, and are a few more.
class BlockShape {
public:
    BlockShape(const glm::dmat2& pixelsToTiles, int blockSide)
        : all_(reach(blockSide) * pixelsToTiles[0], reach(blockSide) * pixelsToTiles[1]),
          halfColumns_(int(std::ceil(all_.half().x))) {}

    /// Half its width and height, cells.
    glm::dvec2 half() const { return all_.half(); }

    /// A block has no more rows: it is a tile high, and its middle may be anywhere in a square.
    static constexpr int maxRows = cellsPerTile + 4;

    /// Where a block lies in a window.
    struct Place {
        const std::array<std::uint32_t, maxRows>* columns;
        int firstRow;  ///< of maxRows, at least -1
        int moved;     ///< columns to the right, at least -1

        /// Of the i-th row: those of the window that the block meets, in which a column is a bit.
        std::uint32_t columnsOf(std::size_t i) const {
            return (*columns)[i] << std::max(moved, 0) >> std::max(-moved, 0);
        }
        /// `rows`: of cells in the window, from firstRow on.
        bool meets(const std::uint32_t* rows) const {
            std::uint32_t met = 0;
            for (std::size_t i = 0; i < maxRows; ++i)
                met |= rows[i] & columnsOf(i);
            return met != 0;
        }
    };
    /// `middle`: the block's, in cells from the window's corner, at least half its size.
    Place placeOf(glm::dvec2 middle) {
        const glm::ivec2 cell(middle), part(double(parts) * (middle - glm::dvec2(cell)));
        std::optional<Cells>& cells = cells_[std::size_t(part.y * parts + part.x)];
        if (!cells)
            cells = cellsOf(dvec2(part) / double(parts));
        return {&cells->columns, cell.y + cells->firstRow, cell.x - halfColumns_};
    }

private:
    using dvec2 = glm::dvec2;

    /// Squares of a cell a side.
    static constexpr int parts = 4;
    /// From the middle to the outermost centres, as if tiles were as wide as cells. Rounding moves pixels by
    /// less than the hundredth.
    static double reach(int blockSide) { return (0.5 * blockSide - 0.5 + 0.01) * cellsPerTile; }

    struct Cells {
        int firstRow = 0;  ///< from the one with the middle
        /// From halfColumns_ to the left of the one with the middle on.
        std::array<std::uint32_t, maxRows> columns{};
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
    Cells cellsOf(dvec2 place) const {
        const dvec2 end = place + 1.0 / parts;
        Cells cells{.firstRow = int(std::floor(place.y - half().y))};
        const int rows = int(std::floor(end.y + half().y)) + 1 - cells.firstRow;
        for (int i = 0; i < rows; ++i) {
            const double low = cells.firstRow + i - end.y, high = cells.firstRow + i + 1 - place.y;
            const int first = int(std::floor(place.x - all_.farthest(-high, -low))) + halfColumns_,
                      last = int(std::floor(end.x + all_.farthest(low, high))) + halfColumns_;
            cells.columns[std::size_t(i)] =
                (~std::uint32_t(0) << first) & (~std::uint32_t(0) >> (cellsPerWindow - 1 - last));
        }
        return cells;
    }

    Parallelogram all_;
    int halfColumns_;
    std::array<std::optional<Cells>, parts * parts> cells_;
};

}  // namespace vtm::gl
