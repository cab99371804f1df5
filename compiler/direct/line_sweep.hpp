/// \file
/// Rows in which too much begins, ends or crosses to be followed: drawn in level steps, in each of which the
/// chains are in their order at its middle.
///
/// The paints follow from the order, and an edge covers what it covers in the step, unless it crosses
/// another: then it counts as it is in the middle. Where chains begin, end or are nearly level, the few that
/// are near take smaller steps. In each step the changes of paint add up, since outlines are closed.
///
/// Paints that are programs are remembered, and their edges are chords, as elsewhere; where that would be too
/// many, they are composited in each pixel that their regions reach, and forgotten.
///
/// Where many layers are cut, they are asked from the top which of them show in the step, and the others are
/// left out of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "compiler/containers/sort_places.hpp"
#include "compiler/direct/covered_row.hpp"
#include "compiler/direct/cut_chains.hpp"
#include "compiler/direct/pixel_colors.hpp"
#include "compiler/direct/region_state.hpp"
#include "compiler/direct/view_chains.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {

/// For one thread.
class LineSweep {
public:
    /// `state` is outside of all layers, and is so again after each run. All must outlive it.
    LineSweep(const ViewChains& chains, RegionState& state, PixelColors& pixels, int width);

    /// Appends chords for what lies between two heights of a band: `numbers` are that band's chains. They
    /// run down the sides of pixels, between paints that are pixels' colours; but those of programs that are
    /// remembered.
    void run(std::span<const std::uint32_t> numbers, float top, float bottom,
             std::vector<asset::Chord>& chords);

    /// Whether the row from there on has level sides, and so few different parts between them that each is
    /// drawn as it is.
    bool isDrawnByContent(std::span<const std::uint32_t> numbers, float top);

private:
    /// An edge that reaches over more columns in a step is nearly level: what it misplaces is seen.
    static constexpr float mostReach = 0.25f;
    /// Of a row.
    static constexpr std::size_t mostSteps = 64;
    /// Chains looked at where layers begin or end, a band: what they may cost.
    static constexpr std::size_t endCutsInBand = 16 * 600'000;

    struct Step {
        float top, bottom;  ///< where the chains are looked at
        float height;       ///< what it stands for

        float middle() const { return 0.5f * (top + bottom); }
    };
    /// Where a chain goes in a step.
    struct Seen {
        std::uint32_t cut;  ///< of cuts_
        std::uint32_t layer;
        float x;            ///< in the middle
        float from, to;     ///< where it enters and leaves the step
        float left, right;  ///< between
        std::int8_t winding;
        bool isAtMiddle;
        bool hasEnd;     ///< it begins or ends in the step
        bool isSpecial;  ///< it does, or is nearly level there

        /// It does not go straight through the step, as where a level side lies in it.
        bool isBent() const { return std::abs(0.5f * (from + to) - x) > mostReach; }
    };
    /// A part of a row with the same chains.
    struct Piece {
        float top, bottom;
        std::uint64_t content;
    };
    /// Of such a part.
    struct ContentChange {
        float y;
        std::uint64_t content;  ///< is added
    };

    /// With which chains begin and end: how long they are in all, and the columns that they lie in.
    struct LevelSides {
        float length = 0;
        float left = INFINITY, right = -INFINITY;
    };

    /// Where an edge enters and leaves a step.
    struct Edge {
        float from, to;
    };
    /// A region's paint: a colour, or a program that is remembered.
    struct Shown {
        Region region;
        glm::vec4 color{0};

        bool isProgram() const { return (region.paint & programBit) != 0; }
        bool showsAs(const Shown& other) const {
            return region.paint == other.region.paint && color == other.color;
        }
    };
    /// An edge that changes what is inside.
    struct Change {
        const Seen* seen = nullptr;
        bool isUpright = false;  ///< taken to be: it bends, or another one crosses it in the step

