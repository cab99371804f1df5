// Where a pixel lies in its tile, and in the picture; the tile's texels.
// Requires: fetch.glsl; tile_vertex.glsl's outputs; constant tileStep.
// Exports: tileOrigin, tileTexels, tilePicture, pixelToTile, times, tilePoint, picturePoint, tileTexel, unpackColor.

uniform usampler2D tiles;

flat in vec4 pixelToTile;  // distances, by columns
flat in vec2 tileOrigin;
flat in uvec3 tileTexels;
flat in vec4 tilePicture;

vec2 times(vec4 matrix, vec2 v) { return matrix.xy * v.x + matrix.zw * v.y; }

// Off the steps on which end points lie, and off the diagonals and axes through them, so that O is no end point,
// which has no direction to itself, and lies on few chords of upright views.
vec2 tilePoint(vec2 pixel) {
    return (floor(times(pixelToTile, pixel - tileOrigin) / tileStep) + vec2(0.25, 0.625)) * tileStep;
}

vec2 picturePoint(vec2 tilePoint) { return tilePicture.xy + tilePicture.z * tilePoint; }

uvec4 tileTexel(uint index) { return texelFetch(tiles, texelPlace(tileTexels.x + index), 0); }

// Times 65535.
vec4 unpackColor(uvec2 words) { return vec4(words.xxyy >> uvec4(0u, 16u, 0u, 16u) & 0xFFFFu); }
