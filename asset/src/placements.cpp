#include <vtm/asset/placements.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <vtm/asset/container.hpp>
#include "asset/place.hpp"

namespace vtm::asset {

using glm::dvec2;

namespace {

std::uint32_t drawnMap(const AssetView& asset) {
    if (asset.mode != Mode::Exact || asset.commands.size() != 1 ||
        asset.commands[0].kind != Command::Kind::DrawMap)
        throw std::invalid_argument("placements: the asset does not draw one map");
    return asset.commands[0].map;
}

Affine2 affineOf(const glm::dmat3x2& m) { return {glm::dmat2(m[0], m[1]), m[2]}; }

Affine2 inverse(const Affine2& a) {
    const glm::dmat2 back = glm::inverse(a.linear);
    return {back, -(back * a.offset)};
}

// ---- Without the instances of the drawn map -----------------------------------------------------------

/// Copies an asset, but for the trees of instances of one map; indices behind those that are left out move
/// up.
class Stripped {
public:
    Stripped(const AssetView& asset, std::uint32_t map)
        : asset_(asset),
          nodes_(asset.nodes.size(), true),
          instances_(asset.instances.size(), true),
          trees_(asset.instanceTrees.size(), true) {
        for (std::uint32_t tree = asset.maps[map].instances; tree != 0;
             tree = asset.instanceTrees[tree - 1].next) {
            trees_[tree - 1] = false;
            drop(asset.instanceTrees[tree - 1].root);
        }
        nodeIndex_ = indices(nodes_);
        instanceIndex_ = indices(instances_);
        treeIndex_ = indices(trees_);
    }

    Asset make(std::uint32_t map) const {
        AssetView rest = asset_;
        rest.nodes = {};
        rest.instances = {};
        rest.instanceTrees = {};
        Asset result = toAsset(rest);
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (nodes_[i]) {
                result.nodes.push_back(asset_.nodes[i]);
                for (Entry& child : result.nodes.back().children)
                    child = moved(child);
            }
        copyInstances(result);
        for (std::size_t i = 0; i < trees_.size(); ++i)
            if (trees_[i]) {
                InstanceTree tree = asset_.instanceTrees[i];
                tree.root = moved(tree.root);
                tree.next = tree.next == 0 ? 0 : treeIndex_[tree.next - 1] + 1;
                result.instanceTrees.push_back(tree);
            }
        for (Map& kept : result.maps) {
            kept.root = moved(kept.root);
            kept.instances = kept.instances == 0 ? 0 : treeIndex_[kept.instances - 1] + 1;
        }
        result.maps[map].instances = 0;
        return result;
    }

private:
    /// With the symbols and palettes that they use: those of the others would pile up.
    void copyInstances(Asset& result) const {
        const std::vector<std::uint32_t> largest = largestPaints(asset_);
        std::map<std::uint16_t, std::uint16_t> symbols;
        result.symbols.clear();
        result.palettes.clear();
        for (std::size_t i = 0; i < instances_.size(); ++i) {
            if (!instances_[i])
                continue;
            const Instance& instance = asset_.instances[i];
            const auto [symbol, isNew] =
                symbols.try_emplace(instance.symbol(), std::uint16_t(result.symbols.size()));
            if (isNew) {
                result.symbols.push_back(asset_.symbols[instance.symbol()]);
                const auto palette = asset_.palettes.subspan(result.symbols.back().palette,
                                                             largest[result.symbols.back().map]);
                result.symbols.back().palette = std::uint32_t(result.palettes.size());
                result.palettes.insert(result.palettes.end(), palette.begin(), palette.end());
            }
            result.instances.push_back(Instance::make(symbol->second, instance.centre(), instance.linear()));
        }
    }

    void drop(Entry entry) {
        if (entry.kind() == Entry::Kind::Instances) {
            const InstanceRange range(entry);
            for (std::uint32_t i = range.first; i < range.first + range.count; ++i)
                instances_[i] = false;
        } else if (entry.kind() == Entry::Kind::Node) {
            nodes_[entry.payload()] = false;
            for (const Entry child : asset_.nodes[entry.payload()].children)
                drop(child);
        }
    }

    static std::vector<std::uint32_t> indices(const std::vector<bool>& kept) {
        std::vector<std::uint32_t> result;
        std::uint32_t next = 0;
        for (const bool isKept : kept) {
            result.push_back(next);
            next += isKept;
        }
        return result;
    }

    Entry moved(Entry entry) const {
        if (entry.kind() == Entry::Kind::Node)
            return Entry::make(entry.kind(), nodeIndex_[entry.payload()]);
        if (entry.kind() != Entry::Kind::Instances)
            return entry;
        const InstanceRange range(entry);
        return InstanceRange::entry(instanceIndex_[range.first], range.count);
    }

