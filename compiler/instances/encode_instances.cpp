#include "compiler/instances/encode_instances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include <vtm/compiler/compile.hpp>
#include <vtm/limits/limits.hpp>
#include "compiler/instances/place_symbols.hpp"
#include "compiler/tree/encode.hpp"

namespace vtm::compiler {
namespace {

using asset::Affine2;
using asset::Asset;
using asset::Entry;
using asset::Instance;
using glm::dvec2;

std::uint16_t nextMap(const Asset& asset) {
    if (asset.maps.size() > 0xFFFF)
        throw LimitError("the picture has more than 65535 symbols");
    return std::uint16_t(asset.maps.size());
}

/// The map's records, behind those that are there.
void appendMap(const SymbolMap& symbol, Asset& asset) {
    const auto nodes = std::uint32_t(asset.nodes.size()), leaves = std::uint32_t(asset.leaves.size()),
               pieces = std::uint32_t(asset.pieces.size());
    const auto moved = [&](Entry entry) {
        const bool isLeaf = entry.kind() == Entry::Kind::Leaf, isNode = entry.kind() == Entry::Kind::Node;
        return Entry::make(entry.kind(), entry.payload() + (isLeaf ? leaves : isNode ? nodes : 0));
    };
    for (asset::Node node : symbol.asset.nodes) {
        std::ranges::transform(node.children, node.children.begin(), moved);
        asset.nodes.push_back(node);
    }
    for (asset::Leaf leaf : symbol.asset.leaves) {
        leaf.firstPiece += pieces;
        asset.leaves.push_back(leaf);
    }
    asset.pieces.insert(asset.pieces.end(), symbol.asset.pieces.begin(), symbol.asset.pieces.end());
    asset::Map map = symbol.asset.maps.front();
    map.root = moved(map.root);
    asset.maps.push_back(map);
}

double largestCoefficient(const glm::dmat2& m) {
    return std::max({std::abs(m[0].x), std::abs(m[0].y), std::abs(m[1].x), std::abs(m[1].y)});
}

float notBelow(double value) {
    const auto rounded = float(value);
    return double(rounded) < value ? std::nextafter(rounded, HUGE_VALF) : rounded;
}

/// Scales of a map's placements: their largest coefficients, which are then stored exactly, or powers of two
/// if there are many of them.
class Scales {
public:
    void add(double coefficient) { exact_.insert(notBelow(coefficient)); }
    float of(double coefficient) const {
        constexpr std::size_t maxExact = 16;
        return exact_.size() <= maxExact ? notBelow(coefficient)
                                         : std::ldexp(1.0f, std::ilogb(coefficient) + 1);
    }

private:
    std::set<float> exact_;
};

class SymbolTable {
public:
    explicit SymbolTable(Asset& asset) : asset_(asset) {}

    std::uint16_t add(std::uint16_t map, float scale, const std::vector<std::uint16_t>& paints) {
        const std::vector<std::uint16_t> inner(paints.begin() + 1, paints.end());
        const auto [palette, isNewPalette] =
            palettes_.try_emplace(inner, std::uint32_t(asset_.palettes.size()));
        if (isNewPalette)
            asset_.palettes.insert(asset_.palettes.end(), inner.begin(), inner.end());
        const auto [symbol, isNew] =
            symbols_.try_emplace({map, paints[0], palette->second, scale}, asset_.symbols.size());
        if (isNew) {
            if (asset_.symbols.size() > 0xFFFF)
                throw LimitError("the picture has more than 65536 symbols");
            asset_.symbols.push_back({map, paints[0], palette->second, scale, 0});
        }
        return std::uint16_t(symbol->second);
    }

private:
    Asset& asset_;
    std::map<std::vector<std::uint16_t>, std::uint32_t> palettes_;
    std::map<std::tuple<std::uint16_t, std::uint16_t, std::uint32_t, float>, std::size_t> symbols_;
};

/// `toSquare`: from the symbol's square, [0, 1]², to that of the map around.
Instance instanceOf(std::uint16_t symbol, float scale, const Affine2& toSquare) {
    const auto coefficient = [&](double value) {
        return std::int16_t(std::lround(value / double(scale) * double(asset::slopeScale)));
    };
    const dvec2 centre = toSquare(dvec2(0.5)) * asset::centreSteps;
    const auto steps = [](double value) {
        return std::uint32_t(std::clamp(std::round(value), 0.0, asset::centreSteps - 1));
    };
    const glm::dmat2& m = toSquare.linear;
    return Instance::make(
        symbol, {steps(centre.x), steps(centre.y)},
        {coefficient(m[0].x), coefficient(m[0].y), coefficient(m[1].x), coefficient(m[1].y)});
}

/// How far an instance's square reaches from its centre along x or y.
double reachOf(const Asset& asset, const Instance& instance) {
    const auto [m00, m01, m10, m11] = instance.linear();
    const double step = 0.5 * double(asset.symbols[instance.symbol()].scale) / double(asset::slopeScale);
    return step * std::max(std::abs(m00) + std::abs(m10), std::abs(m01) + std::abs(m11));
}

// ---- Trees ----------------------------------------------------------------------------------------

/// A cell is divided if it holds more: a footprint asks each of them whether they meet.
constexpr std::size_t usualInstances = 16;

/// One tree of instances that are alike in size.
class TreeBuilder {
public:
    /// Cells of `usualLevel` are about as large as the instances; smaller ones serve only to tell many apart.
    TreeBuilder(Asset& asset, unsigned usualLevel) : asset_(asset), usualLevel_(usualLevel) {}

