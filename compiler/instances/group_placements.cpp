#include "compiler/instances/group_placements.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <glm/matrix.hpp>

#include "asset/place.hpp"
#include "compiler/instances/affine2.hpp"
#include "compiler/instances/repeats.hpp"

namespace vtm::compiler {
namespace {

using asset::Affine2;
using glm::dvec2;

/// Of the slack: for shapes that are not quite images of each other, and for rounding places in a group. The
/// rest is for rounding the group's own place.
constexpr double imageShare = 1.0 / 4, innerShare = 1.0 / 4;

class Grouper {
public:
    Grouper(PlacedSymbols placed, double slack, dvec2 size)
        : placed_(std::move(placed)), slack_(slack), longer_(std::max(size.x, size.y)) {}

    PlacedSymbols run() {
        while (groupOnce())
            placed_.error += (imageShare + innerShare) * slack_;
        return std::move(placed_);
    }

private:
    /// A run of placements as a map, and where it stands.
    struct Group {
        GroupMap map;
        std::vector<PlacedSymbol> places;
    };

    /// Returns whether there are fewer placements now.
    bool groupOnce() {
        std::vector<Shape> shapes;
        for (const PlacedSymbol& p : placed_.placed)
            shapes.push_back({p.map + 1u, affine(p.toOuter), 1});
        std::vector<Group> groups;
        std::vector<bool> isGrouped(shapes.size());
        std::map<std::uint32_t, PlacedSymbol> groupAt;  // by the first placement's number
        const std::vector<unsigned> depths = depthsOf(placed_);
        for (const Repeat& repeat : findRuns(std::move(shapes), imageShare * slack_)) {
            if (depthOf(repeat, depths) + 2 > asset::maxMapDepth)
                continue;
            std::optional<Group> group = groupOf(repeat);
            if (!group)
                continue;
            for (std::size_t i = 0; i < repeat.occurrences.size(); ++i) {
                const std::uint32_t first = repeat.occurrences[i].first;
                group->places[i].map = std::uint32_t(groups.size());
                groupAt.emplace(first, std::move(group->places[i]));
                std::fill_n(isGrouped.begin() + first, repeat.count, true);
            }
            groups.push_back(std::move(*group));
        }
        if (!groups.empty())
            rebuild(std::move(groups), groupAt, isGrouped);
        return !groupAt.empty();
    }

    /// Puts groups before the maps that they place.
    void rebuild(std::vector<Group> groups, std::map<std::uint32_t, PlacedSymbol>& groupAt,
                 const std::vector<bool>& isGrouped) {
        const auto moved = std::uint32_t(groups.size());
        std::vector<std::variant<SymbolMap, GroupMap>> maps;
        for (Group& group : groups)
            maps.push_back(std::move(group.map));
        maps.insert(maps.end(), std::make_move_iterator(placed_.maps.begin()),
                    std::make_move_iterator(placed_.maps.end()));
        placed_.maps = std::move(maps);
        for (auto& map : placed_.maps)
            if (auto* group = std::get_if<GroupMap>(&map))
                for (PlacedSymbol& p : group->placed)
                    p.map += moved;
        std::vector<PlacedSymbol> placed;
        for (std::uint32_t i = 0; i < placed_.placed.size(); ++i)
            if (const auto group = groupAt.find(i); group != groupAt.end())
                placed.push_back(std::move(group->second));
            else if (!isGrouped[i]) {
                placed.push_back(std::move(placed_.placed[i]));
                placed.back().map += moved;
            }
        placed_.placed = std::move(placed);
    }

    /// How many maps each map holds in each other, itself included.
    static std::vector<unsigned> depthsOf(const PlacedSymbols& placed) {
        std::vector<unsigned> depths(placed.maps.size(), 1);
        for (std::size_t i = depths.size(); i-- > 0;)
            if (const auto* group = std::get_if<GroupMap>(&placed.maps[i]))
                for (const PlacedSymbol& p : group->placed)
                    depths[i] = std::max(depths[i], depths[p.map] + 1);
        return depths;
    }
    unsigned depthOf(const Repeat& repeat, const std::vector<unsigned>& depths) const {
        unsigned depth = 0;
        for (std::uint32_t i = 0; i < repeat.count; ++i)
            depth = std::max(depth, depths[first(repeat, i).map]);
        return depth;
    }

    /// Placement i of the first occurrence.
    const PlacedSymbol& first(const Repeat& repeat, std::uint32_t i) const {
        return placed_.placed[repeat.occurrences[0].first + i];
    }

