#include "compiler/direct/crowded_pixel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "compiler/containers/small_sort.hpp"

namespace vtm::compiler {
namespace {

/// Of more, pairs would take too long.
constexpr std::size_t maxExactEdges = 16;

/// Edges this near to each other, in pixels, are one: then rounding does not say which is on the left.
constexpr double sameColumn = 1e-10;

/// Sums of areas are rounded by less: what is no more is nothing.
constexpr double roundedArea = 1e-12;

double distinct(double distance) { return std::abs(distance) < sameColumn ? 0 : distance; }

}  // namespace

double CrowdedPixel::share(scene::FillRule rule, int corner, std::span<const PixelEdge> edges) {
    rule_ = rule;
    const double sum = edges.size() <= maxExactEdges ? exact(corner, edges) : alongLines(corner, edges);
    return sum > roundedArea ? std::min(sum, 1.0) : 0;
}

// ---- Exactly --------------------------------------------------------------------------------------

double CrowdedPixel::exact(int corner, std::span<const PixelEdge> edges) {
    edges_.assign(edges.begin(), edges.end());
    edges_.push_back({0, 0, 0, 1, 0, 0});
    if (lefts_.size() < edges_.size())
        lefts_.resize(edges_.size());
    for (Left& left : std::span(lefts_).first(edges_.size())) {
        left.winding = corner;
        left.changes.clear();
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k)
            meet(k, i);
        addBeside(edges.size(), edges[i]);
    }
    double sum = 0;
    forEachPart(edges.size(), [&](double from, double to, int winding) {
        sum += isInside(rule_, winding) ? to - from : 0;
    });
    for (std::size_t i = 0; i < edges.size(); ++i)
        forEachPart(i, [&, e = edges[i]](double from, double to, int winding) {
            const int turn = isInside(rule_, winding + e.change) - isInside(rule_, winding);
            sum += turn * (to - from) * (1 - e.xAt(0.5 * (from + to)));
        });
    return sum;
}

/// Which of two edges, i < k, is on the left of the other, and where.
void CrowdedPixel::meet(std::size_t i, std::size_t k) {
    const PixelEdge &a = edges_[i], &b = edges_[k];
    const double low = std::max(a.y0, b.y0), high = std::min(a.y1, b.y1);
    if (low < high) {
        const double before = distinct(a.xAt(low) - b.xAt(low)), after = distinct(a.xAt(high) - b.xAt(high));
        const double crossing = before * after < 0 ? low + (high - low) * (before / (before - after)) : high;
        const bool isLeft = before < 0 || (before == 0 && after <= 0);
        const std::size_t left = isLeft ? i : k, right = isLeft ? k : i;
        add(right, edges_[left].change, low, crossing);
        add(left, edges_[right].change, crossing, high);
    }
    addBeside(i, b);
    addBeside(k, a);
}

/// What of another one runs along the pixel's left side.
void CrowdedPixel::addBeside(std::size_t edge, const PixelEdge& other) {
    if (other.low < other.y0)
        add(edge, other.change, other.low, other.y0);
    if (other.y1 < other.high)
        add(edge, other.change, other.y1, other.high);
}

/// On the left of an edge, from a height to another one, is what changes the winding number.
void CrowdedPixel::add(std::size_t edge, int change, double from, double to) {
    const PixelEdge& e = edges_[edge];
    if (from >= to || from >= e.y1 || to <= e.y0)
        return;
    Left& left = lefts_[edge];
    if (from <= e.y0)
        left.winding += change;
    else
        left.changes.push_back({from, change});
    if (to < e.y1)
        left.changes.push_back({to, -change});
}

/// Calls take(from, to, the winding number on the left).
template <class Take>
void CrowdedPixel::forEachPart(std::size_t edge, const Take& take) {
    auto& [winding, changes] = lefts_[edge];
    sortStably(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.y < b.y; });
    double from = edges_[edge].y0;
    for (const Change& c : changes) {
        take(from, c.y, winding);
        winding += c.change;
        from = c.y;
    }
    take(from, edges_[edge].y1, winding);
}

// ---- Along lines ----------------------------------------------------------------------------------

double CrowdedPixel::alongLines(int corner, std::span<const PixelEdge> edges) {
    const int inside =
        rule_ == scene::FillRule::EvenOdd ? oddPlaces(corner, edges) : woundPlaces(corner, edges);
    return inside / double(lines * places);
}

/// Calls cross(line, first place on the right, change) for the lines that an edge crosses. Of n, line j goes
/// from (0, j / n) to (1, (j + 1) / n).
template <class Cross>
void CrowdedPixel::crossLines(const PixelEdge& edge, const Cross& cross) {
    // From line to line a place is moved by the golden section.
    static const ByLine<double> ahead = [] {
        ByLine<double> a;
        for (std::size_t line = 0; line < lines; ++line)
            a[line] = std::fmod(double(line) * std::numbers::phi, 1.0);
        return a;
    }();
    constexpr int n = lines;
    const auto count = [](double height) { return int(std::ceil(height)); };
    const auto crossSide = [&](double from, double to) {
        for (int line = count(from * n); line < std::min(count(to * n), n); ++line)
            cross(std::size_t(line), std::size_t{0}, edge.change);
    };
    if (edge.low < edge.y0)
        crossSide(edge.low, edge.y0);
    if (edge.high > edge.y1)
        crossSide(edge.y1, edge.high);
    const double y0 = edge.y0 * n - edge.x0, y1 = edge.y1 * n - edge.x1;
    const bool rises = y0 < y1;
    const int first = std::max(count(rises ? y0 : y1), 0), end = std::min(count(rises ? y1 : y0), n);
    if (first >= end)
        return;
    const int change = rises ? edge.change : -edge.change;
    const double step = double(places) * (edge.x1 - edge.x0) / (y1 - y0);
    double x = double(places) * edge.x0 + (first - y0) * step;
    for (int line = first; line < end; ++line, x += step)
        cross(std::size_t(line), std::size_t(std::clamp(x + ahead[std::size_t(line)], 0.0, double(places))),
              change);
}

int CrowdedPixel::oddPlaces(int corner, std::span<const PixelEdge> edges) {
    for (auto& word : odd_)
        word.fill(0);
    odd_[0].fill(corner & 1);
    for (const PixelEdge& e : edges)
        crossLines(e, [&](std::size_t line, std::size_t place, int) {
            odd_[place / bits][line] ^= std::uint64_t{1} << place % bits;
        });
    ByLine<std::uint64_t> left{};
    int sum = 0;
    for (std::size_t i = 0; i < places / bits; ++i)
        for (std::size_t line = 0; line < lines; ++line) {
            std::uint64_t word = odd_[i][line];
            for (const int shift : {1, 2, 4, 8, 16, 32})
                word ^= word << shift;
            word ^= left[line];
            left[line] = 0 - (word >> (bits - 1));
            sum += std::popcount(word);
        }
    return sum;
}

int CrowdedPixel::woundPlaces(int corner, std::span<const PixelEdge> edges) {
    for (auto& place : wound_)
        place.fill(0);
    for (const PixelEdge& e : edges)
        crossLines(e, [&](std::size_t line, std::size_t place, int change) {
            wound_[place][line] += std::int16_t(change);
        });
    ByLine<std::int16_t> winding, inside{};
    winding.fill(std::int16_t(corner));
    for (std::size_t place = 0; place < places; ++place)
        for (std::size_t line = 0; line < lines; ++line) {
            winding[line] += wound_[place][line];
            inside[line] += winding[line] != 0;
        }
    return std::accumulate(inside.begin(), inside.end(), 0);
}

}  // namespace vtm::compiler
