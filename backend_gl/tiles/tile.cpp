#include "backend_gl/tiles/tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

#include <vtm/limits/limits.hpp>
#include "backend_gl/core/turns.hpp"
#include "backend_gl/tiles/rough_cells.hpp"
#include "backend_gl/tiles/tile_cells.hpp"
#include "backend_gl/tiles/tile_pieces.hpp"
#include "raster/detail_map.hpp"
#include "raster/steepness.hpp"

namespace vtm::gl {

namespace {

using asset::Change;
using asset::cross;
using asset::Sides;
using glm::dvec2;

// ---- Lists ----------------------------------------------------------------------------------------

/// Pieces by cell: those of cell i are numbers[first[i]] to numbers[first[i + 1]], ascending.
struct Lists {
    std::vector<std::uint32_t> first, numbers;

    std::span<const std::uint32_t> of(std::size_t cell) const {
        return {numbers.data() + first[cell], numbers.data() + first[cell + 1]};
    }
};

/// Calls visit(cell) for every cell that the piece can come nearer to than `margin`.
template <class Visit>
void forEachCell(const CellGrid& grid, const PlanarPiece& p, double margin, Visit&& visit) {
    const int cellCount = grid.cellsPerSide();
    const double cellSize = grid.cellSize();
    const dvec2 d = p.b - p.a;
    const double inverse = 1 / glm::dot(d, d);
    const double reach = margin + p.bulge();
    // From the cell's centre: to the chord, as far as its corners are, and to the chord's line, as far as the
    // cell extends across it.
    const double fromCentre = reach + cellSize * std::sqrt(0.5);
    const double fromLine = reach * glm::length(d) + 0.5 * cellSize * (std::abs(d.x) + std::abs(d.y));
    const auto index = [&](double v) {
        return int(std::clamp(std::floor(v * cellCount), 0.0, cellCount - 1.0));
    };
    if (std::max(p.a.y, p.b.y) + reach < 0 || std::min(p.a.y, p.b.y) - reach > 1)
        return;
    const int firstRow = index(std::min(p.a.y, p.b.y) - reach),
              lastRow = index(std::max(p.a.y, p.b.y) + reach);
    for (int row = firstRow; row <= lastRow; ++row) {
        // The chord between the row's borders, moved outwards by the reach.
        double from = 0, to = 1;
        if (d.y != 0) {
            const double u = (row * cellSize - reach - p.a.y) / d.y,
                         v = ((row + 1) * cellSize + reach - p.a.y) / d.y;
            from = std::max(from, std::min(u, v));
            to = std::min(to, std::max(u, v));
            if (from > to)
                continue;
        }
        const double x0 = p.a.x + from * d.x, x1 = p.a.x + to * d.x;
        const double minimum = std::min(x0, x1) - reach, maximum = std::max(x0, x1) + reach;
        if (maximum < 0 || minimum > 1)
            continue;
        for (int column = index(minimum), last = index(maximum); column <= last; ++column) {
            const dvec2 centre = (dvec2(column, row) + 0.5) * cellSize;
            if (std::abs(cross(d, centre - p.a)) <= fromLine &&
                distance2(p.a, d, inverse, centre) <= fromCentre * fromCentre)
                visit(std::uint32_t(row * cellCount + column));
        }
    }
}

Lists listsOf(const CellGrid& grid, const std::vector<PlanarPiece>& pieces, double margin) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // cell, piece
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        forEachCell(grid, pieces[i], margin, [&](std::uint32_t cell) { found.emplace_back(cell, i); });
    Lists lists;
    lists.first.assign((std::size_t(1) << 2 * grid.log2) + 1, 0);
    for (const auto& [cell, piece] : found)
        ++lists.first[cell + 1];
    for (std::size_t i = 1; i < lists.first.size(); ++i)
        lists.first[i] += lists.first[i - 1];
    std::vector<std::uint32_t> next(lists.first.begin(), lists.first.end() - 1);
    lists.numbers.resize(found.size());
    for (const auto& [cell, piece] : found)
        lists.numbers[next[cell]++] = piece;
    return lists;
}

/// Where cells with pieces list more of them in the mean, cells half and a quarter as wide serve better. A
/// pixel evaluates what comes near its cell: of pieces smaller than that, those in an area of (1.7 cells)²,
/// (1.2 cells)² or (0.96 cells)², cells being those of the coarsest grid. Where lists are short, more cells
/// cost more than that.
constexpr double longList = 8, longestList = 30;

/// With more than these, whatever the grid, shaders meet two pieces at a time (tile_fragment.glsl).
constexpr double longInMean = 4.5;

/// Of the lists that are not empty.
double meanLength(const Lists& lists) {
    std::size_t cells = 0;
    for (std::size_t i = 0; i + 1 < lists.first.size(); ++i)
        cells += lists.of(i).empty() ? 0 : 1;
    return double(lists.numbers.size()) / double(cells);
}

CellGrid gridFor(const Lists& lists) {
    const double mean = meanLength(lists);
    return {mean > longestList ? maxCellsLog2 : mean > longList ? tileCellsLog2 + 1 : tileCellsLog2};
}

// ---- Paints of reference points --------------------------------------------------------------------

/// The net change of paint that a piece makes on the straight way from one point to another: 1 from right to
/// left, -1 from left to right.
int crossing(const PlanarPiece& p, dvec2 from, dvec2 to) {
    const Sides start = p.sidesOf(from), end = p.sidesOf(to);
    const dvec2 way = to - from;
    const bool between = (cross(way, p.a - from) > 0) != (cross(way, p.b - from) > 0);
    return (between ? int(end.leftOfChord) - int(start.leftOfChord) : 0) +
           (int(end.leftOfCurve) - int(end.leftOfChord)) - (int(start.leftOfCurve) - int(start.leftOfChord));
}

/// The paint at one point, known that at another; `a`, `b`: the pieces near either.
class Walk {
public:
    /// `checks`: whether isConsistent() will be asked.
    Walk(const std::vector<PlanarPiece>& pieces, bool checks) : pieces_(pieces), checks_(checks) {}

