// The asset's texels, addressed by one index.
// Requires: constants texelColumnsLog2, programTag. Twin of: asset/records.hpp.
// Exports: spend, texelAt, low, high, isProgram, solidColor; ASSET_IN, ASSET, ASSET_PART, SECTIONS.

// Which asset? One a program, whose parts are uniforms; or, in the include, one of several, a parameter of every
// function that reads texels: ASSET_IN declares it, ASSET hands it on.
#ifndef ASSET_PART
#define ONE_ASSET
#define ASSET_IN
#define ASSET
#define ASSET_PART(name) name
uniform usampler2D texels;
// First texels of the leaves, pieces, paints and data.
uniform uvec4 sections;
#define SECTIONS sections

// Pictures' loops are counted before they are drawn (backend_gl/core/turns.hpp).
bool spend(float turns) { return true; }
#define SAMPLED_TEXELS 0
#endif

ivec2 texelPlace(uint index) {
    return ivec2(index & ((1u << texelColumnsLog2) - 1u), index >> texelColumnsLog2);
}

// llvmpipe's texelFetch() finds the level's size for each lane, and takes twice as long as a nearest sample. Texels' middles
// are found exactly up to 2^22 of them a side.
uvec4 texelAt(ASSET_IN uint index) {
#if SAMPLED_TEXELS
    return textureLod(ASSET_PART(texels), (vec2(texelPlace(index)) + 0.5) * TEXEL_SIZE, 0.0);
#else
    return texelFetch(ASSET_PART(texels), texelPlace(index), 0);
#endif
}

uint low(uint word) { return word & 0xFFFFu; }
uint high(uint word) { return word >> 16; }

uvec4 paintTexel(ASSET_IN uint paint) { return texelAt(ASSET SECTIONS.z + paint); }
bool isProgram(uvec4 paint) { return paint.w == programTag; }
vec4 solidColor(ASSET_IN uint paint) { return uintBitsToFloat(paintTexel(ASSET paint)); }
