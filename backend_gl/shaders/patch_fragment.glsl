// A patch whose regions all have solid colours. Requires: cell.glsl, fetch.glsl.

out vec4 color;

void main() {
    Cell cell = cellAt(gl_FragCoord.xy);
    uvec4 texel = cell.texel;
    vec4 sum = solidColor(referencePaint(cell));
    for (;;) {
        uint count = referenceCount(texel);
        for (uint i = 0u; i < count; ++i) {
            uint reference = referenceAt(texel, i), first = reference >> 2 << 1;
            float weight = pieceWeight(patchPiece(patchTexel(first).xyz, cell.o), cell.way, reference);
            uvec4 colors = patchTexel(first + 1u);
            vec4 left = vec4(colors.xxyy >> uvec4(0u, 16u, 0u, 16u) & 0xFFFFu);
            vec4 right = vec4(colors.zzww >> uvec4(0u, 16u, 0u, 16u) & 0xFFFFu);
            sum += weight / 65535.0 * (left - right);
        }
        if ((texel.x & moreBit) == 0u)
            break;
        texel = patchTexel(texel.w);
    }
    color = sum;
}
