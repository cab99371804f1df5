#include "compiler/tree/block.hpp"

#include <algorithm>
#include <bit>

#include <vtm/compiler/compile.hpp>
#include "compiler/tree/encode.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {
namespace {

using asset::Entry;

/// A leaf with more chords is not tried while it may be split: planarising is quadratic.
constexpr std::size_t maxChordsToTry = 400;
/// A cell of the last level with more is filled with the mean of samples.
constexpr std::size_t maxChordsInLastLeaf = 2000;
/// A cell is not divided down to find out what its children cost if it costs less than this share of the
/// least that they can: where outlines hide each other they may cost less.
constexpr double sureShare = 0.75;
/// asset::Leaf::pieceCount is 16 bits.
constexpr std::size_t maxLeafPieces = 0xFFFF;

bool isInside(const Layer& layer, int winding) {
    return layer.rule == scene::FillRule::NonZero ? winding != 0 : winding % 2 != 0;
}

}  // namespace

void WorkLimit::spend(std::size_t work) {
    if (spent_.fetch_add(work, std::memory_order_relaxed) + work > maximum_)
        throw LimitError("the picture's outlines overlap too much: more than " + std::to_string(maximum_) +
                         " pairs of chords");
}

// ---- layers -----------------------------------------------------------------------------------

void Culler::run(Cell& cell) {
    listLayers(cell, layers_);
    for (const LayerWinding& w : cell.windings)
        covers_[w.layer] = isInside(picture_.layers[w.layer], w.winding) ? Cover::In : Cover::Out;
    for (const ClippedRun& s : cell.clippedRuns)
        covers_[s.layer] = Cover::Edge;
    keep_.assign(layers_.size(), true);
    painter_.cull(layers_, covers_, keep_);
    for (std::size_t i = 0; i < layers_.size(); ++i)
        covers_[layers_[i]] = keep_[i] ? Cover::In : Cover::Out;  // from here on: kept or not
    if (std::find(keep_.begin(), keep_.end(), false) != keep_.end()) {
        std::erase_if(cell.clippedRuns, [&](const ClippedRun& s) { return covers_[s.layer] == Cover::Out; });
        std::erase_if(cell.windings, [&](const LayerWinding& w) { return covers_[w.layer] == Cover::Out; });
    }
    for (std::uint32_t layer : layers_)
        covers_[layer] = Cover::Out;
}

void LeafRegions::enter(const Cell& cell, Palette& palette) {
    palette_ = &palette;
    for (const std::uint32_t layer : layers)
        inside_[layer] = false;
    listLayers(cell, layers);
    entered_.clear();
    auto known = cell.windings.begin();
    for (std::uint32_t layer : layers) {
        const bool isKnown = known != cell.windings.end() && known->layer == layer;
        entered_.push_back({picture_.layers[layer].rule, isKnown ? (known++)->winding : 0, hashValue(layer)});
    }
    RegionPaints::enter(entered_);
}

PaintId LeafRegions::solid(Cell& cell, Culler& culler, Palette& palette) {
    std::uint64_t key = 0;
    for (const LayerWinding& w : cell.windings)
        if (compiler::isInside(picture_.layers[w.layer], w.winding))
            key ^= hashValue(w.layer);
    if (const PaintId paint = known(key); paint != NumberMap::unknown)
        return paint;
    culler.run(cell);
    enter(cell, palette);
    return known(key) = paint();
}

PaintId LeafRegions::compute() {
    limits::check();
    for (std::uint32_t i = 0; i < layers.size(); ++i)
        inside_[layers[i]] = isInside(i);
    return painter_.paint(layers, inside_, *palette_);
}

// ---- build ------------------------------------------------------------------------------------

Tree BlockBuilder::run(Cell cell, bool timed) {
    timed_ = timed;
    const Clock::time_point start = lastLap_ = Clock::now();
    tree_ = {};
    pieces_.clear();
    constexpr std::size_t usualLeaves = 32;
    tree_.leaves.reserve(cell.clippedRuns.empty() ? 0 : usualLeaves);
    firstLevel_ = cell.level;
    regions_.forget();
    tree_.root = build(cell).entry;
    tree_.pieces = pieces_;  // takes no more memory than there are
    if (timed)
        times_.all += milliseconds(start, Clock::now());
    return std::move(tree_);
}

/// Adds the time since the last lap to a stage's.
void BlockBuilder::lap(double& stage) {
    if (!timed_)
        return;
    const Clock::time_point now = Clock::now();
    stage += milliseconds(lastLap_, now);
    lastLap_ = now;
}

/// `cell` is culled already if it has clipped runs.
BlockBuilder::Built BlockBuilder::build(Cell& cell) {
    const AtCell at("planarising", picture_, cell);
    if (cell.clippedRuns.empty())
        return solid(regions_.solid(cell, culler_, tree_.palette), cell.level);
    limits::check();
    work_.spend(cell.clippedRuns.size() * visitWork);
    if (cell.level >= options_.maxDepth)
        return buildLast(cell);
    if (cell.level < options_.minDepth)
        return buildNode(cell, divide(cell));
    return options_.piecesPerLeaf ? buildFixed(cell) : buildBest(cell);
}

