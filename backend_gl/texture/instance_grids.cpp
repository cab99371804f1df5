#include "backend_gl/texture/instance_grids.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "asset/instances.hpp"
#include "asset/walk.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Entry;
using asset::Texel;
using glm::dvec2;
using glm::ivec2;
using glm::vec2;

struct ContentBox {
    dvec2 min{HUGE_VAL}, max{-HUGE_VAL};

    bool isEmpty() const { return min.x > max.x; }
    void add(dvec2 p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(const ContentBox& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
};

ContentBox imageOf(const asset::Affine2& place, const ContentBox& box) {
    if (box.isEmpty())
        return box;
    const dvec2 middle = place(0.5 * (box.min + box.max)), half = 0.5 * (box.max - box.min);
    const dvec2 reach = glm::abs(place.linear[0]) * half.x + glm::abs(place.linear[1]) * half.y;
    return {middle - reach, middle + reach};
}

/// What maps show, in sides of their squares.
class Contents {
public:
    explicit Contents(const AssetView& asset) : asset_(asset), known_(asset.maps.size()) {}

    ContentBox ofMap(std::size_t map) {
        if (!known_[map]) {
            ContentBox box;
            asset::walk(asset_, asset_.maps[map].root, [&](asset::Cell cell, Entry entry) {
                const double side = std::ldexp(1.0, -2 * int(cell.level));
                const dvec2 corner = dvec2(cell.x, cell.y) * side;
                if (entry.kind() == Entry::Kind::Leaf)
                    box.add(imageOf({glm::dmat2(side), corner}, ofLeaf(asset_.leaves[entry.payload()])));
                else if (entry.payload() != 0)
                    box.add(ContentBox{corner, corner + side});
            });
            asset::forEachInstance(asset_, asset_.maps[map],
                                   [&](const asset::Instance& instance) { box.add(ofInstance(instance)); });
            known_[map] = box;
        }
        return *known_[map];
    }

    ContentBox ofInstance(const asset::Instance& instance) {
        const asset::Symbol& symbol = asset_.symbols[instance.symbol()];
        return imageOf(asset::placementOf(symbol, instance), ofMap(symbol.map));
    }

private:
    /// All of it if a corner is not the ground; else what the pieces bound. A curve is off its chord by 4/27
    /// of its slopes' sum at most, in chords.
    ContentBox ofLeaf(const asset::Leaf& leaf) const {
        ContentBox box;
        if (std::ranges::any_of(leaf.corners, [](std::uint16_t paint) { return paint != 0; }))
            return {dvec2(0), dvec2(1)};
        for (const asset::Piece& piece : asset_.pieces.subspan(leaf.firstPiece, leaf.pieceCount)) {
            const dvec2 a = dvec2(piece.a[0], piece.a[1]) / double(asset::leafExtent),
                        b = dvec2(piece.b[0], piece.b[1]) / double(asset::leafExtent);
            const double slopes =
                (std::abs(double(piece.slopeA)) + std::abs(double(piece.slopeB))) / double(asset::slopeScale);
            const double bulge = 4.0 / 27 * slopes * glm::length(b - a);
            box.add(ContentBox{glm::min(a, b) - bulge, glm::max(a, b) + bulge});
        }
        box.min = glm::max(box.min, dvec2(0));
        box.max = glm::min(box.max, dvec2(1));
        return box;
    }

    const AssetView& asset_;
    std::vector<std::optional<ContentBox>> known_;
};

/// An instance and its box, in 65536ths of the map's side, rounded outward: [min, max + 1].
struct BoxedInstance {
    std::uint32_t instance;
    ivec2 min, max;
};
constexpr double boxSteps = 65536;

dvec2 boxSize(const BoxedInstance& placed) { return dvec2(placed.max - placed.min + 1) / boxSteps; }

Texel entryOf(const BoxedInstance& placed) {
    const auto pair = [](int low, int high) { return std::uint32_t(low) | std::uint32_t(high) << 16; };
    return {placed.instance, pair(placed.min.x, placed.max.x), pair(placed.min.y, placed.max.y), 0};
}

/// A grid over boxes, with cells twice as large as these on average.
class Grid {
public:
    explicit Grid(const std::vector<BoxedInstance>& all) {
        ivec2 min(1 << 16), max(0);
        dvec2 size(0);
        for (const BoxedInstance& placed : all) {
            min = glm::min(min, placed.min);
            max = glm::max(max, placed.max + 1);
            size += boxSize(placed) / double(all.size());
        }
        const dvec2 extent = dvec2(max - min) / boxSteps;
        dvec2 cell = cellSize * size;
        // Of instances that lie far apart, more cells would only take memory.
        cell *= std::max(1.0, std::sqrt(extent.x * extent.y / (double(all.size()) * cell.x * cell.y)));
        count_ = ivec2(glm::clamp(glm::ceil(extent / cell), dvec2(1), dvec2(maxSide)));
        corner_ = vec2(min) / float(boxSteps);
        perUnit_ = vec2(count_) / vec2(extent);
        cells_.resize(std::size_t(count_.x) * std::size_t(count_.y));
    }

    /// Entries that the boxes would take.
    double entriesOf(const std::vector<BoxedInstance>& all) const {
        double entries = 0;
        for (const BoxedInstance& placed : all) {
            const ivec2 cells = cellOf(vec2(placed.max + 1), margin) - cellOf(vec2(placed.min), -margin) + 1;
            entries += double(cells.x) * double(cells.y);
        }
        return entries;
    }

    /// False where a cell has no room.
    bool add(const BoxedInstance& placed) {
        const ivec2 first = cellOf(vec2(placed.min), -margin), last = cellOf(vec2(placed.max + 1), margin);
        for (int pass = 0; pass < 2; ++pass)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    std::vector<Texel>& cell =
                        cells_[std::size_t(y) * std::size_t(count_.x) + std::size_t(x)];
                    if (pass == 1)
                        cell.push_back(entryOf(placed));
                    else if (cell.size() == maxInCell)
                        return false;
                }
        return true;
    }

    std::vector<Texel> texels(GLuint first, bool isLast) const {
        std::vector<Texel> all(2), entries;
        std::vector<std::uint32_t> words;
        for (const std::vector<Texel>& cell : cells_) {
            words.push_back(std::uint32_t(entries.size()) | std::uint32_t(cell.size()) << 24);
            entries.insert(entries.end(), cell.begin(), cell.end());
        }
        const GLuint cells = first + appendTexels<std::uint32_t>(all, words);
        const GLuint firstEntry = first + appendTexels<Texel>(all, entries);
        const GLuint next = isLast ? 0 : first + GLuint(all.size());
        all[0] = {std::uint32_t(count_.x) | std::uint32_t(count_.y) << 16, cells, firstEntry, next};
        all[1] = std::bit_cast<Texel>(std::array{corner_.x, corner_.y, perUnit_.x, perUnit_.y});
        return all;
    }

private:
    static constexpr double cellSize = 2;  ///< smaller ones take more entries, and a footprint no less time
    static constexpr int maxSide = 4096;
    static constexpr std::size_t maxInCell = 255;
    /// In cells: boxes are listed beyond their border by what a shader may round the other way.
    static constexpr float margin = 0x1p-8f;

    ivec2 cellOf(vec2 step, float beyond) const {
        const vec2 place = (step / float(boxSteps) - corner_) * perUnit_ + beyond;
        return glm::clamp(ivec2(glm::floor(place)), ivec2(0), count_ - 1);
    }

    ivec2 count_;
    vec2 corner_, perUnit_;
    std::vector<std::vector<Texel>> cells_;
};

class GridMaker {
public:
    GridMaker(const AssetView& asset, GLuint first) : asset_(asset), first_(first), contents_(asset) {}

