/// \file
/// A square of the plane prepared for drawing: a grid of cells, each with the pieces that can matter to a
/// pixel in it. An index only: the curves are the asset's own, and it serves every view of about its scale.
///
/// A pixel whose centre O lies in a cell has the mean colour
///     c(R) + Σ (c_left - c_right) · (crossings of R -> O + area of the piece's shadow in the pixel's box),
/// R being the cell's reference point, and the shadow of a piece what of the box lies behind it as seen from
/// O (docs/coverage.md). The box is convex and holds O, so only pieces in the box have a shadow: what is far
/// away needs no thought, and every pixel is drawn once, by one cell.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "backend_gl/core/turns.hpp"
#include "backend_gl/tiles/plain_paints.hpp"
#include "raster/planar_map.hpp"
#include "raster/steepness.hpp"

namespace vtm::gl {

using asset::PlanarPiece;

/// Which square: squares have the map's side / 2^level, level below 0 being larger than the map; (0, 0) is
/// the one at the map's least corner. There are squares outside the map, too: its border belongs to pixels
/// there as well.
struct TilePlace {
    int level = 0;
    std::int64_t x = 0, y = 0;

    auto operator<=>(const TilePlace&) const = default;
};
/// Smaller squares would be finer than the lattice can number.
inline constexpr int maxTileLevel = 2 * int(asset::maxLevel);

/// A tile has fewer pixels a side.
inline constexpr double tilePixels = 64;
/// Cells a side; of tiles with long lists up to the second.
inline constexpr unsigned tileCellsLog2 = 4, maxCellsLog2 = 6;
/// Some of a tile's cells, as if it were a grid of the first size: rows, in which a column is a bit.
inline constexpr int cellsPerTile = 1 << tileCellsLog2;
using CellSet = std::array<std::uint16_t, cellsPerTile>;
inline constexpr CellSet allCells = [] {
    CellSet cells;
    cells.fill(0xFFFF);
    return cells;
}();
/// What is known of a tile's cells: which have pieces; in which some paint is plain, but no colour; in which
/// one has to be run; which are crowded.
enum class CellKind : std::uint8_t { Mixed, Plain, Run, Crowded };
inline constexpr CellKind cellKinds[] = {CellKind::Mixed, CellKind::Plain, CellKind::Run, CellKind::Crowded};
struct CellSets {
    std::array<CellSet, std::size(cellKinds)> sets{};

    CellSet& operator[](CellKind kind) { return sets[std::size_t(kind)]; }
    const CellSet& operator[](CellKind kind) const { return sets[std::size_t(kind)]; }
};
/// In the word with a tile's first cell.
inline constexpr unsigned gridShift = 28;
/// The cells of a tile, row by row.
struct CellGrid {
    unsigned log2 = tileCellsLog2;

