#include "compiler/instances/place_symbols.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <vtm/limits/limits.hpp>
#include "asset/place.hpp"
#include "compiler/instances/affine2.hpp"
#include "compiler/instances/boundary.hpp"
#include "compiler/instances/group_placements.hpp"
#include "compiler/instances/layers_at.hpp"
#include "compiler/instances/outline_box.hpp"
#include "compiler/instances/own_clips.hpp"
#include "compiler/instances/repeats.hpp"
#include "compiler/paint/painters.hpp"

namespace vtm::compiler {
namespace {

using asset::Affine2;
using geometry::Box;
using glm::dvec2;

/// Of that size, in the middle of a map's square.
Box middle(dvec2 size) { return {0.5 - 0.5 * size, 0.5 + 0.5 * size}; }

/// A repeat with its map.
struct Symbol {
    std::uint32_t layerCount = 0;
    SymbolMap map;
    std::unique_ptr<SymbolBoundary> boundary;
};

/// A place where a symbol may stand.
struct Candidate {
    std::uint32_t symbol = 0;
    std::uint32_t firstLayer = 0;
    Affine2 toPicture;
    Box box;                            ///< of its boundaries, in the picture
    std::vector<PaintId> paints;        ///< by region: the ground first
    std::vector<std::uint32_t> around;  ///< candidates in whose regions it lies
    bool isFlat = false;                ///< it stays with the picture's own layers
};

/// What is known of a repeat before paints are.
struct Unpainted {
    Unpainted(std::uint32_t count, SymbolMaker&& madeBy) : layerCount(count), maker(std::move(madeBy)) {}

    std::uint32_t layerCount;
    SymbolMaker maker;
    LayerSets sets;
    SymbolMap bySets;
    std::unique_ptr<SymbolBoundary> boundary;
    dvec2 inner{0};  ///< a point over which its layers lie
    std::vector<Candidate> candidates;
};

/// Squares of the picture with the candidates whose boxes meet them.
class CandidateGrid {
public:
    CandidateGrid(std::span<const Candidate> candidates, double side) : side_(side) {
        constexpr double cellsPerRoot = 2;
        constexpr int maxCells = 512;
        cells_ = std::clamp(int(cellsPerRoot * std::sqrt(double(candidates.size()))), 1, maxCells);
        grid_.resize(std::size_t(cells_) * std::size_t(cells_));
        for (std::uint32_t i = 0; i < candidates.size(); ++i)
            forEachCell(candidates[i].box, [&](std::vector<std::uint32_t>& cell) { cell.push_back(i); });
    }
    template <class Visit>
    void forEachCell(const Box& box, Visit&& visit) {
        const glm::ivec2 from = cellOf(box.min), to = cellOf(box.max);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                visit(grid_[std::size_t(y) * std::size_t(cells_) + std::size_t(x)]);
    }

private:
    glm::ivec2 cellOf(dvec2 p) const {
        return glm::ivec2(glm::clamp(glm::floor(p * (cells_ / side_)), dvec2(0), dvec2(cells_ - 1)));
    }
    double side_;
    int cells_ = 1;
    std::vector<std::vector<std::uint32_t>> grid_;
};

/// Records of 16 bytes.
constexpr std::size_t recordBytes = 16;

class Placer {
public:
    Placer(const LoweredScene& picture, std::span<const LayerOrigin> origins, std::span<const TileFill> fills,
           const Lattice& lattice, dvec2 size, const Options& options, Palette& palette)
        : picture_(picture),
          origins_(origins),
          lattice_(lattice),
          size_(size),
          options_(options),
          tolerance_(options.tolerance * std::max(size.x, size.y)),
          palette_(palette),
          painter_(picture),
          inside_(picture.layers.size()),
          isTile_(picture.layers.size()) {
        for (const TileFill& fill : fills)
            std::fill_n(isTile_.begin() + fill.tile.first, fill.tile.count, true);
    }

    std::optional<PlacedSymbols> run(std::span<const TileFill> fills) {
        const limits::Stage stage("finding repeats", place_);
        place_ = picture_.layers.empty() ? limits::Place{} : picture_.layers.front().place;
        for (const TileFill& fill : fills)
            if (!fill.blocks.empty() && !addTiles(fill))
                return std::nullopt;
        const std::vector<Repeat> repeats = findRepeats(origins_, isTile_, weights(), imageSlack());
        if (mayPay(repeats)) {
            addRepeats(repeats);
            keepApart();
        }
        return result();
    }

private:
    // ---- Repeats ----

