/// \file
/// The edges of a leaf, which meet only in vertices once they have been snapped: how they lie to each other,
/// their parts where they are cut, and equal ones as one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "compiler/containers/slots.hpp"
#include "compiler/lower/lattice.hpp"
#include "compiler/lower/outline.hpp"

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

inline bool isBetween(Coord low, Coord v, Coord high) { return low <= v && v <= high; }

/// Whether p, known to lie on the line of a→b, lies on the chord, ends included.
inline bool isOnChord(LatticePoint a, LatticePoint b, LatticePoint p) {
    return isBetween(std::min(a.x, b.x), p.x, std::max(a.x, b.x)) &&
           isBetween(std::min(a.y, b.y), p.y, std::max(a.y, b.y));
}

/// The first of first .. last - 1, whose x rise, that is not below x; else last. Its steps depend on the
/// count alone.
inline const LatticePoint* firstNotBelow(const LatticePoint* first, const LatticePoint* last, Coord x) {
    auto count = last - first;
    for (; count > 1; count -= count / 2)
        first += first[count / 2 - 1].x < x ? count / 2 : 0;
    return first + (count == 1 && first->x < x);
}

/// Whether both are on one side of zero, and farther from it than `reach`.
inline bool areBeyond(std::int64_t p, std::int64_t q, std::int64_t reach) {
    return ((p > reach) & (q > reach)) | ((p < -reach) & (q < -reach));
}

inline bool overlap(Coord a, Coord b, Coord c, Coord d) {
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

/// Steps, more than two edges that are bent by √2 come nearer to each other.
inline constexpr int bendReach = 3;

/// orient(a, b, ·) of points within bendReach of the line a→b is no more.
inline std::int64_t near(LatticePoint a, LatticePoint b) {
    return bendReach * (std::abs(std::int64_t{b.x} - a.x) + std::abs(std::int64_t{b.y} - a.y));
}

/// A place where an edge has to be cut: a vertex, or a point on chord `chord` (from vertex `chord` to the
/// next).
struct Cut {
    std::uint32_t edge;
    std::uint32_t chord;
    LatticePoint at;
    std::int64_t progress;  ///< along the chord
    Chord by;               ///< the other one that meets it there
    std::uint32_t byEdge;
};

/// Edges that meet, or nearly so.
struct EdgePair {
    std::uint32_t e, f;
    bool isNear;  ///< chords have not been compared, or come near each other elsewhere than at a crossing
};

/// Keeps its memory from leaf to leaf.
class EdgeCutter {
public:
    /// Replaces every edge that has cuts by its parts, ordered along it. Sorts the cuts.
    void run(EdgeSet& set, std::vector<Cut>& cuts);

    /// Whether parts of the last run meet anywhere but at their ends. A bent chord stays in the box of the
    /// chord that it was, so only edges that were `close` can; most of these have been seen to stay clear of
    /// each other but where they cross. `isRechecked`: edges, as they were, whose parts may meet others
    /// though their chords were not near theirs.
    bool partsMeet(const EdgeSet& set, std::span<const EdgePair> close,
                   const std::vector<std::uint8_t>& isRechecked) const;

private:
    /// The first of the parts of an edge, and of their new chords.
    struct Parts {
        std::uint32_t edge, newChord;
    };
    struct NewChord {
        std::uint32_t edge, first;  ///< from vertex `first`
    };

    void sort(std::size_t edges, std::vector<Cut>& cuts);
    void recheck(std::span<const Cut> cuts);
    void beginParts(const EdgeSet& set);
    void part(EdgeSet& set, const Edge& whole, const Cut* from, const Cut* to);
    bool newMeet(const EdgeSet& set, std::uint32_t e, std::uint32_t f) const;
    bool newMeetUpright(const EdgeSet& set, std::uint32_t e, std::uint32_t f) const;

    std::vector<Cut> nextCuts_;
    std::vector<std::uint32_t> firstCuts_;  ///< by edge
    std::vector<Edge> nextEdges_;
    std::vector<Parts> parts_;         ///< by edge as it was, and the end of all
    std::vector<NewChord> newChords_;  ///< parts of bent chords
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        rechecked_;  ///< edges as they were, whose parts may meet
};

/// Joins equal edges and adds their changes; edges without any change vanish. Keeps its memory from leaf to
/// leaf.
class EdgeMerger {
public:
    /// Sorts the edges by their a, too.
    void sortAndMerge(EdgeSet& set);
    /// Leaves the edges in the order in which they stand.
    void merge(EdgeSet& set);

private:
    struct Place {
        std::uint64_t a;  ///< sortKey of the edge's
        std::uint32_t edge;
    };

    void collect(std::span<const Change> changes);
    void sumChanges(EdgeSet& set, Edge& into);

    std::vector<Change> sum_;
    std::vector<Edge> nextEdges_;
    std::vector<Place> order_, spareOrder_;
    Slots slots_;                           ///< of unequal edges
    std::vector<std::uint32_t> nextEqual_;  ///< by edge
};

}  // namespace vtm::compiler