    std::uint32_t paintAt(dvec2 to, const Reference& from, std::span<const std::uint32_t> a,
                          std::span<const std::uint32_t> b) {
        if (a.empty() && b.empty())
            return from.paint;
        changes_.clear();
        std::size_t i = 0, j = 0;
        while (i < a.size() || j < b.size()) {
            const std::uint32_t next = std::min(i < a.size() ? a[i] : ~0u, j < b.size() ? b[j] : ~0u);
            i += i < a.size() && a[i] == next;
            j += j < b.size() && b[j] == next;
            const PlanarPiece& piece = pieces_[next];
            if (const int change = crossing(piece, from.point, to); change > 0)
                changes_.push_back({0, piece.right, piece.left});
            else if (change < 0)
                changes_.push_back({0, piece.left, piece.right});
        }
        const std::uint32_t paint = paintBehind(from.paint, changes_);
        isConsistent_ = isConsistent_ && (!checks_ || isOnly(paint, from.paint));
        return paint;
    }

    /// Whether all paints were what all changes add up to.
    bool isConsistent() const { return isConsistent_; }

private:
    /// Whether the changes lead from `before` to that paint alone.
    bool isOnly(std::uint32_t paint, std::uint32_t before) {
        paints_.assign({before, paint});
        for (const Change& change : changes_)
            paints_.insert(paints_.end(), {change.before, change.after});
        return std::ranges::all_of(paints_, [&](std::uint32_t p) {
            int net = int(p == before) - int(p == paint);
            for (const Change& change : changes_)
                net += int(p == change.after) - int(p == change.before);
            return net == 0;
        });
    }

    const std::vector<PlanarPiece>& pieces_;
    const bool checks_;
    std::vector<Change> changes_;
    std::vector<std::uint32_t> paints_;
    bool isConsistent_ = true;
};

/// With those between the same two paints one after the other, where shaders gain from it: what asks paint
/// programs for colours keeps the last two (tile_programs_fragment.glsl).
std::vector<PlanarPiece> inOrder(std::vector<PlanarPiece> pieces, bool areColors) {
    if (!areColors)
        std::ranges::stable_sort(pieces, {}, [](const PlanarPiece& p) {
            return std::minmax({p.left, p.right});
        });
    return pieces;
}

/// A tile's cells, in the picture.
class CellPlaces {
public:
    CellPlaces(const TileSource& source, const TilePlace& place, double margin)
        : side_(std::ldexp(source.pieces.map().side, -place.level)),
          corner_(source.pieces.map().origin + side_ * dvec2(double(place.x), double(place.y))),
          margin_(margin * side_) {}