BlockBuilder::Built BlockBuilder::buildLast(Cell& cell) {
    const ErrorBudget& budget = options_.budget;
    const bool isTooMany = distinctChords(cell, maxChordsInLastLeaf) > maxChordsInLastLeaf;
    const Made made = isTooMany ? Made{} : makeLeaf(cell);
    if (made && (budget.holds(made.error) || !budget.canHold()))
        return emit(made, cell.level);
    const double mean = budget.mean(cell.level);
    if (!budget.holds(mean) && cell.level < options_.lastDepth)
        return buildNode(cell, divide(cell));
    return made && made.error <= mean ? emit(made, cell.level) : emitMean(cell);
}

BlockBuilder::Built BlockBuilder::buildFixed(Cell& cell) {
    if (canTry(cell))
        if (const Made made = makeLeaf(cell); made && made.pieceCount() <= *options_.piecesPerLeaf)
            return emit(made, cell.level);
    return buildNode(cell, divide(cell));
}

/// A leaf if it costs less than its children would, guessed from the number of clipped runs first (about as
/// many as pieces), then known. Where outlines hide each other the guess can be too high by far, so
/// children that turn out cheap to join are tried as one leaf after all.
BlockBuilder::Built BlockBuilder::buildBest(Cell& cell) {
    const auto clippedRuns = static_cast<double>(cell.clippedRuns.size());
    Children* children = nullptr;
    std::optional<Spread> spread;
    const auto paysToSplit = [&](double pieces) {
        const double cost = options_.cost.leaf(pieces, cell.level),
                     perRun = std::max(1.0, pieces / clippedRuns);
        if (!mayBeWorthSplitting(pieces, cell.level))
            return false;
        if (!spread)
            spread = spreadOf(cell);
        if (cost <= sureShare * minSplitCost(*spread, cell.level, perRun))
            return false;
        if (!children)
            children = &divide(cell);
        return cost > splitCost(*children, perRun);
    };
    if (!paysToSplit(clippedRuns) && canTry(cell))
        if (const Made made = makeLeaf(cell); made && !paysToSplit(static_cast<double>(made.pieceCount())))
            return emit(made, cell.level);
    return buildNode(cell, children ? *children : divide(cell));
}

/// Drawing all of the leaf for nothing would not pay for a node.
bool BlockBuilder::mayBeWorthSplitting(double pieces, unsigned level) const {
    return options_.cost.drawing(pieces, level) > options_.cost.node();
}

double BlockBuilder::splitCost(const Children& children, double piecesPerRun) const {
    double cost = options_.cost.node();
    for (const Cell& child : children)
        cost += options_.cost.leaf(static_cast<double>(child.clippedRuns.size()) * piecesPerRun, child.level);
    return cost;
}

BlockBuilder::Spread BlockBuilder::spreadOf(const Cell& cell) const {
    const int shift = std::countr_zero(static_cast<std::uint32_t>(cell.square.side / 4));
    const auto place = [shift](Coord offset) { return std::clamp(offset >> shift, 0, 3); };
    unsigned reached = 0;
    Spread spread;
    for (const ClippedRun& s : cell.clippedRuns) {
        const LatticePoint from = points_[s.first], to = points_[s.last];
        const int i = place(from.x - cell.square.x0), j = place(from.y - cell.square.y0),
                  iEnd = place(to.x - cell.square.x0), jEnd = place(to.y - cell.square.y0);
        reached |= 1u << (4 * j + i) | 1u << (4 * jEnd + iEnd);
        spread.visits += 1 + std::abs(iEnd - i) + std::abs(jEnd - j);
    }
    spread.leaves = std::popcount(reached);
    return spread;
}

/// What the children of a cell of the given level would cost if nothing were hidden in them, and no more of
/// them had clipped runs than those where some end.
double BlockBuilder::minSplitCost(const Spread& spread, unsigned level, double piecesPerRun) const {
    const CostModel& model = options_.cost;
    const double piece = model.leaf(2, level + 1) - model.leaf(1, level + 1);
    return model.node() + (16 - spread.leaves) * model.leaf(0, level + 1) +
           spread.leaves * (model.leaf(1, level + 1) - piece) + spread.visits * piecesPerRun * piece;
}

/// Whether the cell is within the limits of a leaf that may still be split.
bool BlockBuilder::canTry(const Cell& cell) {
    const std::size_t distinct = distinctChords(cell, maxChordsToTry);
    if (distinct > maxChordsToTry)
        return false;
    work_.spend(distinct * distinct);
    return true;
}

