#include "compiler/instances/layers_at.hpp"

#include <algorithm>
#include <cmath>

#include <vtm/limits/limits.hpp>

namespace vtm::compiler {
namespace {

/// Beyond all coordinates.
constexpr Coord maxCoord = Coord{1} << 30;

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
    constexpr int maxCells = 256;
    cells_ = std::clamp(int(std::sqrt(double(picture.layers.size()))), 1, maxCells);
    grid_.resize(std::size_t(cells_) * std::size_t(cells_));
    rows_.resize(
        std::min(maxRows, 1 + std::size_t(rowsPerRoot * std::sqrt(double(picture.outlines.runs.size())))));
    const auto& points = picture.outlines.points;
    for (std::uint32_t layer = 0; layer < picture.layers.size(); ++layer) {
        limits::check();
        if (addSmall(layer))
            continue;
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

int LayersAt::cellOf(Coord v, Coord first) const {
    const double share = (double(v) - first) / square_.side;
    return int(std::clamp(share * cells_, 0.0, double(cells_ - 1)));
}

/// Returns whether a layer has so few runs, in so few cells, that they are asked one by one.
bool LayersAt::addSmall(std::uint32_t layer) {
    constexpr std::uint32_t maxRuns = 64;
    constexpr int maxCellsOfLayer = 256;
    const Layer& l = picture_.layers[layer];
    if (l.runCount > maxRuns)
        return false;
    const auto& points = picture_.outlines.points;
    SmallLayer small{layer, {maxCoord, maxCoord}, {-maxCoord, -maxCoord}};
    for (std::uint32_t run = l.firstRun; run < l.firstRun + l.runCount; ++run)
        for (const std::uint32_t end :
             {picture_.outlines.runs[run].first, picture_.outlines.runs[run].last}) {
            small.min = {std::min(small.min.x, points[end].x), std::min(small.min.y, points[end].y)};
            small.max = {std::max(small.max.x, points[end].x), std::max(small.max.y, points[end].y)};
        }
    if (small.min.x > small.max.x)
        return true;
    const int left = cellOf(small.min.x, square_.x0), right = cellOf(small.max.x, square_.x0),
              top = cellOf(small.min.y, square_.y0), bottom = cellOf(small.max.y, square_.y0);
    if ((right - left + 1) * (bottom - top + 1) > maxCellsOfLayer)
        return false;
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x)
            grid_[std::size_t(y) * std::size_t(cells_) + std::size_t(x)].push_back(small);
    return true;
}

bool LayersAt::isInside(std::uint32_t layer, int winding) const {
    return picture_.layers[layer].rule == scene::FillRule::NonZero ? winding != 0 : winding % 2 != 0;
}

std::vector<std::uint32_t> LayersAt::operator()(LatticePoint p) const {
    std::vector<std::uint32_t> layers;
    std::uint32_t layer = noIndex;
    int winding = 0;
    const auto finish = [&] {
        if (layer != noIndex && isInside(layer, winding))
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
    const auto cell =
        std::size_t(cellOf(p.y, square_.y0)) * std::size_t(cells_) + std::size_t(cellOf(p.x, square_.x0));
    for (const SmallLayer& small : grid_[cell]) {
        if (p.x < small.min.x || p.y < small.min.y || p.x > small.max.x || p.y > small.max.y)
            continue;
        const Layer& l = picture_.layers[small.layer];
        int own = 0;
        for (std::uint32_t r = l.firstRun; r < l.firstRun + l.runCount; ++r) {
            const Run& run = picture_.outlines.runs[r];
            const auto& points = picture_.outlines.points;
            const auto [low, high] = std::minmax(points[run.first].y, points[run.last].y);
            if (p.y >= low && p.y < high && p.x >= std::min(points[run.first].x, points[run.last].x))
                own += windingLeftOf(picture_.outlines, run, p);
        }
        if (isInside(small.layer, own))
            layers.push_back(small.layer);
    }
    std::ranges::sort(layers);
    return layers;
}

}  // namespace vtm::compiler
