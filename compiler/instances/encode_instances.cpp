#include "compiler/instances/encode_instances.hpp"

#include <string>
#include <variant>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include "asset/place.hpp"
#include "compiler/instances/placed_symbols.hpp"

namespace vtm::compiler {
namespace {

using asset::Asset;
using asset::PlacementInSquare;
using glm::dvec2;

/// `side`: of the square around, in the units that the placements lead to. `first`: the asset's index of the
/// first map. `paints`: the asset's number of each paint.
template <class PaintOf>
std::uint32_t appendPlaced(std::span<const PlacedSymbol> placed, double side, std::uint16_t first,
                           PaintOf&& paintOf, Asset& asset) {
    std::vector<PlacementInSquare> placements;
    for (const PlacedSymbol& p : placed) {
        std::vector<std::uint16_t> paints;
        for (const PaintId paint : p.paints)
            paints.push_back(paintOf(paint));
        placements.push_back({std::uint16_t(first + p.map),
                              std::move(paints),
                              {p.toOuter.linear / side, p.toOuter.offset / side}});
    }
    return asset::appendInstances(placements, asset);
}

Asset emptyMap() {
    Asset asset;
    asset.maps = {{0, 0, 1, asset::Entry::make(asset::Entry::Kind::Solid, 0), 0}};
    return asset;
}

/// Squares and pieces of a map, those of the maps in it included (asset::maxDrawn).
std::vector<double> drawnOf(const PlacedSymbols& placed) {
    std::vector<double> drawn(placed.maps.size());
    for (std::size_t i = drawn.size(); i-- > 0;) {
        if (const auto* symbol = std::get_if<SymbolMap>(&placed.maps[i])) {
            const Asset& map = symbol->asset;
            drawn[i] = double(1 + 16 * map.nodes.size() + map.pieces.size());
        } else {
            drawn[i] = 1;
            for (const PlacedSymbol& p : std::get<GroupMap>(placed.maps[i]).placed)
                drawn[i] += drawn[p.map] + double(p.paints.size());
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

/// The maps first, so that those that are placed in others have larger indices.
void append(const PlacedSymbols& placed, std::span<const std::uint16_t> paints, Asset& asset) {
    const double side = asset.maps.front().side;
    const auto first = std::uint16_t(asset.maps.size());
    for (const auto& map : placed.maps)
        if (const auto* symbol = std::get_if<SymbolMap>(&map))
            asset::appendMap(symbol->asset, asset);
        else
            asset::appendMap(emptyMap(), asset);
    for (std::size_t i = 0; i < placed.maps.size(); ++i)
        if (const auto* group = std::get_if<GroupMap>(&placed.maps[i])) {
            const std::uint32_t trees = appendPlaced(
                group->placed, 1, first, [](PaintId paint) { return std::uint16_t(paint); }, asset);
            asset.maps[first + i].instances = trees;
        }
    const std::uint32_t trees = appendPlaced(
        placed.placed, side, first, [&](PaintId paint) { return paints[paint]; }, asset);
    asset.maps.front().instances = trees;
}

}  // namespace

void encodeInstances(const PlacedSymbols& placed, std::span<const std::uint16_t> paints, Asset& asset) {
    if (placed.placed.empty())
        return;
    checkDrawn(placed, asset);
    try {
        append(placed, paints, asset);
    } catch (const asset::TooManyInstances& error) {
        throw LimitError(error.what());
    }
}

}  // namespace vtm::compiler
