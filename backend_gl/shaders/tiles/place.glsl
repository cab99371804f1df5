// Where a pixel lies in its tile, and in the picture; the tile's texels.
// Requires: fetch.glsl; block_vertex.glsl's outputs; constant tileStep.
// Exports: pixelToTile, times, Tile, chosen, enterTile, tilePoint, picturePoint, tileTexel, unpackColor.

uniform usampler2D tiles;

flat in vec4 pixelToTile;  // distances, by columns
flat in vec4 tileCorner;
flat in float tileSide;
flat in uvec4 tileTexels, tileCells;

vec2 times(vec4 matrix, vec2 v) { return matrix.xy * v.x + matrix.zw * v.y; }

// The one of the block's tiles that the pixel lies in.
struct Tile {
    vec2 number;  // 0 or 1 along each axis
    uint texels, cells;
} tile;

uint chosen(uvec4 ofTiles) {
    uvec2 row = tile.number.y > 0.5 ? ofTiles.zw : ofTiles.xy;
    return tile.number.x > 0.5 ? row.y : row.x;
}

void enterTile(vec2 pixel) {
    tile.number = clamp(floor(times(pixelToTile, pixel - tileCorner.xy)), 0.0, 1.0);
    tile.texels = chosen(tileTexels);
    tile.cells = chosen(tileCells);
}

// Off the steps on which end points lie, and off the diagonals and axes through them, so that O is no end point,
// which has no direction to itself, and lies on few chords of upright views.
vec2 tilePoint(vec2 pixel) {
    vec2 place = times(pixelToTile, pixel - tileCorner.xy) - tile.number;
    return (floor(place / tileStep) + vec2(0.25, 0.625)) * tileStep;
}

vec2 picturePoint(vec2 tilePoint) { return tileCorner.zw + tileSide * (tile.number + tilePoint); }

uvec4 tileTexel(uint index) { return texelFetch(tiles, texelPlace(tile.texels + index), 0); }

// Times 65535.
vec4 unpackColor(uvec2 words) { return vec4(words.xxyy >> uvec4(0u, 16u, 0u, 16u) & 0xFFFFu); }
