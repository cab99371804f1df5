#include "asset/place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace vtm::asset {

using glm::dvec2;

Asset extractMap(const AssetView& from, std::uint32_t map) {
    Asset asset;
    const auto copied = [&](const auto& self, Entry entry) -> Entry {
        if (entry.kind() == Entry::Kind::Leaf) {
            Leaf leaf = from.leaves[entry.payload()];
            const auto pieces = from.pieces.subspan(leaf.firstPiece, leaf.pieceCount);
            leaf.firstPiece = std::uint32_t(asset.pieces.size());
            asset.pieces.insert(asset.pieces.end(), pieces.begin(), pieces.end());
            asset.leaves.push_back(leaf);
            return Entry::make(entry.kind(), std::uint32_t(asset.leaves.size() - 1));
        }
        if (entry.kind() != Entry::Kind::Node)
            return entry;
        const std::size_t index = asset.nodes.size();
        asset.nodes.emplace_back();
        Node node = from.nodes[entry.payload()];
        for (Entry& child : node.children)
            child = self(self, child);
        asset.nodes[index] = node;
        return Entry::make(entry.kind(), std::uint32_t(index));
    };
    Map copy = from.maps[map];
    copy.root = copied(copied, copy.root);
    asset.maps = {copy};
    return asset;
}

std::uint16_t appendMap(const AssetView& from, Asset& asset) {
    if (asset.maps.size() > 0xFFFF)
        throw TooManyInstances("the picture has more than 65535 symbols");
    const auto nodes = std::uint32_t(asset.nodes.size()), leaves = std::uint32_t(asset.leaves.size()),
               pieces = std::uint32_t(asset.pieces.size());
    const auto moved = [&](Entry entry) {
        const bool isLeaf = entry.kind() == Entry::Kind::Leaf, isNode = entry.kind() == Entry::Kind::Node;
        return Entry::make(entry.kind(), entry.payload() + (isLeaf ? leaves : isNode ? nodes : 0));
    };
    for (Node node : from.nodes) {
        std::ranges::transform(node.children, node.children.begin(), moved);
        asset.nodes.push_back(node);
    }
    for (Leaf leaf : from.leaves) {
        leaf.firstPiece += pieces;
        asset.leaves.push_back(leaf);
    }
    asset.pieces.insert(asset.pieces.end(), from.pieces.begin(), from.pieces.end());
    Map map = from.maps.front();
    map.root = moved(map.root);
    asset.maps.push_back(map);
    return std::uint16_t(asset.maps.size() - 1);
}

namespace {

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
                throw TooManyInstances("the picture has more than 65536 symbols");
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
        return std::int16_t(std::lround(value / double(scale) * double(slopeScale)));
    };
    const dvec2 centre = toSquare(dvec2(0.5)) * centreSteps;
    const auto steps = [](double value) {
        return std::uint32_t(std::clamp(std::round(value), 0.0, centreSteps - 1));
    };
    const glm::dmat2& m = toSquare.linear;
    return Instance::make(
        symbol, {steps(centre.x), steps(centre.y)},
        {coefficient(m[0].x), coefficient(m[0].y), coefficient(m[1].x), coefficient(m[1].y)});
}

/// How far an instance's square reaches from its centre along x or y.
double reachOf(const Asset& asset, const Instance& instance) {
    const auto [m00, m01, m10, m11] = instance.linear();
    const double step = 0.5 * double(asset.symbols[instance.symbol()].scale) / double(slopeScale);
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
        const std::size_t fits = level < usualLevel_ ? usualInstances : maxInstancesPerCell;
        if (instances.size() <= fits || level == maxLevel)
            return list(std::move(instances));
        std::array<std::vector<Instance>, 16> children;
        for (const Instance& instance : instances) {
            const unsigned shift = 2 * (maxLevel - level - 1);
            const auto [x, y] = instance.centre();
            children[((y >> shift) & 3) * 4 + ((x >> shift) & 3)].push_back(instance);
        }
        // A node stands before its children's, so that walks need no check for cycles.
        const std::size_t index = asset_.nodes.size();
        asset_.nodes.emplace_back();
        Node node;
        for (std::size_t i = 0; i < node.children.size(); ++i)
            node.children[i] = build(std::move(children[i]), level + 1);
        asset_.nodes[index] = node;
        return Entry::make(Entry::Kind::Node, std::uint32_t(index));
    }
    /// What no cell had room for.
    std::vector<Instance> takeRest() { return std::move(rest_); }

private:
    Entry list(std::vector<Instance> instances) {
        if (instances.size() > maxInstancesPerCell) {
            rest_.insert(rest_.end(), instances.begin() + maxInstancesPerCell, instances.end());
            instances.resize(maxInstancesPerCell);
        }
        const auto first = std::uint32_t(asset_.instances.size());
        if (first + instances.size() > maxInstances)
            throw TooManyInstances("the picture has more than 2^24 instances");
        asset_.instances.insert(asset_.instances.end(), instances.begin(), instances.end());
        return InstanceRange::entry(first, std::uint32_t(instances.size()));
    }

    Asset& asset_;
    const unsigned usualLevel_;
    std::vector<Instance> rest_;
};

/// The deepest level whose cells are as wide as an instance.
unsigned levelFor(double reach) {
    const double levels = -std::log2(2 * reach) / 2;
    return unsigned(std::clamp(std::floor(levels), 0.0, double(maxLevel)));
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
            InstanceTree tree;
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

}  // namespace

std::uint32_t appendInstances(std::span<const PlacementInSquare> placements, Asset& asset) {
    if (placements.empty())
        return 0;
    std::map<std::uint16_t, Scales> scales;
    for (const PlacementInSquare& placement : placements)
        scales[placement.map].add(largestCoefficient(placement.toSquare.linear));
    SymbolTable symbols(asset);
    std::vector<Instance> instances;
    for (const PlacementInSquare& placement : placements) {
        limits::check();
        const float scale = scales[placement.map].of(largestCoefficient(placement.toSquare.linear));
        instances.push_back(
            instanceOf(symbols.add(placement.map, scale, placement.paints), scale, placement.toSquare));
    }
    return appendTrees(instances, asset);
}

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

}  // namespace vtm::asset
