/// \file
/// The share of one pixel that is inside, where several parts of an outline pass through it and may cross.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <vtm/scene/path.hpp>

namespace vtm::compiler {

/// Whether points of that winding number are inside.
inline bool isInside(scene::FillRule rule, int winding) {
    return rule == scene::FillRule::NonZero ? winding != 0 : (winding & 1) != 0;
}

/// A straight part of an outline in a pixel's own coordinates, going up: y0 < y1. Right of it the winding
/// number is greater by `change`. Where it comes from the pixel's left side, or leaves there, it is taken to
/// go on along that side, from `low` or up to `high`.
struct PixelEdge {
    double x0, y0, x1, y1;
    double across;  ///< dx / dy
    int change;
    double low = y0, high = y1;

    double xAt(double y) const { return x0 + (y - y0) * across; }
};

/// Keeps its memory from pixel to pixel.
///
/// Few edges are solved exactly. The winding number on an edge's left changes where another one begins, ends
/// or crosses it; between, the edge divides inside from outside or it does not, and the area on its right
/// counts. Which of two edges is on the left is asked once for both, so that they agree.
///
/// Of many edges, winding numbers are taken at places along lines. These rise by the distance between them,
/// and each has its places elsewhere: so all heights and all columns are met, whichever way edges go.
class CrowdedPixel {
public:
    /// `corner`: the winding number left of all edges.
    double share(scene::FillRule rule, int corner, std::span<const PixelEdge> edges);

private:
    struct Change {
        double y;
        int change;
    };
    /// The winding number on an edge's left, from its lower end on.
    struct Left {
        int winding;
        std::vector<Change> changes;
    };

    double exact(int corner, std::span<const PixelEdge> edges);
    void meet(std::size_t i, std::size_t k);
    void addBeside(std::size_t edge, const PixelEdge& other);
    void add(std::size_t edge, int change, double from, double to);
    template <class Take>
    void forEachPart(std::size_t edge, const Take& take);

    static constexpr std::size_t lines = 128, places = 128, bits = 64;
    template <class T>
    using ByLine = std::array<T, lines>;

    double alongLines(int corner, std::span<const PixelEdge> edges);
    template <class Cross>
    static void crossLines(const PixelEdge& edge, const Cross& cross);
    int oddPlaces(int corner, std::span<const PixelEdge> edges);
    int woundPlaces(int corner, std::span<const PixelEdge> edges);

    scene::FillRule rule_{};
    std::vector<PixelEdge> edges_;  ///< the last one is the pixel's left side
    std::vector<Left> lefts_;
    std::array<ByLine<std::uint64_t>, places / bits + 1> odd_;  ///< a bit a place: where that changes
    std::array<ByLine<std::int16_t>, places + 1> wound_;        ///< the same of winding numbers
};

}  // namespace vtm::compiler