    InstanceGrids make() {
        for (std::size_t map = 0; map < asset_.maps.size(); ++map)
            grids_.ofMap.push_back(asset_.maps[map].instances == 0 ? 0 : addMap(asset_.maps[map]));
        return std::move(grids_);
    }

private:
    /// Sizes share a grid as far as that takes no more than so many entries an instance.
    static constexpr double mostEntries = 8;

    GLuint addMap(const asset::Map& map) {
        std::map<int, std::vector<BoxedInstance>> bySize;
        asset::forEachInstance(asset_, map, [&](const asset::Instance& instance) {
            const ContentBox box = contents_.ofInstance(instance);
            if (box.isEmpty())
                return;
            const dvec2 largest(boxSteps - 1);
            const BoxedInstance placed{
                std::uint32_t(&instance - asset_.instances.data()),
                ivec2(glm::clamp(glm::floor(box.min * boxSteps), dvec2(0), largest)),
                ivec2(glm::clamp(glm::ceil(box.max * boxSteps) - 1.0, dvec2(0), largest))};
            const dvec2 size = boxSize(placed);
            bySize[std::ilogb(std::max(size.x, size.y))].push_back(placed);
        });
        const GLuint firstGrid = first_ + GLuint(grids_.texels.size());
        std::vector<BoxedInstance> group;
        for (const auto& [size, more] : bySize) {
            std::vector<BoxedInstance> joined = group;
            joined.insert(joined.end(), more.begin(), more.end());
            if (Grid(joined).entriesOf(joined) > mostEntries * double(joined.size()))
                addGrids(std::exchange(group, more), false);
            else
                group = std::move(joined);
        }
        addGrids(std::move(group), true);
        return bySize.empty() ? 0 : firstGrid;
    }

    void addGrids(std::vector<BoxedInstance> group, bool isLast) {
        while (!group.empty())
            addGrid(group, isLast);
    }

    /// Leaves what has no room.
    void addGrid(std::vector<BoxedInstance>& group, bool isLast) {
        Grid grid(group);
        std::erase_if(group, [&](const BoxedInstance& placed) { return grid.add(placed); });
        const std::vector<Texel> texels =
            grid.texels(first_ + GLuint(grids_.texels.size()), isLast && group.empty());
        grids_.texels.insert(grids_.texels.end(), texels.begin(), texels.end());
    }

    const AssetView& asset_;
    const GLuint first_;
    Contents contents_;
    InstanceGrids grids_;
};

}  // namespace

InstanceGrids instanceGrids(const AssetView& asset, GLuint first) { return GridMaker(asset, first).make(); }

}  // namespace vtm::gl
