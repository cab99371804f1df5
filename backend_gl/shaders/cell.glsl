// The cell that a pixel's centre lies in, and its pieces. The only branches are loops: some drivers run both sides of
// every other, fetches and all.
// Requires: fetch.glsl, shadow.glsl; patch_vertex.glsl's outputs; constants of src/patch.hpp.
// Exports: patchOrigin, patchTexels, patchPicture, Cell, cellAt, referencePaint, References, referencesOf,
// referenceAt, patchTexel.

uniform usampler2D patches;

flat in vec2 patchOrigin;
flat in uvec3 patchTexels;
flat in vec4 patchPicture;

uvec4 patchTexel(uint index) { return texelFetch(patches, texelPlace(patchTexels.x + index), 0); }

struct Cell {
    uvec4 texel;
    vec2 o;    // the pixel's centre, patch sides
    vec2 way;  // from the reference point to it
};

Cell cellAt(vec2 pixel) {
    const float side = float(1u << patchCellsLog2);
    // Between the steps on which end points lie, so that none of them is O, which has no direction to itself.
    vec2 o = (floor(times(pixelToPatch, pixel - patchOrigin) / patchStep) + 0.5) * patchStep;
    vec2 place = clamp(floor(o * side), 0.0, side - 1.0);
    uvec4 texel = patchTexel(patchTexels.y + (uint(place.y) << patchCellsLog2) + uint(place.x));
    uvec2 reference = texel.xx >> uvec2(16u, 18u) & 3u;
    return Cell(texel, o, o - (place + (vec2(reference) + 0.5) / 4.0) / side);
}

uint referencePaint(Cell cell) { return cell.texel.x & 0xFFFFu; }
uint referenceCount(uvec4 texel) { return texel.x >> 20 & 7u; }

// Number of the i-th piece of the texel << 2 | bits.
uint referenceAt(uvec4 texel, uint i) {
    uint word = (texel.x & wideBit) != 0u ? i * 2u : i;
    uint pair = word < 2u ? texel.y : word < 4u ? texel.z : texel.w;
    return (texel.x & wideBit) != 0u ? pair : pair >> (word << 4 & 16u) & 0xFFFFu;
}