/// Equal clipped runs of many layers (a shape repeated) count once: snapping merges them at once. Stops
/// counting beyond `maximum`.
std::size_t BlockBuilder::distinctChords(const Cell& cell, std::size_t maximum) const {
    const std::size_t all = cell.chordCount();
    if (all <= maximum)
        return all;
    NumberMap seen;
    std::size_t count = 0;
    for (const ClippedRun& s : cell.clippedRuns) {
        const auto [a, b] = std::minmax(points_[s.first], points_[s.last]);
        const std::uint32_t chords = s.last - s.first;
        std::uint32_t& known = seen[hashValue(sortKey(a)) + hashValue(hashValue(sortKey(b)) + chords)];
        if (known == NumberMap::unknown)
            count += known = chords;
        if (count > maximum)
            break;
    }
    return count;
}

/// What of the cell is in its children; in those with clipped runs, without what cannot show there.
BlockBuilder::Children& BlockBuilder::divide(const Cell& cell) {
    const std::size_t depth = cell.level - firstLevel_;
    while (children_.size() <= depth)
        children_.emplace_back();
    Children& children = children_[depth];
    splitCell(points_, cell, children);
    for (Cell& child : children)
        if (!child.clippedRuns.empty())
            culler_.run(child);
    lap(times_.divide);
    return children;
}

BlockBuilder::Built BlockBuilder::buildNode(const Cell& cell, Children& children) {
    double cost = options_.cost.node();
    const Entry entry = appendNode(tree_.nodes, [&](std::size_t i) {
        const Built child = build(children[i]);
        cost += child.cost;
        return child.entry;
    });
    if (entry.kind() == Entry::Kind::Solid)
        return solid(entry.payload(), cell.level);
    return {entry, cost};
}

BlockBuilder::Built BlockBuilder::solid(PaintId paint, unsigned level) const {
    return {Entry::make(Entry::Kind::Solid, paint), options_.cost.leaf(0, level)};
}

/// Nothing if it cannot be proven, or has too many pieces for the format, or its error is beyond the
/// tolerance and that of smaller leaves would not be.
BlockBuilder::Made BlockBuilder::makeLeaf(const Cell& cell) {
    regions_.enter(cell, tree_.palette);
    runs_ = cell.clippedRuns;
    std::uint32_t local = 0;
    for (ClippedRun& s : runs_) {
        while (regions_.layers[local] != s.layer)
            ++local;
        s.layer = local;
    }
    const ErrorBudget& budget = options_.budget;
    const bool maySplit = cell.level < options_.maxDepth && budget.canHold();
    const PlanarLeaf& planar = planariser_.run(cell.square, points_, runs_, regions_,
                                               maySplit ? budget.maxBend(cell.level) : anyBend);
    lap(times_.planarise);
    if (!planar.certified)
        return {};
    const FittedLeaf& fitted = fitter_.run(cell.square, planar, budget.fit());
    lap(times_.fit);
    const double error = budget.leaf(cell.level, planar.set->bend, fitted.slivers);
    if (fitted.pieces.size() > maxLeafPieces || (maySplit && !budget.holds(error)))
        return {};
    return {&fitted, error};
}

BlockBuilder::Built BlockBuilder::emit(const Made& made, unsigned level) {
    tree_.error = std::max(tree_.error, made.error);
    const FittedLeaf& fitted = *made.leaf;
    if (fitted.pieces.empty())
        return solid(fitted.corners[0], level);
    tree_.leaves.push_back({static_cast<std::uint32_t>(pieces_.size()),
                            static_cast<std::uint32_t>(fitted.pieces.size()), fitted.corners});
    pieces_.insert(pieces_.end(), fitted.pieces.begin(), fitted.pieces.end());
    return {Entry::make(Entry::Kind::Leaf, static_cast<std::uint32_t>(tree_.leaves.size() - 1)),
            options_.cost.leaf(static_cast<double>(fitted.pieces.size()), level)};
}

/// The fallback: the mean over 4 × 4 points, each classified by winding (after Ganacim et al. 2014).
BlockBuilder::Built BlockBuilder::emitMean(const Cell& cell) {
    const double error = options_.budget.mean(cell.level);
    tree_.error = std::max(tree_.error, error);
    if (!options_.budget.holds(error))
        tree_.unproven.push_back(cell.square);
    work_.spend(16 * cell.clippedRuns.size() * visitWork);
    regions_.enter(cell, tree_.palette);
    std::vector<PaintId> paints;
    const Coord step = cell.square.side / 8;
    for (int i = 0; i < 16; ++i) {
        const LatticePoint p{(cell.square.x0 + (2 * (i % 4) + 1) * step) | 1,
                             (cell.square.y0 + (2 * (i / 4) + 1) * step) | 1};
        regions_.toCorner();
        std::uint32_t local = 0;
        for (const ClippedRun& s : cell.clippedRuns) {
            limits::check();
            while (regions_.layers[local] != s.layer)
                ++local;
            if (const int winding = windingBetween(points_, s, cell.square.corner(0), p); winding != 0)
                regions_.change(local, winding);
        }
        paints.push_back(regions_.paint());
    }
    return solid(painter_->mean(paints, tree_.palette), cell.level);
}

}  // namespace vtm::compiler
