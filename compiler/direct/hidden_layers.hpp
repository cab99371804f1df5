/// \file
/// Layers that others hide, found on a coarse grid before anything is swept.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/direct/covered_row.hpp"
#include "compiler/direct/layer_cover.hpp"
#include "compiler/direct/view_chains.hpp"

namespace vtm::compiler {

/// Goes through the layers from the top. A square of pixels that no outline of a layer touches is covered by
/// it or not at all. What is covered until no light is left hides all layers below.
class HiddenLayers {
public:
    /// `rowsOfStrip`: of pixels.
    HiddenLayers(const LoweredScene& picture, const ViewChains& chains, int width, int height,
                 int rowsOfStrip);

    /// Whether nothing of the layer shows in the strip.
    bool isHidden(std::uint32_t layer, int strip) const {
        return shown_[layer * std::size_t(strips_) + std::size_t(strip)] == 0;
    }

private:
    struct RowTouch {
        std::int32_t row;
        Touch touch;
    };

    void touch(const ViewChains& chains, const DownChain& chain);
    void add(std::uint32_t layer, const LayerCover& cover, bool isEvenOdd);
    CoveredRow squaresOf(std::int32_t row) {
        const auto count = std::size_t(columns_ + 1);
        return CoveredRow(std::span(squares_).subspan(std::size_t(row) * count, count));
    }

    std::int32_t side_ = 0;  ///< of squares, in pixels
    std::int32_t columns_, rows_, strips_, rowsOfStrip_;
    std::vector<CoveredSquare> squares_;
    std::size_t stepsLeft_;  ///< of covering
    std::vector<RowTouch> touches_;
    std::vector<Touch> ofRow_;
    std::vector<std::uint8_t> shown_;  ///< by layer and strip
};

}  // namespace vtm::compiler
