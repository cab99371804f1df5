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

#include <cstdint>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "backend_gl/core/turns.hpp"
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
/// Cells a side.
inline constexpr unsigned tileCellsLog2 = 4;
inline constexpr double cellSize = 1.0 / (1u << tileCellsLog2);  ///< tile sides
/// Reference points stand on a grid of 2^referenceLog2 a side in their cell, moved by this: in steps of end
/// points, so that none is an end point.
inline constexpr unsigned referenceLog2 = 2;
inline constexpr double referenceShiftX = 0.625, referenceShiftY = 0.25;
/// Coordinates of end points: steps of 2^-tileStepLog2 of a tile from -1, in 18 bits.
inline constexpr unsigned tileStepLog2 = 16, tileCoordinateBits = 18;
/// Slopes have 12 bits; this stands for 1.
inline constexpr double tileSlopeScale = 2047;
/// Sides of the reference point that go with each piece.
inline constexpr std::uint32_t leftOfChordBit = 1, leftOfCurveBit = 2;
/// Bits of the first word of a texel of references: more texels follow; references are whole words. Of a
/// cell: its pixels are made elsewhere.
inline constexpr std::uint32_t moreBit = 1u << 23, wideBit = 1u << 24, crowdedBit = 1u << 25;
/// ... and how many references there are from that texel on.
inline constexpr std::uint32_t referencesMask = (1u << 20) - 1;

/// `texels` holds the pieces, the rest of the longer lists and, from `firstCell`, the cells row by row;
/// nothing if the tile has one paint. Fields are packed from the lowest bit of the first word on.
///
/// - Piece, two texels. First: a.x, a.y, b.x, b.y (18 bits each), slopes at a and b (12 bits each, signed);
///   left | right << 16. Second: the colours on the left and on the right, premultiplied 16-bit unorm red,
///   green, blue, alpha, of solid paints.
/// - Reference, to a piece: its number << 2 | leftOfCurveBit | leftOfChordBit, as the reference point lies.
/// - References, one texel: references from here on | n << 20 | moreBit | wideBit; then n of them in half
/// words, six at most; with
///   moreBit four at most, the last word being the texel with the next ones. With wideBit they are words:
///   three, or two with moreBit.
/// - Cell, one texel: paint at the reference point | place of that point << 16 | as above; the paint's colour
///   as in a piece; then two references in half words at most, or one word with wideBit, or with moreBit, n
///   being 0, the texel with the first ones. With crowdedBit it has none: its list would take more turns of
///   loops than a pixel may.
struct Tile {
    std::uint32_t paint = 0;  ///< of a tile without texels
    std::vector<asset::Texel> texels;
    std::uint32_t pieces = 0, firstCell = 0;
    bool programs = false;              ///< of the paints near it one is a program
    std::vector<std::uint8_t> crowded;  ///< numbers of such cells, ascending
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

/// Writes the colours of paints that changed into a tile's texels, of which the first are so many pieces.
/// `isChanged`: by paint. Returns whether there are some.
bool recolor(std::span<asset::Texel> texels, std::uint32_t pieces, std::uint32_t firstCell,
             std::span<const asset::Paint> paints, std::span<const std::uint8_t> isChanged);

/// All cells of which are crowded.
Tile crowdedTile(std::span<const asset::Paint> paints);

/// `margin`: the largest distance from a pixel's centre to its corners, in tile sides, at most 1/4. `near`:
/// at least all pieces that come nearer than that to the tile.
Tile buildTile(const TileSource& source, const TilePlace& place, double margin,
               std::span<const PlanarPiece* const> near);

}  // namespace vtm::gl
