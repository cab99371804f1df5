/// \file
/// What a scanner draws: maps with their boundaries, those that are placed in them, and paints.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/asset/difference.hpp>
#include <vtm/raster/scan.hpp>
#include "asset/instances.hpp"
#include "raster/blend.hpp"
#include "raster/chord_scanner.hpp"
#include "raster/src/float4.hpp"
#include "raster/src/paint.hpp"
#include "raster/src/scanned_map.hpp"

namespace vtm::asset {

/// The maps of an asset that are placed in others.
class PlacedMaps {
public:
    /// Must outlive it.
    explicit PlacedMaps(const AssetView& asset)
        : PlacedMaps(asset, std::vector<std::optional<ScannedMap>>()) {}
    /// Of the asset that follows that of `last`, whose boundaries it takes over.
    PlacedMaps(const AssetView& asset, PlacedMaps&& last, std::span<const MapChange> changes)
        : PlacedMaps(asset, takenOver(std::move(last.maps_), changes)) {}

    /// Of those that lie right in a map.
    struct Count {
        std::size_t maps = 0;
        std::size_t boundaries = 0;
    };
    Count countIn(std::uint32_t outer) const {
        Count count;
        forEachInstance(asset_, asset_.maps[outer], [&](const Instance& instance) {
            ++count.maps;
            count.boundaries += maps_[asset_.symbols[instance.symbol()].map]->boundaryCount();
        });
        return count;
    }
    /// Calls visit(the map's number, map, its place, its paints), which tells whether to go on to those in
    /// it, for maps first to end - 1 of those that lie right in one.
    template <class Visit>
    void forEach(std::uint32_t outer, std::size_t first, std::size_t end, Visit&& visit) const {
        walk_.some(asset_.maps[outer], first, end, [&](const PlacedMap& placed) {
            const auto number = std::size_t(&placed.map - asset_.maps.data());
            return bool(visit(number, *maps_[number], placed.toPicture, placed.paints));
        });
    }

private:
    /// `maps`: those that are made already.
    PlacedMaps(const AssetView& asset, std::vector<std::optional<ScannedMap>> maps)
        : asset_(asset), walk_(asset), maps_(std::move(maps)) {
        maps_.resize(asset.maps.size());
        for (const Symbol& symbol : asset.symbols)
            if (!maps_[symbol.map])
                maps_[symbol.map].emplace(asset, asset.maps[symbol.map]);
    }
    static std::vector<std::optional<ScannedMap>> takenOver(std::vector<std::optional<ScannedMap>> last,
                                                            std::span<const MapChange> changes) {
        std::vector<std::optional<ScannedMap>> maps(changes.size());
        for (std::size_t i = 0; i < maps.size(); ++i)
            if (changes[i].before < last.size() && changes[i].squares.empty())
                maps[i] = std::exchange(last[changes[i].before], std::nullopt);
        return maps;
    }

    const AssetView asset_;
    const MapWalk walk_;
    std::vector<std::optional<ScannedMap>> maps_;
};

/// What is drawn.
struct Scanned {
    struct Drawn {
        ScannedMap own;
        std::uint32_t map = noMap;   ///< in which others are placed
        PlacedMaps::Count placed{};  ///< right in it

        std::size_t placedParts() const { return (placed.maps + placedOfPart - 1) / placedOfPart; }
    };
    static constexpr std::uint32_t noMap = 0xFFFFFFFFu;
    /// So many placed maps are a part of the picture.
    static constexpr std::size_t placedOfPart = 64;

    Scanned(const Paints& of, std::size_t paintCount, Sums sumsOf) : paints(of), sums(sumsOf) {
        setPaints(of, paintCount);
    }
    void setPaints(const Paints& of, std::size_t count) {
        paints = of;
        isProgram.clear();
        solid.clear();
        for (const Paint& paint : of.asset().paints.first(count)) {
            isProgram.push_back(asset::isProgram(paint));
            solid.push_back(asset::isProgram(paint) ? Float4{}
                                                    : float4(added(std::bit_cast<glm::vec4>(paint))));
        }
    }

    /// Other maps are placed in the last one that is drawn.
    void place(std::shared_ptr<const PlacedMaps> maps, std::uint32_t map) {
        drawn.back().map = map;
        drawn.back().placed = maps->countIn(map);
        placed = std::move(maps);
    }

    Paints paints;
    std::vector<Drawn> drawn;
    std::shared_ptr<const PlacedMaps> placed;  ///< null if nothing is
    Sums sums = Sums::Encoded;
    std::vector<Float4> solid;            ///< by paint, as it is added; nothing for programs
    std::vector<std::uint8_t> isProgram;  ///< by paint

    /// Of chords that somebody else makes.
    explicit Scanned(const ChordPaints& of) : paints(of.asset, of.images) {
        isProgram.resize(of.asset.paints.size(), 1);
        solid.resize(of.asset.paints.size());
        isProgram.resize(isProgram.size() + of.colors.size());
        for (const glm::vec4& color : of.colors)
            solid.push_back(float4(color));
    }

    const AssetView& asset() const { return paints.asset(); }
    /// The boxes of boundaries, and for each map, after its own, what is placed in it.
    std::size_t partCount() const {
        std::size_t count = 0;
        for (const Drawn& map : drawn)
            count += map.own.boxCount() + map.placedParts();
        return count;
    }
    /// What the parts before each cost, and all: their boundaries, of placed maps in the mean, and
    /// themselves.
    std::vector<std::size_t> costsBefore() const {
        std::vector<std::size_t> costs{0};
        const auto add = [&](std::size_t boundaries) { costs.push_back(costs.back() + 1 + boundaries); };
        for (const Drawn& map : drawn) {
            for (std::size_t i = 0; i < map.own.boxCount(); ++i)
                add(map.own.box(i).size());
            for (std::size_t i = 0; i < map.placedParts(); ++i)
                add(map.placed.boundaries / map.placedParts());
        }
        return costs;
    }
    std::size_t boundaryCount() const {
        std::size_t count = 0;
        for (const Drawn& map : drawn)
            count += map.own.boundaryCount() + map.placed.boundaries;
        return count;
    }
    bool hasPrograms() const { return std::ranges::find(isProgram, 1) != isProgram.end(); }
    glm::vec4 added(glm::vec4 color) const { return sums == Sums::Light ? light(color) : color; }
};

}  // namespace vtm::asset
