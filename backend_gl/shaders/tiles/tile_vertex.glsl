// Squares of the plane, as triangles of whole tiles or runs of them.
// Exports, flat: what tile_fragment.glsl and tile_programs_fragment.glsl need to know of the tile.

layout(location = 0) in vec2 position;  // pixels
layout(location = 1) in vec2 origin;    // the tile's least corner, pixels
// First texel; first cell | log2 of the cells a side << gridShift; 0. Of a tile of one paint: that paint's first word
// (backend_gl/tiles/plain_paints.hpp) and 1 + its number instead.
layout(location = 2) in uvec3 texelsOf;
// The least corner in picture coordinates; picture units a tile; tiles a cell.
layout(location = 3) in vec4 picture;

uniform vec2 targetSize;

flat out vec2 tileOrigin;
flat out uvec3 tileTexels;
flat out vec4 tilePicture;

void main() {
    gl_Position = vec4(position / targetSize * 2.0 - 1.0, 0.0, 1.0);
    tileOrigin = origin;
    tileTexels = texelsOf;
    tilePicture = picture;
}