        /// The next one on its right. Where they cross, both are upright.
        void meet(Change& next) {
            const bool crosses = seen->from > next.seen->from || seen->to > next.seen->to;
            isUpright = isUpright || crosses;
            next.isUpright = next.isUpright || crosses;
        }
        /// Where edges cross or bend, what each does is right in the middle of the step only.
        Edge edge() const { return isUpright ? Edge{seen->x, seen->x} : Edge{seen->from, seen->to}; }
    };
    /// And the paint.
    struct PaintChange : Change {
        RegionPaint left = 0, right = 0;
        glm::vec4 color{0};  ///< that on the right less that on the left
    };

    /// A chain that begins or ends in a step, and the columns that it reaches there.
    struct LayerEnd {
        std::uint32_t layer;
        float left, right;
    };
    /// Columns in which layers begin or end in a step; chains are numbers of sorted_.
    struct EndedColumns {
        float left, right;                   ///< whole numbers
        std::vector<std::uint32_t> members;  ///< that reach into them
        std::vector<std::uint32_t> onLeft;   ///< that lie between them and those before
        bool isDrawn;                        ///< from end to end

        // In the picture.
        int first() const { return int(std::max(left, 0.0f)); }
        int end(int width) const { return int(std::min(right, float(width))); }
    };

    void begin(std::span<const std::uint32_t> numbers);
    void lookInside(const DownChain& chain);
    void row(float top, float bottom);
    bool findSteps(float top, float bottom);
    std::size_t stepsInRow() const;
    void findPieces(float top, float bottom);
    std::size_t chainsAmongSides(const Step& row);
    bool placeByContent(float top, float bottom, std::size_t most);
    void placeByMostContents(float top, std::size_t most);
    void take(float top, float bottom);
    void look(std::size_t number, const Step& step, Seen& seen);
    void lookAgain(CutChain& cut, const Step& step, Seen& seen);
    void lookAround(const CutChain& cut, const Step& step, Seen& seen);
    bool mayHide() const;
    void lookAtAll(const Step& step);
    void lookForShown(const Step& step);
    bool isShown(std::span<const Seen> ofLayer);
    void arrangeCuts();
    void lookAndSort(const Step& step);
    void draw(const Step& step);
    void drawSorted(const Step& step);
    void drawByParts(const Step& step);
    template <class Numbers>
    void takePart(const Numbers& numbers);
    void lookAtPart(const Step& step);
    void drawInSteps(std::span<const Seen> chains, const Step& step, Shown& left, float begin, float end);
    Shown cross(std::span<const Seen> chains, const Step& step, const Shown& left, float begin, float end);
    void drawChains(const Step& step);
    void findEndedColumns(const Step& step);
    void sortToEndedColumns();
    void findHeights(std::span<const std::uint32_t> members, const Step& step);
    void thinHeights(std::size_t most);
    /// Columns of colours only.
    bool mayDrawEnds() const { return !isOneColor_ && !state_.hasPrograms(); }
    void drawEndedColumns(const Step& step);
    void leaveOutEndedColumns(std::span<const glm::vec4> changes);
    glm::vec4 drawFromEndToEnd(const EndedColumns& columns, const Step& step);
    void crossInPixels(std::span<const Seen> chains, const Step& step, float begin, float end);
    void findLayersOfPixels(float top, float bottom);
    void lookHere(Shown& shown);
    void measure(float top, float bottom);
    class OutlineSum;
    void addOutline(std::span<const Seen> chains, float height);
    bool addInOrder(const Step& step);
    void add(const PaintChange& change, const Step& step);
    void addInPixels(const Edge& left, const Edge& right, const Step& step);
    template <class Amount>
    static void addAlong(std::vector<Amount>& sums, float from, float to, const Amount& amount);
    void finishRow(float top, float bottom);