    /// Their maps are made on all processors, and painted in their order.
    void addRepeats(std::span<const Repeat> repeats) {
        constexpr std::size_t atOnce = 256;
        for (std::size_t first = 0; first < repeats.size(); first += atOnce) {
            std::vector<std::unique_ptr<Unpainted>> made(std::min(atOnce, repeats.size() - first));
            tbb::parallel_for(std::size_t{0}, made.size(), [&, holding = limits::current()](std::size_t i) {
                const limits::Scope scope(holding);
                made[i] = unpainted(repeats[first + i]);
            });
            for (const std::unique_ptr<Unpainted>& repeat : made)
                if (repeat)
                    paint(*repeat);
        }
    }

    /// Null if it should not be placed, or its map could not be proven.
    std::unique_ptr<Unpainted> unpainted(const Repeat& repeat) const {
        limits::check();
        const limits::Place place = picture_.layers[repeat.occurrences[0].first].place;
        const limits::Stage stage("finding repeats", place);
        if (!mayPay(repeat))
            return nullptr;
        const auto reference = referenceOf(repeat);
        if (!reference)
            return nullptr;
        const auto& [of, box] = *reference;
        const double side = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
        if (!(side > tolerance_))
            return nullptr;
        std::vector<Candidate> candidates = candidatesOf(repeat, of, box, side);
        const dvec2 size = (box.max - box.min) / side;
        if (candidates.size() * manyChords <
            usualOccurrences * chordsOf(repeat.occurrences[of].first, repeat.count))
            std::erase_if(candidates, [&](const Candidate& c) { return isCrossed(c, repeat.count, size); });
        if (candidates.size() < 2 || areCrowded(candidates, size))
            return nullptr;
        double stretch = 0;
        for (const Candidate& candidate : candidates)
            stretch = std::max(stretch, largestStretch(candidate.toPicture));
        auto made = std::make_unique<Unpainted>(
            repeat.count,
            SymbolMaker(origins_.subspan(repeat.occurrences[of].first, repeat.count), cornerOf(box, side),
                        side, stretch / std::max(size_.x, size_.y), options_));
        made->candidates = std::move(candidates);
        return findBoundary(*made) && keepOverOnePaint(*made) ? std::move(made) : nullptr;
    }

    std::size_t chordsOf(std::uint32_t first, std::uint32_t count) const {
        std::size_t chords = 0;
        for (std::uint32_t i = first; i < first + count; ++i)
            for (std::uint32_t r = 0; r < picture_.layers[i].runCount; ++r) {
                const Run& run = picture_.outlines.runs[picture_.layers[i].firstRun + r];
                chords += run.last - run.first;
            }
        return chords;
    }

    /// A rectangle takes as much as an instance.
    static constexpr std::size_t minChords = 5;

    /// By layer: what takes more than an instance.
    std::vector<double> weights() const {
        std::vector<double> weights;
        weights.reserve(picture_.layers.size());
        for (std::uint32_t i = 0; i < picture_.layers.size(); ++i) {
            const std::size_t chords = chordsOf(i, 1);
            weights.push_back(chords < minChords ? 0 : double(chords));
        }
        return weights;
    }

    /// Before anything is built: whether enough of the picture repeats. One that hardly does takes no time
    /// and keeps its bytes.
    bool mayPay(std::span<const Repeat> repeats) const {
        constexpr double minShare = 1.0 / 4;
        std::size_t saved = 0;
        for (const Repeat& repeat : repeats)
            saved += (repeat.occurrences.size() - 1) * chordsOf(repeat.occurrences[0].first, repeat.count);
        const std::size_t all = chordsOf(0, std::uint32_t(picture_.layers.size()));
        return double(saved) >= minShare * double(all) && saved > 0;
    }

    /// The map of a large run that stands only two or three times takes as long as it saves, and more where
    /// it turns out to be crossed.
    bool mayPay(const Repeat& repeat) const {
        constexpr std::size_t minOccurrences = 4;
        const std::size_t chords = chordsOf(repeat.occurrences[0].first, repeat.count);
        return chords >= minChords && (chords <= manyChords || repeat.occurrences.size() >= minOccurrences);
    }

    Box boxOf(std::uint32_t first, std::uint32_t count) const {
        Box box;
        for (std::uint32_t i = first; i < first + count; ++i)
            for (std::uint32_t r = 0; r < picture_.layers[i].runCount; ++r) {
                const Run& run = picture_.outlines.runs[picture_.layers[i].firstRun + r];
                box.add(lattice_.toUnits(picture_.outlines.points[run.first]));
                box.add(lattice_.toUnits(picture_.outlines.points[run.last]));
            }
        return box;
    }