    Entry build(std::vector<Instance> instances, unsigned level) {
        if (instances.empty())
            return Entry::make(Entry::Kind::Solid, 0);
        const std::size_t fits = level < usualLevel_ ? usualInstances : asset::maxInstancesPerCell;
        if (instances.size() <= fits || level == asset::maxLevel)
            return list(std::move(instances));
        std::array<std::vector<Instance>, 16> children;
        for (const Instance& instance : instances) {
            const unsigned shift = 2 * (asset::maxLevel - level - 1);
            const auto [x, y] = instance.centre();
            children[((y >> shift) & 3) * 4 + ((x >> shift) & 3)].push_back(instance);
        }
        return appendNode(asset_.nodes,
                          [&](std::size_t i) { return build(std::move(children[i]), level + 1); });
    }
    /// What no cell had room for.
    std::vector<Instance> takeRest() { return std::move(rest_); }

private:
    Entry list(std::vector<Instance> instances) {
        if (instances.size() > asset::maxInstancesPerCell) {
            rest_.insert(rest_.end(), instances.begin() + asset::maxInstancesPerCell, instances.end());
            instances.resize(asset::maxInstancesPerCell);
        }
        const auto first = std::uint32_t(asset_.instances.size());
        if (first + instances.size() > asset::maxInstances)
            throw LimitError("the picture has more than 2^24 instances");
        asset_.instances.insert(asset_.instances.end(), instances.begin(), instances.end());
        return asset::InstanceRange::entry(first, std::uint32_t(instances.size()));
    }

