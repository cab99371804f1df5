/// \file
/// Clipping, snapping and merging: from clipped runs to edges that meet only in vertices.
#pragma once

#include <vector>

#include "compiler/containers/slots.hpp"
#include "compiler/planar/clipped_run.hpp"

namespace vtm::compiler {

/// Winding on the left minus winding on the right, of one layer.
struct Change {
    std::uint32_t layer;
    int winding;
    friend bool operator==(const Change&, const Change&) = default;
};

/// A chain of chords from a to b, a < b, monotone in x and in y, with the changes of winding across it. It
/// runs through EdgeSet::vertices[first] (a) to [last] (b).
struct Edge {
    LatticePoint a, b;
    std::uint32_t first = 0, last = 0;
    std::uint32_t firstChange = 0, changeCount = 0;

    std::uint32_t chordCount() const { return last - first; }
};

/// Workspace of a leaf: unequal edges, and what they refer to.
struct EdgeSet {
    std::vector<LatticePoint> vertices;
    std::vector<Edge> edges;
    std::vector<Change> changes;
    /// How far snapping has bent an edge at most, in steps: the sum over the rounds of the largest distance
    /// between a rounded crossing and its chord.
    double bend = 0;

    std::span<const Change> of(const Edge& e) const {
        return {changes.data() + e.firstChange, e.changeCount};
    }
    /// From a to b, both included.
    std::span<const LatticePoint> chain(const Edge& e) const {
        return {vertices.data() + e.first, e.chordCount() + 1};
    }
    /// Vertex k of 0 (a) .. chordCount (b).
    LatticePoint vertex(const Edge& e, std::uint32_t k) const { return vertices[e.first + k]; }
};

/// Beyond these a leaf is given up, and its caller splits it.
inline constexpr std::size_t maxLeafEdges = 6000;
inline constexpr int maxSnapRounds = 60;

/// Turns clipped runs into edges; keeps its memory from leaf to leaf.
class Snapper {
public:
    /// The edges of the clipped runs, which all pass through the square's inside; their layers are places in
    /// the leaf's own list. Nothing if the leaf is beyond its limits. Valid until the next call.
    const EdgeSet* run(const Square& square, Points points, std::span<const ClippedRun> clippedRuns);

private:
    /// A place where an edge has to be cut: a vertex, or a point on chord `chord` (from vertex `chord`
    /// to the next).
    struct Split {
        std::uint32_t edge;
        std::uint32_t chord;
        LatticePoint at;
        std::int64_t progress;  ///< along the chord
        Chord by;               ///< the other one that meets it there
        std::uint32_t byEdge;
    };

    /// The line a→b of an edge, and how far the chain strays from it, as orient(a, b, ·) of its vertices.
    struct Band {
        double dx, dy, perLength2, low, high;
    };

    struct Pair {
        std::uint32_t e, f;
        bool isNear;  ///< chords have not been compared, or come near each other elsewhere than at a crossing
    };
    /// The first of the parts of an edge, and of their new chords.
    struct Parts {
        std::uint32_t edge, newChord;
    };
    struct NewChord {
        std::uint32_t edge, first;  ///< from vertex `first`
    };

    struct Place {
        std::uint64_t a;  ///< sortKey of the edge's
        std::uint32_t edge;
    };

    void clip(const Square& square, Points points, std::span<const ClippedRun> clippedRuns);
    void findBoxes();
    Band bandOf(const Edge& e) const;
    bool areApart(std::uint32_t e, std::uint32_t f) const;
    bool fanOut(const Edge& e, const Edge& f) const;
    bool meetInOneColumn(const Edge& e, const Edge& f) const;
    std::size_t gather(std::size_t first, std::size_t last, Coord low, Coord high);
    bool meetAll();
    void meet(std::uint32_t e, std::uint32_t f);
    void meetUpright(std::uint32_t e, const LatticePoint* p, std::uint32_t f, const LatticePoint* q);
    struct Meeting;
    void meetChords(const Meeting& m, std::uint32_t e, const LatticePoint* p, std::uint32_t f,
                    const LatticePoint* q);
    void bend(LatticePoint a, LatticePoint b, LatticePoint to);
    void split(std::uint32_t edge, std::uint32_t chord, LatticePoint at, const Chord& by,
               std::uint32_t byEdge);
    void sortSplits();
    void applySplits();
    void doubt(std::span<const Split> cuts);
    void beginParts();
    void part(const Edge& whole, const Split* from, const Split* to);
    bool partsMeet() const;
    bool newMeet(std::uint32_t e, std::uint32_t f) const;
    bool meetsPart(const Edge& e, std::uint32_t v, const Edge& f) const;
    void sortAndMerge();
    void mergeParts();
    int compare(const Edge& e, const Edge& f) const;
    void collect(const Edge& edge);
    void sumChanges(Edge& into);

    EdgeSet set_;
    double bentSquare_ = 0;                         ///< the largest bend of this round, squared
    std::vector<Coord> left_, right_, low_, high_;  ///< of each edge's box
    std::vector<Band> bands_;                       ///< of each edge
    std::vector<std::uint32_t> found_;
    std::vector<Pair> close_;  ///< edges that meet, or nearly so
    bool isNear_ = false;      ///< Pair::isNear of the pair at hand
    /// By edge: its parts may meet others though its chords were not near theirs.
    std::vector<std::uint8_t> isDoubtful_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> doubts_;  ///< so of two edges
    std::vector<Split> splits_, nextSplits_;
    std::vector<std::uint32_t> firstSplits_;  ///< by edge
    std::vector<Parts> parts_;                ///< by edge as it was, and the end of all
    std::vector<NewChord> newChords_;         ///< parts of bent chords
    std::vector<Change> sum_;
    std::vector<Edge> nextEdges_;
    std::vector<Place> order_, spareOrder_;
    Slots slots_;                           ///< of unequal edges
    std::vector<std::uint32_t> nextEqual_;  ///< by edge
};

}  // namespace vtm::compiler
