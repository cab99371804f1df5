#include "backend_gl/tiles/atlas.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <system_error>
#include <utility>

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <vtm/limits/limits.hpp>
#include "asset/records.hpp"
#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/turns.hpp"
#include "backend_gl/debug.hpp"
#include "backend_gl/upload/asset_texels.hpp"
#include "raster/detail_map.hpp"

namespace vtm::gl {

namespace {

template <class Item>
void copy(std::span<const Item> from, std::vector<Item>& to) {
    to.assign(from.begin(), from.end());
}

/// A map's paint 0 becomes the asset's.
asset::AssetView withPaintsFrom(const asset::Asset& asset, std::uint32_t first) {
    asset::AssetView view = asset;
    view.paints = view.paints.subspan(first);
    return view;
}

}  // namespace

namespace {

void copyTrees(const asset::AssetView& from, asset::Asset& to) {
    copy(from.maps, to.maps);
    copy(from.nodes, to.nodes);
    copy(from.leaves, to.leaves);
    copy(from.pieces, to.pieces);
}

void copyPaints(const asset::AssetView& from, KeptAsset& to) {
    copy(from.paints, to.asset.paints);
    copy(from.data, to.asset.data);
    to.programTurns = programTurns(from);
    to.changes = asset::changesOf(from);
}

bool hasSameTexels(const asset::AssetView& a, std::size_t i, const asset::AssetView& b, std::size_t j,
                   std::size_t count) {
    return std::ranges::equal(a.data.subspan(i, count), b.data.subspan(j, count));
}

/// Whether both do the same; of images and materials that is not asked.
bool isSame(const asset::AssetView& a, const asset::Instruction& one, const asset::AssetView& b,
            const asset::Instruction& other) {
    using asset::Op;
    if (one.op != other.op || one.blend != other.blend || one.opacity != other.opacity)
        return false;
    constexpr std::size_t head = asset::GradientView::headTexels;
    switch (one.op) {
        case Op::Solid:
            return hasSameTexels(a, one.argument, b, other.argument, 1);
        case Op::Linear:
        case Op::Radial:
            return hasSameTexels(a, one.argument, b, other.argument, head) &&
                   hasSameTexels(a, one.argument + head, b, other.argument + head,
                                 asset::recordAt<asset::Gradient>(a.data, one.argument).stopCount);
        default:
            return one.op != Op::Image && one.op != Op::Material;
    }
}

/// Whether two paints are the same program, wherever it stands, or both are none.
bool isSameProgram(const asset::AssetView& a, const asset::Paint& one, const asset::AssetView& b,
                   const asset::Paint& other) {
    if (!asset::isProgram(one) || !asset::isProgram(other))
        return asset::isProgram(one) == asset::isProgram(other);
    bool same = one[1] == other[1];
    for (std::uint32_t i = 0; same && i < one[1]; ++i)
        same = isSame(a, asset::recordAt<asset::Instruction>(a.data, one[0] + i), b,
                      asset::recordAt<asset::Instruction>(b.data, other[0] + i));
    return same;
}

}  // namespace

KeptAsset keptOf(const asset::AssetView& asset) {
    KeptAsset kept;
    copyTrees(asset, kept.asset);
    copyPaints(asset, kept);
    copy(asset.images, kept.asset.images);
    copy(asset.materials, kept.asset.materials);
    copy(asset.instanceTrees, kept.asset.instanceTrees);
    copy(asset.instances, kept.asset.instances);
    copy(asset.symbols, kept.asset.symbols);
    copy(asset.palettes, kept.asset.palettes);
    return kept;
}

PaintUpdate update(KeptAsset& kept, const asset::AssetView& asset, const asset::Difference& difference) {
    if (!difference.squares.empty())
        copyTrees(asset, kept.asset);
    if (!difference.paints)
        return {};
    asset::Asset before;
    before.paints = std::move(kept.asset.paints);
    before.data = std::move(kept.asset.data);
    copyPaints(asset, kept);
    PaintUpdate update;
    update.isChanged.resize(asset.paints.size(), 1);
    for (std::size_t i = 0; i < std::min(before.paints.size(), asset.paints.size()); ++i) {
        const asset::Paint &one = before.paints[i], &other = asset.paints[i];
        update.isChanged[i] = one != other;
        update.kinds |= asset::isProgram(one) != asset::isProgram(other);
        update.programs |= !isSameProgram(before, one, asset, other);
    }
    return update;
}

asset::AssetView ScannedPixels::drawing() const {
    asset::AssetView drawing = withPaintsFrom(*asset_, firstPaint_);
    drawing.commands = {&command_, 1};
    return drawing;
}

void ScannedPixels::update(const asset::Difference& difference) {
    for (std::optional<asset::Scanner>& scanner : scanners_)
        if (scanner)
            scanner->update(drawing(), difference);
}

const asset::Scanner& ScannedPixels::scannerFor(asset::Sums sums) {
    std::optional<asset::Scanner>& scanner = scanners_[std::size_t(sums)];
    if (!scanner)
        scanner.emplace(drawing(), sums);
    return *scanner;
}

namespace {

/// So many blocks of a row stand beside each other, among the scanned ones, too.
std::size_t runAt(std::span<const glm::ivec2> corners, std::size_t first, std::size_t columns, int side) {
    std::size_t end = first + 1;
    while (end < corners.size() && end % columns != 0 &&
           corners[end] == corners[end - 1] + glm::ivec2(side, 0))
        ++end;
    return end - first;
}

/// So many rows of `columns` blocks stand below each other.
std::size_t rowsAt(std::span<const glm::ivec2> corners, std::size_t first, std::size_t columns, int side) {
    std::size_t rows = 1;
    for (std::size_t next = first + columns; next + columns <= corners.size(); next += columns, ++rows)
        if (corners[next] != corners[next - columns] + glm::ivec2(0, side) ||
            runAt(corners, next, columns, side) != columns)
            break;
    return rows;
}

}  // namespace

/// Box by box, as blocks beside and below each other make them.
void ScannedPixels::scan(const asset::View& view, std::span<const glm::ivec2> corners, const PixelBox& box,
                         const BlockGrid& grid, asset::Sums sums) {
    const auto columns = std::size_t(grid.columnsOf(box));
    const glm::ivec2 size(grid.side * int(columns),
                          scannedPlace(corners.size() - 1, box, grid).y + grid.side);
    std::vector<glm::vec4> pixels(std::size_t(size.x) * std::size_t(size.y));
    for (std::size_t first = 0; first < corners.size();) {
        const std::size_t run = runAt(corners, first, columns, grid.side),
                          rows = run == columns ? rowsAt(corners, first, columns, grid.side) : 1;
        const PixelBox blocks{corners[first], corners[first] + grid.side * glm::ivec2(run, rows)},
            inside = blocks.intersection(box);
        const asset::View part{
            inside.width(),
            inside.height(),
            {view.toPixels[0], view.toPixels[1], view.toPixels[2] - glm::dvec2(inside.min)}};
        const glm::ivec2 place = scannedPlace(first, box, grid) + inside.min - blocks.min;
        scannerFor(sums).scan(part, [&](int y, const asset::ColorRun& colors) {
            glm::vec4* const row = pixels.data() + std::size_t(place.y + y) * std::size_t(size.x) + place.x;
            std::fill(row + colors.first, row + colors.end, colors.color);
        });
        first += run * rows;
    }
    send(size, pixels);
}

void ScannedPixels::send(glm::ivec2 size, const std::vector<glm::vec4>& pixels) {
    if (texture_.get() == 0 || size.x > size_.x || size.y > size_.y) {
        size_ = glm::max(size_, size);
        texture_ = makeTexture(GL_RGBA32F, size_.x, size_.y);
    }
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, pixels.data());
    checkErrors("scanned pixels");
}

