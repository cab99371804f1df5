/// \file
/// The planar map of one leaf: which paint lies on each side of every boundary in a square.
///
/// clip → snap → merge → label → certify, all on the integer lattice:
/// - clip: chains of chords are cut at the square; cuts are rounded to even positions of the odd border,
///   so they keep their order and never meet a corner;
/// - snap: crossings are rounded to even points and both chords pass through them, again and again
///   until nothing crosses and nothing is split any more (after Hobby 1999, iterated);
/// - merge: equal chains become one that carries the sum of each layer's change of winding;
/// - label: one walks along the square's border, and from there along edges and round vertices, crossing
///   one edge after the other; a sweep from the border tells where a part of the map stands that does not
///   reach it;
/// - certify: see PlanarLeaf::certified.
#pragma once

#include <array>
#include <vector>

#include "compiler/paint/region_paints.hpp"
#include "compiler/planar/vertices.hpp"

namespace vtm::compiler {

/// What lies beside an edge, seen along it from a to b.
struct Sides {
    PaintId left = 0, right = 0;
    bool known = false;
};

struct PlanarLeaf {
    const EdgeSet* set = nullptr;      ///< the edges; nothing if the leaf is beyond the limits
    Vertices vertices;                 ///< of the edges
    std::vector<Sides> sides;          ///< of each edge
    std::array<PaintId, 4> corners{};  ///< paints at Square::corner(k)
    /// True if every label is proven: the windings close round every inner vertex and round the border;
    /// they are the same beside an edge as found from both of its ends; hash(left) - hash(right) cancels over
    /// the edges at every inner vertex and adds up to the corners' difference on every side. A false label
    /// would break one of them (but for 2^-64 of chance).
    bool certified = false;
};

/// Makes planar leaves; keeps its memory from leaf to leaf.
class Planariser {
public:
    /// `clipped runs` by layer, numbered as `regions`, which stands in this leaf, numbers them. A leaf whose
    /// edges are bent by more than `maxBend` is given up. Valid until the next call.
    const PlanarLeaf& run(const Square& square, Points points, std::span<const ClippedRun> clippedRuns,
                          RegionPaints& regions, double maxBend = anyBend);

private:
    struct Axis;
    struct Place;
    /// A vertex that is being walked round, clockwise from `arrival`.
    struct Visit {
        std::span<const EdgeEnd> ends;
        std::uint32_t at;    ///< the end whose edge has been crossed last, of these
        std::uint32_t left;  ///< ends that are left to cross
        bool followed;       ///< the next end's edge has been followed to its other vertex
        std::uint64_t windingSum;
    };

    void cross(std::uint32_t edge, int times);
    Chord chordAt(const Axis& axis, const Edge& e, Coord m) const;
    static bool isBefore(const Place& f, const Place& e);
    void sweepTo(std::uint32_t index);
    void walkFrom(std::uint32_t edge);
    void arrive(EdgeEnd end);
    void walk();
    void crossFrom(EdgeEnd end);
    void along(std::size_t side);
    bool labelFromBorder();
    void findFlows();
    std::uint64_t flow(EdgeEnd end) const;
    bool certifyVertices() const;
    bool certifySides() const;

    Snapper snapper_;
    PlanarLeaf leaf_;
    Square square_;
    RegionPaints* regions_ = nullptr;
    bool consistent_ = true;
    std::vector<std::uint8_t> visited_;    ///< by vertex; those on the border count as visited
    std::vector<std::uint64_t> leftSums_;  ///< by edge whose sides are known: the windings' sum on its left
    std::vector<Visit> visits_;
    std::vector<std::uint64_t> flows_;  ///< by edge
};

}  // namespace vtm::compiler
