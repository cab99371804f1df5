/// \file
/// The tiles of a view in; out come the blocks, upright squares of pixels, by which it is drawn, sorted by
/// what has to be computed in them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include "backend_gl/tiles/atlas.hpp"
#include "backend_gl/tiles/tile_raster.hpp"

namespace vtm::gl {

/// Of flat_vertex.glsl.
struct FlatVertex {
    float position[2];
    float color[4];
};

/// Of block_vertex.glsl.
struct BlockVertex {
    float middle[2];
    float corner[4];
    std::array<std::uint32_t, 4> texels, cells;
    asset::Texel more;
};

/// What has to be computed in a block.
struct BlockWork {
    enum class Kind : std::uint8_t {
        Solid,     ///< pieces between solid colours
        Plain,     ///< pieces between plain paints, some of which may be solid
        OnePlain,  ///< no pieces, a plain paint
        Programs   ///< whatever there is
    };
    Kind kind = Kind::Solid;
    bool crowded = false;                       ///< some cells' pixels are scanned
    bool hasTwoColors = false, isLong = false;  ///< Solid: no others; many pieces in cells
    std::uint8_t points = 0;                    ///< which of rampPoints

    bool operator==(const BlockWork&) const = default;
    /// Whether what draws such blocks draws those of `other`, too.
    bool serves(const BlockWork& other) const;
};

/// Blocks that one program draws.
struct BlockGroup {
    BlockWork work;
    std::vector<BlockVertex> vertices;
};

struct Blocks {
    std::vector<FlatVertex> flat;  ///< two triangles for each rectangle of one colour
    std::vector<BlockGroup> groups;
    std::vector<glm::ivec2> crowded;  ///< the first pixels of such blocks, row by row
    PixelBox drawn;                   ///< holds what may not be transparent
};

/// `tiles`: of the raster's region. `paints`: from the map's first on.
Blocks blocksOf(const TileRaster& raster, const Atlas& atlas, std::span<const asset::Paint> paints,
                const std::vector<const Atlas::Placed*>& tiles);
/// Draws groups of fewer blocks together with others that serve.
Blocks merged(Blocks blocks, std::size_t fewest);
/// All of the map's pixels from the scanner, as those of crowded cells.
Blocks crowdedBlocks(const TileRaster& raster, Atlas& atlas);

}  // namespace vtm::gl
