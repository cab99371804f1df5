/// \file
/// Layers that others hide, found on a grid of small squares before anything is swept.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "compiler/direct/covered_row.hpp"
#include "compiler/direct/layer_cover.hpp"
#include "compiler/direct/view_chains.hpp"

namespace vtm::compiler {

/// Goes through the layers of each band from the top. A square that no outline of a layer touches is covered
/// by it or not at all. What is covered until no light is left hides all layers below.
///
/// Squares are parallelograms that lean as most chains near them do. Slanting outlines that nearly coincide
/// would touch too many upright ones to hide each other.
class HiddenLayers {
public:
    HiddenLayers(const LoweredScene& picture, const ViewChains& chains, int width, int height);

    /// Whether nothing of the layer shows in the band.
    bool isHidden(std::uint32_t layer, int band) const { return isHidden_[placeOf(layer, band)]; }
    /// In how many bands chains are hidden, summed.
    std::size_t hiddenInBands() const { return hiddenInBands_; }

private:
    /// So many squares of a row lean alike.
    static constexpr std::int32_t leaningColumns = 8;

    /// Where a chain goes in a row of squares: between two lines from the row's upper border to its lower
    /// one.
    struct Passage {
        std::int32_t row;
        glm::vec2 left, right;
        bool spans;  ///< the row
        bool isAtMiddle;
    };
    /// How far chains go to the right in a row, in squares: those that enter it in some columns.
    struct Leaning {
        static constexpr double few = 16;
        double count = 0, sum = 0, sumOfSquares = 0;

        void add(double shift) {
            ++count;
            sum += shift;
            sumOfSquares += shift * shift;
        }
        bool tells() const { return count >= few; }
        /// Their mean, if its square is more than half of that of their shifts. It is not where chains go
        /// anywhere: of `few` it would be 2.8 standard deviations off.
        double mean() const { return 2 * sum * sum > count * sumOfSquares ? sum / count : 0; }
    };

    void takeChains(int band);
    void makeSquares(int band, double most);
    void lookAt(int band, std::span<const LayerCover> covers);
    template <class Take>
    void follow(const DownChain& chain, std::uint32_t& at, float top, const Take& take) const;
    void leanSquares(float top);
    void leanRow(std::int32_t row, std::span<const Leaning> leanings);
    void touch(const DownChain& chain, std::uint32_t& at, float top);
    bool isShown(std::span<const std::uint32_t> ofLayer, const LayerCover& cover, int band);
    bool add(const LayerCover& cover, bool isEvenOdd);
    std::int32_t columnOf(float x) const {
        return std::int32_t(std::clamp(x / squareWidth_, 0.0f, float(columns_ - 1)));
    }
    /// The square with that place on the lower border of its row.
    std::int32_t squareAbove(std::int32_t row, float x) const {
        return above_[std::size_t(row) * std::size_t(columns_) + std::size_t(columnOf(x))];
    }
    std::span<Leaning> leaningsOf(std::int32_t row) {
        const auto count = std::size_t(columns_ / leaningColumns + 1);
        return std::span(leanings_).subspan(std::size_t(row) * count, count);
    }
    std::size_t placeOf(std::uint32_t layer, int band) const {
        return layer * std::size_t(chains_.bands()) + std::size_t(band);
    }
    const LoweredScene& picture_;
    const ViewChains& chains_;
    const int width_;
    // Of the band.
    float squareWidth_ = 0, squareHeight_ = 0;  ///< in pixels
    std::int32_t columns_ = 0, rows_ = 0;
    std::vector<CoveredRow> squares_;  ///< by row
    std::size_t stepsLeft_ = 0;        ///< of covering
    std::vector<std::uint32_t> numbers_;
    std::vector<std::uint32_t> at_;            ///< by chain: a vertex that is not below the band
    std::vector<std::vector<Touch>> touches_;  ///< of a layer, by row
    std::vector<Leaning> leanings_;            ///< by row, then by `leaningColumns` columns
    std::vector<std::int32_t> above_;  ///< by row, then by column of its lower border: the square there
    std::vector<bool> isHidden_;       ///< by layer and band
    std::size_t hiddenInBands_ = 0;
};

}  // namespace vtm::compiler