    const AssetView& asset_;
    std::vector<bool> nodes_, instances_, trees_;
    std::vector<std::uint32_t> nodeIndex_, instanceIndex_, treeIndex_;
};

double stretchOf(const Affine2& place) {
    return std::max(glm::length(place.linear[0]), glm::length(place.linear[1]));
}

/// By how much placements make maps larger than they were, or, where they were not placed, than their own
/// size: so much larger are the errors of their boundaries. At least 1.
double enlargement(const AssetView& asset, std::span<const Placement> placements) {
    std::map<std::uint32_t, double> known;
    for (const Placement& before : placementsOf(asset)) {
        double& largest = known[before.map];
        largest = std::max(largest, stretchOf(affineOf(before.toPicture)));
    }
    double largest = 1;
    for (const Placement& p : placements) {
        const auto before = known.try_emplace(p.map, asset.maps[p.map].side).first->second;
        largest = std::max(largest, stretchOf(affineOf(p.toPicture)) / before);
    }
    return largest;
}

}  // namespace

// ---- The functions -----------------------------------------------------------------------------------

std::vector<Placement> placementsOf(const AssetView& asset) {
    const Map& map = asset.maps[drawnMap(asset)];
    const std::vector<std::uint32_t> largest = largestPaints(asset);
    std::vector<std::pair<std::size_t, Placement>> found;
    forEachInstance(asset, map, [&](const Instance& instance) {
        const Symbol& symbol = asset.symbols[instance.symbol()];
        Placement placement;
        placement.map = symbol.map;
        placement.paints.push_back(symbol.ground);
        const auto own = asset.palettes.subspan(symbol.palette, largest[symbol.map]);
        placement.paints.insert(placement.paints.end(), own.begin(), own.end());
        const Affine2 place = compose(placeOf(map), placementOf(symbol, instance));
        placement.toPicture = glm::dmat3x2(place.linear[0], place.linear[1], place.offset);
        found.emplace_back(&instance - asset.instances.data(), std::move(placement));
    });
    std::ranges::sort(found, {}, [](const auto& entry) { return entry.first; });
    std::vector<Placement> placements;
    for (auto& [index, placement] : found)
        placements.push_back(std::move(placement));
    return placements;
}

Asset withPlacements(const AssetView& asset, std::span<const Placement> placements) {
    const std::uint32_t drawn = drawnMap(asset);
    const Affine2 toSquare = inverse(placeOf(asset.maps[drawn]));
    const std::vector<std::uint32_t> largest = largestPaints(asset);
    const dvec2 size(asset.width, asset.height);
    std::vector<PlacementInSquare> placed;
    for (std::size_t i = 0; i < placements.size(); ++i) {
        const Placement& p = placements[i];
        const auto require = [&](bool holds, const char* what) {
            if (!holds)
                throw std::invalid_argument(fmt::format("placements[{}]: {}", i, what));
        };
        require(p.map > drawn && p.map < asset.maps.size(), "refers to a map that cannot be placed");
        require(p.paints.size() == largest[p.map] + 1, "has not one paint for each number of its map");
        for (const std::uint16_t paint : p.paints)
            require(paint < asset.paints.size(), "refers to a missing paint");
        const Affine2 place = affineOf(p.toPicture);
        const double area = glm::determinant(place.linear);
        require(std::isfinite(area) && std::isfinite(place.offset.x + place.offset.y),
                "its matrix is not finite");
        require(area != 0, "its matrix is singular");
        const dvec2 centre = place(dvec2(0.5)),
                    reach = 0.5 * (glm::abs(place.linear[0]) + glm::abs(place.linear[1]));
        if (glm::any(glm::greaterThanEqual(centre - reach, size)) ||
            glm::any(glm::lessThanEqual(centre + reach, dvec2(0))))
            continue;
        const Affine2 inSquare = compose(toSquare, place);
        const dvec2 middle = inSquare(dvec2(0.5));
        require(
            glm::all(glm::greaterThanEqual(middle, dvec2(0))) && glm::all(glm::lessThan(middle, dvec2(1))),
            "its middle lies outside the picture's square");
        placed.push_back({std::uint16_t(p.map), p.paints, inSquare});
    }
    Asset result = Stripped(asset, drawn).make(drawn);
    if (result.finestPixel)
        *result.finestPixel *= enlargement(asset, placements);
    try {
        const std::uint32_t trees = appendInstances(placed, result);
        result.maps[drawn].instances = trees;
        validate(result);
    } catch (const TooManyInstances& error) {
        throw std::invalid_argument(error.what());
    } catch (const FormatError& error) {  // rounded to a line, or too much to draw
        throw std::invalid_argument(fmt::format("placements: {}", error.what()));
    }
    return result;
}

Placement addPicture(Asset& asset, const AssetView& picture) {
    const Map& map = picture.maps[drawnMap(picture)];
    const auto require = [](bool holds, const char* what) {
        if (!holds)
            throw std::invalid_argument(fmt::format("the picture cannot be placed: {}", what));
    };
    require(map.instances == 0, "it holds instances");
    require(std::ranges::none_of(picture.paints, isProgram), "it has paints that are not solid");
    require(asset.paints.size() + picture.paints.size() <= 0x10000, "there are too many paints");
    Placement placement;
    try {
        placement.map = appendMap(extractMap(picture, picture.commands[0].map), asset);
    } catch (const TooManyInstances& error) {
        throw std::invalid_argument(error.what());
    }
    placement.paints.assign(largestPaints(picture)[picture.commands[0].map] + 1, 0);
    for (std::size_t i = 1; i < placement.paints.size(); ++i) {
        placement.paints[i] = std::uint16_t(asset.paints.size());
        asset.paints.push_back(picture.paints[i]);
    }
    placement.toPicture = glm::dmat3x2(dvec2(map.side, 0), dvec2(0, map.side), dvec2(map.x, map.y));
    if (picture.finestPixel && asset.finestPixel)
        asset.finestPixel = std::max(*asset.finestPixel, *picture.finestPixel);
    asset.fallbackLeaves += picture.fallbackLeaves;
    return placement;
}

}  // namespace vtm::asset