    /// An occurrence of which no part lies outside of the picture, and its box.
    std::optional<std::pair<std::size_t, Box>> referenceOf(const Repeat& repeat) const {
        const dvec2 step(2 / lattice_.stepsPerUnit());
        for (std::size_t i = 0; i < repeat.occurrences.size(); ++i) {
            const auto run = origins_.subspan(repeat.occurrences[i].first, repeat.count);
            const bool isWhole = std::ranges::all_of(run, [&](const LayerOrigin& origin) {
                return Box{step, size_ - step}.contains(outlineBox(origin));
            });
            if (isWhole)
                return std::pair(i, boxOf(repeat.occurrences[i].first, repeat.count));
        }
        return std::nullopt;
    }

    /// Of a square with the box in its middle, so that its centre lies in the picture.
    static dvec2 cornerOf(const Box& box, double side) { return 0.5 * (box.min + box.max) - 0.5 * side; }

    std::vector<Candidate> candidatesOf(const Repeat& repeat, std::size_t reference, const Box& box,
                                        double side) const {
        std::vector<Candidate> candidates;
        const Affine2 toReference{glm::dmat2(side), cornerOf(box, side)};
        const Affine2 back = inverse(affine2(repeat.occurrences[reference].fromFirst));
        const dvec2 slack(slackOf());
        for (const Repeat::Occurrence& occurrence : repeat.occurrences) {
            Candidate candidate;
            candidate.firstLayer = occurrence.first;
            candidate.toPicture = compose(compose(affine2(occurrence.fromFirst), back), toReference);
            const dvec2 size = (box.max - box.min) / side;
            if (Box{-slack, size_ + slack}.contains(mapped(candidate.toPicture, middle(size))) &&
                isStorable(candidate.toPicture))
                candidates.push_back(std::move(candidate));
        }
        return candidates;
    }

    /// Building a map of so many chords takes longer than to look at points first, and pays only if there are
    /// as many occurrences. A few points settle it sooner for half the chords where there are half as many.
    static constexpr std::size_t manyChords = 1000, usualOccurrences = 4;

    /// Whether some points of a run lie under or over layers that others do not, as where two of them
    /// overlap.
    bool isCrossed(const Candidate& candidate, std::uint32_t count, dvec2 size) const {
        constexpr int grid = 8;
        std::optional<std::vector<std::uint32_t>> known;
        for (int i = 0; i < grid * grid; ++i) {
            const dvec2 p = 0.5 + ((dvec2(i % grid, i / grid) + 0.5) / double(grid) - 0.5) * size;
            std::vector<std::uint32_t> layers = layersOver(candidate.toPicture(p));
            const bool isIn =
                std::erase_if(layers, [&](std::uint32_t layer) {
                    return layer >= candidate.firstLayer && layer < candidate.firstLayer + count;
                }) > 0;
            if (isIn && known && *known != layers)
                return true;
            if (isIn)
                known = std::move(layers);
        }
        return false;
    }

    static constexpr double maxCrowd = 3;

    /// Whether most of them must cross each other: their boxes have several times the area that they lie in.
    static bool areCrowded(std::span<const Candidate> candidates, dvec2 size) {
        double area = 0;
        Box all;
        for (const Candidate& candidate : candidates) {
            area += std::abs(glm::determinant(candidate.toPicture.linear)) * size.x * size.y;
            all.add(mapped(candidate.toPicture, middle(size)));
        }
        return area > maxCrowd * (all.max.x - all.min.x) * (all.max.y - all.min.y);
    }

    /// What abutting instances may overlap by, as rounding has it.
    double slackOf() const { return tolerance_ / 8; }
    /// By which layers may differ from images of each other, and again from where a run's map has them. At
    /// the default tolerance it is a thousandth of a unit in a picture of 1000, as is what three decimals
    /// leave open.
    double imageSlack() const { return tolerance_ / 16; }

    bool isStorable(const Affine2& toPicture) const {
        const double longer = std::max(size_.x, size_.y);
        return asset::placementError(toPicture.linear / longer) * longer <= slackOf();
    }

    static std::unique_ptr<SymbolBoundary> boundaryOf(const SymbolMap& map) {
        return std::make_unique<SymbolBoundary>(planarMap(map.asset, map.asset.maps[0]));
    }

