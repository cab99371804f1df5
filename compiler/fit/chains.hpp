/// \file
/// The boundaries of a planar leaf that are visible, linked into chains.
#pragma once

#include <vector>

#include "compiler/planar/planar.hpp"

namespace vtm::compiler {

/// Consecutive points of a boundary with one paint on the left and one on the right.
struct Chain {
    std::uint32_t first, count;  ///< points, of Chains::x and y
    PaintId left, right;
    LatticePoint start, end;
};

/// Keeps its memory from leaf to leaf.
class Chains {
public:
    /// Links edges with different paints on both sides through vertices where exactly two of them, with the
    /// same paints, meet. Points are stored in leaf coordinates, `scale` a lattice step.
    void link(const PlanarLeaf& leaf, const Square& square, double scale);

    std::vector<Chain> all;
    std::vector<double> x, y;  ///< there is one more than the chains have

private:
    /// The visible ends at a vertex.
    struct Meeting {
        std::uint32_t count = 0;
        EdgeEnd ends = 0;  ///< joined by exclusive or: two tell each other
    };

    void meet(const PlanarLeaf& leaf);
    EdgeEnd partner(const PlanarLeaf& leaf, EdgeEnd end) const;
    void follow(const PlanarLeaf& leaf, EdgeEnd end);
    void append(const PlanarLeaf& leaf, const Edge& edge, bool fromA);

    LatticePoint origin_;
    double scale_ = 1;
    std::uint32_t points_ = 0;
    std::vector<std::uint8_t> used_;  ///< by edge; those that are not visible count as used
    std::vector<Meeting> meetings_;   ///< by vertex
};

}  // namespace vtm::compiler
