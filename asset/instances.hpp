/// \file
/// Maps that are placed in other maps, as they lie in the picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/limits/limits.hpp>

namespace vtm::asset {

/// An affine map: linear · p + offset.
struct Affine2 {
    glm::dmat2 linear{1};
    glm::dvec2 offset{0};

    glm::dvec2 operator()(glm::dvec2 p) const { return linear * p + offset; }
};
/// inner, then outer.
inline Affine2 compose(const Affine2& outer, const Affine2& inner) {
    return {outer.linear * inner.linear, outer(inner.offset)};
}

/// From the square [0, 1]² of a symbol's map to that of the map in which it is placed.
inline Affine2 placementOf(const Symbol& symbol, const Instance& instance) {
    const auto [x, y] = instance.centre();
    const auto [m00, m01, m10, m11] = instance.linear();
    const double step = double(symbol.scale) / double(slopeScale);
    const glm::dmat2 linear(m00 * step, m01 * step, m10 * step, m11 * step);
    return {linear, glm::dvec2(x, y) / centreSteps - linear * glm::dvec2(0.5)};
}

/// From the square [0, 1]² of a map that is drawn to the picture.
inline Affine2 placeOf(const Map& map) { return {glm::dmat2(map.side), {map.x, map.y}}; }

/// The asset's paint for each of the numbers that a map names. Of a map that is drawn by a command: all
/// numbers are themselves.
class PlacedPaints {
public:
    PlacedPaints() = default;
    /// Of a symbol's map, which is placed in one with the paints `around`.
    PlacedPaints(const AssetView& asset, const Symbol& symbol, const PlacedPaints& around, std::size_t count)
        : paints_(count + 1) {
        paints_[0] = around(symbol.ground);
        for (std::size_t i = 0; i < count; ++i)
            paints_[i + 1] = around(asset.palettes[symbol.palette + i]);
    }
    std::uint32_t operator()(std::uint32_t paint) const { return paints_.empty() ? paint : paints_[paint]; }
    /// What lies around a placed map; 0 for others.
    std::uint32_t ground() const { return paints_.empty() ? 0 : paints_[0]; }

private:
    std::vector<std::uint32_t> paints_;
};

/// The largest number of a paint that each map names, instances in it included.
std::vector<std::uint32_t> largestPaints(const AssetView& asset);

/// How many maps each map holds in each other, itself included.
std::vector<unsigned> mapDepths(const AssetView& asset);

/// Calls visit(const Instance&) for each instance that lies right in the map.
template <class Visit>
void forEachInstance(const AssetView& asset, const Map& map, Visit&& visit) {
    std::vector<Entry> entries;
    for (std::uint32_t tree = map.instances; tree != 0; tree = asset.instanceTrees[tree - 1].next) {
        entries.assign(1, asset.instanceTrees[tree - 1].root);
        while (!entries.empty()) {
            const Entry entry = entries.back();
            entries.pop_back();
            limits::check();
            if (entry.kind() == Entry::Kind::Node) {
                const auto& children = asset.nodes[entry.payload()].children;
                entries.insert(entries.end(), children.rbegin(), children.rend());
            } else if (entry.kind() == Entry::Kind::Instances) {
                const InstanceRange range(entry);
                for (const Instance& instance : asset.instances.subspan(range.first, range.count))
                    visit(instance);
            }
        }
    }
}

/// A map where it is drawn.
struct PlacedMap {
    const Map& map;
    Affine2 toPicture;  ///< from the map's [0, 1]²
    const PlacedPaints& paints;
};

/// Visits a map and all that are placed in it and in each other.
class MapWalk {
public:
    explicit MapWalk(const AssetView& asset)
        : asset_(asset),
          largest_(asset.symbols.empty() ? std::vector<std::uint32_t>{} : largestPaints(asset)) {}

    /// Calls visit(const PlacedMap&), which tells whether to go on to the maps inside: the map first.
    template <class Visit>
    void operator()(const Map& map, Visit&& visit) const {
        walk({map, placeOf(map), PlacedPaints{}}, visit);
    }
    /// Only instances first to end - 1 of those that lie right in the map, and what is in them.
    template <class Visit>
    void some(const Map& map, std::size_t first, std::size_t end, Visit&& visit) const {
        walkInside({map, placeOf(map), PlacedPaints{}}, first, end, visit);
    }

private:
    template <class Visit>
    void walk(const PlacedMap& placed, Visit&& visit) const {
        if (visit(placed) && placed.map.instances != 0)
            walkInside(placed, 0, std::numeric_limits<std::size_t>::max(), visit);
    }
    template <class Visit>
    void walkInside(const PlacedMap& placed, std::size_t first, std::size_t end, Visit& visit) const {
        // Instances of one symbol often follow each other.
        std::uint32_t known = 0xFFFFFFFFu;
        PlacedPaints paints;
        std::size_t number = 0;
        forEachInstance(asset_, placed.map, [&](const Instance& instance) {
            if (const std::size_t at = number++; at < first || at >= end)
                return;
            const Symbol& symbol = asset_.symbols[instance.symbol()];
            if (known != instance.symbol())
                paints = {asset_, symbol, placed.paints, largest_[symbol.map]};
            known = instance.symbol();
            walk({asset_.maps[symbol.map], compose(placed.toPicture, placementOf(symbol, instance)), paints},
                 visit);
        });
    }

    const AssetView asset_;
    std::vector<std::uint32_t> largest_;
};

/// The same where one map is visited once.
template <class Visit>
void forEachMap(const AssetView& asset, const Map& map, Visit&& visit) {
    const MapWalk walkMaps(asset);
    walkMaps(map, visit);
}

}  // namespace vtm::asset
