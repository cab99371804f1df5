#include "compiler/direct/hidden_layers.hpp"

#include <algorithm>
#include <utility>

#include <vtm/limits/limits.hpp>

namespace vtm::compiler {
namespace {

constexpr std::int32_t leastSide = 2;
constexpr std::size_t mostSquares = 1u << 18;
/// Then layers cover no more, and only ask whether they are hidden.
constexpr std::size_t mostSquareVisits = 1u << 26;

}  // namespace

HiddenLayers::HiddenLayers(const LoweredScene& picture, const ViewChains& chains, int width, int height,
                           int rowsOfStrip)
    : strips_((height + rowsOfStrip - 1) / rowsOfStrip), stepsLeft_(mostSquareVisits) {
    // Strips consist of whole rows of squares.
    for (side_ = leastSide; std::size_t(width / side_ + 2) * std::size_t(height / side_ + 1) > mostSquares &&
                            side_ < rowsOfStrip;)
        side_ *= 2;
    columns_ = width / side_ + 1;
    rowsOfStrip_ = rowsOfStrip / side_;
    rows_ = strips_ * rowsOfStrip_;
    squares_.resize(std::size_t(rows_) * std::size_t(columns_ + 1));
    for (std::int32_t row = 0; row < rows_; ++row)
        for (std::int32_t column = 0; column <= columns_; ++column)
            squares_[indexOf(row, column)].next = column;
    shown_.resize(picture.layers.size() * std::size_t(strips_), 1);

    const std::vector<LayerCover> covers = layerCovers(picture);
    const std::span<const DownChain> all = chains.all();
    for (std::size_t end = all.size(); end > 0;) {
        limits::check();
        const std::uint32_t layer = all[end - 1].layer;
        touches_.clear();
        for (; end > 0 && all[end - 1].layer == layer; --end)
            touch(chains, all[end - 1]);
        add(layer, covers[layer], picture.layers[layer].rule == scene::FillRule::EvenOdd);
    }
}

void HiddenLayers::touch(const ViewChains& chains, const DownChain& chain) {
    const auto side = float(side_);
    const glm::vec2* const vertices = chains.vertices();
    const auto column = [&](float x) { return std::clamp(std::int32_t(x / side), 0, columns_ - 1); };
    std::uint32_t at = chain.first;
    float x = vertices[at].x;
    const auto firstRow = std::clamp(std::int32_t(chain.top / side), 0, rows_ - 1),
               lastRow = std::clamp(std::int32_t(chain.bottom / side), 0, rows_ - 1);
    for (std::int32_t row = firstRow; row <= lastRow; ++row) {
        const float bottom = float(row + 1) * side, middle = bottom - 0.5f * side;
        float left = x, right = x;
        const auto add = [&](float to) {
            left = std::min(left, to);
            right = std::max(right, to);
            x = to;
        };
        while (at + 1 < chain.end && vertices[at + 1].y <= bottom)
            add(vertices[++at].x);
        if (at + 1 < chain.end && vertices[at].y < bottom) {
            const glm::vec2 a = vertices[at], b = vertices[at + 1];
            add(a.x + (bottom - a.y) * ((b.x - a.x) / (b.y - a.y)));
        }
        touches_.push_back({row, column(left), column(right),
                            chain.top <= middle && middle < chain.bottom ? chain.winding : 0});
    }
}

void HiddenLayers::add(std::uint32_t layer, const LayerCover& cover, bool isEvenOdd) {
    if (!cover.mayBeHidden)
        return;
    std::ranges::sort(touches_, [](const Touch& a, const Touch& b) {
        return a.row != b.row ? a.row < b.row : a.first < b.first;
    });
    std::uint8_t* const shown = &shown_[layer * std::size_t(strips_)];
    std::fill(shown, shown + strips_, std::uint8_t{0});
    for (std::size_t first = 0, end = 0; first < touches_.size(); first = end) {
        const std::int32_t row = touches_[first].row;
        while (end < touches_.size() && touches_[end].row == row)
            ++end;
        addRow(std::span(touches_).subspan(first, end - first), cover, isEvenOdd, shown[row / rowsOfStrip_]);
    }
}

void HiddenLayers::addRow(std::span<const Touch> touches, const LayerCover& cover, bool isEvenOdd,
                          std::uint8_t& isShown) {
    const std::int32_t row = touches[0].row;
    std::int32_t winding = 0, done = 0;
    for (const Touch& t : touches) {
        if (t.first > done && (isEvenOdd ? winding % 2 != 0 : winding != 0)) {
            isShown |= std::uint8_t{isOpen(row, done, t.first - 1)};
            coverSquares(row, done, t.first, cover);
        }
        isShown |= std::uint8_t{isOpen(row, t.first, t.last)};
        winding += t.winding;
        done = std::max(done, t.last + 1);
    }
}

void HiddenLayers::coverSquares(std::int32_t row, std::int32_t first, std::int32_t end,
                                const LayerCover& cover) {
    if (cover.alpha <= 0)
        return;
    for (std::int32_t column = nextOpen(row, first); column < end && stepsLeft_ > 0;
         column = nextOpen(row, column + 1)) {
        --stepsLeft_;
        Square& square = squares_[indexOf(row, column)];
        // Of a group's layers only the topmost counts.
        if (cover.group != noIndex && square.group == cover.group)
            continue;
        square.group = cover.group;
        square.light *= 1 - cover.alpha;
        if (square.light <= unseen)
            square.next = column + 1;
    }
}

std::int32_t HiddenLayers::nextOpen(std::int32_t row, std::int32_t column) {
    Square* const squares = &squares_[indexOf(row, 0)];
    std::int32_t open = column;
    while (squares[open].next != open)
        open = squares[open].next;
    while (squares[column].next != open && column != open)
        column = std::exchange(squares[column].next, open);
    return open;
}

}  // namespace vtm::compiler
