#include "compiler/instances/layers_at.hpp"

#include <algorithm>
#include <cmath>

#include <vtm/limits/limits.hpp>

namespace vtm::compiler {
namespace {

/// What a run changes of a winding number on the way along a row from the left to a point that is in its
/// rows, not below the lowest and below the highest, so that each contour is met once.
int windingLeftOf(const Outlines& outlines, Run run, LatticePoint p) {
    const auto* const points = outlines.points.data();
    const LatticePoint first = points[run.first], last = points[run.last];
    const bool isUpward = first.y < last.y;
    // The chord whose rows hold the point's: the run nowhere turns back.
    const auto* const begin = points + run.first;
    const auto* const end = points + run.last + 1;
    const auto* b = isUpward ? std::partition_point(begin, end, [&](LatticePoint q) { return q.y <= p.y; })
                             : std::partition_point(begin, end, [&](LatticePoint q) { return q.y > p.y; });
    const LatticePoint lower = isUpward ? b[-1] : b[0], upper = isUpward ? b[0] : b[-1];
    return orient(lower, upper, p) < 0 ? (isUpward ? 1 : -1) : 0;
}

}  // namespace

LayersAt::LayersAt(const LoweredScene& picture, const Square& square) : picture_(picture), square_(square) {
    constexpr double rowsPerRoot = 8;
    constexpr std::size_t maxRows = 4096;
    rows_.resize(
        std::min(maxRows, 1 + std::size_t(rowsPerRoot * std::sqrt(double(picture.outlines.runs.size())))));
    const auto& points = picture.outlines.points;
    for (std::uint32_t layer = 0; layer < picture.layers.size(); ++layer) {
        limits::check();
        const Layer& l = picture.layers[layer];
        for (std::uint32_t run = l.firstRun; run < l.firstRun + l.runCount; ++run) {
            const Run& r = picture.outlines.runs[run];
            const auto [low, high] = std::minmax(points[r.first].y, points[r.last].y);
            if (low == high)
                continue;
            const std::size_t last = rowOf(high);
            for (std::size_t row = rowOf(low); row <= last; ++row)
                rows_[row].push_back({layer, run, low, high, std::min(points[r.first].x, points[r.last].x)});
        }
    }
}

std::size_t LayersAt::rowOf(Coord y) const {
    const double share = (double(y) - square_.y0) / square_.side;
    return std::size_t(std::clamp(share * double(rows_.size()), 0.0, double(rows_.size() - 1)));
}

std::vector<std::uint32_t> LayersAt::operator()(LatticePoint p) const {
    std::vector<std::uint32_t> layers;
    std::uint32_t layer = noIndex;
    int winding = 0;
    const auto finish = [&] {
        const bool isInside =
            layer != noIndex &&
            (picture_.layers[layer].rule == scene::FillRule::NonZero ? winding != 0 : winding % 2 != 0);
        if (isInside)
            layers.push_back(layer);
        winding = 0;
    };
    for (const LayerRun& run : rows_[rowOf(p.y)]) {
        if (p.y < run.low || p.y >= run.high || p.x < run.left)
            continue;
        if (run.layer != layer)
            finish();
        layer = run.layer;
        winding += windingLeftOf(picture_.outlines, picture_.outlines.runs[run.run], p);
    }
    finish();
    return layers;
}

}  // namespace vtm::compiler
