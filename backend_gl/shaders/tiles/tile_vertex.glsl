// Squares of the plane, as triangles of whole tiles or runs of them.
// Exports, flat: what fragments need to know of the tile, and of the view: some drivers read a uniform once for each
// pixel of a vector, wherever it is used, and what is flat once for all.

layout(location = 0) in vec2 position;  // pixels
layout(location = 1) in vec2 origin;    // the tile's least corner, pixels
// First texel; first cell | log2 of the cells a side << gridShift; 0. Of a tile of one paint: that paint's first word
// (backend_gl/tiles/plain_paints.hpp) and 1 + its number instead.
layout(location = 2) in uvec3 texelsOf;
// The least corner in picture coordinates; picture units a tile; tiles a cell.
layout(location = 3) in vec4 picture;
// Of a tile of two colours, the first pair's, as its texel has them.
layout(location = 4) in uvec4 pairOf;

uniform vec2 targetSize;
uniform vec4 toTile;  // distances from pixels to tiles, by columns
// Tile to pixel distances, by columns, mirrored if need be so that areas keep their sign; the box does not care.
uniform vec4 toBox;

flat out vec2 tileOrigin;
flat out uvec3 tileTexels;
flat out vec4 tilePicture;
flat out vec4 pixelToTile, tileToBox;
flat out uvec4 tilePair;

void main() {
    gl_Position = vec4(position / targetSize * 2.0 - 1.0, 0.0, 1.0);
    tileOrigin = origin;
    tileTexels = texelsOf;
    tilePicture = picture;
    pixelToTile = toTile;
    tileToBox = toBox;
    tilePair = pairOf;
}
