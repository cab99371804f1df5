#include "compiler/instances/tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/limits/limits.hpp>
#include "asset/place.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {
namespace {

using glm::dvec2;
using glm::i64vec2;

/// A grid of tiles with those that are not free: touched by an outline or beyond the picture. Outlines that
/// run along a border of tiles touch none, but the tiles on its two sides differ.
class TileGrid {
public:
    TileGrid(const TilePattern& pattern, const Lattice& lattice, dvec2 size)
        : pattern_(pattern), size_(pattern.last - pattern.first + i64vec2(1)) {
        toTiles_ = *scene::inverse(pattern.toPicture);
        for (std::vector<bool>* flags : {&isCut_, &isBeyond_, &isBordered_[0], &isBordered_[1]})
            flags->resize(std::size_t(size_.x) * std::size_t(size_.y));
        // Outlines that run along a tile's border have been rounded to the lattice.
        const double step = 2 / lattice.stepsPerUnit();
        const dvec2 reach = (glm::abs(scene::applyVector(toTiles_, {step, 0})) +
                             glm::abs(scene::applyVector(toTiles_, {0, step}))) /
                            pattern.period();
        constexpr double minSlack = 1e-6;
        slack_ = glm::max(reach, dvec2(minSlack));
        cutBeyond(size, step);
    }

    i64vec2 size() const { return size_; }
    bool isFree(i64vec2 at) const { return !isCut_[index(at)]; }
    /// False of some tiles that lie beyond the picture.
    bool isSeen(i64vec2 at) const { return !isBeyond_[index(at)]; }
    /// Whether an outline runs along the tile's first side across an axis.
    bool isBordered(i64vec2 at, std::size_t axis) const { return isBordered_[axis][index(at)]; }

    /// In the picture.
    void cut(dvec2 a, dvec2 b) {
        a = toGrid(a);
        b = toGrid(b);
        border(a, b, 0);
        border(a, b, 1);
        if (a.x > b.x)
            std::swap(a, b);
        const double from = std::max(std::floor(a.x - slack_.x), 0.0),
                     to = std::min(std::floor(b.x + slack_.x), double(size_.x - 1));
        for (double x = from; x <= to; ++x) {
            // What lies in the column, but for its borders.
            const double left = std::max(a.x, x + slack_.x), right = std::min(b.x, x + 1 - slack_.x);
            if (left > right)
                continue;
            const double slope = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0;
            const double y0 = b.x > a.x ? a.y + (left - a.x) * slope : a.y,
                         y1 = b.x > a.x ? a.y + (right - a.x) * slope : b.y;
            const double low = std::floor(std::min(y0, y1) + slack_.y),
                         high = std::floor(std::max(y0, y1) - slack_.y);
            for (double y = std::max(low, 0.0); y <= std::min(high, double(size_.y - 1)); ++y)
                isCut_[index({std::int64_t(x), std::int64_t(y)})] = true;
        }
    }

private:
    void border(dvec2 a, dvec2 b, int axis) {
        const int other = 1 - axis;
        if (a[axis] > b[axis])
            std::swap(a, b);
        const double slope = b[axis] > a[axis] ? (b[other] - a[other]) / (b[axis] - a[axis]) : 0;
        const double from = std::max(std::ceil(a[axis] - slack_[axis]), 0.0),
                     to = std::min(std::floor(b[axis] + slack_[axis]), double(size_[axis] - 1));
        for (double line = from; line <= to; ++line) {
            // What lies near the line.
            const double near = std::max(a[axis], line - slack_[axis]),
                         far = std::min(b[axis], line + slack_[axis]);
            const double p0 = a[other] + (near - a[axis]) * slope,
                         p1 = slope == 0 ? b[other] : a[other] + (far - a[axis]) * slope;
            const double low = std::floor(std::min(p0, p1) - slack_[other]),
                         high = std::floor(std::max(p0, p1) + slack_[other]);
            for (double at = std::max(low, 0.0); at <= std::min(high, double(size_[other] - 1)); ++at) {
                i64vec2 tile;
                tile[axis] = std::int64_t(line);
                tile[other] = std::int64_t(at);
                isBordered_[std::size_t(axis)][index(tile)] = true;
            }
        }
    }

    std::size_t index(i64vec2 at) const {
        return std::size_t(at.y) * std::size_t(size_.x) + std::size_t(at.x);
    }
    dvec2 toGrid(dvec2 p) const {
        return (scene::apply(toTiles_, p) - pattern_.min) / pattern_.period() - dvec2(pattern_.first);
    }

