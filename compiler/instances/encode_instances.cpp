#include "compiler/instances/encode_instances.hpp"

#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include "asset/place.hpp"
#include "compiler/instances/place_symbols.hpp"

namespace vtm::compiler {
namespace {

using asset::Asset;
using asset::PlacementInSquare;
using glm::dvec2;

std::uint32_t appendGrid(const GridMap& grid, std::uint16_t inner, Asset& asset) {
    std::vector<std::uint16_t> numbers(grid.paints + 1);
    std::iota(numbers.begin(), numbers.end(), std::uint16_t(0));
    const glm::dmat2 linear(1.0 / double(blockTiles));
    std::vector<PlacementInSquare> tiles;
    for (std::int64_t i = 0; i < blockTiles * blockTiles; ++i)
        tiles.push_back(
            {inner,
             numbers,
             {linear, grid.first + dvec2(double(i % blockTiles), double(i / blockTiles)) * grid.step}});
    return asset::appendInstances(tiles, asset);
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
        if (const auto* grid = std::get_if<GridMap>(&placed.maps[i])) {
            const std::uint32_t trees = appendGrid(*grid, std::uint16_t(first + grid->map), asset);
            asset.maps[first + i].instances = trees;
        }
    std::vector<PlacementInSquare> placements;
    for (const PlacedSymbol& p : placed.placed) {
        std::vector<std::uint16_t> own;
        for (const PaintId paint : p.paints)
            own.push_back(paints[paint]);
        placements.push_back({std::uint16_t(first + p.map),
                              std::move(own),
                              {p.toPicture.linear / side, p.toPicture.offset / side}});
    }
    const std::uint32_t trees = asset::appendInstances(placements, asset);
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
