/// \file
/// Rows in which too much begins, ends or crosses to be followed: drawn in level steps, in each of which the
/// chains are in their order at its middle.
///
/// The paints follow from the order, and an edge covers what it covers in the step. What is misplaced are the
/// triangles between edges that cross within the step. Where chains begin, end or are nearly level, the few
/// that are near take smaller steps. In each step the changes of paint add up, since outlines are closed.
///
/// Where many layers are cut, they are asked from the top which of them show in the step, and the others are
/// left out of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "compiler/containers/sort_places.hpp"
#include "compiler/direct/covered_row.hpp"
#include "compiler/direct/region_state.hpp"
#include "compiler/direct/view_chains.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {

/// For one thread.
class LineSweep {
public:
    /// `state` is outside of all layers, and is so again after each run. Both must outlive it.
    LineSweep(const ViewChains& chains, RegionState& state, int width);

    /// Appends chords for what lies between two heights of a band: `numbers` are that band's chains. They
    /// run down the sides of pixels, between paints that are pixels' colours; but those of programs.
    void run(std::span<const std::uint32_t> numbers, float top, float bottom,
             std::vector<asset::Chord>& chords);

private:
    struct Step {
        float top, bottom;  ///< where the chains are looked at
        float height;       ///< what it stands for

        float middle() const { return 0.5f * (top + bottom); }
    };
    /// A chain that the row cuts. Many are gone through in each step, so there is no more in it.
    struct Cut {
        std::uint32_t at;    ///< the upper end of the edge that was looked at last, or the chain's
        std::uint32_t last;  ///< of the chain
        float top, bottom;   ///< of the chain
        std::uint32_t layer;
        std::int32_t winding;
        float x;         ///< in the middle of the last step, or where the chain begins
        glm::vec2 a{0};  ///< of an edge that the row cuts, the upper end
        float slope = 0;
        float edgeBottom = -1;  ///< where it ends; none at first

        bool isAt(float y) const { return top <= y && y < bottom; }
    };
    /// Where a chain goes in a step.
    struct Seen {
        std::uint32_t cut;  ///< of cuts_
        std::uint32_t layer;
        std::int32_t winding;
        float x = 0;                ///< in the middle
        float from = 0, to = 0;     ///< where it enters and leaves the step
        float left = 0, right = 0;  ///< between
        bool isAtMiddle = false;
        bool hasEnd = false;     ///< it begins or ends in the step
        bool isSpecial = false;  ///< it does, or is nearly level there
    };
    /// A part of a row with the same chains.
    struct Piece {
        float top, bottom;
        std::uint64_t content;
    };
    /// Of such a part.
    struct Change {
        float y;
        std::uint64_t content;  ///< is added
    };

    void row(float top, float bottom);
    bool findSteps(float top, float bottom, std::size_t count);
    void findPieces(float top, float bottom);
    bool placeByContent(float top, float bottom, std::size_t most);
    void take(float top, float bottom);
    void look(std::size_t number, const Step& step, Seen& seen);
    void lookAround(const Cut& cut, const Step& step, Seen& seen) const;
    bool mayHide() const;
    void fetchAhead(std::size_t number, const Step& step) const;
    void lookAtAll(const Step& step);
    void lookForShown(const Step& step);
    bool isShown(std::span<const Seen> ofLayer);
    void arrangeCuts();
    void draw(const Step& step);
    void drawByParts(const Step& step);
    void drawInSteps(std::span<const Seen> chains, const Step& step, Region& left);
    Region cross(std::span<const Seen> chains, const Step& step, Region left);
    void change(const Seen& seen, const Step& step, RegionPaint left, RegionPaint right);
    void add(float from, float to, const glm::vec4& amount);
    void finishRow(float top, float bottom);

    const ViewChains& chains_;
    const glm::vec2* const vertices_;
    RegionState& state_;
    const int width_;
    double meanCut_ = 0;  ///< chains that meet a row, in the mean; 0 until it is asked for
    std::vector<asset::Chord>* chords_ = nullptr;
    bool isOneLayer_ = false;    ///< all chains are of one
    bool isArranged_ = false;    ///< in the row
    std::vector<Cut> cuts_;      ///< from the topmost layer down; of one layer from left to right
    std::vector<Cut> arranged_;  ///< spare
    std::vector<Seen> seen_;     ///< those of them that may show in the step
    std::vector<Placed> order_;  ///< of these, from left to right
    std::vector<Seen> sorted_;   ///< in this order
    std::vector<Placed> spare_;
    std::span<const std::uint32_t> toCome_;  ///< from the top
    std::vector<Step> steps_;
    std::vector<Change> changes_;
    std::vector<Piece> pieces_;
    std::vector<Seen> part_;  ///< of sorted_, in smaller steps
    std::vector<Placed> partOrder_;
    std::vector<Seen> partSorted_;
    std::vector<float> leftmost_;  ///< in sorted_, from i on
    std::vector<glm::vec4> sums_;  ///< by column: what changes there, times height
    float drawn_ = 0;              ///< of the row
    std::size_t smallSteps_ = 0;   ///< chains in smaller steps that may still be taken: by the step
    std::size_t smallInBand_ = 0;  ///< and by the rest of the band

    // Which layers show.
    bool hides_ = false;  ///< in the row
    std::vector<CoveredSquare> squares_;
    std::vector<Touch> touches_;
};

}  // namespace vtm::compiler