namespace {

using asset::Texel;
using glm::dvec2;

constexpr double cellsPerRadius = 2.83;
/// Pixels: where pieces are longer in the mean, no square has less detail.
constexpr double longPiece = 1;
/// Of the pieces, that are left.
constexpr double fewer = 0.9;
/// What was made ahead is added by so many pictures.
constexpr std::size_t picturesToAdd = 8;
/// What is kept at most, 64 MiB, beside what the last picture used; and the most that every driver has room
/// for: tiles beyond are crowded.
constexpr std::size_t maxTexels = std::size_t(1) << 22, maxOfPicture = std::size_t(1) << 24;

/// From a pixel's centre to the furthest of its corners, in sides of the map.
double footprintRadius(const asset::Map& map, const asset::View& view) {
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    return 0.5 * std::max(glm::length(inverse * dvec2(1, 1)), glm::length(inverse * dvec2(1, -1))) / map.side;
}

/// Of halvings of the map's side to a cell.
double octavesOf(double radius) { return -std::log2(cellsPerRadius * radius); }

}  // namespace

int tileLevelFor(const asset::Map& map, const asset::View& view) {
    const double cells = std::floor(octavesOf(footprintRadius(map, view)));
    return std::min(int(cells) - int(tileCellsLog2), maxTileLevel);
}

