#include "backend_gl/tiles/blocks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include <glm/common.hpp>

#include "backend_gl/tiles/block_shape.hpp"
#include "backend_gl/tiles/tile_windows.hpp"

namespace vtm::gl {

namespace {

using glm::dvec2;
using glm::ivec2;
using Placed = Atlas::Placed;

/// One more, where it stands.
BlockVertex& added(std::vector<BlockVertex>& vertices, ivec2 corner, int side) {
    BlockVertex& vertex = vertices.emplace_back();
    vertex.middle[0] = float(corner.x + side / 2);
    vertex.middle[1] = float(corner.y + side / 2);
    return vertex;
}

void put(BlockVertex& vertex, std::size_t i, const Placed& tile) {
    vertex.texels[i] = tile.firstTexel;
    vertex.cells[i] = tile.firstCell | tile.grid.log2 << gridShift;
}

/// The blocks with crowded cells, whose pixels stand in a texture of blocks (ScannedPixels).
void putScanned(Blocks& blocks, BlockVertex& vertex, ivec2 corner, const TileRaster& raster) {
    const ivec2 offset = scannedPlace(blocks.crowded.size(), raster.box(), raster.grid()) - corner;
    vertex.more = {std::uint32_t(offset.x), std::uint32_t(offset.y), 0, 0};
    blocks.crowded.push_back(corner);
}

/// Bits, one for each CellKind.
class Kinds {
public:
    Kinds() = default;
    explicit Kinds(std::uint8_t bits) : bits_(bits) {}

    bool any() const { return bits_ != 0; }
    bool has(CellKind kind) const { return (bits_ >> unsigned(kind) & 1) != 0; }
    bool havePrograms() const { return has(CellKind::Plain) || has(CellKind::Run); }
    void add(CellKind kind) { bits_ = std::uint8_t(bits_ | 1u << unsigned(kind)); }
    void add(Kinds other) { bits_ = std::uint8_t(bits_ | other.bits_); }

private:
    std::uint8_t bits_ = 0;
};

Kinds kindsOf(const Placed& tile) { return Kinds(tile.kinds); }

struct Block {
    ivec2 corner;
    ivec2 window{};
    BlockShape::Place place{};             ///< if there are kinds near
    ivec2 middle{};                        ///< in which cell of the window it lies
    std::array<const Placed*, 4> tiles{};  ///< null: not met, or beyond the region
    const Placed* some = nullptr;          ///< of those
    Kinds near{}, kinds{};                 ///< of the tiles' cells, of its own
};

/// Of a block's cells in one tile.
struct MetCell {
    const Placed* tile = nullptr;  ///< null: there is none
    unsigned column = 0, row = 0;
};

/// Rectangles of one colour: blocks beside each other that are alike become one.
class FlatRuns {
public:
    /// `words`: as cells have them.
    struct Paint {
        std::uint32_t number;
        PaintWords words;
        bool operator==(const Paint&) const = default;
    };

    FlatRuns(std::vector<FlatVertex>& vertices, std::span<const asset::Paint> paints, int side)
        : vertices_(vertices), paints_(paints), side_(side) {}

    void add(ivec2 corner, const Paint& paint) {
        if (width_ != 0 && (corner.x != first_.x + width_ || paint != paint_))
            end();
        if (width_ == 0)
            first_ = corner;
        width_ += side_;
        paint_ = paint;
    }
    void end() {
        const ivec2 size(std::exchange(width_, 0), side_);
        if (size.x == 0)
            return;
        FlatVertex vertex = ofColor();
        for (const ivec2 c : {ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(0, 1), ivec2(1, 0), ivec2(1, 1)}) {
            const ivec2 at = first_ + c * size;
            vertex.position[0] = float(at.x);
            vertex.position[1] = float(at.y);
            vertices_.push_back(vertex);
        }
    }

private:
    FlatVertex ofColor() const {
        const asset::Paint& paint = paints_[paint_.number];
        FlatVertex vertex{};
        for (unsigned c = 0; c < 4; ++c)
            vertex.color[c] = asset::isProgram(paint)
                                  ? float(paint_.words[c / 2] >> c % 2 * 16 & 0xFFFF) / 65535
                                  : std::bit_cast<float>(paint[c]);
        return vertex;
    }

