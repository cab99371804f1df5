#include "compiler/direct/hidden_layers.hpp"

#include <algorithm>

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
        squaresOf(row).clear();
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
        // What is not met in the middle adds nothing on its right.
        touches_.push_back({row,
                            {column(left), column(right),
                             chain.top <= middle && middle < chain.bottom ? chain.winding : 0}});
    }
}

void HiddenLayers::add(std::uint32_t layer, const LayerCover& cover, bool isEvenOdd) {
    if (!cover.mayBeHidden)
        return;
    std::ranges::sort(touches_, [](const RowTouch& a, const RowTouch& b) {
        return a.row != b.row ? a.row < b.row : a.touch.first < b.touch.first;
    });
    std::uint8_t* const shown = &shown_[layer * std::size_t(strips_)];
    std::fill(shown, shown + strips_, std::uint8_t{0});
    for (std::size_t first = 0; first < touches_.size();) {
        const std::int32_t row = touches_[first].row;
        ofRow_.clear();
        for (; first < touches_.size() && touches_[first].row == row; ++first)
            ofRow_.push_back(touches_[first].touch);
        shown[row / rowsOfStrip_] |= std::uint8_t{squaresOf(row).add(ofRow_, cover, isEvenOdd, stepsLeft_)};
    }
}

}  // namespace vtm::compiler
