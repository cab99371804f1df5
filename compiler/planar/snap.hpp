/// \file
/// Clipping, snapping and merging: from clipped runs to edges that meet only in vertices.
#pragma once

#include <limits>
#include <vector>

#include "compiler/planar/clipped_run.hpp"
#include "compiler/planar/edges.hpp"

namespace vtm::compiler {

/// Beyond these a leaf is given up, and its caller splits it.
inline constexpr std::size_t maxLeafEdges = 6000;
inline constexpr int maxSnapRounds = 60;
inline constexpr double anyBend = std::numeric_limits<double>::infinity();

/// Turns clipped runs into edges; keeps its memory from leaf to leaf.
class Snapper {
public:
    /// The edges of the clipped runs, which all pass through the square's inside; their layers are places in
    /// the leaf's own list. Nothing if the leaf is beyond its limits, or edges are bent by more than
    /// `maxBend`. Valid until the next call.
    const EdgeSet* run(const Square& square, Points points, std::span<const ClippedRun> clippedRuns,
                       double maxBend = anyBend);

private:
    /// The line a→b of an edge, and how far the chain strays from it, as orient(a, b, ·) of its vertices.
    struct Band {
        double dx, dy, perLength2, low, high;
    };

    void clip(const Square& square, Points points, std::span<const ClippedRun> clippedRuns);
    bool beginAgainByPixels(const Square& square, Points points, std::span<const ClippedRun> clippedRuns);
    void meetPixels(std::uint32_t edge, std::uint32_t chord);
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
    void cut(std::uint32_t edge, std::uint32_t chord, LatticePoint at, const Chord& by, std::uint32_t byEdge);

    EdgeSet set_;
    double bentSquare_ = 0;                         ///< the largest bend of this round, squared
    std::vector<Coord> left_, right_, low_, high_;  ///< of each edge's box
    std::vector<Band> bands_;                       ///< of each edge
    std::vector<std::uint32_t> found_;
    std::vector<EdgePair> close_;
    bool isNear_ = false;  ///< EdgePair::isNear of the pair at hand
    /// By edge: its parts may meet others though its chords were not near theirs.
    std::vector<std::uint8_t> isRechecked_;
    std::vector<Cut> cuts_;
    std::vector<LatticePoint> hot_;  ///< the middles of hot pixels
    EdgeCutter cutter_;
    EdgeMerger merger_;
};

}  // namespace vtm::compiler