    /// Corners of a pixel are no further from its centre than the margin, so it stretches what it maps by no
    /// more than twice that.
    double stretch() const { return 2 * margin_; }
    TileFrame frame() const { return {corner_, side_, stretch() / side_}; }
    /// The pixels with centres in a cell.
    asset::PixelsNear pixels(const CellGrid& grid, int column, int row) const {
        const double cell = grid.cellSize() * side_;
        return {corner_ + cell * dvec2(column + 0.5, row + 0.5), std::sqrt(0.5) * cell, stretch()};
    }

private:
    double side_;
    dvec2 corner_;
    double margin_;
};

/// Programs near a tile.
struct ProgramsNear {
    std::vector<std::pair<std::uint32_t, PlainPaint>> plain;
    TilePaints kind = TilePaints::Solid;  ///< of the plain ones
    double change = 0;                    ///< the largest of those
    bool hasOthers = false;               ///< which have to be run
    bool any = false;

    /// Whether programs may be run.
    bool mayRun() const { return hasOthers || change > asset::minSteepChange; }
    bool areColors() const { return !hasOthers && kind == TilePaints::Solid; }
};

/// Texels of all layers and tables of a tile. With more, programs are run.
constexpr std::size_t maxPlainTexels = 1u << 14;

/// Nothing where the program had better be run.
std::optional<TilePaints> kindOf(const PlainPaint& paint) {
    if (paint.layers == 0)
        return TilePaints::Solid;
    if (paint.change > maxPlainChange)
        return std::nullopt;
    for (std::size_t i = 0; i < rampPoints.size(); ++i)
        if (rampPoints[i].error * paint.bend <= maxPlainError)
            return TilePaints(std::size_t(TilePaints::Plain) + i);
    return std::nullopt;
}

/// `paints`: ascending.
ProgramsNear programsNear(const TileSource& source, const CellPlaces& places,
                          std::span<const std::uint32_t> paints) {
    ProgramsNear near;
    std::size_t texels = 0;
    for (const std::uint32_t paint : paints) {
        if (!asset::isProgram(source.asset.paints[paint]))
            continue;
        near.any = true;
        std::optional<PlainPaint> plain = plainPaint(source.asset, paint, places.frame());
        const std::optional<TilePaints> kind = plain ? kindOf(*plain) : std::nullopt;
        if (!kind || texels + plain->texels.size() > maxPlainTexels) {
            near.hasOthers = true;
            continue;
        }
        texels += plain->texels.size();
        near.kind = std::max(near.kind, *kind);
        near.change = std::max(near.change, plain->change);
        near.plain.emplace_back(paint, std::move(*plain));
    }
    return near;
}

std::vector<std::uint32_t> paintsBeside(std::span<const PlanarPiece* const> pieces) {
    std::vector<std::uint32_t> paints;
    for (const PlanarPiece* piece : pieces)
        paints.insert(paints.end(), {piece->left, piece->right});
    std::ranges::sort(paints);
    const auto [end, last] = std::ranges::unique(paints);
    paints.erase(end, last);
    return paints;
}

/// A plain paint may be off by 2/255 under an edge where it is nearly steep. Programs that are run beside it
/// are not, as they are steep somewhere and asked for in quarters; so there it is steep from half on.
constexpr double besideOthers = 2;

/// Their layers and tables are the tile's first texels.
TileWords putPaints(const TileSource& source, const CellPlaces& places, const ProgramsNear& programs,
                    Tile& tile) {
    tile.paints = programs.kind;
    tile.steepness = float((programs.hasOthers ? besideOthers : 1) * programs.change / places.stretch());
    tile.programs = programs.any;
    TileWords words(source.asset.paints);
    for (const auto& [paint, plain] : programs.plain)
        words.put(paint, append(plain, tile.texels));
    tile.firstPair = std::uint32_t(tile.texels.size());
    return words;
}

/// Which cells shaders do not draw: they would take too many turns, or not be exact.
class HandedOver {
public:
    HandedOver(const TileSource& source, const CellPlaces& places, const ProgramsNear& programs)
        : maxTurns_(source.asset.materials.empty() ? source.maxTurns : source.maxTurns * materialFactor),
          programs_(!programs.areColors()),
          costs_{source.programTurns, source.changes, asset::minSteepness(glm::dmat2(places.stretch()))} {
        if (programs.mayRun() && source.asset.materials.empty())
            rough_ = RoughCells(source.asset, source.changes);
    }

