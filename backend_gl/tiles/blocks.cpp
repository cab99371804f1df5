#include "backend_gl/tiles/blocks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/common.hpp>

#include "backend_gl/tiles/block_shape.hpp"

namespace vtm::gl {

namespace {

using glm::dvec2;
using glm::i64vec2;
using glm::ivec2;
using Placed = Atlas::Placed;

ivec2 firstCorner(const PixelBox& box) { return box.min / blockSide * blockSide; }

PixelBox pixelsOf(ivec2 corner, const PixelBox& box) {
    return {glm::max(corner, box.min), glm::min(corner + blockSide, box.max)};
}

/// Calls visit(corner) for each block that a box meets, row by row, and endRow() after each row.
template <class Visit, class EndRow>
void forEachBlock(const PixelBox& box, Visit&& visit, EndRow&& endRow) {
    const ivec2 first = firstCorner(box);
    for (int y = first.y; y < box.max.y; y += blockSide) {
        for (int x = first.x; x < box.max.x; x += blockSide)
            visit(ivec2(x, y));
        endRow();
    }
}

BlockVertex vertexAt(ivec2 corner) {
    BlockVertex vertex{};
    vertex.middle[0] = float(corner.x + blockSide / 2);
    vertex.middle[1] = float(corner.y + blockSide / 2);
    return vertex;
}

void put(BlockVertex& vertex, std::size_t i, const Placed& tile) {
    vertex.texels[i] = tile.firstTexel;
    vertex.cells[i] = tile.firstCell | tile.grid.log2 << gridShift;
}

/// The blocks with crowded cells, whose pixels stand in a texture of blocks (ScannedPixels).
void putScanned(Blocks& blocks, BlockVertex& vertex, ivec2 corner, const PixelBox& box) {
    const ivec2 offset = scannedPlace(blocks.crowded.size(), box) - corner;
    vertex.more = {std::uint32_t(offset.x), std::uint32_t(offset.y), 0, 0};
    blocks.crowded.push_back(corner);
}

/// What a block meets of a tile.
struct MetTile {
    const Placed* tile = nullptr;  ///< null: nothing
    bool mixed = false, plain = false, run = false, crowded = false;
    unsigned column = 0, row = 0;  ///< one of the cells
};

struct Block {
    ivec2 corner;
    i64vec2 least;                 ///< of four tiles the first
    std::array<MetTile, 4> tiles;  ///< the others have x, y or both larger by 1

    bool any(bool MetTile::*what) const {
        return std::ranges::any_of(tiles, [&](const MetTile& met) { return met.*what; });
    }
};

/// Colours for rectangles, block by block: those beside each other that are alike become one.
class FlatRuns {
public:
    using Color = std::array<float, 4>;

    explicit FlatRuns(std::vector<FlatVertex>& vertices) : vertices_(vertices) {}

    void add(ivec2 corner, const Color& color) {
        if (width_ != 0 && (corner.x != first_.x + width_ || color != color_))
            end();
        if (width_ == 0)
            first_ = corner;
        width_ += blockSide;
        color_ = color;
    }
    void end() {
        const ivec2 size(std::exchange(width_, 0), blockSide);
        if (size.x == 0)
            return;
        for (const ivec2 c : {ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(0, 1), ivec2(1, 0), ivec2(1, 1)}) {
            const ivec2 at = first_ + c * size;
            vertices_.push_back({{float(at.x), float(at.y)}, {color_[0], color_[1], color_[2], color_[3]}});
        }
    }

private:
    std::vector<FlatVertex>& vertices_;
    ivec2 first_{0};
    int width_ = 0;
    Color color_{};
};

class Sorter {
public:
    Sorter(const TileRaster& raster, const Atlas& atlas, std::span<const asset::Paint> paints,
           const std::vector<const Placed*>& tiles)
        : raster_(raster),
          atlas_(atlas),
          paints_(paints),
          tiles_(tiles),
          shape_(raster.pixelsToTiles()),
          runs_(blocks_.flat) {}

    Blocks sorted() {
        forEachBlock(
            raster_.box(), [&](ivec2 corner) { add(blockAt(corner)); }, [&] { runs_.end(); });
        return std::move(blocks_);
    }

private:
    const Placed* tileAt(i64vec2 at) const {
        const auto& [level, min, max] = raster_.region();
        const bool inside = at.x >= min.x && at.y >= min.y && at.x < max.x && at.y < max.y;
        return inside ? tiles_[std::size_t((at.y - min.y) * (max.x - min.x) + at.x - min.x)] : nullptr;
    }