/// With s and t the stretches, s² + t² is the sum of the squares of the matrix and s t its determinant, and
/// s / t + t / s grows with the ratio.
bool isStretched(const asset::View& view) {
    const dvec2 x = view.toPixels[0], y = view.toPixels[1];
    const double squares = glm::dot(x, x) + glm::dot(y, y);
    return squares > (maxStretchRatio + 1 / maxStretchRatio) * std::abs(x.x * y.y - x.y * y.x);
}

double tileMargin() { return std::ldexp(1 / cellsPerRadius, -int(tileCellsLog2)); }

Atlas::Atlas(const KeptAsset& asset, std::uint32_t map, std::uint32_t firstPaint, std::uint32_t maxTurns)
    : number_(map),
      map_(asset.asset.maps[map]),
      asset_(&asset),
      firstPaint_(firstPaint),
      maxTurns_(maxTurns),
      scanned_(asset.asset, map, firstPaint) {}

/// What tiles of a level are cut from: all pieces where less detail has hardly fewer.
Atlas::Pieces Atlas::lessDetailed(const Work& work) {
    const std::vector<PlanarPiece>& all = work.pieces->map().pieces;
    double length = 0;
    for (const PlanarPiece& piece : all)
        length += glm::distance(piece.a, piece.b);
    const double pixel = std::ldexp(work.pieces->map().extent, -work.region.level) / tilePixels;
    if (length > longPiece * pixel * double(all.size()) || work.map.instances != 0)
        return work.pieces;
    asset::PlanarMap map = mapForPixels(work.asset->asset, work.map, pixel);
    if (double(map.pieces.size()) >= fewer * double(all.size()))
        return work.pieces;
    return std::make_shared<const asset::PlanarIndex>(std::move(map));
}

namespace {

/// By square, row by row.
std::vector<std::vector<const PlanarPiece*>> piecesNear(const asset::PlanarMap& map,
                                                        const Atlas::Region& region) {
    const auto& [level, min, max] = region;
    const auto columns = std::size_t(max.x - min.x), rows = std::size_t(max.y - min.y);
    std::vector<std::vector<const PlanarPiece*>> near(columns * rows);
    const double side = std::ldexp(map.extent, -level);
    for (const PlanarPiece& piece : map.pieces) {
        limits::check();
        const double reach = tileMargin() + piece.bulge() / side;
        const dvec2 minimum = glm::floor(glm::min(piece.a, piece.b) / side - reach),
                    maximum = glm::floor(glm::max(piece.a, piece.b) / side + reach);
        if (!(maximum.x >= double(min.x) && maximum.y >= double(min.y) && minimum.x < double(max.x) &&
              minimum.y < double(max.y)))
            continue;
        const glm::i64vec2 from(glm::max(minimum, dvec2(min))), to(glm::min(maximum, dvec2(max) - 1.0));
        for (std::int64_t y = from.y; y <= to.y; ++y)
            for (std::int64_t x = from.x; x <= to.x; ++x)
                near[std::size_t(y - min.y) * columns + std::size_t(x - min.x)].push_back(&piece);
    }
    return near;
}

bool isCrowdedAllOver(const Tile& tile) { return tile.cells[CellKind::Crowded] == allCells; }

}  // namespace

Atlas::Placed Atlas::place(Tile tile) {
    Placed placed{.paints = tile.paints,
                  .programs = tile.programs,
                  .hasLongLists = tile.hasLongLists,
                  .steepness = tile.steepness,
                  .firstTexel = std::uint32_t(texels_.size()),
                  .firstPair = tile.firstPair,
                  .pairs = tile.pairs,
                  .firstCell = tile.firstCell,
                  .texelCount = std::uint32_t(tile.texels.size()),
                  .grid = tile.grid,
                  .used = picture_,
                  .cells = tile.cells};
    for (const CellKind kind : cellKinds)
        placed.kinds |= std::uint8_t((tile.cells[kind] != CellSet{}) << unsigned(kind));
    texels_.insert(texels_.end(), tile.texels.begin(), tile.texels.end());
    look(placed);
    return placed;
}