    Asset& asset_;
    const unsigned usualLevel_;
    std::vector<Instance> rest_;
};

/// The deepest level whose cells are as wide as an instance.
unsigned levelFor(double reach) {
    const double levels = -std::log2(2 * reach) / 2;
    return unsigned(std::clamp(std::floor(levels), 0.0, double(asset::maxLevel)));
}

/// Appends trees and returns 1 + the index of the first.
std::uint32_t appendTrees(const std::vector<Instance>& instances, Asset& asset) {
    std::map<unsigned, std::vector<Instance>> byLevel;
    for (const Instance& instance : instances)
        byLevel[levelFor(reachOf(asset, instance))].push_back(instance);
    const auto firstTree = std::uint32_t(asset.instanceTrees.size());
    for (auto& [level, group] : byLevel) {
        double reach = 0;
        for (const Instance& instance : group)
            reach = std::max(reach, reachOf(asset, instance));
        while (!group.empty()) {
            TreeBuilder builder(asset, level);
            asset::InstanceTree tree;
            tree.root = builder.build(std::move(group), 0);
            tree.reach = notBelow(reach);
            tree.next = std::uint32_t(asset.instanceTrees.size()) + 2;
            asset.instanceTrees.push_back(tree);
            group = builder.takeRest();
        }
    }
    asset.instanceTrees.back().next = 0;
    return firstTree + 1;
}

std::uint32_t appendGrid(const GridMap& grid, std::uint16_t inner, SymbolTable& symbols, Asset& asset) {
    std::vector<std::uint16_t> numbers(grid.paints + 1);
    std::iota(numbers.begin(), numbers.end(), std::uint16_t(0));
    constexpr float scale = 1.0f / blockTiles;
    const std::uint16_t symbol = symbols.add(inner, scale, numbers);
    std::vector<Instance> instances;
    for (std::int64_t i = 0; i < blockTiles * blockTiles; ++i)
        instances.push_back(
            instanceOf(symbol, scale,
                       {glm::dmat2(double(scale)),
                        grid.first + dvec2(double(i % blockTiles), double(i / blockTiles)) * grid.step}));
    return appendTrees(instances, asset);
}

/// Squares and pieces of a map, those of the maps in it included (asset::maxDrawn).
std::vector<double> drawnOf(const PlacedSymbols& placed) {
    std::vector<double> drawn(placed.maps.size());
    for (std::size_t i = drawn.size(); i-- > 0;) {
        if (const auto* symbol = std::get_if<SymbolMap>(&placed.maps[i])) {
            const Asset& map = symbol->asset;
            drawn[i] = double(1 + 16 * map.nodes.size() + map.pieces.size());
        } else {
            const auto& grid = std::get<GridMap>(placed.maps[i]);
            drawn[i] = 1 + double(blockTiles * blockTiles) * (drawn[grid.map] + grid.paints);
        }
    }
    return drawn;
}

void checkDrawn(const PlacedSymbols& placed, const Asset& asset) {
    const std::vector<double> drawn = drawnOf(placed);
    double sum = double(asset.maps.size() + 16 * asset.nodes.size() + asset.pieces.size());
    for (const PlacedSymbol& p : placed.placed)
        sum += drawn[p.map] + double(p.paints.size());
    if (sum > double(asset::maxDrawn))
        throw LimitError("the picture's instances need more than " + std::to_string(asset::maxDrawn) +
                         " squares and pieces");
}

}  // namespace

double placementError(const glm::dmat2& linear) {
    double error = 0;
    const double largest = largestCoefficient(linear);
    for (const float scale : {notBelow(largest), std::ldexp(1.0f, std::ilogb(largest) + 1)}) {
        const Affine2 stored = placementOf({0, 0, 0, scale, 0},
                                           instanceOf(0, scale, {linear, -linear * dvec2(0.5) + dvec2(0.5)}));
        const glm::dmat2 off = stored.linear - linear;
        error = std::max({error, 0.5 * (std::abs(off[0].x) + std::abs(off[1].x)),
                          0.5 * (std::abs(off[0].y) + std::abs(off[1].y))});
    }
    return error;
}

void encodeInstances(const PlacedSymbols& placed, std::span<const std::uint16_t> paints, Asset& asset) {
    if (placed.placed.empty())
        return;
    checkDrawn(placed, asset);
    const double side = asset.maps.front().side;
    const std::uint16_t first = nextMap(asset);
    for (const auto& map : placed.maps) {
        nextMap(asset);
        if (const auto* symbol = std::get_if<SymbolMap>(&map))
            appendMap(*symbol, asset);
        else
            asset.maps.push_back({0, 0, 1, Entry::make(Entry::Kind::Solid, 0), 0});
    }
    SymbolTable symbols(asset);
    for (std::size_t i = 0; i < placed.maps.size(); ++i)
        if (const auto* grid = std::get_if<GridMap>(&placed.maps[i])) {
            const auto trees = appendGrid(*grid, std::uint16_t(first + grid->map), symbols, asset);
            asset.maps[first + i].instances = trees;
        }
    const auto toSquare = [&](const PlacedSymbol& p) {
        return Affine2{p.toPicture.linear / side, p.toPicture.offset / side};
    };
    std::vector<Scales> scales(placed.maps.size());
    for (const PlacedSymbol& p : placed.placed)
        scales[p.map].add(largestCoefficient(toSquare(p).linear));
    std::vector<Instance> instances;
    for (const PlacedSymbol& p : placed.placed) {
        limits::check();
        std::vector<std::uint16_t> own;
        for (const PaintId paint : p.paints)
            own.push_back(paints[paint]);
        const float scale = scales[p.map].of(largestCoefficient(toSquare(p).linear));
        instances.push_back(
            instanceOf(symbols.add(std::uint16_t(first + p.map), scale, own), scale, toSquare(p)));
    }
    asset.maps.front().instances = appendTrees(instances, asset);
}

}  // namespace vtm::compiler
