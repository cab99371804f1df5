/// \file
/// The vertices in which edges meet.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "compiler/containers/slots.hpp"
#include "compiler/planar/snap.hpp"

namespace vtm::compiler {

/// The end of edge `end / 2` at its a (even) or b (odd).
using EdgeEnd = std::uint32_t;

constexpr EdgeEnd endAtA(std::uint32_t edge) { return 2 * edge; }
constexpr EdgeEnd endAtB(std::uint32_t edge) { return 2 * edge + 1; }
constexpr EdgeEnd otherEnd(EdgeEnd end) { return end ^ 1; }
constexpr bool isAtA(EdgeEnd end) { return end % 2 == 0; }

/// The ends of a leaf's edges by vertex; keeps its memory from leaf to leaf.
class Vertices {
public:
    struct Vertex {
        LatticePoint at;
        std::uint32_t first = 0, count = 0;  ///< its ends
        bool isInner() const { return ((at.x | at.y) & 1) == 0; }
    };

    /// Ends stand counter-clockwise round inner vertices, from -y, and along the border in the order in which
    /// one crosses their edges on the way along it (along +x and +y).
    void collect(const EdgeSet& set, const Square& square);

    const std::vector<Vertex>& all() const { return vertices_; }
    std::uint32_t of(EdgeEnd end) const { return vertexOf_[end]; }
    std::span<const EdgeEnd> ends(const Vertex& v) const { return {ends_.data() + v.first, v.count}; }
    /// The place of an end among those of its vertex.
    std::uint32_t place(EdgeEnd end) const { return placeOf_[end] - vertices_[vertexOf_[end]].first; }
    /// The ends on a side, in the order of +x or +y.
    const std::vector<EdgeEnd>& border(std::size_t side) const { return border_[side]; }

private:
    void findVertices(const EdgeSet& set);
    std::uint32_t numberOf(LatticePoint at);
    void groupEnds();
    void sortRound(const EdgeSet& set, const Vertex& v);
    void sortAlong(const EdgeSet& set, const Vertex& v, std::size_t side);
    void listBorder(const EdgeSet& set);

    std::vector<Vertex> vertices_;
    Slots slots_;                                    ///< of the vertices
    std::vector<std::uint32_t> vertexOf_, placeOf_;  ///< by end; placeOf_: in ends_
    std::vector<EdgeEnd> ends_;
    std::array<std::vector<std::uint32_t>, 4> onSide_;  ///< vertices
    std::array<std::vector<EdgeEnd>, 4> border_;
};

}  // namespace vtm::compiler