void Atlas::look(Placed& tile) const {
    const std::span texels = std::span(texels_).subspan(tile.firstTexel, tile.texelCount);
    tile.cell = texels[tile.firstCell];
    tile.twoColors.reset();
    if (tile.paints != TilePaints::Solid || tile.pairs == 0 || tile.pairs > 2)
        return;
    const std::span pairs = texels.subspan(tile.firstPair, 2 * tile.pairs);
    if (tile.pairs == 1 || std::rotl(pairs[1][0], 16) == pairs[3][0])
        tile.twoColors = pairs[0];
}

std::size_t Atlas::update(const asset::Difference& difference, const PaintUpdate& paints) {
    map_ = asset_->asset.maps[number_];
    scanned_.update(difference);
    if (!difference.squares.empty()) {
        pieces_.reset();
        levels_.clear();
        forget(difference.squares);
    }
    if (paints.kinds)
        placed_.clear();
    else if (paints.programs)
        std::erase_if(placed_, [](const auto& tile) { return tile.second.programs; });
    return paints.isChanged.empty() ? 0 : recolorAll(paints);
}

const asset::Texel& Atlas::cellAt(const Placed& tile, unsigned column, unsigned row) const {
    const unsigned log2 = tile.grid.log2;
    if (log2 == 0)
        return tile.cell;
    const auto inGrid = [&](unsigned place) { return place << log2 >> tileCellsLog2; };
    return texels_[tile.firstTexel + tile.firstCell + (inGrid(row) << log2) + inGrid(column)];
}

/// Tiles that show something of the squares.
void Atlas::forget(std::span<const asset::Cell> squares) {
    // Pieces reach a little over the border of their squares, and pixels over that of their tiles.
    constexpr double reach = 0.25;
    const auto meets = [&](const TilePlace& tile, const asset::Cell& square) {
        const double scale = std::ldexp(1.0, tile.level - 2 * int(square.level));  // square's sides in tiles
        const dvec2 low = scale * dvec2(square.x, square.y) - reach, high = low + scale + 2 * reach;
        return high.x > double(tile.x) && high.y > double(tile.y) && low.x < double(tile.x + 1) &&
               low.y < double(tile.y + 1);
    };
    std::erase_if(placed_, [&](const auto& tile) {
        return std::ranges::any_of(squares,
                                   [&](const asset::Cell& square) { return meets(tile.first, square); });
    });
}

/// Returns the bytes sent.
std::size_t Atlas::recolorAll(const PaintUpdate& changed) {
    const std::span isChanged = std::span(changed.isChanged).subspan(firstPaint_);
    std::size_t sent = 0;
    for (auto& [at, tile] : placed_) {
        const std::span texels = std::span(texels_).subspan(tile.firstTexel, tile.texelCount);
        if (!recolor(texels, tile.firstPair, tile.pairs, tile.firstCell, paints(), isChanged))
            continue;
        look(tile);
        if (tile.firstTexel >= uploaded_)
            continue;
        updateTexels(texture_.get(), tile.firstTexel, texels);
        sent += texels.size_bytes();
    }
    return sent;
}

/// Forgets the tiles that were not used for longest, until half of what may be kept is left.
void Atlas::makeRoom() {
    if (texels_.size() <= std::max(maxTexels, 2 * texelsOfPicture_))
        return;
    std::vector<std::pair<std::uint64_t, std::size_t>> sizes;  // by picture
    for (const auto& [at, tile] : placed_)
        sizes.emplace_back(tile.used, tile.texelCount);
    std::ranges::sort(sizes, std::greater());
    std::size_t kept = 0;
    std::uint64_t oldest = picture_;
    for (const auto& [used, count] : sizes)
        if ((kept += count) <= maxTexels / 2)
            oldest = used;
    std::erase_if(placed_, [&](const auto& tile) { return tile.second.used < oldest; });
    std::erase_if(levels_, [&](const auto& level) {
        return std::ranges::none_of(placed_,
                                    [&](const auto& tile) { return tile.first.level == level.first; });
    });
    crowded_.reset();
    std::vector<Texel> texels;
    for (auto& [at, tile] : placed_) {
        const auto first = texels_.begin() + std::ptrdiff_t(tile.firstTexel);
        tile.firstTexel = std::uint32_t(texels.size());
        texels.insert(texels.end(), first, first + std::ptrdiff_t(tile.texelCount));
    }
    texels_ = std::move(texels);
    uploaded_ = 0;
}