    void cutBeyond(dvec2 size, double step) {
        const geometry::Box picture{dvec2(-step), size + step}, inside{dvec2(step), size - step};
        for (std::int64_t y = 0; y < size_.y; ++y) {
            limits::check();
            for (std::int64_t x = 0; x < size_.x; ++x) {
                const dvec2 corner = pattern_.min + dvec2(pattern_.first + i64vec2(x, y)) * pattern_.period();
                const geometry::Box box =
                    geometry::mapped(geometry::Box{corner, corner + pattern_.period()}, pattern_.toPicture);
                if (!picture.contains(box))
                    isCut_[index({x, y})] = true;
                if (inside.intersection(box).empty())
                    isBeyond_[index({x, y})] = true;
            }
        }
    }

    const TilePattern& pattern_;
    const i64vec2 size_;
    scene::Affine toTiles_;
    dvec2 slack_;
    std::vector<bool> isCut_, isBeyond_;
    std::array<std::vector<bool>, 2> isBordered_;
};

/// Blocks of free tiles, as large as they are free: level by level, from the tiles up.
class Blocks {
public:
    Blocks(const TileGrid& grid, unsigned maxLevel) {
        levels_.push_back({grid.size(), {}, {}});
        for (std::int64_t y = 0; y < grid.size().y; ++y)
            for (std::int64_t x = 0; x < grid.size().x; ++x) {
                levels_[0].isFree.push_back(grid.isFree({x, y}));
                for (const std::size_t axis : {0, 1})
                    levels_[0].isBordered[axis].push_back(grid.isBordered({x, y}, axis));
            }
        while (levels_.size() <= maxLevel &&
               std::ranges::find(levels_.back().isFree, true) != levels_.back().isFree.end())
            levels_.push_back(above(levels_.back()));
    }

    /// Calls visit(block) for those that no free block holds.
    template <class Visit>
    void forEach(Visit&& visit) const {
        for (unsigned level = 0; level < levels_.size(); ++level)
            for (std::int64_t y = 0; y < levels_[level].size.y; ++y)
                for (std::int64_t x = 0; x < levels_[level].size.x; ++x) {
                    const i64vec2 at(x, y);
                    if (levels_[level].at(at) &&
                        (level + 1 == levels_.size() || !levels_[level + 1].at(at / blockTiles)))
                        visit(TileBlock{level, at});
                }
    }

private:
    struct Level {
        i64vec2 size;
        std::vector<bool> isFree;
        std::array<std::vector<bool>, 2> isBordered;

        bool holds(i64vec2 p) const { return p.x < size.x && p.y < size.y; }
        std::size_t index(i64vec2 p) const {
            return std::size_t(p.y) * std::size_t(size.x) + std::size_t(p.x);
        }
        /// False beyond it.
        bool at(i64vec2 p) const { return holds(p) && isFree[index(p)]; }
    };
    static Level above(const Level& level) {
        Level next{(level.size + blockTiles - std::int64_t(1)) / blockTiles, {}, {}};
        for (std::int64_t y = 0; y < next.size.y; ++y)
            for (std::int64_t x = 0; x < next.size.x; ++x) {
                bool isFree = true;
                std::array<bool, 2> isBordered{};
                for (std::int64_t i = 0; isFree && i < blockTiles * blockTiles; ++i) {
                    const i64vec2 inside(i % blockTiles, i / blockTiles),
                        at = i64vec2(x, y) * blockTiles + inside;
                    isFree = level.at(at);
                    for (const int axis : {0, 1})
                        if (isFree && level.isBordered[std::size_t(axis)][level.index(at)]) {
                            isBordered[std::size_t(axis)] = true;
                            isFree = inside[axis] == 0;  // no outline runs through the block
                        }
                }
                next.isFree.push_back(isFree);
                for (const std::size_t axis : {0, 1})
                    next.isBordered[axis].push_back(isBordered[axis]);
            }
        return next;
    }
    std::vector<Level> levels_;
};

class Choosing {
public:
    Choosing(const LoweredScene& picture, const Lattice& lattice, dvec2 size,
             std::span<const TilePattern> patterns, double tolerance)
        : tolerance_(tolerance),
          picture_(picture),
          lattice_(lattice),
          size_(size),
          patterns_(patterns),
          layersAt_(picture, lattice.square()) {}

