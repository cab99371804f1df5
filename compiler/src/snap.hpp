/// \file
/// Clipping, snapping and merging: from strands to edges that meet only in vertices.
#pragma once

#include <vector>

#include "compiler/src/strand.hpp"

namespace vtm::compiler {

/// Winding on the left minus winding on the right, of one layer.
struct Change {
    std::uint32_t layer;
    int winding;
    friend bool operator==(const Change&, const Change&) = default;
};

/// A chain of chords from a to b, a < b, monotone in x and in y, with the changes of winding across
/// it. Between a and b it runs through `innerCount` vertices of the outlines, the first of them `inner`,
/// then upwards or (`backward`) downwards.
struct Edge {
    LatticePoint a, b;
    std::uint32_t inner = 0, innerCount = 0;
    bool backward = false;
    std::uint32_t firstChange = 0, changeCount = 0;
};

/// Workspace of a leaf: edges by (a, b), and what they refer to.
struct EdgeSet {
    Points points;
    std::vector<Edge> edges;
    std::vector<Change> changes;
    /// How far snapping has bent an edge at most, in steps: the sum over the rounds of the largest distance
    /// between a rounded crossing and its chord.
    double bend = 0;

    std::span<const Change> of(const Edge& e) const {
        return {changes.data() + e.firstChange, e.changeCount};
    }
    /// Those between a and b, from either end.
    std::span<const LatticePoint> inner(const Edge& e) const {
        return points.subspan(e.backward ? e.inner + 1 - e.innerCount : e.inner, e.innerCount);
    }
    /// Vertex k of 0 (a) .. innerCount + 1 (b).
    LatticePoint vertex(const Edge& e, std::uint32_t k) const {
        return k == 0 ? e.a : k > e.innerCount ? e.b : points[e.backward ? e.inner + 1 - k : e.inner + k - 1];
    }
};

/// Beyond these a leaf is given up, and its caller splits it.
inline constexpr std::size_t maxLeafEdges = 6000;
inline constexpr int maxSnapRounds = 60;

/// Turns strands into edges; keeps its memory from leaf to leaf.
class Snapper {
public:
    /// The edges of the strands inside the square; their layers are places in the leaf's own list.
    /// Nothing if the leaf is beyond its limits. Valid until the next call.
    const EdgeSet* run(const Square& square, Points points, std::span<const Strand> strands);

private:
    /// A place where an edge has to be cut: a vertex, or a point on chord `chord` (from vertex `chord`
    /// to the next).
    struct Split {
        std::uint32_t edge;
        std::uint32_t chord;
        LatticePoint at;
        std::int64_t progress;  ///< along the chord
    };

    /// Of an edge; (left, y of a) and (right, y of b) are its ends.
    struct Box {
        Coord left, right, low, high;
    };

    /// How far the chain strays from the line a→b, as orient(a, b, ·) of its vertices, and that line.
    struct Band {
        double dx, dy, length2, low, high;
    };

    struct Walk;
    struct Place {
        std::uint64_t a;  ///< sortKey of the edge's
        std::uint32_t edge;
    };

    void clip(const Square& square, std::span<const Strand> strands);
    Band bandOf(const Edge& e) const;
    bool isBeside(std::uint32_t e, std::uint32_t f) const;
    static bool shareEnd(const Edge& e, const Edge& f) { return e.a == f.a || e.b == f.b; }
    bool fanOut(const Edge& e, const Edge& f) const;
    bool findSplits();
    void meet(std::uint32_t e, std::uint32_t f);
    void meetChords(std::uint32_t e, const Walk& p, std::uint32_t f, const Walk& q);
    void bend(LatticePoint a, LatticePoint b, LatticePoint to);
    void split(std::uint32_t edge, std::uint32_t chord, LatticePoint at);
    void applySplits();
    void reverse(Edge& e);
    void part(const Edge& whole, LatticePoint from, LatticePoint to, std::uint32_t firstInner,
              std::uint32_t innerEnd, bool fresh);
    void mergeEqual();
    int compare(const Edge& e, const Edge& f) const;
    void addChanges(Edge& into, std::span<const Place> equal);

    EdgeSet set_;
    double bentSquare_ = 0;            ///< the largest bend of this round, squared
    std::vector<std::uint8_t> fresh_;  ///< made in the last round: only such edges can meet others anew
    std::vector<Box> boxes_;           ///< of each edge
    std::vector<Band> bands_;          ///< of each edge
    std::vector<Split> splits_;
    std::vector<Change> sum_;
    std::vector<Edge> nextEdges_;
    std::vector<std::uint8_t> nextFresh_;
    std::vector<Place> order_;
};

}  // namespace vtm::compiler
