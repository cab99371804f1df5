/// \file
/// The share of one pixel that is inside, where several parts of an outline pass through it and may cross.
#pragma once

#include <span>
#include <vector>

#include <vtm/scene/path.hpp>

namespace vtm::compiler {

/// Whether points of that winding number are inside.
inline bool isInside(scene::FillRule rule, int winding) {
    return rule == scene::FillRule::NonZero ? winding != 0 : (winding & 1) != 0;
}

/// A straight part of an outline in a pixel's own coordinates, going up: y0 < y1. Right of it the winding
/// number is greater by `change`. Parts of the same strand do not cross.
struct PixelEdge {
    double x0, y0, y1;
    double across;  ///< dx / dy
    int change, strand;

    double xAt(double y) const { return x0 + (y - y0) * across; }
};

/// From `y` up, the winding number at the pixel's left side is greater by `change`.
struct PixelStep {
    double y;
    int change;
};

/// Keeps its memory from pixel to pixel.
///
/// Between two heights at which something ends or crosses, edges are in one order, and what lies between two
/// of them is a trapezoid: its width in the middle times its height. Of many edges the crossings are too many
/// to be found pair by pair: the pixel is halved until few edges are left, or until a part is so low that the
/// order in its middle stands for all of it.
class CrowdedPixel {
public:
    /// `corner`: the winding number just above the lower left corner.
    double share(scene::FillRule rule, int corner, std::span<const PixelEdge> edges,
                 std::span<const PixelStep> steps);

private:
    struct Crossed {
        double x;
        int change;
    };

    double part(double low, double high, std::vector<PixelEdge>& edges, int depth);
    double halves(double low, double high, const std::vector<PixelEdge>& edges, int depth);
    double slabs(double low, double high, std::span<const PixelEdge> edges);
    void cutAtCrossings(double low, double high, std::span<const PixelEdge> edges);
    double width(double y, std::span<const PixelEdge> edges);
    int leftWinding(double y) const;

    scene::FillRule rule_{};
    int corner_ = 0;
    int maxDepth_ = 0;
    std::span<const PixelStep> steps_;
    std::vector<double> heights_;
    std::vector<Crossed> crossed_;
};

}  // namespace vtm::compiler