    TileChoice choose(std::size_t number) {
        const TilePattern& pattern = patterns_[number];
        TileGrid grid(pattern, lattice_, size_);
        for (const Layer& layer : picture_.layers)
            for (std::uint32_t r = layer.firstRun; r < layer.firstRun + layer.runCount; ++r) {
                limits::check();
                const Run& run = picture_.outlines.runs[r];
                for (std::uint32_t p = run.first; p < run.last; ++p)
                    grid.cut(lattice_.toUnits(picture_.outlines.points[p]),
                             lattice_.toUnits(picture_.outlines.points[p + 1]));
            }
        TileChoice choice;
        std::vector<i64vec2> cut;
        Blocks(grid, maxLevelOf(pattern)).forEach([&](TileBlock block) {
            const std::int64_t side = sideOf(block);
            switch (placeOf(number, block.at * side, side)) {
                case Place::Outside:
                    break;
                case Place::Inside:
                    block.at = block.at * side + pattern.first;
                    choice.blocks.push_back(block);
                    break;
                case Place::Shared:
                    for (std::int64_t i = 0; i < side * side && cut.size() <= maxTiles; ++i)
                        cut.push_back(block.at * side + i64vec2(i % side, i / side) + pattern.first);
            }
        });
        for (std::int64_t y = 0; y < grid.size().y; ++y)
            for (std::int64_t x = 0; x < grid.size().x; ++x)
                if (!grid.isFree({x, y}) && grid.isSeen({x, y}))
                    cut.push_back(i64vec2(x, y) + pattern.first);
        const double tiles = double(cut.size() + 1) * (1 + pattern.tilesInTile);
        if (tiles > double(maxTiles) || cutInAll_ + tiles > double(maxCutTiles))
            return {.cut = {}, .blocks = {}, .isImage = true};
        cutInAll_ += tiles;
        if (!choice.blocks.empty())
            choice.cut.push_back(choice.blocks.front().at);
        std::ranges::sort(cut, {}, [](i64vec2 p) { return std::pair(p.y, p.x); });
        choice.cut.insert(choice.cut.end(), cut.begin(), cut.end());
        return choice;
    }

private:
    /// Where a block lies to the shape that is filled; Shared: in another pattern of many tiles too.
    enum class Place { Outside, Inside, Shared };

    static std::int64_t sideOf(TileBlock block) {
        std::int64_t side = 1;
        for (unsigned i = 0; i < block.level; ++i)
            side *= blockTiles;
        return side;
    }

    /// Blocks that can be placed within an eighth of the tolerance. The picture's map and the tile's take two
    /// of asset::maxMapDepth.
    unsigned maxLevelOf(const TilePattern& pattern) const {
        const double longer = std::max(size_.x, size_.y);
        double side = std::max(pattern.period().x, pattern.period().y) / longer;
        unsigned level = 0;
        const glm::dmat2 linear(pattern.toPicture[0], pattern.toPicture[1]);
        while (level < asset::maxMapDepth - 2 &&
               asset::placementError(linear * (side * double(blockTiles))) <= tolerance_ / 8) {
            side *= double(blockTiles);
            ++level;
        }
        return level;
    }

    Place placeOf(std::size_t number, i64vec2 at, std::int64_t side) const {
        const TilePattern& pattern = patterns_[number];
        const dvec2 centre =
            pattern.min + (dvec2(at + pattern.first) + 0.5 * double(side)) * pattern.period();
        const dvec2 steps = scene::apply(lattice_.toSteps(), scene::apply(pattern.toPicture, centre));
        const std::vector<std::uint32_t> layers =
            layersAt_({Coord(std::lround(steps.x)), Coord(std::lround(steps.y))});
        const auto holds = [&](const TilePattern& p) { return std::ranges::binary_search(layers, p.shape); };
        if (!holds(pattern))
            return Place::Outside;
        for (const TilePattern& other : patterns_)
            if (&other != &pattern && holds(other))
                return Place::Shared;
        return Place::Inside;
    }

    const double tolerance_;
    double cutInAll_ = 0;
    const LoweredScene& picture_;
    const Lattice& lattice_;
    const dvec2 size_;
    const std::span<const TilePattern> patterns_;
    const LayersAt layersAt_;
};

}  // namespace

std::vector<TileChoice> chooseTiles(const LoweredScene& picture, const Lattice& lattice, dvec2 size,
                                    std::span<const TilePattern> patterns, double tolerance) {
    Choosing choosing(picture, lattice, size, patterns, tolerance);
    std::vector<TileChoice> choices;
    for (std::size_t i = 0; i < patterns.size(); ++i)
        choices.push_back(choosing.choose(i));
    return choices;
}

}  // namespace vtm::compiler
