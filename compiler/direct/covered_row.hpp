/// \file
/// A row of squares that layers cover, from the top: what lies below is hidden where no light is left.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/direct/layer_cover.hpp"

namespace vtm::compiler {

/// Squares [first, last] that a chain of an outline touches, none if last < first, and what it adds to the
/// winding number on its right.
struct Touch {
    std::int32_t first, last;
    std::int32_t winding;
    bool isEnd = false;  ///< it begins or ends within the row

    /// Left of all squares.
    static Touch before(std::int32_t winding, bool isEnd) { return {0, -1, winding, isEnd}; }
    /// Right of so many squares.
    static Touch behind(std::int32_t squares, std::int32_t winding, bool isEnd) {
        return {squares, squares - 1, winding, isEnd};
    }
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

/// A square that no outline of a layer touches is covered by it or not at all. Squares that are covered alike
/// are covered by the block.
class CoveredRow {
public:
    /// All are open.
    explicit CoveredRow(std::int32_t squares = 0);

    void clear();
    std::int32_t squares() const { return squares_; }
    /// Whether nothing shows of what is laid under all layers so far.
    bool isHidden() { return !isOpen(0, squares_ - 1); }
    /// Lays a layer under those before. Touches are sorted by their first squares. Returns whether it shows
    /// anywhere. `stepsLeft`: so many times squares of a block may still be covered.
    bool add(std::span<const Touch> touches, const LayerCover& cover, bool isEvenOdd, std::size_t& stepsLeft);

private:
    static constexpr std::int32_t blockSquares = 64;

    struct Block {
        float light = 1;           ///< what comes through all of its squares, times what comes through each
        float most = 1;            ///< that comes through one of them
        float openAt = -1;         ///< the light at which `open` was found
        std::uint64_t open = 0;    ///< a bit a square: it is not hidden
        bool isCovered = false;    ///< in part; else nothing is kept of single squares
        bool isOfOneGroup = true;  ///< what covers it last
        std::uint32_t group = noIndex;  ///< if so
        std::int32_t next = 0;          ///< a block further right, up to which all are hidden; or itself
    };

    void cover(std::int32_t first, std::int32_t end, const LayerCover& cover, std::size_t& stepsLeft);
    static bool coverWhole(Block& block, const LayerCover& cover);
    void coverSquares(std::int32_t first, std::int32_t end, const LayerCover& cover);
    /// The first block, from that one on, that is not hidden.
    std::int32_t nextOpen(std::int32_t block);
    bool isOpen(std::int32_t first, std::int32_t last);
    bool isOpenIn(std::int32_t block, std::int32_t first, std::int32_t end);
    std::uint64_t openSquares(std::int32_t block);
    Block& at(std::int32_t block) { return blocks_[std::size_t(block)]; }

    std::int32_t squares_;
    std::vector<Block> blocks_;          ///< the last one is beyond the row, and stays open
    std::vector<float> lights_;          ///< by square, of blocks that are covered in part
    std::vector<std::uint32_t> groups_;  ///< of blocks that are not of one group
};

}  // namespace vtm::compiler
