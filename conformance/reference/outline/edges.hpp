/// \file
/// Outlines as directed edges in pixel space.
#pragma once

#include <vector>

#include "conformance/reference/outline/geometry.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::reference {

/// A straight edge from its upper to its lower end (a horizontal one: as it runs). Stored the same way
/// whichever way it ran, so that two shapes that share it find the same crossings.
struct Edge {
    double x0, y0, x1, y1;  ///< y0 <= y1
    int shape;
    int winding;  ///< +1 if it ran from (x0, y0) to (x1, y1), else -1

    double xAt(double y) const {
        if (y <= y0)
            return x0;
        return y >= y1
                   ? x1
                   : std::clamp(x0 + (y - y0) / (y1 - y0) * (x1 - x0), std::min(x0, x1), std::max(x0, x1));
    }
};

/// Gathers a shape's edges. Leaves out those that no pixel's winding depends on: above, below and to
/// the right of the view.
class EdgeList {
public:
    EdgeList(int width, int height);

    void add(Point from, Point to, int shape);
    void addPolygon(std::span<const Point> points, int shape);
    /// Around all that was added and lies in the view; min > max if nothing does.
    Box bounds() const;
    const std::vector<Edge>& edges() const { return edges_; }
    std::vector<Edge> take() { return std::move(edges_); }

private:
    double width_, height_;
    Box added_;  ///< around all points
    std::vector<Edge> edges_;
};

Box boxOf(const View& view);

/// The edges of a path's fill; open subpaths are closed.
void addFill(const scene::Path& path, const Affine& toPixels, const View& view, double flatness, int shape,
             EdgeList& edges);

}  // namespace vtm::reference
