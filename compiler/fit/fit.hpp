/// \file
/// From the boundaries of a planar leaf to quantised pieces.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "compiler/fit/chains.hpp"
#include "compiler/lower/pairs.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// Slopes beyond tan 22.5° are not fitted: longer turns take more pieces, which keeps four chords a
/// piece enough for the renderers (docs/coverage.md).
inline constexpr double maxSlope = 0.4142135623730951;

/// Points along a chord, from 0 to 1, and across it; one or two more fill the last pair.
struct LocalPoints {
    static constexpr std::uint32_t maxChords = 48;

    std::array<double, maxChords + 3> along, across;
};

/// Fits slopes over a chord; holds its workspace.
class PieceFit {
public:
    /// In units of 1 / asset::slopeScale.
    struct Slopes {
        std::int16_t a = 0, b = 0;
    };

    /// Slopes over the chord from a to b for points 0 .. last of a chain, 2 <= last <=
    /// LocalPoints::maxChords, of which the first and the last are about a and b. Returns by what factor the
    /// chain is too long, roughly; at most 1 if it stays within `tolerance` of the piece. That the chain's
    /// own ends are not quite a and b is not counted. Reads a point more.
    double run(const double* x, const double* y, std::uint32_t last, Pair a, Pair b, double tolerance);
    Slopes slopes() const { return slopes_; }

private:
    Slopes slopes_;
    LocalPoints local_;
};

struct FittedLeaf {
    std::vector<Tree::Piece> pieces;
    std::array<PaintId, 4> corners{};
    bool slivers = false;  ///< some have been cut
};

/// Fits pieces; keeps its memory from leaf to leaf.
class Fitter {
public:
    /// Chains of edges between junctions become Hermite pieces. End points are rounded to leaf
    /// coordinates; each piece stays within `tolerance` lattice steps of its chain, unless the chain
    /// cannot be met (a single edge is always a piece). Edges with equal paints on both sides and
    /// slivers along the border, thinner than a step, are dropped. Valid until the next call.
    const FittedLeaf& run(const Square& square, const PlanarLeaf& leaf, double tolerance);

private:
    /// Points in leaf coordinates; rounded ones are whole.
    Pair exact(std::uint32_t point) const { return Pair{chains_.x[point], chains_.y[point]}; }
    static Pair roundInside(Pair u);
    Pair roundEnd(LatticePoint p, std::uint32_t point) const;
    Pair rounded(const Chain& chain, std::uint32_t i) const;

    void cutSlivers();
    /// Leaf coordinates: one, and a lattice step.
    double sliverReach() const { return 1 + std::floor(scale_); }
    bool isNearBorder(Pair u) const;
    bool isSliver(const Chain& chain);
    bool cutAlong(const Chain& chain, LatticePoint start, LatticePoint end, PaintId outer, PaintId inner);
    bool isBorderFree(LatticePoint from, LatticePoint to) const;
    bool hugs(Pair p, Pair q, std::size_t from, std::size_t sides) const;

    void fit(const Chain& chain);
    std::uint32_t emitLongest(const Chain& chain, std::uint32_t from, Pair& a, Pair end);
    std::uint32_t reach(std::uint32_t from, std::uint32_t last) const;

    Square square_;
    double scale_ = 1;      ///< leaf coordinates a lattice step
    double tolerance_ = 0;  ///< leaf coordinates
    Chains chains_;
    PieceFit pieceFit_;
    FittedLeaf leaf_;
};

}  // namespace vtm::compiler
