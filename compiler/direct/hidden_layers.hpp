/// \file
/// Layers that others hide, found on a grid of small squares before anything is swept.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/direct/covered_row.hpp"
#include "compiler/direct/layer_cover.hpp"
#include "compiler/direct/view_chains.hpp"

namespace vtm::compiler {

/// Goes through the layers of each band from the top. A square that no outline of a layer touches is covered
/// by it or not at all. What is covered until no light is left hides all layers below.
class HiddenLayers {
public:
    HiddenLayers(const LoweredScene& picture, const ViewChains& chains, int width, int height);

    /// Whether nothing of the layer shows in the band.
    bool isHidden(std::uint32_t layer, int band) const { return isHidden_[placeOf(layer, band)]; }
    /// In how many bands chains are hidden, summed.
    std::size_t hiddenInBands() const { return hiddenInBands_; }

private:
    void lookAt(int band, std::span<const LayerCover> covers);
    void touch(const DownChain& chain, std::uint32_t& at, float top);
    bool add(const LayerCover& cover, bool isEvenOdd);
    std::size_t placeOf(std::uint32_t layer, int band) const {
        return layer * std::size_t(chains_.bands()) + std::size_t(band);
    }
    CoveredRow squaresOf(std::int32_t row) {
        const auto count = std::size_t(columns_ + 1);
        return CoveredRow(std::span(squares_).subspan(std::size_t(row) * count, count));
    }

    const LoweredScene& picture_;
    const ViewChains& chains_;
    float squareWidth_, squareHeight_;  ///< in pixels
    std::int32_t columns_, rows_;       ///< of a band
    std::vector<CoveredSquare> squares_;
    std::size_t stepsLeft_ = 0;  ///< of covering
    std::vector<std::uint32_t> numbers_;
    std::vector<std::uint32_t> at_;            ///< by chain: a vertex that is not below the band
    std::vector<std::vector<Touch>> touches_;  ///< of a layer, by row
    std::vector<bool> isHidden_;               ///< by layer and band
    std::size_t hiddenInBands_ = 0;
};

}  // namespace vtm::compiler