    std::vector<FlatVertex>& vertices_;
    std::span<const asset::Paint> paints_;
    int side_;
    ivec2 first_{0};
    int width_ = 0;
    Paint paint_{};
};

/// Blocks of a row that are drawn.
class DrawnBox {
public:
    DrawnBox(PixelBox& drawn, const TileRaster& raster) : drawn_(drawn), raster_(raster) {}

    void add(ivec2 corner) {
        row_ = row_.empty() ? PixelBox{corner, corner + raster_.grid().side}
                            : PixelBox{row_.min, corner + raster_.grid().side};
    }
    void endRow() { drawn_ = drawn_.joined(std::exchange(row_, {}).intersection(raster_.box())); }

private:
    PixelBox& drawn_;
    const TileRaster& raster_;
    PixelBox row_;
};

class Sorter {
public:
    Sorter(const TileRaster& raster, const Atlas& atlas, std::span<const asset::Paint> paints,
           const std::vector<const Placed*>& tiles)
        : raster_(raster),
          atlas_(atlas),
          side_(raster.grid().side),
          windows_(raster.region(), tiles),
          shape_(raster.pixelsToTiles(), side_),
          pixelsToTiles_(raster.pixelsToTiles()),
          halfInTiles_(shape_.half() / double(cellsPerTile)),
          firstLeast_(raster.toTile(dvec2(0.5 * side_)) - halfInTiles_ -
                      dvec2(raster.region().min - std::int64_t(1))),
          runs_(blocks_.flat, paints, side_),
          drawn_(blocks_.drawn, raster) {}

    Blocks sorted() {
        const PixelBox& box = raster_.box();
        const ivec2 first = raster_.grid().cornerAt(box.min);
        for (ivec2 corner = first; corner.y < box.max.y; corner.y += side_) {
            for (corner.x = first.x; corner.x < box.max.x; corner.x += side_)
                add(blockAt(corner));
            runs_.end();
            drawn_.endRow();
        }
        return std::move(blocks_);
    }

private:
    Block blockAt(ivec2 corner) {
        Block block{.corner = corner};
        const dvec2 least = firstLeast_ + pixelsToTiles_ * dvec2(corner);
        const ivec2 size = windows_.size();
        if (!(least.x >= 0 && least.y >= 0 && least.x < size.x && least.y < size.y))
            return block;
        block.window = ivec2(least);
        const dvec2 inWindow = least - dvec2(block.window), end = inWindow + 2.0 * halfInTiles_,
                    middle = (inWindow + halfInTiles_) * double(cellsPerTile);
        block.middle = ivec2(middle);
        block.tiles = windows_.tilesAt(block.window);
        if (end.x < 1)
            block.tiles[1] = block.tiles[3] = nullptr;
        if (end.y < 1)
            block.tiles[2] = block.tiles[3] = nullptr;
        for (const Placed* tile : block.tiles)
            if (tile != nullptr) {
                block.some = tile;
                block.near.add(kindsOf(*tile));
            }
        if (block.near.any())
            block.place = shape_.placeOf(middle);
        for (const CellKind kind : cellKinds)
            if (block.near.has(kind) && windows_.meets(block.window, kind, block.place))
                block.kinds.add(kind);
        return block;
    }

    void add(const Block& block) {
        if (block.some == nullptr)
            return;
        if (block.kinds.has(CellKind::Crowded) || block.kinds.has(CellKind::Mixed))
            return addMixed(block);
        const MetCell some = someCell(block);
        if (some.tile == nullptr)
            return;
        // No boundary, so one paint, of which each tile has words of its own.
        const asset::Texel& cell = cellOf(some);
        const std::uint32_t paint = cell[0] & 0xFFFF;
        if (paint == 0)
            return;
        if (block.kinds.havePrograms())
            return addOfOneProgram(block);
        drawn_.add(block.corner);
        runs_.add(block.corner, {paint, {cell[1], cell[2]}});
    }

