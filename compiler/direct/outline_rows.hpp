/// \file
/// Bands in which a single outline crosses itself again and again, in one colour over another: its coverage
/// is computed pixel by pixel, so that crossings need not be followed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "compiler/direct/pixel_row.hpp"
#include "compiler/direct/region_state.hpp"
#include "compiler/direct/view_chains.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {

/// For one thread.
class OutlineRows {
public:
    /// `state` is outside of all layers, and is so again after each call. Both must outlive it.
    OutlineRows(const ViewChains& chains, RegionState& state, int width);

    /// Appends chords for a band: `numbers` are its chains. They run down the sides of pixels, between paints
    /// that are pixels' colours. False where more than one layer's edges are seen,
    /// or its inside or outside is no colour.
    bool draw(std::span<const std::uint32_t> numbers, float top, float bottom,
              std::vector<asset::Chord>& chords);

private:
    /// Columns are counted from the outer ones on.
    static glm::dvec2 placeOf(const glm::vec2& vertex) {
        return {vertex.x + double(PixelRow::outerColumns), vertex.y};
    }
    using ChainStrand = Strand<glm::vec2, placeOf>;

    void findOutline();
    bool runsBeside(const DownChain& chain, bool onLeft) const;
    const glm::vec2* edgeAt(const DownChain& chain, float y) const;
    bool findColors(std::span<const std::uint32_t> numbers, float top, float bottom);
    void drawRow(int y, std::vector<asset::Chord>& chords);

    const ViewChains& chains_;
    const glm::vec2* const vertices_;
    RegionState& state_;
    const int width_;
    bool isAsked_ = false;
    std::uint32_t outline_ = noIndex;  ///< the only layer whose edges are seen, if there is one
    bool isEvenOdd_ = false;
    PixelRow evenOdd_, nonZero_;
    glm::vec4 colors_[2];  ///< outside and inside
    std::vector<ChainStrand> strands_;
};

}  // namespace vtm::compiler
