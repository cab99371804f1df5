#include "compiler/instances/symbol_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compiler/compile/settings.hpp"
#include "compiler/tree/build_tree.hpp"
#include "compiler/tree/encode.hpp"

namespace vtm::compiler {
namespace {

/// Regions by the layers over them, or by the classes of these sets. Nothing is hidden: what an item hides
/// depends on where the run stands.
class SetPainter : public Painter {
public:
    SetPainter(LayerSets& sets, std::span<const std::uint32_t> classes) : sets_(sets), classes_(classes) {}
    std::unique_ptr<Painter> clone() const override { return std::make_unique<SetPainter>(sets_, classes_); }
    PaintId paint(std::span<const std::uint32_t> layers, const std::vector<std::uint8_t>& inside,
                  Palette&) override {
        set_.clear();
        for (const std::uint32_t layer : layers)
            if (inside[layer])
                set_.push_back(layer);
        const std::uint32_t number = sets_.add(set_);
        if (classes_.empty())
            return number;
        // The same regions as those that were classified.
        return number < classes_.size() ? classes_[number] : 0;
    }
    void cull(std::span<const std::uint32_t> layers, const std::vector<Cover>&,
              std::vector<std::uint8_t>& keep) override {
        std::fill_n(keep.begin(), layers.size(), std::uint8_t(true));
    }
    PaintId mean(std::span<const PaintId> paints, Palette&) override { return paints.front(); }

private:
    LayerSets& sets_;
    std::span<const std::uint32_t> classes_;
    std::vector<std::uint32_t> set_;
};

/// Each layer of a run as an item of its own.
scene::Scene sceneOf(std::span<const LayerOrigin> run, double side) {
    scene::Scene scene;
    scene.width = scene.height = side;
    for (const LayerOrigin& origin : run) {
        scene::Item item;
        item.path = origin.path;
        item.transform = origin.transform;
        item.paint = scene::Color{0, 0, 0, 1};
        if (origin.stroke)
            item.geometry = *origin.stroke;
        else
            item.geometry = origin.rule;
        scene.root.children.push_back({std::move(item)});
    }
    return scene;
}

/// Of the picture's tolerance. Leaves of a picture cut its boundaries short, so that their pieces are mostly
/// far better than they must be; a symbol has few leaves, and is stored but once.
constexpr double toleranceShare = 1.0 / 4;

constexpr double finestTolerance = 0x1p-24, coarsestTolerance = 0x1p-6;  // Options::tolerance that is proven

}  // namespace

std::uint32_t LayerSets::add(const std::vector<std::uint32_t>& set) {
    const std::lock_guard lock(mutex_);
    const auto [entry, isNew] = numbers_.try_emplace(set, std::uint32_t(sets_.size()));
    if (isNew)
        sets_.push_back(&entry->first);
    return entry->second;
}

SymbolMaker::SymbolMaker(std::span<const LayerOrigin> run, scene::Point corner, double side, double share,
                         const Options& options)
    : options_(options), side_(side), share_(share) {
    options_.tolerance =
        std::clamp(toleranceShare * options.tolerance / share, finestTolerance, coarsestTolerance);
    lattice_ = std::make_unique<Lattice>(side, side, latticeBits(options_));
    const Excerpt excerpt{scene::translation(-corner.x, -corner.y), side, side, false};
    lowered_ = lower(sceneOf(run, side), excerpt, *lattice_, errorBudget(options_), Sharing::None);
}

std::optional<SymbolMap> SymbolMaker::bySets(LayerSets& sets) const { return make(sets, {}); }

std::optional<SymbolMap> SymbolMaker::byClasses(LayerSets& sets,
                                                std::span<const std::uint32_t> classes) const {
    return make(sets, classes);
}

std::optional<SymbolMap> SymbolMaker::make(LayerSets& sets, std::span<const std::uint32_t> classes) const {
    std::vector<std::uint32_t> layers(lowered_.layers.size());
    std::iota(layers.begin(), layers.end(), 0u);
    TreeTimes times;
    TreeOptions options = treeOptions(options_);
    options.cost.area = CostModel::areasFor(CostModel::nominalPixels * share_);
    JoinedTree joined =
        buildTree(lowered_, lattice_->square(), layers, SetPainter(sets, classes), options, times);
    const Tree& tree = joined.tree;
    constexpr std::size_t maxNumbers = 0x10000;
    if (!tree.unproven.empty() || !options.budget.holds(tree.error) || sets.size() > maxNumbers)
        return std::nullopt;
    std::vector<std::uint16_t> numbers(sets.size());
    std::iota(numbers.begin(), numbers.end(), std::uint16_t(0));
    SymbolMap made;
    made.error = options.budget.share(tree.error);
    const asset::Entry root = encodeTree(std::move(joined), numbers, made.asset);
    made.asset.maps.push_back({0, 0, side_, root});
    return made;
}

}  // namespace vtm::compiler