    void addMixed(const Block& block) {
        const bool crowded = block.kinds.has(CellKind::Crowded), programs = block.kinds.havePrograms();
        const asset::Texel* const pair = crowded || programs ? nullptr : twoColors(block);
        BlockWork work = programs ? workOfPrograms(block, true) : BlockWork();
        work.crowded = crowded;
        work.hasTwoColors = pair != nullptr;
        work.isLong = !crowded && !programs && hasLongLists(block);
        BlockVertex& vertex = put(block, work);
        if (crowded)
            putScanned(blocks_, vertex, block.corner, raster_);
        else if (pair != nullptr)
            vertex.more = *pair;
    }

    void addOfOneProgram(const Block& block) {
        BlockWork work = workOfPrograms(block, false);
        asset::Texel words{};
        bool isPlain = work.kind == BlockWork::Kind::Plain;
        for (std::size_t i = 0; isPlain && i < 4; ++i)
            if (const MetCell met = cellIn(block, i); met.tile != nullptr) {
                // The paint may have one colour in one tile and change in the next.
                isPlain = cellOf(met)[2] == plainTag;
                words[i] = cellOf(met)[1];
            }
        if (isPlain)
            work.kind = BlockWork::Kind::OnePlain;
        BlockVertex& vertex = put(block, work);
        if (isPlain)
            vertex.more = words;
    }

    /// In the i-th of its tiles.
    static MetCell cellIn(const Block& block, std::size_t i) {
        const Placed* const tile = block.tiles[i];
        if (tile == nullptr || !block.near.has(CellKind::Mixed))
            return {tile};  // all cells are of one paint
        const int firstRow = int(i / 2) * cellsPerTile - block.place.firstRow;
        for (int row = std::max(firstRow, 0); row < std::min(firstRow + cellsPerTile, BlockShape::maxRows);
             ++row)
            if (const auto columns =
                    std::uint16_t(block.place.columnsOf(std::size_t(row)) >> i % 2 * cellsPerTile);
                columns != 0)
                return {tile, unsigned(std::countr_zero(columns)), unsigned(row - firstRow)};
        return {};
    }

    static MetCell someCell(const Block& block) {
        const ivec2 tile = block.middle / cellsPerTile, cell = block.middle % cellsPerTile;
        if (const Placed* const met = block.tiles[std::size_t(2 * tile.y + tile.x)])
            return {met, unsigned(cell.x), unsigned(cell.y)};
        MetCell found;
        for (std::size_t i = 0; found.tile == nullptr && i < 4; ++i)
            found = cellIn(block, i);
        return found;
    }

    const asset::Texel& cellOf(const MetCell& met) const {
        return atlas_.cellAt(*met.tile, met.column, met.row);
    }

    static bool hasLongLists(const Block& block) {
        return std::ranges::any_of(block.tiles,
                                   [](const Placed* tile) { return tile != nullptr && tile->hasLongLists; });
    }

    /// `cut`: by pieces, so that it matters whether paints are steep.
    BlockWork workOfPrograms(const Block& block, bool cut) const {
        if (block.kinds.has(CellKind::Run))
            return {.kind = BlockWork::Kind::Programs};
        BlockWork work{.kind = BlockWork::Kind::Plain};
        for (const Placed* tile : block.tiles) {
            if (tile == nullptr || !kindsOf(*tile).has(CellKind::Plain))
                continue;
            if (cut && tile->steepness > raster_.minSteepness())
                return {.kind = BlockWork::Kind::Programs};
            work.points = std::max(
                work.points, std::uint8_t(std::uint8_t(tile->paints) - std::uint8_t(TilePaints::Plain)));
        }
        return work;
    }

    /// If all of its tiles with pieces have the same, else null.
    static const asset::Texel* twoColors(const Block& block) {
        const asset::Texel* pair = nullptr;
        for (const Placed* tile : block.tiles) {
            if (tile == nullptr || !kindsOf(*tile).has(CellKind::Mixed))
                continue;
            if (!tile->twoColors || (pair != nullptr && *pair != *tile->twoColors))
                return nullptr;
            pair = &*tile->twoColors;
        }
        return pair;
    }

