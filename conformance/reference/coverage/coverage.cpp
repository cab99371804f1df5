#include "conformance/reference/coverage/coverage.hpp"

#include <stdexcept>

#include "conformance/reference/coverage/bands.hpp"
#include "conformance/reference/outline/stroke.hpp"

namespace vtm::reference {
namespace {

std::vector<double> coverageOf(const EdgeList& list, scene::FillRule rule, const View& view) {
    std::vector<double> coverage(std::size_t(view.width) * std::size_t(view.height));
    forEachBand(view.height, [&] {
        return
            [&, sweep = RowSweep(view.width), parts = std::vector<EdgePart>()](int first, int end) mutable {
                const std::vector<Edge> edges = edgesOfBand(list.edges(), first, end);
                for (int y = first; y < end; ++y) {
                    parts.clear();
                    cutToRow(edges, y, parts);
                    CoverageRow row(rule, &coverage[std::size_t(y) * std::size_t(view.width)]);
                    sweep.sweep(parts, y, row);
                }
            };
    });
    return coverage;
}

}  // namespace

void checkView(const View& view) {
    const auto size = [&] { return std::to_string(view.width) + "x" + std::to_string(view.height); };
    if (view.width <= 0 || view.height <= 0)
        throw std::invalid_argument("reference: a view of " + size() + " pixels");
    if (view.width > maxViewSide || view.height > maxViewSide ||
        std::int64_t(view.width) * view.height > maxViewPixels)
        throw std::length_error("reference: a view of " + size() + " pixels is too large");
}

std::vector<double> fillCoverage(const scene::Path& path, const scene::Affine& transform,
                                 scene::FillRule rule, const View& view, double flatness) {
    checkView(view);
    EdgeList edges(view.width, view.height);
    addFill(path, scene::compose(view.toPixels, transform), view, flatness, 0, edges);
    return coverageOf(edges, rule, view);
}

namespace {

EdgeList edgesOf(const scene::Path& path, const scene::Affine& transform, const scene::StrokeStyle& style,
                 const View& view, double flatness) {
    checkView(view);
    EdgeList edges(view.width, view.height);
    addStroke(path, style, scene::compose(view.toPixels, transform), view, flatness, 0, edges);
    return edges;
}

}  // namespace

std::vector<double> strokeCoverage(const scene::Path& path, const scene::Affine& transform,
                                   const scene::StrokeStyle& style, const View& view, double flatness) {
    EdgeList edges = edgesOf(path, transform, style, view, flatness);
    return coverageOf(edges, scene::FillRule::NonZero, view);
}

std::size_t strokeEdges(const scene::Path& path, const scene::Affine& transform,
                        const scene::StrokeStyle& style, const View& view, double flatness) {
    return edgesOf(path, transform, style, view, flatness).edges().size();
}

}  // namespace vtm::reference
