/// \file
/// Equal edges become one.
#pragma once

#include <span>
#include <vector>

#include "compiler/containers/slots.hpp"
#include "compiler/planar/edges.hpp"

namespace vtm::compiler {

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
