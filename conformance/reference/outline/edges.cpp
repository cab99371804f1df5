#include "conformance/reference/outline/edges.hpp"

#include <glm/common.hpp>
#include <numbers>

#include <vtm/limits/limits.hpp>
#include "conformance/reference/outline/flatten.hpp"

namespace vtm::reference {
namespace {

/// Pixel coordinates beyond it are moved onto it, so that no difference of two overflows. At this
/// distance neighbouring doubles lie 2^-2 pixels apart, and an edge's place in the view means nothing.
constexpr double farthest = 1e15;

double pinned(double v) { return std::isnan(v) ? 0 : std::clamp(v, -farthest, farthest); }

Point pinned(Point p) { return {pinned(p.x), pinned(p.y)}; }

}  // namespace

EdgeList::EdgeList(int width, int height)
    : width_(width), height_(height), added_{Point(farthest), Point(-farthest)} {}

Box EdgeList::bounds() const {
    return {{std::max(added_.min.x, 0.0), std::max(added_.min.y, 0.0)},
            {std::min(added_.max.x, width_), std::min(added_.max.y, height_)}};
}

void EdgeList::add(Point from, Point to, int shape) {
    from = pinned(from);
    to = pinned(to);
    added_.min = glm::min(added_.min, glm::min(from, to));
    added_.max = glm::max(added_.max, glm::max(from, to));
    if (std::max(from.y, to.y) < 0 || std::min(from.y, to.y) >= height_ || std::min(from.x, to.x) >= width_ ||
        from == to)
        return;
    // Horizontal edges too are stored one way only.
    const bool forward = from.y < to.y || (from.y == to.y && from.x < to.x);
    if (forward)
        edges_.push_back({from.x, from.y, to.x, to.y, shape, 1});
    else
        edges_.push_back({to.x, to.y, from.x, from.y, shape, -1});
}

void EdgeList::addPolygon(std::span<const Point> points, int shape) {
    for (std::size_t i = 0; i < points.size(); ++i)
        add(points[i], points[(i + 1) % points.size()], shape);
}

Box boxOf(const View& view) { return {{0, 0}, {view.width, view.height}}; }

void addFill(const scene::Path& path, const Affine& toPixels, const View& view, double flatness, int shape,
             EdgeList& edges) {
    const Fineness fineness{toPixels, boxOf(view), flatness, 2 * std::numbers::pi, wholePiece};
    for (const Subpath& subpath : subpaths(path)) {
        Point last = scene::apply(toPixels, subpath.start);
        const Point first = last;
        for (const Curve& curve : subpath.curves) {
            for (const Sample& sample : flatten(curve, fineness)) {
                limits::check();
                const Point next = scene::apply(toPixels, sample.at);
                edges.add(last, next, shape);
                last = next;
            }
        }
        edges.add(last, first, shape);
    }
}

}  // namespace vtm::reference