    /// Nothing if it does not pay, or cannot be stored as exactly as it must be.
    std::optional<Group> groupOf(const Repeat& repeat) const {
        geometry::Box box;
        for (std::uint32_t i = 0; i < repeat.count; ++i)
            box.add(mapped(first(repeat, i).toOuter, unitSquare));
        const dvec2 size = box.max - box.min;
        const double side = std::max(size.x, size.y);
        const Affine2 square{glm::dmat2(side), 0.5 * (box.min + box.max) - 0.5 * side};
        std::vector<Affine2> places;
        for (const Repeat::Occurrence& occurrence : repeat.occurrences)
            places.push_back(compose(affine2(occurrence.fromFirst), square));
        if (areCrowded(places) || !isStorable(places))
            return std::nullopt;
        Group group;
        double stretch = 0;
        for (const Affine2& place : places)
            stretch = std::max(stretch, largestStretch(place));
        const Affine2 toSquare = inverse(square);
        for (std::uint32_t i = 0; i < repeat.count; ++i) {
            const PlacedSymbol& symbol = first(repeat, i);
            group.map.placed.push_back({symbol.map, compose(toSquare, symbol.toOuter), {}});
            if (asset::placementError(group.map.placed.back().toOuter.linear) * stretch > innerShare * slack_)
                return std::nullopt;
        }
        for (const Affine2& place : places)
            group.places.push_back({0, place, {}});
        addPaints(repeat, group);
        return pays(group) ? std::optional(std::move(group)) : std::nullopt;
    }

    /// Whether their squares have several times the area that they lie in: a pixel would look into many.
    static bool areCrowded(std::span<const Affine2> places) {
        constexpr double maxCrowd = 3;
        double area = 0;
        geometry::Box all;
        for (const Affine2& place : places) {
            area += std::abs(glm::determinant(place.linear));
            all.add(mapped(place, unitSquare));
        }
        return area > maxCrowd * (all.max.x - all.min.x) * (all.max.y - all.min.y);
    }

    bool isStorable(std::span<const Affine2> places) const {
        return std::ranges::all_of(places, [&](const Affine2& place) {
            const dvec2 middle = place(dvec2(0.5));
            return asset::placementError(place.linear / longer_) * longer_ <= slack_ &&
                   std::min(middle.x, middle.y) >= 0 && std::max(middle.x, middle.y) <= longer_;
        });
    }

    /// Regions that have the same paint at every place have one number in the group.
    void addPaints(const Repeat& repeat, Group& group) const {
        std::map<std::vector<PaintId>, PaintId> numbers;
        for (std::uint32_t i = 0; i < repeat.count; ++i)
            for (std::size_t region = 0; region < first(repeat, i).paints.size(); ++region) {
                std::vector<PaintId> paints;
                for (const Repeat::Occurrence& occurrence : repeat.occurrences)
                    paints.push_back(placed_.placed[occurrence.first + i].paints[region]);
                const auto [number, isNew] = numbers.try_emplace(paints, PaintId(numbers.size()));
                group.map.placed[i].paints.push_back(number->second);
                for (std::size_t place = 0; isNew && place < paints.size(); ++place)
                    group.places[place].paints.push_back(paints[place]);
            }
        group.map.paints = std::uint32_t(numbers.size() - 1);
    }

    /// Each level of maps takes time to draw: half of the bytes must be saved.
    static bool pays(const Group& group) {
        constexpr double minSaving = 0.5, perInstance = 24,
                         perSymbol = 16;  // with shares of trees, and records
        const auto count = double(group.places.size()), length = double(group.map.placed.size());
        std::set<std::vector<PaintId>> palettes;
        for (const PlacedSymbol& place : group.places)
            palettes.insert(place.paints);
        std::set<std::pair<std::uint32_t, std::vector<PaintId>>> symbols;
        for (const PlacedSymbol& p : group.map.placed)
            symbols.emplace(p.map, p.paints);
        const double numbers = group.map.paints + 1;
        const double after = perInstance * (count + length) + perSymbol * double(symbols.size()) +
                             sizeof(asset::Map) + double(palettes.size()) * (perSymbol + 2 * numbers);
        constexpr double maxNumbers = 0xFFFF;
        return numbers <= maxNumbers && after <= (1 - minSaving) * perInstance * count * length;
    }

    PlacedSymbols placed_;
    const double slack_, longer_;
};

}  // namespace

PlacedSymbols groupPlacements(PlacedSymbols placed, double slack, dvec2 size) {
    return Grouper(std::move(placed), slack, size).run();
}

}  // namespace vtm::compiler