    const ViewChains& chains_;
    const glm::vec2* const vertices_;
    RegionState& state_;
    PixelColors& pixels_;
    const int width_;
    double meanCut_ = 0;  ///< chains that meet a row, in the mean; 0 until it is asked for
    std::vector<asset::Chord>* chords_ = nullptr;
    bool isOneLayer_ = false;  ///< all chains are of one
    bool isOneColor_ = false;  ///< and its inside is a colour
    bool isEvenOdd_ = false;   ///< if so
    glm::vec4 color_{0};
    bool isArranged_ = false;  ///< in the row
    bool hasSpecial_ = false;  ///< among those that were looked at
    ChainTaker taker_;
    std::vector<CutChain> cuts_;      ///< from the topmost layer down; of one layer from left to right
    std::vector<CutChain> arranged_;  ///< spare
    std::vector<Seen> seen_;          ///< those of them that may show in the step
    std::vector<Placed> order_;       ///< of these, from left to right
    std::vector<Seen> sorted_;        ///< in this order
    std::vector<Placed> spare_;
    std::vector<Step> steps_;
    std::vector<ContentChange> contentChanges_;
    LevelSides levelSides_;  ///< of the row
    std::vector<Piece> pieces_;
    std::vector<Seen> part_;  ///< some chains, in thinner steps
    std::vector<Placed> partOrder_;
    std::vector<Seen> partSorted_;
    std::vector<float> leftmost_;      ///< in sorted_, from i on
    std::vector<glm::vec4> sums_;      ///< by column: what changes there, times height
    std::vector<float> shares_;        ///< the same of one layer's inside, or of a region
    std::vector<float> sharesBefore_;  ///< a step that may be given up
    // Of pictures with programs.
    bool remembers_ = false;   ///< their paints
    bool isInPixels_ = false;  ///< or paints are composited in each pixel
    double costOfCut_ = 1;     ///< then, in the band
    bool isMeasured_ = false;  ///< that is known
    std::size_t pixelsAsked_ = 0, regionsAsked_ = 0;
    std::vector<Change> changes_;
    std::vector<glm::vec4> pixelSums_;  ///< by column: what regions show there, times height
    std::int32_t winding_ = 0;          ///< of one layer
    float drawn_ = 0;                   ///< of the row
    std::size_t smallSteps_ = 0;        ///< chains in smaller steps that may still be taken: by the step
    std::size_t smallInBand_ = 0;       ///< and by the rest of the band

    // Where layers begin and end in a step.
    std::vector<LayerEnd> ends_;
    std::vector<EndedColumns> endedColumns_;
    std::vector<float> heights_;
    std::vector<glm::vec4> inStep_, fine_;  ///< as sums_: of the step, and from end to end
    std::size_t endCuts_ = 0;        ///< chains from end to end that may still be looked at: in the band
    std::size_t endCutsInStep_ = 0;  ///< and in the step

    // Which layers show.
    bool hides_ = false;  ///< in the row
    int rowsShown_ = 0;   ///< in so many rows to come nobody looks
    CoveredRow squares_;
    std::vector<Touch> touches_;
};

inline void LineSweep::look(std::size_t number, const Step& step, Seen& seen) {
    CutChain& cut = cuts_[number];
    seen.cut = std::uint32_t(number);
    seen.layer = cut.layer;
    seen.winding = std::int8_t(cut.winding);
    if (!cut.spans(step.top, step.bottom))
        return lookAgain(cut, step, seen);
    seen.from = cut.a.x + (step.top - cut.a.y) * cut.slope;
    seen.to = cut.a.x + (step.bottom - cut.a.y) * cut.slope;
    seen.x = 0.5f * (seen.from + seen.to);
    seen.left = std::min(seen.from, seen.to);
    seen.right = std::max(seen.from, seen.to);
    seen.isAtMiddle = true;
    seen.hasEnd = false;
    seen.isSpecial = seen.right - seen.left > mostReach;
    hasSpecial_ = hasSpecial_ || seen.isSpecial;
}

/// Takes chains of cuts_, whose numbers are given.
template <class Numbers>
void LineSweep::takePart(const Numbers& numbers) {
    part_.clear();
    partOrder_.clear();
    for (const std::uint32_t number : numbers) {
        partOrder_.push_back({0, std::uint32_t(part_.size())});
        part_.emplace_back().cut = number;
    }
}

}  // namespace vtm::compiler