const Atlas::Placed& Atlas::prepareCrowded() {
    makeRoom();
    if (!crowded_)
        crowded_ = place(crowdedTile(paints()));
    upload();
    return *crowded_;
}

/// Tiles stand column by column in the map.
std::vector<Atlas::Placed*> Atlas::find(const Region& region) {
    const auto& [level, min, max] = region;
    const auto columns = std::size_t(max.x - min.x), rows = std::size_t(max.y - min.y);
    std::vector<Placed*> tiles(columns * rows);
    for (std::size_t x = 0; x < columns; ++x) {
        auto next = placed_.lower_bound({level, min.x + std::int64_t(x), min.y});
        for (std::size_t y = 0; y < rows && next != placed_.end(); ++y)
            if (next->first == TilePlace{level, min.x + std::int64_t(x), min.y + std::int64_t(y)})
                tiles[y * columns + x] = &next++->second;
    }
    return tiles;
}

std::vector<const Atlas::Placed*> Atlas::prepare(const Region& region) {
    makeRoom();
    ++picture_;
    addAhead(region.level);
    std::vector<Placed*> tiles = find(region);
    if (const Work work = workOn(region, tiles); !work.places.empty()) {
        add(region.level, makeTiles(work));
        tiles = find(region);
    }
    texelsOfPicture_ = 0;
    for (Placed* tile : tiles) {
        tile->used = picture_;
        texelsOfPicture_ += tile->texelCount;
    }
    upload();
    return {tiles.begin(), tiles.end()};
}

std::optional<Atlas::Zoom> Atlas::zoomTo(const asset::View& view) {
    // Less is no zoom, more a jump.
    constexpr double least = 1 + 1e-3, most = 2;
    const double radius = footprintRadius(map_, view), last = std::exchange(lastRadius_, radius);
    const double larger = radius / last, smaller = last / radius;
    const double octaves = octavesOf(radius), inOctave = octaves - std::floor(octaves);
    if (smaller > least && smaller < most && inOctave > 0.5)
        return Zoom{1, std::exp2(1 - inOctave)};
    if (larger > least && larger < most && inOctave < 0.5)
        return Zoom{-1, std::exp2(-inOctave)};
    return std::nullopt;
}

void Atlas::prepareAhead(const Region& region) {
    if (ahead_ || region.level > maxTileLevel || texels_.size() > maxTexels)
        return;
    Work work = workOn(region, find(region));
    if (work.places.empty())
        return;
    try {
        ahead_ = {region.level,
                  std::async(std::launch::async, [work = std::move(work)] { return makeTiles(work); })};
    } catch (const std::system_error&) {
        // There is no thread; it is made when it is needed.
    }
}

