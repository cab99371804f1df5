/// \file
/// Edges and the places where they meet in, their parts out.
#pragma once

#include <span>
#include <vector>

#include "compiler/lower/outline.hpp"
#include "compiler/planar/edges.hpp"

namespace vtm::compiler {

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

    std::vector<Cut> nextCuts_;
    std::vector<std::uint32_t> firstCuts_;  ///< by edge
    std::vector<Edge> nextEdges_;
    std::vector<Parts> parts_;         ///< by edge as it was, and the end of all
    std::vector<NewChord> newChords_;  ///< parts of bent chords
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        rechecked_;  ///< edges as they were, whose parts may meet
};

}  // namespace vtm::compiler
