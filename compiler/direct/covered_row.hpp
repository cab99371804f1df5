/// \file
/// A row of squares that layers cover, from the top: what lies below is hidden where no light is left.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "compiler/direct/layer_cover.hpp"

namespace vtm::compiler {

/// Of a row. What is hidden is never looked at again.
struct CoveredSquare {
    LightBelow below;
    std::int32_t next = 0;  ///< a square further right, up to which all are hidden; or itself
};

/// Squares [first, last] that a chain of an outline touches, and what it adds to the winding number on its
/// right.
struct Touch {
    std::int32_t first, last;
    std::int32_t winding;
    bool isEnd = false;  ///< it begins or ends within the row
};

/// Between chains of an outline that begin or end there may be level sides, of which no chain tells: it
/// touches all that lies between its ends. Returns the last square that one of them touches, -1 if there are
/// none.
inline std::int32_t lastOfEnds(std::span<const Touch> touches) {
    std::int32_t last = -1;
    for (const Touch& t : touches)
        if (t.isEnd)
            last = std::max(last, t.last);
    return last;
}

/// A square that no outline of a layer touches is covered by it or not at all.
class CoveredRow {
public:
    /// The last square is beyond the row, and stays open.
    explicit CoveredRow(std::span<CoveredSquare> squares) : squares_(squares) {}

    void clear();
    /// Lays a layer under those before. Touches are sorted by their first squares. Returns whether it shows
    /// anywhere. `stepsLeft`: squares that may still be covered.
    bool add(std::span<const Touch> touches, const LayerCover& cover, bool isEvenOdd, std::size_t& stepsLeft);

private:
    void coverSquares(std::int32_t first, std::int32_t end, const LayerCover& cover, std::size_t& stepsLeft);
    /// The first square, from `column` on, that is not hidden.
    std::int32_t nextOpen(std::int32_t column);
    bool isOpen(std::int32_t first, std::int32_t last) { return nextOpen(first) <= last; }
    CoveredSquare& at(std::int32_t column) { return squares_[std::size_t(column)]; }

    std::span<CoveredSquare> squares_;
};

}  // namespace vtm::compiler
