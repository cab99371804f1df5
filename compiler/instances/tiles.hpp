/// \file
/// Patterns of many tiles in; out come the tiles that other outlines touch, and blocks of tiles that nothing
/// touches, which are placed as maps of maps.
#pragma once

#include <span>
#include <vector>

#include "compiler/instances/layers_at.hpp"
#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// Tiles [x, x + side) × [y, y + side), side = blockTiles^level: all of them free, or level 0.
struct TileBlock {
    unsigned level = 0;
    glm::i64vec2 at{0};
};
inline constexpr std::int64_t blockTiles = 8;  ///< a side of the next smaller blocks

struct TileChoice {
    /// Lowered one by one. If there are blocks the first one is the tile that they are made of, which is not
    /// drawn where it stands.
    std::vector<glm::i64vec2> cut;
    std::vector<TileBlock> blocks;
    bool isImage = false;  ///< too many tiles are cut: there are no others either
};

/// `picture` without any of the patterns' tiles; `tolerance`: Options::tolerance.
std::vector<TileChoice> chooseTiles(const LoweredScene& picture, const Lattice& lattice, glm::dvec2 size,
                                    std::span<const TilePattern> patterns, double tolerance);

/// A pattern as it is placed.
struct TileFill {
    TilePattern pattern;
    std::vector<TileBlock> blocks;
    LayerRange tile;         ///< layers of the tile that blocks are made of
    glm::i64vec2 tileAt{0};  ///< where it stands
};

}  // namespace vtm::compiler
