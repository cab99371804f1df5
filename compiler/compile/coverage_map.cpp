#include "compiler/coverage_map.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "compiler/compile/settings.hpp"
#include "compiler/paint/painters.hpp"
#include "compiler/tree/block.hpp"

namespace vtm::compiler {
namespace {

using asset::PlanarMap;
using glm::dvec2;

/// A square with more is divided: monotone runs are compared in pairs, and chords in order.
constexpr std::size_t maxSquareRuns = 400, maxSquareChords = 4096;

scene::Scene sceneOf(const std::shared_ptr<const scene::Path>& outline, scene::FillRule rule,
                     const scene::Affine& toPicture, dvec2 picture) {
    scene::Item item;
    item.path = outline;
    item.transform = toPicture;
    item.geometry = rule;
    item.paint = scene::Color{0, 0, 0, 1};
    scene::Scene scene;
    scene.width = picture.x;
    scene.height = picture.y;
    scene.root.children.push_back({std::move(item)});
    return scene;
}

/// The map's square, and what its border takes.
class SquareMap {
public:
    SquareMap(const Square& square, double side) : square_(square) {
        map_.side = side;
        map_.extent = square.side;
    }

    PlanarMap run(const PlanarLeaf& leaf) {
        for (std::size_t e = 0; e < leaf.sides.size(); ++e)
            if (leaf.sides[e].left != leaf.sides[e].right)
                add(leaf.set->chain(leaf.set->edges[e]), leaf.sides[e]);
        for (std::size_t side = 0; side < 4; ++side)
            addBorder(leaf, side);
        return std::move(map_);
    }

private:
    dvec2 at(LatticePoint p) const { return {p.x - square_.x0, p.y - square_.y0}; }

    void add(std::span<const LatticePoint> chain, const Sides& sides) {
        for (std::size_t i = 1; i < chain.size(); ++i)
            map_.pieces.push_back({at(chain[i - 1]), at(chain[i]), 0, 0, sides.left, sides.right});
    }

    /// Outside lies paint 0.
    void addBorder(const PlanarLeaf& leaf, std::size_t side) {
        const LatticePoint first = square_.corner(int(side));
        changes_.clear();
        for (const EdgeEnd end : leaf.vertices.border(side)) {
            const Edge& edge = leaf.set->edges[end / 2];
            const Sides& sides = leaf.sides[end / 2];
            const LatticePoint p = isAtA(end) ? edge.a : edge.b;
            const auto steps = std::uint32_t(std::abs(p.x - first.x) + std::abs(p.y - first.y));
            if (isAtA(end))
                changes_.push_back({steps, sides.left, sides.right});
            else
                changes_.push_back({steps, sides.right, sides.left});
        }
        std::ranges::sort(changes_, {}, &asset::Change::at);
        const dvec2 from = at(first), way = (at(square_.corner((int(side) + 1) % 4)) - from) / map_.extent;
        asset::forEachStretch(
            leaf.corners[side], changes_, std::uint32_t(square_.side),
            [&](double start, double end, std::uint32_t paint) {
                if (paint != 0)
                    map_.pieces.push_back({from + start * way, from + end * way, 0, 0, paint, 0});
            });
    }

    const Square square_;
    PlanarMap map_;
    std::vector<asset::Change> changes_;
};

/// Nothing if it takes a tree, or has no boundary.
std::optional<PlanarMap> inOneSquare(const scene::Path& outline, scene::FillRule rule,
                                     const scene::Affine& toPicture, dvec2 picture, const Options& options) {
    const Lattice lattice(picture.x, picture.y, latticeBits(options));
    const ErrorBudget budget = errorBudget(options);
    LoweredScene lowered;
    addOutline(lowered.outlines, outline, scene::compose(lattice.toSteps(), toPicture), budget.fillChords(),
               lattice.clampMin(), lattice.clampMax());
    lowered.layers.push_back({rule, 0, std::uint32_t(lowered.outlines.runs.size()), {}});
    const std::array<std::uint32_t, 1> layer{0};
    Cell cell = rootCell(lowered, lattice.square(), layer);
    if (cell.clippedRuns.empty() || cell.clippedRuns.size() > maxSquareRuns ||
        cell.chordCount() > maxSquareChords)
        return std::nullopt;
    MaskPainter painter(lowered, 0, noIndex);
    LeafRegions regions(lowered, painter);
    Palette palette;
    regions.enter(cell, palette);
    thread_local Planariser planariser;
    const PlanarLeaf& leaf = planariser.run(cell.square, lowered.outlines.points, cell.clippedRuns, regions);
    if (!leaf.certified || !budget.holds(budget.planar(leaf.set->bend)))
        return std::nullopt;
    return SquareMap(cell.square, std::max(picture.x, picture.y)).run(leaf);
}

}  // namespace

PlanarMap coverageMap(const std::shared_ptr<const scene::Path>& outline, scene::FillRule rule,
                      const scene::Affine& toPicture, dvec2 picture, const Options& options) {
    checkOptions(options);
    const limits::Stage stage("compiling");
    const scene::Scene scene = sceneOf(outline, rule, toPicture, picture);
    scene::validate(scene);
    if (std::optional<PlanarMap> map = inOneSquare(*outline, rule, toPicture, picture, options))
        return *std::move(map);
    const asset::Asset asset = compileExcerpt(scene, wholeOf(scene), options).asset;
    return asset::planarMap(asset, asset.maps.front());
}

}  // namespace vtm::compiler
