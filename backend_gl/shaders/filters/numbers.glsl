// A primitive's parameters among the asset's texels. Requires: fetch.glsl.
// Exports: number.

uniform uint firstNumber;  // the first parameter's word

float number(uint index) {
    uint word = firstNumber + index;
    uvec4 texel = texelAt(word >> 2);
    uvec2 pair = (word & 2u) == 0u ? texel.xy : texel.zw;
    return uintBitsToFloat((word & 1u) == 0u ? pair.x : pair.y);
}
