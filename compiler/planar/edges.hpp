/// \file
/// The edges of a leaf, which meet only in vertices once they have been snapped.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/lower/lattice.hpp"

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

}  // namespace vtm::compiler