    Block blockAt(ivec2 corner) const {
        const dvec2 middle = raster_.toTile(dvec2(corner) + 0.5 * blockSide);
        Block block{corner, i64vec2(glm::floor(middle - shape_.half() / double(cellsPerTile))), {}};
        std::array<const Placed*, 4> near;
        for (std::size_t i = 0; i < 4; ++i)
            near[i] = tileAt(block.least + i64vec2(i % 2, i / 2));
        shape_.forEachRow((middle - dvec2(block.least)) * double(cellsPerTile),
                          [&](int row, std::uint32_t columns) {
                              for (std::size_t side = 0; side < 2; ++side) {
                                  const std::size_t i = std::size_t(row / cellsPerTile) * 2 + side;
                                  const auto half = std::uint16_t(columns >> side * cellsPerTile);
                                  if (half != 0 && near[i] != nullptr)
                                      meet(block.tiles[i], *near[i], unsigned(row % cellsPerTile), half);
                              }
                          });
        return block;
    }

    static void meet(MetTile& met, const Placed& tile, unsigned row, std::uint16_t columns) {
        if (met.tile == nullptr)
            met = {&tile, false, false, false, false, unsigned(std::countr_zero(columns)), row};
        met.mixed = met.mixed || (tile.mixed[row] & columns) != 0;
        met.plain = met.plain || (tile.plain[row] & columns) != 0;
        met.run = met.run || (tile.run[row] & columns) != 0;
        met.crowded = met.crowded || (tile.crowded[row] & columns) != 0;
    }

    void add(const Block& block) {
        const MetTile* const some = someTile(block);
        if (some == nullptr)
            return;
        const bool crowded = block.any(&MetTile::crowded);
        if (crowded || block.any(&MetTile::mixed))
            return addMixed(block, *some, crowded);
        // No boundary, so one paint, of which each tile has words of its own.
        const asset::Texel& cell = cellOf(*some);
        const std::uint32_t paint = cell[0] & 0xFFFF;
        if (paint == 0)
            return;
        if (hasPrograms(block))
            return addOfOneProgram(block, *some);
        touch(block);
        runs_.add(block.corner, colorOf(paint, {cell[1], cell[2]}));
    }

    void addMixed(const Block& block, const MetTile& some, bool crowded) {
        touch(block);
        BlockVertex vertex = vertexOf(block, some);
        BlockWork work = hasPrograms(block) ? workOfPrograms(block, true)
                         : crowded          ? BlockWork()
                                            : workOfColors(block);
        work.crowded = crowded;
        if (crowded)
            putScanned(blocks_, vertex, block.corner, raster_.box());
        else if (work.hasTwoColors)
            vertex.more = *twoColors(block);
        group(work).push_back(vertex);
    }

    void addOfOneProgram(const Block& block, const MetTile& some) {
        touch(block);
        const BlockVertex vertex = vertexOf(block, some);
        BlockVertex onePaint = vertex;
        BlockWork work = workOfPrograms(block, false);
        bool isPlain = work.kind == BlockWork::Kind::Plain;
        for (std::size_t i = 0; i < 4; ++i) {
            // The paint may have one colour in one tile and change in the next.
            const asset::Texel& cell = cellOf(block.tiles[i].tile != nullptr ? block.tiles[i] : some);
            isPlain = isPlain && cell[2] == plainTag;
            onePaint.cells[i] = cell[1];
        }
        if (isPlain)
            work.kind = BlockWork::Kind::OnePlain;
        group(work).push_back(isPlain ? onePaint : vertex);
    }

    static const MetTile* someTile(const Block& block) {
        const auto found =
            std::ranges::find_if(block.tiles, [](const MetTile& met) { return met.tile != nullptr; });
        return found == block.tiles.end() ? nullptr : &*found;
    }

    const asset::Texel& cellOf(const MetTile& met) const {
        return atlas_.cellAt(*met.tile, met.column, met.row);
    }

    FlatRuns::Color colorOf(std::uint32_t paint, const PaintWords& words) const {
        FlatRuns::Color color;
        for (unsigned c = 0; c < 4; ++c)
            color[c] = asset::isProgram(paints_[paint]) ? float(words[c / 2] >> c % 2 * 16 & 0xFFFF) / 65535
                                                        : std::bit_cast<float>(paints_[paint][c]);
        return color;
    }

