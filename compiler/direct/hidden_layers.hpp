/// \file
/// Layers that others hide, found on a coarse grid before anything is swept.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

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
    /// The squares of a row that a chain touches, [first, last].
    struct Touch {
        std::int32_t row, first, last;
        std::int32_t
            winding;  ///< that is added to what lies right of it; 0 for a chain not met in the middle
    };

    void touch(const ViewChains& chains, const DownChain& chain);
    void add(std::uint32_t layer, const LayerCover& cover, bool isEvenOdd);
    void addRow(std::span<const Touch> touches, const LayerCover& cover, bool isEvenOdd,
                std::uint8_t& isShown);
    void coverSquares(std::int32_t row, std::int32_t first, std::int32_t end, const LayerCover& cover);
    /// The first square of a row, from `column` on, that is not hidden.
    std::int32_t nextOpen(std::int32_t row, std::int32_t column);
    bool isOpen(std::int32_t row, std::int32_t first, std::int32_t last) {
        return nextOpen(row, first) <= last;
    }
    std::size_t indexOf(std::int32_t row, std::int32_t column) const {
        return std::size_t(row) * std::size_t(columns_ + 1) + std::size_t(column);
    }

    std::int32_t side_ = 0;  ///< of squares, in pixels
    std::int32_t columns_, rows_, strips_, rowsOfStrip_;
    struct Square {
        float light = 1;
        std::uint32_t group = noIndex;  ///< that covers it already
        std::int32_t next = 0;          ///< a square further right, up to which all are hidden
    };
    std::vector<Square> squares_;
    std::size_t stepsLeft_;  ///< of covering
    std::vector<Touch> touches_;
    std::vector<std::uint8_t> shown_;  ///< by layer and strip
};

}  // namespace vtm::compiler
