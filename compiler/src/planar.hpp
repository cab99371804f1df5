/// \file
/// The planar map of one leaf: which paint lies on each side of every boundary in a square.
///
/// clip → snap → merge → label → certify, all on the integer lattice:
/// - clip: chains of chords are cut at the square; cuts are rounded to even positions of the odd border,
///   so they keep their order and never meet a corner;
/// - snap: crossings are rounded to even points and both chords pass through them, again and again
///   until nothing crosses and nothing is split any more (after Hobby 1999, iterated);
/// - merge: equal chains become one that carries the sum of each layer's change of winding;
/// - label: a sweep from the square's border gives the windings beside a chain; labels go on along
///   vertices of degree two;
/// - certify: see PlanarLeaf::certified.
#pragma once

#include <array>
#include <vector>

#include "compiler/src/palette.hpp"
#include "compiler/src/snap.hpp"

namespace vtm::compiler {

/// Gives regions their paints.
class RegionPaints {
public:
    virtual ~RegionPaints() = default;
    /// The paint of the region where the leaf's layers have these windings.
    virtual PaintId paint(std::span<const int> windings) = 0;
};

/// What lies beside an edge, seen along it from a to b.
struct Sides {
    PaintId left = 0, right = 0;
    bool known = false;
};

struct PlanarLeaf {
    const EdgeSet* set = nullptr;      ///< the edges; nothing if the leaf is beyond the limits
    std::vector<Sides> sides;          ///< of each edge
    std::array<PaintId, 4> corners{};  ///< paints at Square::corner(k)
    /// True if every label is proven: the windings close round the border; hash(left) - hash(right)
    /// cancels over the edges at every inner vertex and adds up to the corners' difference on every
    /// side. A false label would break one of them (but for 2^-64 of chance).
    bool certified = false;
};

/// Makes planar leaves; keeps its memory from leaf to leaf.
class Planariser {
public:
    /// `strands` by layer, whose numbers are places in `windings`: the windings at the square's first
    /// corner. Valid until the next call.
    const PlanarLeaf& run(const Square& square, Points points, std::span<const Strand> strands,
                          std::span<const int> windings, RegionPaints& paints);

private:
    using Windings = std::vector<int>;
    struct Axis;
    struct Place;
    /// An edge's end at a vertex.
    struct End {
        LatticePoint at;
        std::uint32_t edge;
        bool isA;
    };

    void collectEnds();
    int sideOf(LatticePoint p) const;
    void cross(Windings& w, const Edge& e, int times) const;
    Chord chordAt(const Axis& axis, const Edge& e, Coord m) const;
    static bool isBefore(const Place& f, const Place& e);
    void sweepTo(std::uint32_t index);
    void spread(std::uint32_t from);
    const End* other(std::uint32_t edge, bool isA) const;
    void along(Windings& w, std::size_t side) const;
    bool labelCorners();
    std::uint64_t flow(const End& end) const;
    bool certifyVertices() const;
    bool certifySides() const;

    Snapper snapper_;
    PlanarLeaf leaf_;
    Square square_;
    std::span<const int> corner_;
    RegionPaints* paints_ = nullptr;
    std::vector<End> ends_;             ///< sorted by vertex
    std::vector<std::uint32_t> endOf_;  ///< place in ends_ of edge e's a (2e) and b (2e + 1)
    std::array<std::vector<End>, 4> border_;
    Windings swept_, other_;
};

}  // namespace vtm::compiler