void Atlas::addAhead(int level) {
    if (!ahead_)
        return;
    const bool isNeeded = ahead_->level == level;
    if (ahead_->thread.valid()) {
        if (!isNeeded && ahead_->thread.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return;
        try {
            ahead_->made = ahead_->thread.get();
        } catch (const std::exception&) {
            // What fails is tried again when it is needed, and says so then.
            ahead_.reset();
            return;
        }
        ahead_->perPicture = ahead_->made.tiles.size() / picturesToAdd + 1;
    }
    std::vector<std::pair<TilePlace, Tile>>& tiles = ahead_->made.tiles;
    const auto first =
        isNeeded ? tiles.begin() : tiles.end() - std::ptrdiff_t(std::min(tiles.size(), ahead_->perPicture));
    Made some{ahead_->made.level, {std::move_iterator(first), std::move_iterator(tiles.end())}};
    tiles.erase(first, tiles.end());
    add(ahead_->level, std::move(some));
    if (tiles.empty())
        ahead_.reset();
}

Atlas::Work Atlas::workOn(const Region& region, std::span<Placed* const> tiles) {
    Work work{asset_, map_, firstPaint_, maxTurns_, {}, {}, region, {}};
    const std::int64_t columns = region.max.x - region.min.x;
    for (std::size_t i = 0; i < tiles.size(); ++i)
        if (tiles[i] == nullptr)
            work.places.push_back({region.level, region.min.x + std::int64_t(i) % columns,
                                   region.min.y + std::int64_t(i) / columns});
    if (work.places.empty())
        return work;
    if (!pieces_)
        pieces_ = std::make_shared<const asset::PlanarIndex>(flatPlanarMap(asset_->asset, map_));
    work.pieces = pieces_;
    if (const auto found = levels_.find(region.level); found != levels_.end())
        work.level = found->second;
    return work;
}

/// On all processors. Where levels of detail do not serve, as where hundreds of pieces meet, tiles are cut
/// from all pieces.
Atlas::Made Atlas::makeTiles(const Work& work) {
    Made made{work.level ? work.level : lessDetailed(work), {}};
    made.tiles.resize(work.places.size());
    const auto& [level, min, max] = work.region;
    const auto near = piecesNear(made.level->map(), work.region);
    const auto build = [&](const asset::PlanarIndex& of, const TilePlace& at,
                           std::span<const PlanarPiece* const> nearIt) {
        const KeptAsset& asset = *work.asset;
        const TileSource source{withPaintsFrom(asset.asset, work.firstPaint),
                                of,
                                *work.pieces,
                                std::span(asset.programTurns).subspan(work.firstPaint),
                                std::span(asset.changes).subspan(work.firstPaint),
                                work.maxTurns};
        return buildTile(source, at, tileMargin(), nearIt);
    };
    tbb::parallel_for(std::size_t{0}, work.places.size(), [&, holding = limits::current()](std::size_t i) {
        const limits::Scope scope(holding);
        const TilePlace at = work.places[i];
        const auto number = std::size_t((at.y - min.y) * (max.x - min.x) + at.x - min.x);
        Tile tile = build(*made.level, at, near[number]);
        if (made.level != work.pieces && (!tile.isConsistent || isCrowdedAllOver(tile)))
            tile = build(*work.pieces, at,
                         piecesNear(work.pieces->map(), {at.level, {at.x, at.y}, {at.x + 1, at.y + 1}})[0]);
        made.tiles[i] = {at, std::move(tile)};
    });
    return made;
}

void Atlas::add(int level, Made made) {
    levels_.emplace(level, std::move(made.level));
    for (auto& [at, tile] : made.tiles) {
        if (placed_.contains(at))
            continue;
        const bool fits = texels_.size() + tile.texels.size() <= maxOfPicture;
        placed_.emplace(at, place(fits ? std::move(tile) : crowdedTile(paints())));
    }
}

namespace {

constexpr std::size_t columns = std::size_t(1) << texelColumnsLog2;

std::size_t rowsOf(std::size_t texels) { return (texels + columns - 1) / columns; }

void sendRows(std::size_t row, std::size_t rows, std::size_t width, const Texel* texels) {
    if (rows != 0 && width != 0)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, GLint(row), GLsizei(width), GLsizei(rows), GL_RGBA_INTEGER,
                        GL_UNSIGNED_INT, texels);
}

}  // namespace

/// Rows from the first that has new texels.
void Atlas::upload() {
    if (uploaded_ == texels_.size() && texture_.get() != 0)
        return;
    if (texture_.get() == 0 || texels_.size() > capacity_) {
        const std::size_t rows =
            std::clamp(rowsOf(2 * texels_.size()), std::size_t(1), maxOfPicture / columns);
        texture_ = makeTexture(GL_RGBA32UI, int(columns), int(rows));
        capacity_ = rows * columns;
        uploaded_ = 0;
    }
    const std::size_t first = uploaded_ / columns, whole = texels_.size() / columns;
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    sendRows(first, whole - first, columns, texels_.data() + first * columns);
    sendRows(whole, 1, texels_.size() % columns, texels_.data() + whole * columns);
    checkErrors("tiles");
    uploaded_ = texels_.size();
}

TileGrid tileGrid(const asset::Map& map, const asset::View& view) {
    return {std::ldexp(map.side, -tileLevelFor(map, view)), 1u << tileCellsLog2};
}

}  // namespace vtm::gl
