/// \file
/// Clipping, snapping and merging: from chords to edges that meet only in vertices.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compiler/src/planar.hpp"

namespace vtm::compiler {

/// Winding on the left minus winding on the right, of one layer.
struct Change {
    std::uint32_t layer;
    int winding;
    friend bool operator==(const Change&, const Change&) = default;
};

/// An edge from a to b, a < b, with the changes of winding across it.
struct Edge {
    LatticePoint a, b;
    std::uint32_t firstChange = 0, changeCount = 0;
};

struct EdgeSet {
    std::vector<Edge> edges;
    std::vector<Change> changes;

    std::span<const Change> of(const Edge& e) const {
        return {changes.data() + e.firstChange, e.changeCount};
    }
};

/// Nothing if the leaf is beyond its limits.
std::optional<EdgeSet> snap(const Square& square, std::span<const LeafChord> chords);

}  // namespace vtm::compiler
