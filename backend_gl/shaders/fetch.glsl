// The asset's texels, addressed by one index.
// Requires: constants texelColumnsLog2, programTag. Twin of: asset/src/records.hpp.
// Exports: texelAt, low, high, sections, isProgram, solidColor.

uniform usampler2D texels;
// First texels of the leaves, pieces, paints and data.
uniform uvec4 sections;

ivec2 texelPlace(uint index) {
    return ivec2(index & ((1u << texelColumnsLog2) - 1u), index >> texelColumnsLog2);
}

uvec4 texelAt(uint index) { return texelFetch(texels, texelPlace(index), 0); }

uint low(uint word) { return word & 0xFFFFu; }
uint high(uint word) { return word >> 16; }

uvec4 paintAt(uint paint) { return texelAt(sections.z + paint); }
bool isProgram(uvec4 paint) { return paint.w == programTag; }
vec4 solidColor(uint paint) { return uintBitsToFloat(paintAt(paint)); }