    void touch(const Block& block) {
        blocks_.drawn = blocks_.drawn.joined(pixelsOf(block.corner, raster_.box()));
    }

    static bool hasPrograms(const Block& block) {
        return block.any(&MetTile::plain) || block.any(&MetTile::run);
    }

    BlockWork workOfColors(const Block& block) const {
        BlockWork work;
        work.hasTwoColors = twoColors(block).has_value();
        work.isLong = std::ranges::any_of(
            block.tiles, [](const MetTile& met) { return met.mixed && met.tile->hasLongLists; });
        return work;
    }

    /// `cut`: by pieces, so that it matters whether paints are steep.
    BlockWork workOfPrograms(const Block& block, bool cut) const {
        BlockWork work{.kind = BlockWork::Kind::Plain};
        for (const MetTile& met : block.tiles) {
            if (met.run || (met.plain && cut && met.tile->steepness > raster_.minSteepness()))
                return {.kind = BlockWork::Kind::Programs};
            if (!met.plain)
                continue;
            work.points = std::max(
                work.points, std::uint8_t(std::uint8_t(met.tile->paints) - std::uint8_t(TilePaints::Plain)));
        }
        return work;
    }

    std::optional<asset::Texel> twoColors(const Block& block) const {
        std::optional<asset::Texel> pair;
        for (const MetTile& met : block.tiles) {
            if (!met.mixed)
                continue;
            const std::optional<asset::Texel> here = atlas_.twoColors(*met.tile);
            if (!here || (pair && *pair != *here))
                return std::nullopt;
            pair = here;
        }
        return pair;
    }

    BlockVertex vertexOf(const Block& block, const MetTile& some) const {
        BlockVertex vertex = vertexAt(block.corner);
        const dvec2 pixel = raster_.toPixel(dvec2(block.least)),
                    picture = raster_.toPicture(dvec2(block.least));
        vertex.corner[0] = float(pixel.x);
        vertex.corner[1] = float(pixel.y);
        vertex.corner[2] = float(picture.x);
        vertex.corner[3] = float(picture.y);
        for (std::size_t i = 0; i < 4; ++i)
            put(vertex, i, block.tiles[i].tile != nullptr ? *block.tiles[i].tile : *some.tile);
        return vertex;
    }

    std::vector<BlockVertex>& group(const BlockWork& work) {
        const auto found = std::ranges::find(blocks_.groups, work, &BlockGroup::work);
        return (found != blocks_.groups.end() ? *found : blocks_.groups.emplace_back(BlockGroup{work, {}}))
            .vertices;
    }

    const TileRaster& raster_;
    const Atlas& atlas_;
    std::span<const asset::Paint> paints_;
    const std::vector<const Placed*>& tiles_;
    BlockShape shape_;
    Blocks blocks_;
    FlatRuns runs_;
};

}  // namespace

Blocks blocksOf(const TileRaster& raster, const Atlas& atlas, std::span<const asset::Paint> paints,
                const std::vector<const Placed*>& tiles) {
    return Sorter(raster, atlas, paints, tiles).sorted();
}

Blocks crowdedBlocks(const TileRaster& raster, Atlas& atlas) {
    dvec2 minimum(HUGE_VAL), maximum(-HUGE_VAL);
    for (const dvec2 corner : {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1), dvec2(1, 1)}) {
        minimum = glm::min(minimum, raster.toPixel(corner));
        maximum = glm::max(maximum, raster.toPixel(corner));
    }
    const dvec2 first(raster.box().min), end(raster.box().max);
    Blocks blocks;
    blocks.drawn = {ivec2(glm::clamp(glm::floor(minimum), first, end)),
                    ivec2(glm::clamp(glm::ceil(maximum), first, end))};
    if (blocks.drawn.empty())
        return blocks;
    const Placed& tile = atlas.prepareCrowded();
    std::vector<BlockVertex> vertices;
    forEachBlock(
        blocks.drawn,
        [&](ivec2 corner) {
            BlockVertex vertex = vertexAt(corner);
            for (std::size_t i = 0; i < 4; ++i)
                put(vertex, i, tile);
            putScanned(blocks, vertex, corner, raster.box());
            vertices.push_back(vertex);
        },
        [] {});
    blocks.groups.push_back({{.crowded = true}, std::move(vertices)});
    return blocks;
}

}  // namespace vtm::gl