    /// Of all that may be seen, whatever lies around it. Returns whether there is one.
    bool findBoundary(Unpainted& symbol) const {
        std::optional<SymbolMap> bySets = symbol.maker.bySets(symbol.sets);
        if (!bySets)
            return false;
        symbol.bySets = std::move(*bySets);
        symbol.boundary = boundaryOf(symbol.bySets);
        const std::optional<dvec2> inner = symbol.layerCount == 1 ? firstOf(symbol.boundary->pointsInside())
                                                                  : innermost(*symbol.boundary, symbol.sets);
        if (!inner)
            return false;
        symbol.inner = *inner;
        if (!hasClips(symbol))
            return true;
        const auto visible = symbol.maker.byClasses(symbol.sets, visibleClassesOf(symbol));
        if (!visible)
            return false;
        symbol.boundary = boundaryOf(*visible);
        return true;
    }

    /// Keeps the candidates of which the same layers lie over all parts. Returns whether there are any.
    bool keepOverOnePaint(Unpainted& symbol) const {
        const std::vector<dvec2> points = symbol.boundary->pointsInside();
        constexpr std::size_t maxParts = 256;
        if (points.empty() || points.size() > maxParts)
            return false;
        std::erase_if(symbol.candidates, [&](const Candidate& candidate) {
            const auto around = layersAround(candidate, symbol.layerCount, symbol.inner);
            return std::ranges::any_of(
                points, [&](dvec2 p) { return layersAround(candidate, symbol.layerCount, p) != around; });
        });
        return !symbol.candidates.empty();
    }

    void paint(Unpainted& symbol) {
        place_ = picture_.layers[symbol.candidates[0].firstLayer].place;
        for (Candidate& candidate : symbol.candidates)
            candidate.paints =
                paintsOf(candidate, symbol.sets, layersAround(candidate, symbol.layerCount, symbol.inner));
        const std::vector<std::uint32_t> classes = classesOf(symbol.candidates, symbol.sets.size());
        // One layer has two sets, which are classes already unless it shows nowhere.
        std::optional<SymbolMap> map = symbol.layerCount == 1 && classes.back() == 1
                                           ? std::move(symbol.bySets)
                                           : symbol.maker.byClasses(symbol.sets, classes);
        if (!map)
            return;
        const auto number = std::uint32_t(symbols_.size());
        for (Candidate& candidate : symbol.candidates) {
            candidate.symbol = number;
            candidate.box = mapped(candidate.toPicture, {symbol.boundary->min(), symbol.boundary->max()});
            candidate.paints = paintsByClass(candidate.paints, classes);
            candidates_.push_back(std::move(candidate));
        }
        symbols_.push_back({symbol.layerCount, std::move(*map), std::move(symbol.boundary)});
    }

    /// A point in a region over which most layers lie, away from its boundaries.
    static std::optional<dvec2> innermost(const SymbolBoundary& boundary, const LayerSets& sets) {
        constexpr int grid = 16;
        std::optional<dvec2> best;
        std::size_t most = 0;
        for (int y = 0; y < grid; ++y)
            for (int x = 0; x < grid; ++x) {
                const dvec2 p = (dvec2(x, y) + 0.5) / double(grid);
                const std::size_t layers = sets[boundary.regionAt(p)].size();
                if (layers > most) {
                    most = layers;
                    best = p;
                }
            }
        return best ? best : firstOf(boundary.pointsInside());
    }
    static std::optional<dvec2> firstOf(const std::vector<dvec2>& points) {
        return points.empty() ? std::nullopt : std::optional(points.front());
    }

    LatticePoint onLattice(dvec2 p) const {
        const dvec2 steps = scene::apply(lattice_.toSteps(), p);
        return {Coord(std::lround(steps.x)), Coord(std::lround(steps.y))};
    }

    /// Both are made when they are first asked for, by one of several threads: of a crowded picture they take
    /// much memory, and it may have no repeat that asks.
    const LayersAt& layersAt() const {
        std::call_once(areLayersFound_, [this] { layersAt_.emplace(picture_, lattice_.square()); });
        return *layersAt_;
    }
    const OwnClips& ownClips() const {
        std::call_once(areClipsFound_, [this] { ownClips_.emplace(picture_); });
        return *ownClips_;
    }

    std::vector<std::uint32_t> layersOver(dvec2 point) const { return layersAt()(onLattice(point)); }

