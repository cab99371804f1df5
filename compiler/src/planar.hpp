/// \file
/// The planar map of one leaf: which paint lies on each side of every boundary in a square.
///
/// clip → snap → merge → label → certify, all on the integer lattice:
/// - clip: chords are cut at the square; cuts are rounded to even positions of the odd border, so
///   they keep their order and never meet a corner;
/// - snap: crossings are rounded to even points and both chords pass through them, again and again
///   until nothing crosses and nothing is split any more (after Hobby 1999, iterated);
/// - merge: equal edges become one that carries the sum of each layer's change of winding;
/// - label: a sweep from the square's first corner gives the windings beside an edge; labels go on
///   along vertices of degree two;
/// - certify: see PlanarLeaf::certified.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "compiler/src/outline.hpp"

namespace vtm::compiler {

/// A chord of one of the leaf's layers, by the layer's place in the leaf's own list.
struct LeafChord {
    Chord chord;
    std::uint32_t layer;
};

/// A boundary between two different paints.
struct PlanarEdge {
    LatticePoint a, b;
    std::uint16_t left = 0, right = 0;
};

struct PlanarLeaf {
    std::vector<PlanarEdge> edges;
    std::array<std::uint16_t, 4> corners{};  ///< paints at Square::corner(k)
    /// True if every label is proven: the windings close round the border; hash(left) - hash(right)
    /// cancels over the edges at every inner vertex and adds up to the corners' difference on every
    /// side. A false label would break one of them (but for 2^-64 of chance).
    bool certified = false;
};

/// The paint of a region from the windings of the leaf's layers.
using Labeller = std::function<std::uint16_t(std::span<const int>)>;

/// Beyond these a leaf is given up, uncertified, and its caller splits it.
inline constexpr std::size_t maxLeafEdges = 6000;
inline constexpr int maxSnapRounds = 60;

/// `windings` of the layers at the square's first corner.
PlanarLeaf planarise(const Square& square, std::span<const LeafChord> chords, std::span<const int> windings,
                     const Labeller& labeller);

}  // namespace vtm::compiler
