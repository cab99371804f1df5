// The cell that a pixel's centre lies in, and its pieces. The only branches are loops: some drivers run both sides of
// every other, fetches and all.
// Requires: fetch.glsl, place.glsl; constants of backend_gl/tiles/tile.hpp; CROWDED defined as 1 where the tile has
// crowded cells, else 0.
// Exports: Cell, cellAt, List, listOf, nextPiece, finishedSum.

uint lowBits(uint word, uint count) { return word & ((1u << count) - 1u); }

struct Cell {
    uvec4 texel;
    vec2 o;    // the pixel's centre, tile sides
    vec2 way;  // from the reference point to it
};

Cell cellAt(vec2 pixel) {
    enterTile(pixel);
    uint log2 = tile.cells >> gridShift;
    float side = float(1u << log2), cellSize = uintBitsToFloat((127u - log2) << 23);
    vec2 o = tilePoint(pixel);
    vec2 place = clamp(floor(o * side), 0.0, side - 1.0);
    uvec4 texel = tileTexel(lowBits(tile.cells, gridShift) + (uint(place.y) << log2) + uint(place.x));
    uvec2 reference = texel.xx >> uvec2(16u, 18u) & 3u;
    return Cell(texel, o, o - (place + (vec2(reference) + 0.5) / 4.0) * cellSize - referenceShift * tileStep);
}

// A cell's pieces, one after the other. That all were met has to be counted: compilers take it for granted that a loop
// ends where the program says.
struct List {
    uint next, left;
};

List listOf(Cell cell) {
    uint low = lowBits(cell.texel.x >> lengthShift, lowLengthBits), high = cell.texel.w >> firstTexelBits;
    return List(lowBits(cell.texel.w, firstTexelBits), low | high << lowLengthBits);
}

// Requires that some are left.
uvec4 nextPiece(inout List list) {
    --list.left;
    return tileTexel(list.next++);
}

// ---- Pixels that were too much ----------------------------------------------------------------------

#if CROWDED
uniform sampler2D layer;  // pixels of crowded cells (backend_gl/tiles/atlas.hpp)
flat in uvec4 blockMore;  // their distance from the block's
#endif

uniform bool markOverruns;

// What a pixel shows: the sum over its cell's pieces; where the cell is crowded, which has none, the scanned pixel; and
// where the driver ended the loops before the last piece, magenta, or the colour at the reference point, made opaque.
vec4 finishedSum(Cell cell, vec4 sum, bool complete) {
    vec4 near = cell.texel.z == plainTag ? vec4(0.0) : unpackColor(cell.texel.yz) / 65535.0;
    vec4 overrun = markOverruns ? vec4(1.0, 0.0, 1.0, 1.0) : vec4(near.rgb + 0.5 * (1.0 - near.a), 1.0);
#if CROWDED
    if ((cell.texel.x & crowdedBit) != 0u)
        return texelFetch(layer, ivec2(gl_FragCoord.xy) + ivec2(blockMore.xy), 0);
#endif
    return complete ? sum : overrun;
}
