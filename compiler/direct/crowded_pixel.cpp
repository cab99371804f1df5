#include "compiler/direct/crowded_pixel.hpp"

#include <algorithm>
#include <optional>

namespace vtm::compiler {
namespace {

/// More are halved: pairs of them would take longer.
constexpr std::size_t maxPairedEdges = 24;
/// Parts of 2^-10 of a pixel misplace the triangles of crossings in them, less than 1/1024 of it.
constexpr int deepest = 10, shallowest = 5;
/// Edges times parts of a pixel: a millisecond.
constexpr std::size_t maxWork = 1 << 16;

/// The height at which two edges cross, below both their upper ends and above their lower ones.
std::optional<double> crossingHeight(const PixelEdge& a, const PixelEdge& b) {
    const double low = std::max(a.y0, b.y0), high = std::min(a.y1, b.y1);
    if (!(low < high))
        return std::nullopt;
    const double before = a.xAt(low) - b.xAt(low), after = a.xAt(high) - b.xAt(high);
    if (!(before * after < 0))
        return std::nullopt;
    return low + (high - low) * (before / (before - after));
}

/// The first `count`; mostly they are few.
template <class Value, class Key>
void sorted(std::vector<Value>& values, std::size_t count, Key&& key) {
    constexpr std::size_t few = 16;
    if (count > few) {
        std::ranges::sort(std::span(values).first(count), {}, key);
        return;
    }
    for (std::size_t i = 1; i < count; ++i) {
        const Value value = values[i];
        std::size_t k = i;
        for (; k > 0 && key(value) < key(values[k - 1]); --k)
            values[k] = values[k - 1];
        values[k] = value;
    }
}

}  // namespace

double CrowdedPixel::share(scene::FillRule rule, int corner, std::span<const PixelEdge> edges,
                           std::span<const PixelStep> steps) {
    rule_ = rule;
    corner_ = corner;
    steps_ = steps;
    if (edges.size() <= maxPairedEdges)
        return slabs(0, 1, edges);
    maxDepth_ = deepest;
    while (maxDepth_ > shallowest && edges.size() << maxDepth_ > maxWork)
        --maxDepth_;
    std::vector<PixelEdge> all(edges.begin(), edges.end());
    return part(0, 1, all, 0);
}

double CrowdedPixel::part(double low, double high, std::vector<PixelEdge>& edges, int depth) {
    if (edges.size() <= maxPairedEdges)
        return slabs(low, high, edges);
    if (depth == maxDepth_)
        return (high - low) * width((low + high) / 2, edges);
    return halves(low, high, edges, depth);
}

double CrowdedPixel::halves(double low, double high, const std::vector<PixelEdge>& edges, int depth) {
    const double middle = (low + high) / 2;
    std::vector<PixelEdge> half;
    half.reserve(edges.size());
    for (PixelEdge e : edges) {
        if (e.y0 >= middle)
            continue;
        e.y1 = std::min(e.y1, middle);
        half.push_back(e);
    }
    const double below = part(low, middle, half, depth + 1);
    half.clear();
    for (PixelEdge e : edges) {
        if (e.y1 <= middle)
            continue;
        if (e.y0 < middle)
            e.x0 = e.xAt(middle), e.y0 = middle;
        half.push_back(e);
    }
    return below + part(middle, high, half, depth + 1);
}

double CrowdedPixel::slabs(double low, double high, std::span<const PixelEdge> edges) {
    cutAtCrossings(low, high, edges);
    double sum = 0;
    for (std::size_t i = 1; i < heights_.size(); ++i) {
        const double from = heights_[i - 1], to = heights_[i];
        if (from < to)
            sum += (to - from) * width((from + to) / 2, edges);
    }
    return sum;
}

/// Finds the heights between which all edges are in one order.
void CrowdedPixel::cutAtCrossings(double low, double high, std::span<const PixelEdge> edges) {
    heights_.assign({low, high});
    const auto add = [&](double y) {
        if (low < y && y < high)
            heights_.push_back(y);
    };
    for (const PixelStep& step : steps_)
        add(step.y);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        add(edges[i].y0);
        add(edges[i].y1);
        for (std::size_t k = 0; k < i; ++k)
            if (edges[k].strand != edges[i].strand)
                if (const std::optional<double> y = crossingHeight(edges[i], edges[k]))
                    add(*y);
    }
    sorted(heights_, heights_.size(), [](double y) { return y; });
}

/// What is inside at a height.
double CrowdedPixel::width(double y, std::span<const PixelEdge> edges) {
    if (crossed_.size() < edges.size())
        crossed_.resize(edges.size());
    std::size_t count = 0;
    for (const PixelEdge& e : edges)
        if (e.y0 <= y && y < e.y1)
            crossed_[count++] = {e.xAt(y), e.change};
    sorted(crossed_, count, [](const Crossed& c) { return c.x; });
    int winding = leftWinding(y);
    double sum = 0, from = 0;
    for (const Crossed& c : std::span(crossed_).first(count)) {
        if (isInside(rule_, winding))
            sum += c.x - from;
        from = c.x;
        winding += c.change;
    }
    return isInside(rule_, winding) ? sum + (1 - from) : sum;
}

int CrowdedPixel::leftWinding(double y) const {
    int winding = corner_;
    for (const PixelStep& step : steps_)
        if (step.y <= y)
            winding += step.change;
    return winding;
}

}  // namespace vtm::compiler