    bool operator()(const asset::PixelsNear& pixels, std::uint32_t paint,
                    const std::vector<PlanarPiece>& pieces, std::span<const std::uint32_t> list) const {
        const std::uint64_t turns =
            programs_ ? turnsWithPrograms(costs_, paint, pieces, list) : solidTurns(list.size());
        return turns > maxTurns_ || rough_.mayBe(pixels, paint, pieces, list);
    }

private:
    /// The scanner has no colours of materials, so shaders take up to half of what a driver allows; pixels
    /// that share an invocation have cells that are alike.
    static constexpr std::uint64_t materialFactor = vectorPixels / 2;

    std::uint64_t maxTurns_;
    bool programs_;
    PaintCosts costs_;
    RoughCells rough_;
};

/// A cell of a grid, in a set.
void put(CellSet& set, const CellGrid& grid, int column, int row) {
    const unsigned finer = grid.log2 - tileCellsLog2;
    set[std::size_t(row) >> finer] |= std::uint16_t(1u << (unsigned(column) >> finer));
}

constexpr CellGrid oneCell{0};

/// Of one paint. It has one cell, unless there are some that shaders do not draw.
Tile tileOfOnePaint(const TileSource& source, const CellPlaces& places, std::uint32_t paint) {
    Tile tile;
    const ProgramsNear programs = programsNear(source, places, {&paint, 1});
    const TileWords words = putPaints(source, places, programs, tile);
    const PaintKind kind = words.kindOf(paint);
    if (kind != PaintKind::Solid)
        tile.cells[kind == PaintKind::Plain ? CellKind::Plain : CellKind::Run] = allCells;
    const std::vector<PlanarPiece> none;
    const HandedOver isHandedOver(source, places, programs);
    const Reference here{dvec2(0.5), 0, paint};
    CellWriter writer(words, source.changes, none, tile.texels);
    std::vector<Texel> cells;
    if (programs.hasOthers)
        for (int row = 0; row < cellsPerTile; ++row)
            for (int column = 0; column < cellsPerTile; ++column) {
                const bool crowded = isHandedOver(places.pixels(tile.grid, column, row), paint, none, {});
                cells.push_back(crowded ? writer.writeCrowded(here) : writer.write(here, {}));
                if (crowded)
                    put(tile.cells[CellKind::Crowded], tile.grid, column, row);
            }
    if (tile.cells[CellKind::Crowded] == CellSet{}) {
        tile.grid = oneCell;
        cells = {writer.write(here, {})};
    }
    tile.firstCell = std::uint32_t(tile.texels.size());
    tile.texels.insert(tile.texels.end(), cells.begin(), cells.end());
    return tile;
}

/// Levels of detail move boundaries by no more; tile sides.
constexpr double movedByDetail = 4 * asset::detailTolerance / tilePixels;

/// A point that is clear of pieces, and its paint. Where there are pieces it lies in the first cell.
std::optional<Reference> startOf(const TileSource& source, const LocalPieces& local, bool isEmpty,
                                 std::span<const PlanarPiece* const> near) {
    const double clearance = source.hasLessDetail() ? movedByDetail : 0;
    const std::optional<dvec2> point =
        clearPoint(local, isEmpty ? 1 : CellGrid().cellSize(), clearance, near);
    if (!point)
        return std::nullopt;
    return Reference{*point, 0, source.exact.paintAt(local.toLattice(*point))};
}

}  // namespace

bool recolor(std::span<Texel> texels, std::uint32_t firstPair, std::uint32_t pairs, std::uint32_t firstCell,
             std::span<const asset::Paint> paints, std::span<const std::uint8_t> isChanged) {
    bool changed = false;
    const auto put = [&](std::uint32_t paint, std::uint32_t& first, std::uint32_t& second) {
        if (isChanged[paint] == 0 || asset::isProgram(paints[paint]))
            return;
        const PaintWords words = solidWords(paints[paint]);
        first = words[0];
        second = words[1];
        changed = true;
    };
    for (std::uint32_t i = 0; i < pairs; ++i) {
        Texel& colors = texels[firstPair + 2 * i];
        const std::uint32_t pair = texels[firstPair + 2 * i + 1][0];
        put(pair & 0xFFFF, colors[0], colors[1]);
        put(pair >> 16, colors[2], colors[3]);
    }
    for (Texel& cell : texels.subspan(firstCell))
        put(cell[0] & 0xFFFF, cell[1], cell[2]);
    return changed;
}