    /// The layers over a point of a symbol's square, but for its own.
    std::vector<std::uint32_t> layersAround(const Candidate& candidate, std::uint32_t count,
                                            dvec2 point) const {
        std::vector<std::uint32_t> layers = layersOver(candidate.toPicture(point));
        std::erase_if(layers, [&](std::uint32_t layer) {
            return isTile_[layer] || (layer >= candidate.firstLayer && layer < candidate.firstLayer + count);
        });
        return layers;
    }

    /// By set, of the symbol's layers.
    std::vector<PaintId> paintsOf(const Candidate& candidate, const LayerSets& sets,
                                  const std::vector<std::uint32_t>& around) {
        const auto middle = std::ranges::lower_bound(around, candidate.firstLayer);
        std::vector<PaintId> paints;
        std::vector<std::uint32_t> layers;
        for (std::size_t i = 0; i < sets.size(); ++i) {
            layers.assign(around.begin(), middle);
            for (const std::uint32_t layer : sets[i])
                layers.push_back(candidate.firstLayer + layer);
            layers.insert(layers.end(), middle, around.end());
            for (const std::uint32_t layer : layers)
                inside_[layer] = true;
            paints.push_back(painter_.paint(layers, inside_, palette_));
            for (const std::uint32_t layer : layers)
                inside_[layer] = false;
        }
        return paints;
    }

    /// Sets that have the same paint wherever the symbol stands are one class; those that show the ground
    /// everywhere are class 0.
    static std::vector<std::uint32_t> classesOf(std::span<const Candidate> candidates, std::size_t sets) {
        std::map<std::vector<PaintId>, std::uint32_t> classes;
        std::vector<std::uint32_t> classOf;
        for (std::size_t set = 0; set < sets; ++set) {
            std::vector<PaintId> paints;
            for (const Candidate& candidate : candidates)
                paints.push_back(candidate.paints[set]);
            classOf.push_back(
                classes.try_emplace(std::move(paints), std::uint32_t(classes.size())).first->second);
        }
        return classOf;
    }

    bool hasClips(const Unpainted& symbol) const {
        return std::ranges::any_of(symbol.candidates, [&](const Candidate& candidate) {
            return ownClips().areIn({candidate.firstLayer, symbol.layerCount});
        });
    }

    /// Sets of which the same may be seen, wherever the symbol stands and whatever lies around it, are one
    /// class. Other outlines must keep away from lines between these, too, which may show nothing here but
    /// clip or be clipped elsewhere.
    std::vector<std::uint32_t> visibleClassesOf(const Unpainted& symbol) const {
        std::map<std::vector<std::vector<std::uint32_t>>, std::uint32_t> classes;
        std::vector<std::uint32_t> classOf;
        for (std::size_t set = 0; set < symbol.sets.size(); ++set) {
            std::vector<std::vector<std::uint32_t>> visible;
            for (const Candidate& candidate : symbol.candidates)
                visible.push_back(
                    ownClips().visible({candidate.firstLayer, symbol.layerCount}, symbol.sets[set]));
            classOf.push_back(
                classes.try_emplace(std::move(visible), std::uint32_t(classes.size())).first->second);
        }
        return classOf;
    }

    static std::vector<PaintId> paintsByClass(std::span<const PaintId> bySet,
                                              std::span<const std::uint32_t> classes) {
        std::vector<PaintId> paints;
        for (std::size_t set = 0; set < classes.size(); ++set)
            if (classes[set] == paints.size())
                paints.push_back(bySet[set]);
        return paints;
    }

    // ---- Patterns ----

