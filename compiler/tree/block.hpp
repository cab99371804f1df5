/// \file
/// A block: one subtree, built by one thread.
#pragma once

#include <atomic>
#include <deque>

#include "compiler/fit/fit.hpp"
#include "compiler/planar/planar.hpp"
#include "compiler/tree/cell.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// Pairs of chords looked at before the picture is refused.
class WorkLimit {
public:
    explicit WorkLimit(std::size_t maximum) : maximum_(maximum) {}

    /// Throws LimitError beyond the limit.
    void spend(std::size_t work);

private:
    const std::size_t maximum_;
    std::atomic<std::size_t> spent_{0};
};

/// What passing one chord down a level, or classifying one point by it, counts in pairs. Without it
/// thousands of equal outlines, which go down to the last level, are divided and sampled for minutes.
inline constexpr std::size_t visitWork = 100;

/// Drops the layers that cannot show in a cell.
class Culler {
public:
    Culler(const LoweredScene& picture, Painter& painter)
        : picture_(picture), painter_(painter), covers_(picture.layers.size(), Cover::Out) {}
    void run(Cell& cell);

private:
    const LoweredScene& picture_;
    Painter& painter_;
    std::vector<Cover> covers_;  ///< by layer
    std::vector<std::uint32_t> layers_;
    std::vector<std::uint8_t> keep_;
};

/// The regions of a block's cells. The paint of each set of layers is asked for once.
class LeafRegions : public RegionPaints {
public:
    LeafRegions(const LoweredScene& picture, Painter& painter)
        : picture_(picture), painter_(painter), inside_(picture.layers.size()) {}
    void enter(const Cell& cell, Palette& palette);
    /// The paint of a cell without clipped runs, which need not be culled yet.
    PaintId solid(Cell& cell, Culler& culler, Palette& palette);

    std::vector<std::uint32_t> layers;  ///< of the cell, ascending: the others are numbered by them

private:
    PaintId compute() override;

    const LoweredScene& picture_;
    Painter& painter_;
    Palette* palette_ = nullptr;
    std::vector<std::uint8_t> inside_;  ///< by layer: false for all but those of the cell
    std::vector<Layer> entered_;
};

/// Builds blocks, one after the other, keeping its memory.
class BlockBuilder {
public:
    BlockBuilder(const LoweredScene& picture, const Painter& painter, const TreeOptions& options,
                 WorkLimit& work)
        : picture_(picture),
          points_(picture.outlines.points),
          painter_(painter.clone()),
          options_(options),
          work_(work),
          culler_(picture, *painter_),
          regions_(picture, *painter_) {}

    /// `timed`: adds to times().
    Tree run(Cell cell, bool timed);
    const TreeTimes& times() const { return times_; }

private:
    /// An entry and what it costs, all below it included.
    struct Built {
        asset::Entry entry;
        double cost = 0;
    };
    using Children = std::array<Cell, 16>;
    /// How a cell's clipped runs spread over its children: how many of these they end in, and how many visits
    /// they pay them.
    struct Spread {
        int leaves = 0, visits = 0;
    };

    void lap(double& stage);
    Built build(Cell& cell);
    Built buildFixed(Cell& cell);
    Built buildBest(Cell& cell);
    Built buildLast(Cell& cell);
    Built buildNode(const Cell& cell, Children& children);
    Children& divide(const Cell& cell);
    bool mayBeWorthSplitting(double pieces, unsigned level) const;
    Spread spreadOf(const Cell& cell) const;
    double minSplitCost(const Spread& spread, unsigned level, double piecesPerRun) const;
    double splitCost(const Children& children, double piecesPerRun) const;
    Built solid(PaintId paint, unsigned level) const;
    bool canTry(const Cell& cell);
    std::size_t distinctChords(const Cell& cell, std::size_t maximum) const;
    /// A leaf and how far its boundaries may be off, lattice steps.
    struct Made {
        const FittedLeaf* leaf = nullptr;
        double error = 0;
        explicit operator bool() const { return leaf; }
        std::size_t pieceCount() const { return leaf->pieces.size(); }
    };
    Made makeLeaf(const Cell& cell);
    Built emit(const Made& made, unsigned level);
    Built emitMean(const Cell& cell);

    const LoweredScene& picture_;
    const Points points_;
    const std::unique_ptr<Painter> painter_;
    const TreeOptions& options_;
    WorkLimit& work_;
    Culler culler_;
    LeafRegions regions_;
    Planariser planariser_;
    Fitter fitter_;
    std::vector<ClippedRun> runs_;
    std::deque<Children> children_;  ///< by level; a deque, so that growing moves none
    unsigned firstLevel_ = 0;
    Tree tree_;  ///< without its pieces
    std::vector<Tree::Piece> pieces_;
    TreeTimes times_;
    bool timed_ = false;
    Clock::time_point lastLap_;
};

}  // namespace vtm::compiler