Tile crowdedTile(std::span<const asset::Paint> paints) {
    const TileWords words(paints);
    Tile tile;
    const std::vector<PlanarPiece> none;
    const CellWriter writer(words, {}, none, tile.texels);
    tile.grid = oneCell;
    tile.cells[CellKind::Crowded] = allCells;
    tile.texels = {writer.writeCrowded({dvec2(0.5), 0, 0})};
    return tile;
}

Tile buildTile(const TileSource& source, const TilePlace& place, double margin,
               std::span<const PlanarPiece* const> near) {
    const LocalPieces local(source.pieces.map().extent, place, margin, near);
    const CellPlaces places(source, place, margin);
    const ProgramsNear programs = programsNear(source, places, paintsBeside(near));
    const std::vector<PlanarPiece> pieces = inOrder(local.pieces(), programs.areColors());
    const Lists coarse = listsOf(CellGrid(), pieces, margin);
    const std::optional<Reference> start = startOf(source, local, coarse.numbers.empty(), near);
    if (!start)
        return crowdedTile(source.asset.paints);
    if (coarse.numbers.empty())
        return tileOfOnePaint(source, places, start->paint);
    const HandedOver isHandedOver(source, places, programs);
    Tile tile;
    const TileWords words = putPaints(source, places, programs, tile);
    tile.grid = gridFor(coarse);
    std::optional<Lists> fine;
    if (tile.grid.log2 != CellGrid().log2)
        fine = listsOf(tile.grid, pieces, margin);
    const Lists& lists = fine ? *fine : coarse;
    const int cellCount = tile.grid.cellsPerSide();
    std::vector<Texel> cells;
    CellWriter writer(words, source.changes, pieces, tile.texels);
    const auto markPaint = [&](std::uint32_t paint, int column, int row) {
        if (const PaintKind kind = words.kindOf(paint); kind != PaintKind::Solid)
            put(tile.cells[kind == PaintKind::Plain ? CellKind::Plain : CellKind::Run], tile.grid, column,
                row);
    };
    Walk walk(pieces, source.hasLessDetail());
    Reference rowStart, last;
    for (int row = 0; row < cellCount; ++row)
        for (int column = 0; column < cellCount; ++column) {
            const std::size_t i = cells.size();
            Reference here = referenceIn(tile.grid, column, row, pieces, lists.of(i));
            if (i == 0)
                here.paint = walk.paintAt(here.point, *start, {}, coarse.of(0));
            else if (column == 0)
                here.paint =
                    walk.paintAt(here.point, rowStart, lists.of(i - std::size_t(cellCount)), lists.of(i));
            else
                here.paint = walk.paintAt(here.point, last, lists.of(i - 1), lists.of(i));
            const bool crowded =
                !writer.hasRoomFor(lists.of(i)) ||
                isHandedOver(places.pixels(tile.grid, column, row), here.paint, pieces, lists.of(i));
            cells.push_back(crowded ? writer.writeCrowded(here) : writer.write(here, lists.of(i)));
            if (crowded)
                put(tile.cells[CellKind::Crowded], tile.grid, column, row);
            if (!lists.of(i).empty())
                put(tile.cells[CellKind::Mixed], tile.grid, column, row);
            if (programs.any) {
                markPaint(here.paint, column, row);
                for (const std::uint32_t piece : lists.of(i)) {
                    markPaint(pieces[piece].left, column, row);
                    markPaint(pieces[piece].right, column, row);
                }
            }
            last = here;
            if (column == 0)
                rowStart = here;
        }
    tile.pairs = writer.pairs();
    tile.isConsistent = walk.isConsistent();
    tile.hasLongLists = meanLength(lists) > longInMean;
    tile.firstCell = std::uint32_t(tile.texels.size());
    tile.texels.insert(tile.texels.end(), cells.begin(), cells.end());
    return tile;
}

}  // namespace vtm::gl
