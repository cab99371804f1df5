/// \file
/// Rows in which too much begins, ends or crosses to be followed: drawn in level steps, in each of which the
/// chains are in their order at its middle.
///
/// The paints follow from the order, and an edge covers what it covers in the step. What is misplaced are the
/// triangles between edges that cross within the step. Where chains begin, end or are nearly level, the few
/// that are near take smaller steps. In each step the changes of paint add up, since outlines are closed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

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
    /// A chain in a step.
    struct Cut {
        std::uint32_t at;    ///< the upper end of the edge that the step's top cuts, or the chain's
        std::uint32_t last;  ///< of the chain
        float top, bottom;   ///< of the chain
        float x;             ///< in the middle of the step
        float from, to;      ///< where it enters and leaves the step
        float left, right;   ///< between
        std::uint32_t layer;
        std::int32_t winding;

        bool isAt(float y) const { return top <= y && y < bottom; }
        /// Whether it begins or ends in the step, or is nearly level there.
        bool isSpecial(const Step& step) const;
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
    void look(Cut& cut, const Step& step) const;
    void lookAround(Cut& cut, const Step& step) const;
    static void sort(std::vector<Cut>& cuts);
    void draw(const Step& step);
    void drawByParts(const Step& step);
    void drawInSteps(std::span<const Cut> cuts, const Step& step, Region& left);
    Region cross(std::span<const Cut> cuts, const Step& step, Region left);
    void change(const Cut& cut, const Step& step, RegionPaint left, RegionPaint right);
    void add(float from, float to, const glm::vec4& amount);
    void finishRow(float top, float bottom);

    const ViewChains& chains_;
    const glm::vec2* const vertices_;
    RegionState& state_;
    const int width_;
    double meanCut_ = 0;  ///< chains that meet a row, in the mean; 0 until it is asked for
    std::vector<asset::Chord>* chords_ = nullptr;
    std::vector<Cut> cuts_;                  ///< from left to right
    std::span<const std::uint32_t> toCome_;  ///< from the top
    std::vector<Step> steps_;
    std::vector<Change> changes_;
    std::vector<Piece> pieces_;
    std::vector<Cut> part_;        ///< of cuts_, in smaller steps
    std::vector<float> leftmost_;  ///< of the cuts from i on
    std::vector<glm::vec4> sums_;  ///< by column: what changes there, times height
    float drawn_ = 0;              ///< of the row
    std::size_t smallSteps_ = 0;   ///< chains in smaller steps that may still be taken: by the step
    std::size_t smallInBand_ = 0;  ///< and by the rest of the band
};

}  // namespace vtm::compiler