    /// Returns whether the tile could be proven.
    bool addTiles(const TileFill& fill) {
        place_ = picture_.layers[fill.pattern.shape].place;
        limits::check();
        const dvec2 period = fill.pattern.period();
        const double side = std::max(period.x, period.y);
        const Affine2 toPicture = affine2(fill.pattern.toPicture);
        const SymbolMaker maker(tileOf(fill), fill.pattern.min + 0.5 * (period - side), side,
                                largestStretch(toPicture) * side / std::max(size_.x, size_.y), options_);
        LayerSets sets;
        const std::optional<SymbolMap> bySets = maker.bySets(sets);
        if (!bySets)
            return false;
        // Blocks in the same layers have the same paints.
        std::map<std::vector<std::uint32_t>, std::size_t> known;
        std::vector<Candidate> surroundings;
        std::vector<std::size_t> surroundingOf;
        for (const TileBlock& block : fill.blocks) {
            Candidate candidate;
            candidate.firstLayer = fill.tile.first;
            candidate.toPicture = compose(toPicture, squareOf(fill, block));
            const dvec2 middle(0.5);
            std::vector<std::uint32_t> around = layersAround(candidate, fill.tile.count, middle);
            const auto [entry, isNew] = known.try_emplace(around, surroundings.size());
            if (isNew) {
                candidate.paints = paintsOf(candidate, sets, around);
                surroundings.push_back(std::move(candidate));
            }
            surroundingOf.push_back(entry->second);
        }
        const std::vector<std::uint32_t> classes = classesOf(surroundings, sets.size());
        const std::optional<SymbolMap> map = maker.byClasses(sets, classes);
        if (!map)
            return false;
        unsigned levels = 0;
        for (const TileBlock& block : fill.blocks)
            levels = std::max(levels, block.level);
        const auto firstMap = std::uint32_t(placed_.maps.size());
        const std::uint32_t numbers = *std::ranges::max_element(classes);
        for (std::uint32_t level = levels; level > 0; --level)
            placed_.maps.push_back(gridOf(firstMap + levels - level + 1, period / side, numbers));
        placed_.maps.push_back(*map);
        for (std::size_t i = 0; i < fill.blocks.size(); ++i) {
            const TileBlock& block = fill.blocks[i];
            placed_.error = std::max(placed_.error, map->error * side * largestStretch(toPicture));
            placed_.placed.push_back({firstMap + levels - block.level,
                                      compose(toPicture, squareOf(fill, block)),
                                      paintsByClass(surroundings[surroundingOf[i]].paints, classes)});
        }
        return true;
    }

    /// The origins of a tile's layers in the pattern's space, as of tile (0, 0).
    std::vector<LayerOrigin> tileOf(const TileFill& fill) const {
        const dvec2 moved = dvec2(fill.tileAt) * fill.pattern.period();
        const scene::Affine toPattern =
            *scene::inverse(scene::compose(fill.pattern.toPicture, scene::translation(moved.x, moved.y)));
        std::vector<LayerOrigin> tile(origins_.begin() + fill.tile.first,
                                      origins_.begin() + fill.tile.first + fill.tile.count);
        for (LayerOrigin& origin : tile)
            origin.transform = scene::compose(toPattern, origin.transform);
        return tile;
    }

    /// 8 × 8 of a map. `period`: in sides of the tile's square, in the middle of which a tile lies, as a
    /// block does in its own.
    static GroupMap gridOf(std::uint32_t map, dvec2 period, std::uint32_t paints) {
        constexpr double share = 1.0 / double(blockTiles);
        GroupMap grid{{}, paints};
        std::vector<PaintId> numbers(paints + 1);
        std::iota(numbers.begin(), numbers.end(), PaintId(0));
        for (std::int64_t i = 0; i < blockTiles * blockTiles; ++i) {
            const dvec2 at(double(i % blockTiles), double(i / blockTiles));
            grid.placed.push_back(
                {map,
                 {glm::dmat2(share), (1 - share) * 0.5 * (1.0 - period) + at * share * period},
                 numbers});
        }
        return grid;
    }

    /// From a block's [0, 1]² to the pattern's space: a block lies in the middle of its square.
    static Affine2 squareOf(const TileFill& fill, const TileBlock& block) {
        const dvec2 period = fill.pattern.period();
        const double side = std::ldexp(std::max(period.x, period.y), int(3 * block.level));
        static_assert(blockTiles == 8);
        const dvec2 size = period * std::ldexp(1.0, int(3 * block.level));
        return {glm::dmat2(side), fill.pattern.min + dvec2(block.at) * period + 0.5 * (size - side)};
    }

    // ---- All of them ----

    bool areAllCrowded() const {
        double area = 0;
        Box all;
        for (const Candidate& candidate : candidates_) {
            const dvec2 size = candidate.box.max - candidate.box.min;
            area += size.x * size.y;
            all.add(candidate.box);
        }
        return area > maxCrowd * (all.max.x - all.min.x) * (all.max.y - all.min.y);
    }

    /// Marks candidates as flat that touch something else.
    void keepApart() {
        if (candidates_.empty())
            return;
        if (areAllCrowded()) {
            candidates_.clear();
            return;
        }
        CandidateGrid grid(candidates_, std::max(size_.x, size_.y));
        std::vector<bool> isCandidates(picture_.layers.size());
        for (const Candidate& candidate : candidates_)
            std::fill_n(isCandidates.begin() + candidate.firstLayer, symbols_[candidate.symbol].layerCount,
                        true);
        for (std::uint32_t layer = 0; layer < picture_.layers.size(); ++layer)
            if (!isCandidates[layer] && !isTile_[layer])
                keepApartFrom(picture_.layers[layer], grid);
        for (std::uint32_t i = 0; i < candidates_.size(); ++i)
            keepApartFromOthers(i, grid);
        // What lies in a candidate and is flat makes that flat too.
        std::vector<std::uint32_t> flat;
        for (std::uint32_t i = 0; i < candidates_.size(); ++i)
            if (candidates_[i].isFlat)
                flat.push_back(i);
        flattenAround(std::move(flat));
        refuseWhatDoesNotPay();
    }