    BlockVertex& put(const Block& block, const BlockWork& work) {
        drawn_.add(block.corner);
        BlockVertex& vertex = added(group(work), block.corner, side_);
        const dvec2 least = dvec2(raster_.region().min + glm::i64vec2(block.window - 1)),
                    pixel = raster_.toPixel(least), picture = raster_.toPicture(least);
        vertex.corner[0] = float(pixel.x);
        vertex.corner[1] = float(pixel.y);
        vertex.corner[2] = float(picture.x);
        vertex.corner[3] = float(picture.y);
        for (std::size_t i = 0; i < 4; ++i)
            gl::put(vertex, i, block.tiles[i] != nullptr ? *block.tiles[i] : *block.some);
        return vertex;
    }

    std::vector<BlockVertex>& group(const BlockWork& work) {
        const auto found = std::ranges::find(blocks_.groups, work, &BlockGroup::work);
        return (found != blocks_.groups.end() ? *found : blocks_.groups.emplace_back(BlockGroup{work, {}}))
            .vertices;
    }

    const TileRaster& raster_;
    const Atlas& atlas_;
    int side_;
    TileWindows windows_;
    BlockShape shape_;
    glm::dmat2 pixelsToTiles_;
    dvec2 halfInTiles_, firstLeast_;  ///< of a block; of one with its corner at 0, from the first window on
    Blocks blocks_;
    FlatRuns runs_;
    DrawnBox drawn_;
};

}  // namespace

bool BlockWork::serves(const BlockWork& other) const {
    if (other.crowded && !crowded)
        return false;
    switch (kind) {
        case Kind::Programs:
            return true;
        case Kind::Plain:
            return other.kind != Kind::Programs && other.points <= points;
        case Kind::OnePlain:
            return other.kind == Kind::OnePlain && other.points <= points;
        default:
            return other.kind == Kind::Solid && (other.hasTwoColors || !hasTwoColors);
    }
}

namespace {

/// The simplest of those that serve what the group needs; the end if there are none.
auto findServing(std::vector<BlockGroup>& groups, const BlockGroup& group) {
    const auto cost = [](const BlockWork& work) {
        return std::tuple(work.kind, work.crowded, work.points, !work.hasTwoColors);
    };
    auto found = groups.end();
    for (auto other = groups.begin(); other != groups.end(); ++other)
        if (&*other != &group && other->work.serves(group.work) &&
            (found == groups.end() || cost(other->work) < cost(found->work)))
            found = other;
    return found;
}

}  // namespace

Blocks merged(Blocks blocks, std::size_t fewest) {
    std::vector<BlockGroup>& groups = blocks.groups;
    std::ranges::stable_sort(groups, {}, [](const BlockGroup& group) { return group.vertices.size(); });
    for (auto group = groups.begin(); group != groups.end() && group->vertices.size() < fewest;)
        if (const auto serving = findServing(groups, *group); serving != groups.end()) {
            serving->vertices.insert(serving->vertices.end(), group->vertices.begin(), group->vertices.end());
            group = groups.erase(group);
        } else {
            ++group;
        }
    return blocks;
}

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
    const BlockGrid& grid = raster.grid();
    BlockGroup group{{.crowded = true}, {}};
    const ivec2 least = grid.cornerAt(blocks.drawn.min);
    for (ivec2 corner = least; corner.y < blocks.drawn.max.y; corner.y += grid.side)
        for (corner.x = least.x; corner.x < blocks.drawn.max.x; corner.x += grid.side) {
            BlockVertex& vertex = added(group.vertices, corner, grid.side);
            for (std::size_t i = 0; i < 4; ++i)
                put(vertex, i, tile);
            putScanned(blocks, vertex, corner, raster);
        }
    blocks.groups.push_back(std::move(group));
    return blocks;
}

}  // namespace vtm::gl
