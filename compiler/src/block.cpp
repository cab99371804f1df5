#include "compiler/src/block.hpp"

#include <algorithm>
#include <chrono>

#include "compiler/compile.hpp"

namespace vtm::compiler {
namespace {

using asset::Entry;

/// A leaf with more chords is not tried while it may be split: planarising is quadratic.
constexpr std::size_t maxChordsToTry = 400;
/// A cell of the last level with more is filled with the mean of samples.
constexpr std::size_t maxChordsInLastLeaf = 2000;
/// A minute or so.
constexpr std::size_t maxWork = 20'000'000'000;
/// asset::Leaf::pieceCount is 16 bits.
constexpr std::size_t maxLeafPieces = 0xFFFF;

class Stopwatch {
public:
    explicit Stopwatch(double& into) : into_(into), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() {
        into_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    double& into_;
    const std::chrono::steady_clock::time_point start_;
};

bool isInside(const Layer& layer, int winding) {
    return layer.rule == scene::FillRule::NonZero ? winding != 0 : winding % 2 != 0;
}

}  // namespace

void WorkLimit::spend(std::size_t work) {
    if (spent_.fetch_add(work, std::memory_order_relaxed) + work > maxWork)
        throw LimitError("the picture's outlines are too tangled: beyond " + std::to_string(maxWork) +
                         " pairs of chords");
}

// ---- layers -----------------------------------------------------------------------------------

void Culler::run(Cell& cell) {
    listLayers(cell, layers_);
    for (const LayerWinding& w : cell.windings)
        covers_[w.layer] = isInside(picture_.layers[w.layer], w.winding) ? Cover::In : Cover::Out;
    for (const Strand& s : cell.strands)
        covers_[s.layer] = Cover::Edge;
    keep_.assign(layers_.size(), true);
    painter_.cull(layers_, covers_, keep_);
    for (std::size_t i = 0; i < layers_.size(); ++i)
        covers_[layers_[i]] = keep_[i] ? Cover::In : Cover::Out;  // from here on: kept or not
    if (std::find(keep_.begin(), keep_.end(), false) != keep_.end()) {
        std::erase_if(cell.strands, [&](const Strand& s) { return covers_[s.layer] == Cover::Out; });
        std::erase_if(cell.windings, [&](const LayerWinding& w) { return covers_[w.layer] == Cover::Out; });
    }
    for (std::uint32_t layer : layers_)
        covers_[layer] = Cover::Out;
}

void LeafRegions::enter(const Cell& cell, Palette& palette) {
    palette_ = &palette;
    listLayers(cell, layers);
    corner.assign(layers.size(), 0);
    std::size_t i = 0;
    for (const LayerWinding& w : cell.windings) {
        while (layers[i] != w.layer)
            ++i;
        corner[i] = w.winding;
    }
    seen_.clear();
}

PaintId LeafRegions::paint(std::span<const int> windings) {
    if (layers.size() > 64)
        return compute(windings);
    std::uint64_t key = 0;
    for (std::size_t i = 0; i < windings.size(); ++i)
        key |= std::uint64_t{isInside(picture_.layers[layers[i]], windings[i])} << i;
    for (const auto& [seen, paint] : seen_)
        if (seen == key)
            return paint;
    seen_.emplace_back(key, compute(windings));
    return seen_.back().second;
}

PaintId LeafRegions::compute(std::span<const int> windings) {
    for (std::size_t i = 0; i < layers.size(); ++i)
        inside_[layers[i]] = isInside(picture_.layers[layers[i]], windings[i]);
    const PaintId result = painter_.paint(layers, inside_, *palette_);
    for (std::uint32_t layer : layers)
        inside_[layer] = false;
    return result;
}

// ---- build ------------------------------------------------------------------------------------

Tree BlockBuilder::run(Cell cell) {
    tree_ = {};
    firstLevel_ = cell.level;
    tree_.root = build(cell);
    return std::move(tree_);
}

Entry BlockBuilder::build(Cell& cell) {
    work_.spend(cell.strands.size() * visitWork);
    {
        const Stopwatch watch(times_.push);
        culler_.run(cell);
    }
    if (cell.strands.empty()) {
        regions_.enter(cell, tree_.palette);
        return Entry::make(Entry::Kind::Solid, regions_.paint(regions_.corner));
    }
    const bool last = cell.level >= options_.maxDepth;
    const std::size_t most = last ? maxChordsInLastLeaf : maxChordsToTry;
    const std::size_t distinct =
        last || cell.level >= options_.minDepth ? distinctChords(cell, most) : most + 1;
    if (last && distinct > most)
        return emitMean(cell);
    if (distinct <= most) {
        work_.spend(distinct * distinct);
        const FittedLeaf* leaf = makeLeaf(cell);
        if (leaf && (last || leaf->pieces.size() <= options_.piecesPerLeaf))
            return emit(*leaf);
        if (last)
            return emitMean(cell);
    }
    return buildNode(cell);
}

/// Equal chords of many layers (a shape repeated) count once: snapping merges them at once. Stops
/// counting beyond `most`.
std::size_t BlockBuilder::distinctChords(const Cell& cell, std::size_t most) const {
    const std::size_t all = cell.chordCount();
    if (all <= most)
        return all;
    std::set<std::pair<LatticePoint, LatticePoint>> ends;
    for (const Strand& s : cell.strands)
        for (std::uint32_t i = s.first; i < s.last; ++i) {
            ends.insert(std::minmax(points_[i], points_[i + 1]));
            if (ends.size() > most)
                return ends.size();
        }
    return ends.size();
}

Entry BlockBuilder::buildNode(Cell& cell) {
    const std::size_t depth = cell.level - firstLevel_;
    while (children_.size() <= depth)
        children_.emplace_back();
    std::array<Cell, 16>& children = children_[depth];
    {
        const Stopwatch watch(times_.push);
        splitCell(points_, cell, children);
    }
    const std::size_t index = tree_.nodes.size();  // before its children's: walks need no cycle check
    tree_.nodes.emplace_back();
    asset::Node node;
    for (std::size_t i = 0; i < 16; ++i)
        node.children[i] = build(children[i]);
    const Entry first = node.children[0];
    const bool same =
        first.kind() == Entry::Kind::Solid && std::all_of(node.children.begin(), node.children.end(),
                                                          [&](Entry e) { return e.bits == first.bits; });
    if (same) {
        tree_.nodes.pop_back();  // solid children made no nodes
        return first;
    }
    tree_.nodes[index] = node;
    return Entry::make(Entry::Kind::Node, static_cast<std::uint32_t>(index));
}

/// Nothing if it cannot be proven, or has too many pieces for the format.
const FittedLeaf* BlockBuilder::makeLeaf(const Cell& cell) {
    const PlanarLeaf* planar;
    {
        const Stopwatch watch(times_.planarise);
        regions_.enter(cell, tree_.palette);
        strands_ = cell.strands;
        std::uint32_t local = 0;
        for (Strand& s : strands_) {
            while (regions_.layers[local] != s.layer)
                ++local;
            s.layer = local;
        }
        planar = &planariser_.run(cell.square, points_, strands_, regions_.corner, regions_);
    }
    if (!planar->certified)
        return nullptr;
    const Stopwatch watch(times_.fit);
    const FittedLeaf& fitted = fitter_.run(cell.square, *planar, options_.fitTolerance);
    return fitted.pieces.size() <= maxLeafPieces ? &fitted : nullptr;
}

Entry BlockBuilder::emit(const FittedLeaf& fitted) {
    if (fitted.pieces.empty())
        return Entry::make(Entry::Kind::Solid, fitted.corners[0]);
    tree_.leaves.push_back({static_cast<std::uint32_t>(tree_.pieces.size()),
                            static_cast<std::uint32_t>(fitted.pieces.size()), fitted.corners});
    tree_.pieces.insert(tree_.pieces.end(), fitted.pieces.begin(), fitted.pieces.end());
    return Entry::make(Entry::Kind::Leaf, static_cast<std::uint32_t>(tree_.leaves.size() - 1));
}

/// The fallback: the mean over 4 × 4 points, each classified by winding (after Ganacim et al. 2014).
Entry BlockBuilder::emitMean(const Cell& cell) {
    ++tree_.fallbackLeaves;
    work_.spend(16 * cell.strands.size() * visitWork);
    regions_.enter(cell, tree_.palette);
    std::vector<PaintId> paints;
    const Coord step = cell.square.side / 8;
    for (int i = 0; i < 16; ++i) {
        const LatticePoint p{(cell.square.x0 + (2 * (i % 4) + 1) * step) | 1,
                             (cell.square.y0 + (2 * (i / 4) + 1) * step) | 1};
        std::vector<int> windings = regions_.corner;
        std::size_t local = 0;
        for (const Strand& s : cell.strands) {
            while (regions_.layers[local] != s.layer)
                ++local;
            windings[local] += windingBetween(points_, s, cell.square.corner(0), p);
        }
        paints.push_back(regions_.paint(windings));
    }
    return Entry::make(Entry::Kind::Solid, painter_->mean(paints, tree_.palette));
}

}  // namespace vtm::compiler