    void flattenAround(std::vector<std::uint32_t> flat) {
        while (!flat.empty()) {
            const std::uint32_t i = flat.back();
            flat.pop_back();
            candidates_[i].isFlat = true;
            for (const std::uint32_t around : candidates_[i].around)
                if (!candidates_[around].isFlat) {
                    candidates_[around].isFlat = true;
                    flat.push_back(around);
                }
        }
    }

    void keepApartFrom(const Layer& layer, CandidateGrid& grid) {
        place_ = layer.place;
        const auto& outlines = picture_.outlines;
        for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r) {
            limits::check();
            const Run& run = outlines.runs[r];
            Box runBox;
            runBox.add(lattice_.toUnits(outlines.points[run.first]));
            runBox.add(lattice_.toUnits(outlines.points[run.last]));
            bool isNear = false;
            grid.forEachCell(runBox, [&](const auto& cell) { isNear = isNear || !cell.empty(); });
            for (std::uint32_t p = run.first; isNear && p < run.last; ++p) {
                const Segment2 chord{lattice_.toUnits(outlines.points[p]),
                                     lattice_.toUnits(outlines.points[p + 1])};
                Box box;
                box.add(chord.a);
                box.add(chord.b);
                grid.forEachCell(box, [&](const std::vector<std::uint32_t>& cell) {
                    for (const std::uint32_t i : cell)
                        if (!candidates_[i].isFlat && touches(candidates_[i], chord, box))
                            candidates_[i].isFlat = true;
                });
            }
        }
    }

    /// Whether a chord meets a candidate's boundaries or lies in one of its regions.
    bool touches(const Candidate& candidate, const Segment2& chord, const Box& box) const {
        const double slack = slackOf();
        if (box.max.x - slack <= candidate.box.min.x || box.min.x + slack >= candidate.box.max.x ||
            box.max.y - slack <= candidate.box.min.y || box.min.y + slack >= candidate.box.max.y)
            return false;
        const SymbolBoundary& boundary = *symbols_[candidate.symbol].boundary;
        const Affine2 toSymbol = inverse(candidate.toPicture);
        const Segment2 s{toSymbol(chord.a), toSymbol(chord.b)};
        return boundary.meets(s) || boundary.regionAt(s.a) != 0;
    }

    void keepApartFromOthers(std::uint32_t i, CandidateGrid& grid) {
        Candidate& candidate = candidates_[i];
        place_ = picture_.layers[candidate.firstLayer].place;
        limits::check();
        std::vector<std::uint32_t> others;
        grid.forEachCell(candidate.box, [&](const std::vector<std::uint32_t>& cell) {
            for (const std::uint32_t j : cell)
                if (j != i && overlap(candidate.box, candidates_[j].box, slackOf()))
                    others.push_back(j);
        });
        std::ranges::sort(others);
        others.erase(std::unique(others.begin(), others.end()), others.end());
        for (const std::uint32_t j : others) {
            Candidate& other = candidates_[j];
            if (candidate.isFlat && other.isFlat)
                continue;
            const Position position =
                j > i && meet(candidate, other) ? Position::Partly : positionIn(candidate, other);
            if (position == Position::Partly)
                candidate.isFlat = other.isFlat = true;
            else if (position == Position::Inside)
                candidate.around.push_back(j);
        }
    }

    bool meet(const Candidate& a, const Candidate& b) const {
        const SymbolBoundary& boundary = *symbols_[b.symbol].boundary;
        const Affine2 toB = compose(inverse(b.toPicture), a.toPicture);
        return std::ranges::any_of(symbols_[a.symbol].boundary->segments(), [&](const Segment2& s) {
            return boundary.meets({toB(s.a), toB(s.b)});
        });
    }

    /// Where a candidate lies to the regions of another.
    enum class Position { Outside, Partly, Inside };

