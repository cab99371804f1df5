/// \file
/// From the boundaries of a planar leaf to quantised pieces.
#pragma once

#include <array>
#include <vector>

#include <glm/vec2.hpp>

#include "compiler/src/planar.hpp"
#include "compiler/src/tree.hpp"

namespace vtm::compiler {

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
    using Steps = std::array<std::uint16_t, 2>;
    /// Consecutive boundary points with one paint on the left and one on the right.
    struct Chain {
        std::uint32_t first, count;  ///< of points_
        PaintId left, right;
    };
    /// Slopes of a piece over its chord.
    struct Slopes {
        double a = 0, b = 0;
    };

    void link(const PlanarLeaf& leaf);
    static std::uint32_t next(const PlanarLeaf& leaf, std::uint32_t edge, bool atB);
    void follow(const PlanarLeaf& leaf, std::uint32_t edge, bool fromA);

    glm::dvec2 exact(LatticePoint p) const;
    static Steps roundInside(glm::dvec2 u);
    Steps round(LatticePoint p) const;
    Steps rounded(std::uint32_t i) const;

    void cutSlivers();
    /// Leaf coordinates: one, and a lattice step.
    int sliverReach() const { return 1 + static_cast<int>(scale_); }
    bool isNearBorder(LatticePoint p) const;
    bool isSliver(const Chain& chain);
    bool cutAlong(const Chain& chain, LatticePoint start, LatticePoint end, PaintId outer, PaintId inner);
    bool isBorderFree(LatticePoint from, LatticePoint to) const;
    bool hugs(Steps p, Steps q, std::size_t from, std::size_t sides) const;

    void fit(const Chain& chain);
    std::uint32_t emitLongest(const Chain& chain, std::uint32_t from, std::uint32_t last);
    std::uint32_t reach(std::uint32_t from, std::uint32_t last) const;
    bool isFlat(std::uint32_t from, std::uint32_t to) const;
    double tryFit(std::uint32_t from, std::uint32_t to, Slopes& slopes);
    Slopes leastSquares(std::uint32_t last) const;
    double stray(const Slopes& m, std::uint32_t last) const;
    void emit(const Chain& chain, std::uint32_t from, std::uint32_t to, const Slopes& m);

    Square square_;
    double scale_ = 1;      ///< leaf coordinates a lattice step
    double tolerance_ = 0;  ///< leaf coordinates
    std::vector<std::uint8_t> used_;
    std::vector<LatticePoint> points_;
    std::vector<Chain> chains_;
    std::vector<glm::dvec2> exact_;  ///< the chain at hand in leaf coordinates
    std::array<Steps, 2> ends_{};    ///< of that chain
    std::vector<glm::dvec2> local_;
    FittedLeaf leaf_;
};

}  // namespace vtm::compiler
