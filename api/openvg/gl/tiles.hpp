/// \file
/// Covered rows as rectangles for the GPU: few, whatever the outline. The plane is divided into tiles of 16 ×
/// 16 pixels from the first covered pixel on; tiles that are all covered are joined, and of the others the
/// share of every pixel is given.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "api/openvg/draw/path_mask.hpp"

namespace vtm::openvg::gl {

/// A rectangle of pixels.
struct Tile {
    std::uint16_t x, y, width, height;
    std::uint32_t shares;  ///< where those of its pixels begin, row by row; `allCovered`: all are 1

    static constexpr std::uint32_t allCovered = 0xffffffff;
};

/// Disjoint tiles that hold every covered pixel, and others whose share is 0.
struct Tiles {
    std::vector<Tile> tiles;
    std::vector<float> shares;
    Rectangle box;  ///< around the tiles

    bool areAllCovered() const { return shares.empty(); }
};

/// A rectangle, all of it covered.
Tiles oneTile(const Rectangle& box);

/// The same in parts of about so many shares: no tile has more than 2^19.
std::vector<Tiles> inParts(Tiles tiles, std::size_t shares);

class TileBuilder {
public:
    /// Runs of a row, disjoint and each of a share above 0; places are not negative. Rows may come in any
    /// order, and in parts.
    void add(int y, int first, int end, float share);
    /// Of all that was added.
    Tiles finish();

private:
    struct Run {
        int y, first, end;
        float share;
    };
    enum class Kind : std::uint8_t { empty, partly, all };
    /// Columns of a band whose shares are given, and where those begin.
    struct Block {
        int x0, x1;
        std::size_t shares;
    };

    void addBand(Tiles& tiles, std::span<const Run> runs, int y0, int y1);
    /// Of a band's tiles.
    void findKinds(std::span<const Run> runs, int rows);
    void addCovered(Tiles& tiles, int x0, int x1, int y0, int y1);
    void addBlock(Tiles& tiles, int x0, int x1, int y0, int y1);
    void fillBlocks(Tiles& tiles, std::span<const Run> runs, int y0) const;

    std::vector<Run> runs_;
    Rectangle box_;
    std::vector<Kind> kinds_;
    std::vector<int> covered_, touched_;  ///< by column: rows, as differences to the column before
    std::vector<Block> blocks_;           ///< of a band, from left to right
    /// The last bands' rectangles that may still grow upwards: indices of tiles.
    std::vector<std::size_t> open_, opened_;
};

}  // namespace vtm::openvg::gl