    /// By the ends of its boundary's chords: what touches the other's boundary may have gone unseen by
    /// meet().
    Position positionIn(const Candidate& a, const Candidate& b) const {
        const SymbolBoundary& boundary = *symbols_[b.symbol].boundary;
        const Affine2 toB = compose(inverse(b.toPicture), a.toPicture);
        const auto segments = symbols_[a.symbol].boundary->segments();
        const auto inside = std::ranges::count_if(
            segments, [&](const Segment2& s) { return boundary.regionAt(toB(s.a)) != 0; });
        return inside == 0                      ? Position::Outside
               : inside == std::ssize(segments) ? Position::Inside
                                                : Position::Partly;
    }

    /// Instances must save a fifth of what their pieces take otherwise.
    void refuseWhatDoesNotPay() {
        constexpr double minSaving = 0.2;
        std::vector<std::size_t> counts(symbols_.size());
        std::vector<std::map<std::vector<PaintId>, int>> paints(symbols_.size());
        for (const Candidate& candidate : candidates_)
            if (!candidate.isFlat) {
                ++counts[candidate.symbol];
                ++paints[candidate.symbol][candidate.paints];
            }
        std::vector<std::uint32_t> flat;
        for (std::uint32_t i = 0; i < candidates_.size(); ++i) {
            const std::uint32_t symbol = candidates_[i].symbol;
            const asset::Asset& map = symbols_[symbol].map.asset;
            const double pieces = double(recordBytes * map.pieces.size());
            const double own = pieces + double(recordBytes * map.leaves.size() + sizeof(asset::Map) +
                                               sizeof(asset::Node) * map.nodes.size());
            const double forPaints =
                double(paints[symbol].size()) * double(recordBytes + 2 * candidates_[i].paints.size());
            const double each = 1.5 * recordBytes;  // its record, and a share of the tree
            const double count = double(counts[symbol]);
            if (!candidates_[i].isFlat && count * (pieces * (1 - minSaving) - each) < own + forPaints)
                flat.push_back(i);
        }
        flattenAround(std::move(flat));
    }

    PlacedSymbols result() {
        PlacedSymbols placed = std::move(placed_);
        std::vector<bool> isPlaced = isTile_;
        std::vector<std::uint32_t> numbers(symbols_.size(), noIndex);
        // What was written together stands together, for groups.
        std::ranges::stable_sort(candidates_, {}, &Candidate::firstLayer);
        for (Candidate& candidate : candidates_) {
            if (candidate.isFlat)
                continue;
            Symbol& symbol = symbols_[candidate.symbol];
            std::fill_n(isPlaced.begin() + candidate.firstLayer, symbol.layerCount, true);
            if (std::ranges::all_of(candidate.paints, [&](PaintId p) { return p == candidate.paints[0]; }))
                continue;  // hidden
            if (numbers[candidate.symbol] == noIndex) {
                numbers[candidate.symbol] = std::uint32_t(placed.maps.size());
                placed.maps.push_back(symbol.map);
            }
            placed.error = std::max(placed.error, symbol.map.error * largestStretch(candidate.toPicture));
            placed.placed.push_back(
                {numbers[candidate.symbol], candidate.toPicture, std::move(candidate.paints)});
        }
        placed.error += placed.placed.empty() ? 0 : slackOf() + 2 * imageSlack();  // rounding, and images
        for (std::uint32_t i = 0; i < isPlaced.size(); ++i)
            if (!isPlaced[i])
                placed.layers.push_back(i);
        return groupPlacements(std::move(placed), slackOf(), size_);
    }

    const LoweredScene& picture_;
    const std::span<const LayerOrigin> origins_;
    const Lattice& lattice_;
    const dvec2 size_;
    const Options& options_;
    const double tolerance_;  ///< user units
    limits::Place place_;     ///< of what is being looked at, for messages
    Palette& palette_;
    PicturePainter painter_;
    mutable std::once_flag areLayersFound_, areClipsFound_;
    mutable std::optional<OwnClips> ownClips_;
    std::vector<std::uint8_t> inside_;  ///< by layer
    std::vector<bool> isTile_;          ///< by layer: of a tile that blocks are made of
    PlacedSymbols placed_;              ///< patterns
    mutable std::optional<LayersAt> layersAt_;
    std::vector<Symbol> symbols_;
    std::vector<Candidate> candidates_;
};

}  // namespace

std::optional<PlacedSymbols> placeSymbols(const LoweredScene& picture, std::span<const LayerOrigin> origins,
                                          std::span<const TileFill> fills, const Lattice& lattice,
                                          glm::dvec2 size, const Options& options, Palette& palette) {
    return Placer(picture, origins, fills, lattice, size, options, palette).run(fills);
}

}  // namespace vtm::compiler
