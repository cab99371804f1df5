// Blocks: upright squares of pixels, drawn as points. Drivers that shade groups of pixels shade none of them twice, as they
// do along the edges of turned squares.
// Exports, flat: what fragments need to know of the block's tiles, and of the view: some drivers read a uniform once for
// each pixel of a vector, wherever it is used, and what is flat once for all.

layout(location = 0) in vec2 middle;  // pixels
// Of the four tiles that a block may meet, the one with the least coordinates: its least corner in pixels, and in picture
// coordinates.
layout(location = 1) in vec4 leastCorner;
// Of each of the four: the first texel, and the first cell | log2 of the cells a side << gridShift.
layout(location = 2) in uvec4 texelsOf;
layout(location = 3) in uvec4 cellsOf;
// Where tiles have two colours, the first pair's, as their texels have them. Of one plain paint, its first word in each
// tile (backend_gl/tiles/plain_paints.hpp). Where cells are crowded, how far from the pixels the scanned ones are.
layout(location = 4) in uvec4 more;

uniform vec2 targetSize;
uniform float blockSide;  // pixels
uniform float sideOfTile;  // picture units
uniform vec4 toTile;  // distances from pixels to tiles, by columns
// Tile to pixel distances, by columns, mirrored if need be so that areas keep their sign; the box does not care.
uniform vec4 toBox;

flat out vec4 tileCorner;
flat out float tileSide;
flat out uvec4 tileTexels, tileCells;
flat out vec4 pixelToTile, tileToBox;
flat out uvec4 blockMore;

void main() {
    gl_Position = vec4(middle / targetSize * 2.0 - 1.0, 0.0, 1.0);
    gl_PointSize = blockSide;
    tileCorner = leastCorner;
    tileSide = sideOfTile;
    tileTexels = texelsOf;
    tileCells = cellsOf;
    pixelToTile = toTile;
    tileToBox = toBox;
    blockMore = more;
}
