#include "compiler/direct/covered_row.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace vtm::compiler {
namespace {

/// Of as many as several lanes hold.
float greatestOf(std::span<const float> lights) {
    constexpr std::size_t lanes = 8;
    std::array<float, lanes> most{};
    for (std::size_t i = 0; i < lights.size(); i += lanes)
        for (std::size_t k = 0; k < lanes; ++k)
            most[k] = lights[i + k] > most[k] ? lights[i + k] : most[k];
    return std::ranges::max(most);
}

}  // namespace

CoveredRow::CoveredRow(std::int32_t squares)
    : squares_(squares),
      blocks_(std::size_t(squares / blockSquares + 2)),
      lights_(blocks_.size() * blockSquares),
      groups_(lights_.size()) {
    clear();
}

void CoveredRow::clear() {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        blocks_[b] = {.next = std::int32_t(b)};
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
            this->cover(done, t.first, cover, stepsLeft);
        }
        isShown = isShown || isOpen(t.first, last);
        winding += t.winding;
        done = std::max(done, last + 1);
    }
    return isShown;
}

void CoveredRow::cover(std::int32_t first, std::int32_t end, const LayerCover& cover,
                       std::size_t& stepsLeft) {
    if (cover.alpha <= 0)
        return;
    for (std::int32_t b = nextOpen(first / blockSquares); b * blockSquares < end && stepsLeft > 0;
         b = nextOpen(b + 1)) {
        const std::int32_t from = std::max(first, b * blockSquares),
                           to = std::min(end, (b + 1) * blockSquares);
        Block& block = at(b);
        const bool isWhole = to - from == blockSquares;
        if (!isWhole && !isOpenIn(b, from, to))
            continue;
        --stepsLeft;
        if (!isWhole || !coverWhole(block, cover))
            coverSquares(from, to, cover);
        if (block.light * block.most <= unseen)
            block.next = b + 1;
    }
}

/// False if single squares must be asked.
bool CoveredRow::coverWhole(Block& block, const LayerCover& cover) {
    const bool isOfGroup = cover.group != noIndex;
    if (isOfGroup && !block.isOfOneGroup)
        return false;
    if (!isOfGroup || cover.group != block.group)
        block.light *= 1 - cover.alpha;
    block.isOfOneGroup = true;
    block.group = cover.group;
    return true;
}

/// Of one block.
void CoveredRow::coverSquares(std::int32_t first, std::int32_t end, const LayerCover& cover) {
    const std::int32_t b = first / blockSquares;
    const auto begin = std::size_t(b) * blockSquares;
    Block& block = at(b);
    const auto lights = std::span(lights_).subspan(begin, blockSquares);
    const auto groups = std::span(groups_).subspan(begin, blockSquares);
    if (!std::exchange(block.isCovered, true))
        std::ranges::fill(lights, 1.0f);
    const float through = 1 - cover.alpha;
    const auto from = std::size_t(first) - begin, to = std::size_t(end) - begin;
    if (block.isOfOneGroup && block.group == cover.group) {
        if (cover.group != noIndex)
            return;
        for (std::size_t i = from; i < to; ++i)
            lights[i] *= through;
    } else {
        if (block.isOfOneGroup)
            std::ranges::fill(groups, block.group);
        block.isOfOneGroup = false;
        for (std::size_t i = from; i < to; ++i) {
            if (cover.group == noIndex || groups[i] != cover.group)
                lights[i] *= through;
            groups[i] = cover.group;
        }
    }
    block.most = greatestOf(lights);
    block.openAt = -1;
}

std::int32_t CoveredRow::nextOpen(std::int32_t block) {
    std::int32_t open = block;
    while (at(open).next != open)
        open = at(open).next;
    while (at(block).next != open && block != open)
        block = std::exchange(at(block).next, open);
    return open;
}

bool CoveredRow::isOpen(std::int32_t first, std::int32_t last) {
    if (last < first)
        return false;
    for (std::int32_t b = nextOpen(first / blockSquares); b * blockSquares <= last; b = nextOpen(b + 1))
        if (isOpenIn(b, std::max(first, b * blockSquares), std::min(last + 1, (b + 1) * blockSquares)))
            return true;
    return false;
}

/// Whether one of some squares of a block is open, which is not hidden.
bool CoveredRow::isOpenIn(std::int32_t block, std::int32_t first, std::int32_t end) {
    const std::int32_t from = first - block * blockSquares, count = end - first;
    return !at(block).isCovered || count == blockSquares ||
           (openSquares(block) >> from & ((std::uint64_t{1} << count) - 1)) != 0;
}

/// Of a block that is covered in part.
std::uint64_t CoveredRow::openSquares(std::int32_t b) {
    Block& block = at(b);
    if (block.openAt == block.light)
        return block.open;
    const float* const lights = &lights_[std::size_t(b) * blockSquares];
    std::uint64_t open = 0;
    for (std::int32_t i = 0; i < blockSquares; ++i)
        open |= std::uint64_t{block.light * lights[i] > unseen} << i;
    block.open = open;
    block.openAt = block.light;
    return open;
}

}  // namespace vtm::compiler