    int cellsPerSide() const { return 1 << log2; }
    double cellSize() const { return 1.0 / (1u << log2); }  ///< tile sides
};
/// Reference points stand on a grid of 2^referenceLog2 a side in their cell, moved by this: in steps of end
/// points, so that none is an end point.
inline constexpr unsigned referenceLog2 = 2;
inline constexpr double referenceShiftX = 0.625, referenceShiftY = 0.25;
/// Coordinates of end points: steps of 2^-tileStepLog2 of a tile from -1, in 18 bits.
inline constexpr unsigned tileStepLog2 = 16, tileCoordinateBits = 18;
/// Slopes have 12 bits; this stands for 1.
inline constexpr double tileSlopeScale = 2047;
/// Sides of a cell's reference point that go with each piece in its list.
inline constexpr std::uint32_t leftOfChordBit = 1, leftOfCurveBit = 2;
/// Of a cell's first word: its pixels are made elsewhere.
inline constexpr std::uint32_t crowdedBit = 1u << 31;
/// A cell's first word holds the lower bits of its list's length, from bit lengthShift on; its last word the
/// list's first texel and, above, the rest of the length.
inline constexpr unsigned lengthShift = 20, lowLengthBits = 11, firstTexelBits = 23;

/// Those near a tile, as they are there (backend_gl/tiles/plain_paints.hpp), but for programs that have to be
/// run: nothing but colours, or plain ones that change little over a pixel, whose means over it are those of
/// one, two or four points.
enum class TilePaints : std::uint8_t { Solid, Plain, PlainOfTwo, PlainOfFour };
/// By TilePaints, from Plain on: points, and how far their mean may be off, by the difference between slopes
/// times the diagonal of a pixel. That is where a ramp is bent in a pixel's middle or between two points,
/// which are evenly apart and have the pixel's variance.
struct RampPoints {
    unsigned count;
    double error;
};
inline constexpr std::array<RampPoints, 3> rampPoints{{{1, 0.125}, {2, 0.022}, {4, 0.009}}};

/// What plain paints change by at most over a pixel as wide as the diagonal of the tile's largest. Sides of
/// pixels are a √2th to a √8th of that: with more, such paints are steep in all views of the tile.
inline constexpr double maxPlainChange = asset::minSteepChange * 2.83;
/// What the mean of points may be off by.
inline constexpr double maxPlainError = 0.25 / 255;

/// `texels` holds the layers and tables of plain paints, from `firstPair` the pairs of paints beside pieces,
/// ascending, the lists of pieces and, from `firstCell`, the cells row by row; a tile of one paint has one
/// cell. A piece stands in the list of every cell that it matters to, so that a pixel reads its pieces one
/// after the other. Fields are packed from the lowest bit of the first word on.
///
/// - Pair, two texels. First: the paints on the left and on the right as PaintWords. Second: left | right <<
///   16; the steepness of each as a float.
/// - Piece, one texel: a.x, a.y, b.x, b.y (18 bits each), slopes at a and b (12 bits each, signed); texel of
///   its pair << 2 | leftOfCurveBit | leftOfChordBit, as the cell's reference point lies.
/// - Cell, one texel: paint at the reference point | place of that point << 16 | length of the list (lower
///   bits) << lengthShift | crowdedBit; the paint as in a pair; first texel of the list | length >>
///   lowLengthBits << firstTexelBits. With crowdedBit the list is empty: it would take more turns of loops
///   than a pixel may, or more texels than a tile.
struct Tile {
    std::vector<asset::Texel> texels;
    std::uint32_t firstPair = 0, pairs = 0, firstCell = 0;
    CellGrid grid;
    TilePaints paints = TilePaints::Solid;
    bool programs = false;  ///< whether paints are programs, whatever they are there
    /// Of plain paints: what a picture unit changes a channel by, at most; twice that beside programs that
    /// have to be run. In views in which that is steep all are run.
    float steepness = 0;
    bool hasLongLists = false;  ///< so that shaders had better meet two pieces at a time
    CellSets cells;
    /// Whether each reference point has one paint. Where levels of detail have moved boundaries over each
    /// other some may have none, and a cell beside them would be wrong.
    bool isConsistent = true;
};

/// What tiles are cut from.
struct TileSource {
    asset::AssetView asset;  ///< its paints
    const asset::PlanarIndex& pieces;
    const asset::PlanarIndex& exact;              ///< the same without less detail
    std::span<const std::uint32_t> programTurns;  ///< by paint (turns.hpp)
    std::span<const asset::PaintChange> changes;  ///< by paint
    std::uint32_t maxTurns = turnsPerPixel;

    bool hasLessDetail() const { return &pieces != &exact; }
};

/// Writes the colours of solid paints that changed into a tile's texels. `isChanged`: by paint. Returns
/// whether there are some.
bool recolor(std::span<asset::Texel> texels, std::uint32_t firstPair, std::uint32_t pairs,
             std::uint32_t firstCell, std::span<const asset::Paint> paints,
             std::span<const std::uint8_t> isChanged);

/// All cells of which are crowded.
Tile crowdedTile(std::span<const asset::Paint> paints);

/// `margin`: the largest distance from a pixel's centre to its corners, in tile sides, at most 1/4. `near`:
/// at least all pieces that come nearer than that to the tile.
Tile buildTile(const TileSource& source, const TilePlace& place, double margin,
               std::span<const PlanarPiece* const> near);

}  // namespace vtm::gl
