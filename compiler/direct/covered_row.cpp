#include "compiler/direct/covered_row.hpp"

#include <algorithm>
#include <utility>

namespace vtm::compiler {

void CoveredRow::clear() {
    for (std::size_t i = 0; i < squares_.size(); ++i)
        squares_[i] = {.below = {}, .next = std::int32_t(i)};
}

bool CoveredRow::add(std::span<const Touch> touches, const LayerCover& cover, bool isEvenOdd,
                     std::size_t& stepsLeft) {
    const std::int32_t lastEnd = lastOfEnds(touches);
    bool isShown = false;
    std::int32_t winding = 0, done = 0;
    for (const Touch& t : touches) {
        const std::int32_t last = t.isEnd ? lastEnd : t.last;
        if (t.first > done && (isEvenOdd ? winding % 2 != 0 : winding != 0)) {
            isShown = isShown || isOpen(done, t.first - 1);
            coverSquares(done, t.first, cover, stepsLeft);
        }
        isShown = isShown || isOpen(t.first, last);
        winding += t.winding;
        done = std::max(done, last + 1);
    }
    return isShown;
}

void CoveredRow::coverSquares(std::int32_t first, std::int32_t end, const LayerCover& cover,
                              std::size_t& stepsLeft) {
    if (cover.alpha <= 0)
        return;
    for (std::int32_t column = nextOpen(first); column < end && stepsLeft > 0;
         column = nextOpen(column + 1)) {
        --stepsLeft;
        CoveredSquare& square = at(column);
        square.below.add(cover);
        if (square.below.light() <= unseen)
            square.next = column + 1;
    }
}

std::int32_t CoveredRow::nextOpen(std::int32_t column) {
    std::int32_t open = column;
    while (at(open).next != open)
        open = at(open).next;
    while (at(column).next != open && column != open)
        column = std::exchange(at(column).next, open);
    return open;
}

}  // namespace vtm::compiler
